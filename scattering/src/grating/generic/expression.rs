//! The arithmetic of description files: + − * / ^, parentheses, functions, names.
//!
//! All operators associate to the left, `^` too. A minus at the start of an expression is
//! 0 −, so −2^2 is −4; after an operator it belongs to the number, so 3*−2^2 is 12.

use std::collections::BTreeMap;

/// Names and their values.
pub(super) type Constants = BTreeMap<String, f64>;

/// The value of `text`.
pub(super) fn evaluate(text: &str, scope: &Constants) -> Result<f64, String> {
    match tuple(text, scope)?[..] {
        [value] => Ok(value),
        _ => Err(format!("{text:?} is not one value")),
    }
}

/// The values of `text`, one expression or several as `(a,b,…)`; none if it is blank.
pub(super) fn tuple(text: &str, scope: &Constants) -> Result<Vec<f64>, String> {
    let mut reader = ExpressionParser { text, at: 0, scope, depth: 0 };
    if reader.peek().is_none() {
        return Ok(Vec::new());
    }
    let values = reader.tuple().or_else(|_| {
        reader = ExpressionParser { text, at: 0, scope, depth: 0 };
        reader.sum().map(|value| vec![value])
    })?;
    match reader.peek() {
        None => Ok(values),
        Some(_) if values.len() == 1 => {
            // A parenthesis that was only the beginning of an expression.
            reader = ExpressionParser { text, at: 0, scope, depth: 0 };
            let value = reader.sum()?;
            reader.peek().map_or(Ok(vec![value]), |_| Err(reader.wrong("an operator")))
        }
        Some(_) => Err(reader.wrong("the end")),
    }
}

/// Deepest nesting of parentheses; a file is not trusted with the stack.
const DEEPEST: usize = 100;

struct ExpressionParser<'a> {
    text: &'a str,
    at: usize,
    scope: &'a Constants,
    depth: usize,
}

impl ExpressionParser<'_> {
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        self.text[self.at..].chars().next()
    }

    fn take(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.at += wanted.len_utf8();
        }
        found
    }

    fn wrong(&self, expected: &str) -> String {
        format!("{:?}: expected {expected} at {:?}", self.text, &self.text[self.at..])
    }

    fn tuple(&mut self) -> Result<Vec<f64>, String> {
        if !self.take('(') {
            return Err(self.wrong("("));
        }
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err("parentheses are nested too deeply".to_owned());
        }
        let mut values = vec![self.sum()?];
        while self.take(',') {
            values.push(self.sum()?);
        }
        self.depth -= 1;
        if self.take(')') { Ok(values) } else { Err(self.wrong(")")) }
    }

    fn sum(&mut self) -> Result<f64, String> {
        let mut value = if self.take('-') { -self.product()? } else { self.product()? };
        loop {
            if self.take('+') {
                value += self.product()?;
            } else if self.take('-') {
                value -= self.product()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn product(&mut self) -> Result<f64, String> {
        let mut value = self.power()?;
        loop {
            if self.take('*') {
                value *= self.power()?;
            } else if self.take('/') {
                value /= self.power()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn power(&mut self) -> Result<f64, String> {
        let mut value = self.operand()?;
        while self.take('^') {
            value = value.powf(self.operand()?);
        }
        Ok(value)
    }

    fn operand(&mut self) -> Result<f64, String> {
        match self.peek() {
            Some('-') => {
                self.at += 1;
                self.atom().map(|value| -value)
            }
            Some('+') => {
                self.at += 1;
                self.atom()
            }
            _ => self.atom(),
        }
    }

    fn atom(&mut self) -> Result<f64, String> {
        match self.peek() {
            Some('(') => match self.tuple()?[..] {
                [value] => Ok(value),
                _ => Err(self.wrong("one value in parentheses")),
            },
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_alphabetic() || c == '_' => self.name(),
            _ => Err(self.wrong("a value")),
        }
    }

    fn number(&mut self) -> Result<f64, String> {
        let rest = &self.text.as_bytes()[self.at..];
        let digits = |from: usize| {
            rest[from..].iter().take_while(|b| b.is_ascii_digit() || **b == b'.').count()
        };
        let mut length = digits(0);
        if matches!(rest.get(length), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(rest.get(length + 1), Some(b'+' | b'-')));
            let exponent = digits(length + 1 + sign);
            if exponent > 0 {
                length += 1 + sign + exponent;
            }
        }
        let text = &self.text[self.at..self.at + length];
        let value = text.parse().map_err(|_| self.wrong("a number"))?;
        self.at += length;
        Ok(value)
    }

    fn name(&mut self) -> Result<f64, String> {
        let rest = &self.text[self.at..];
        let length = rest
            .find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '.'))
            .unwrap_or(rest.len());
        let name = &rest[..length];
        self.at += length;
        if self.peek() == Some('(') {
            let arguments = self.tuple()?;
            return function(name, &arguments)
                .ok_or_else(|| format!("no function {name} of {} arguments", arguments.len()));
        }
        self.scope.get(name).copied().ok_or_else(|| format!("no value is called {name}"))
    }
}

fn function(name: &str, arguments: &[f64]) -> Option<f64> {
    match *arguments {
        [x] => Some(match name {
            "exp" => x.exp(),
            "log" => x.ln(),
            "log10" => x.log10(),
            "sqrt" => x.sqrt(),
            "abs" => x.abs(),
            "sin" => x.sin(),
            "cos" => x.cos(),
            "tan" => x.tan(),
            "asin" => x.asin(),
            "acos" => x.acos(),
            "atan" => x.atan(),
            "sind" => x.to_radians().sin(),
            "cosd" => x.to_radians().cos(),
            "tand" => x.to_radians().tan(),
            "asind" => x.asin().to_degrees(),
            "acosd" => x.acos().to_degrees(),
            "atand" => x.atan().to_degrees(),
            "sinh" => x.sinh(),
            "cosh" => x.cosh(),
            "tanh" => x.tanh(),
            _ => return None,
        }),
        [x, y] => Some(match name {
            "atan2" => x.atan2(y),
            "atan2d" => x.atan2(y).to_degrees(),
            "min" => x.min(y),
            "max" => x.max(y),
            _ => return None,
        }),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_have_the_precedence_of_the_file_format() {
        let scope = Constants::from([("w".to_owned(), 0.4)]);
        for (text, value) in [
            ("-2^2", -4.0),
            ("3*-2^2", 12.0),
            ("2^3^2", 64.0),
            ("(1+2)*3", 9.0),
            ("-w/2", -0.2),
            ("sqrt(9)+max(1,2)", 5.0),
            ("1e-3*2", 0.002),
        ] {
            assert!((evaluate(text, &scope).unwrap() - value).abs() < 1e-15, "{text}");
        }
        assert_eq!(tuple(" (1, w) ", &scope), Ok(vec![1.0, 0.4]));
        assert_eq!(tuple("", &scope), Ok(vec![]));
    }

    #[test]
    fn nonsense_is_an_error_that_quotes_it() {
        for text in ["(1,", "1+", "x", "sin(1,2)", "3 4", "(1)2", &"(".repeat(500)] {
            assert!(evaluate(text, &Constants::new()).is_err(), "{text}");
        }
    }
}
