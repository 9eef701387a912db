//! Formula files: a table that is computed from parameters.
//!
//! ```text
//! PARAMETERS name value … END @v:expr,expr…
//! PARAMETERS name value … END FOR v FROM a TO b BY s WORKING name expr … END VALUES x y … END
//! ```
//!
//! Keywords are read in any case; expressions are those of the library's evaluator.

use super::columns::ColumnTable;
use super::error::TableError;
use super::limits::MAX_FORMULA_ROWS;
use super::lines::{SourceLine, lines, open_comment};
use crate::expr::{Expr, OperandStack, Scope, Value};
use std::collections::HashMap;

/// A formula file.
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaFile {
    /// Name and value of each parameter; they can be set as sub-parameters.
    pub parameters: Vec<(String, f64)>,
    /// The computation of the columns.
    pub body: FormulaBody,
}

/// The computation of the columns of a formula file.
#[derive(Clone, Debug, PartialEq)]
pub enum FormulaBody {
    /// `@v:expr,…`: column c is the (c−1)st element.
    Formula {
        /// The variable.
        variable: String,
        /// The columns from the second on.
        columns: Expr,
    },
    /// A loop that makes the rows.
    Loop(Box<FormulaLoop>),
}

/// The loop of a formula file.
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaLoop {
    /// The loop variable.
    pub variable: String,
    /// First value.
    pub from: Expr,
    /// Last value.
    pub to: Expr,
    /// Step.
    pub by: Expr,
    /// Intermediate results, in order.
    pub working: Vec<Working>,
    /// The columns of a row, from the first on.
    pub values: Vec<Expr>,
}

/// An intermediate result of a loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Working {
    /// Its name.
    pub name: String,
    /// Its expression.
    pub expression: Expr,
}

impl FormulaFile {
    /// True if the first word of the text is PARAMETERS.
    pub fn is_formula(text: &str) -> bool {
        let first = lines(text).find_map(|line| line.text.split_ascii_whitespace().next());
        first.is_some_and(|word| word.eq_ignore_ascii_case("PARAMETERS"))
    }

    /// Reads a formula file.
    ///
    /// # Errors
    /// The line that violates the grammar, and the expected item.
    pub fn parse(text: &str) -> Result<Self, TableError> {
        if let Some(line) = open_comment(text) {
            return Err(TableError::OpenComment { line });
        }
        let mut words = FormulaWords::new(text);
        words.keyword("PARAMETERS")?;
        let mut parameters = Vec::new();
        while let Some(name) = words.until("END")? {
            let value = words.next("the value of the parameter")?;
            parameters.push((name, words.constant(&value)?));
        }
        let first = words.next("a formula `@v:…`, or FOR")?;
        let body = match first.strip_prefix('@').and_then(|rest| rest.split_once(':')) {
            Some((variable, expression)) => {
                let text = expression.to_owned() + &words.rest();
                let columns = words.expression(&text)?;
                FormulaBody::Formula { variable: variable.into(), columns }
            }
            None if first.eq_ignore_ascii_case("FOR") => words.body()?,
            None => return Err(words.expected("a formula `@v:…`, or FOR")),
        };
        Ok(Self { parameters, body })
    }

    /// The columns from the second on at `x`, for a file with a formula; for one with a loop,
    /// use [`FormulaFile::table`]. `parameter` may replace the value of a parameter.
    ///
    /// # Errors
    /// A formula that cannot be computed.
    pub fn columns_at(
        &self,
        x: f64,
        parameter: impl Fn(&str) -> Option<f64>,
    ) -> Result<Option<Value>, TableError> {
        let FormulaBody::Formula { variable, columns } = &self.body else { return Ok(None) };
        let mut names = self.names(parameter);
        names.insert(variable, x);
        evaluate(columns, &names).map(Some)
    }

    /// The table of the file's loop; none for a file with a formula.
    ///
    /// # Errors
    /// A formula that cannot be computed, or a loop without end.
    pub fn table(
        &self,
        parameter: impl Fn(&str) -> Option<f64>,
    ) -> Result<Option<ColumnTable>, TableError> {
        let FormulaBody::Loop(each) = &self.body else { return Ok(None) };
        let FormulaLoop { variable, from, to, by, working, values } = &**each;
        let mut names = self.names(parameter);
        let number = |expr: &Expr, names: &HashMap<&str, f64>| {
            evaluate(expr, names).map(|value| value.number())
        };
        let (mut v, end) = (number(from, &names)?, number(to, &names)?);
        let step = number(by, &names)?;
        // The slack of the FOR loops of programs, so that rounding does not lose the end.
        let slack = 1e-9 * step.abs();
        let mut numbers = Vec::new();
        for _ in 0..MAX_FORMULA_ROWS {
            let inside = if step < 0.0 { v >= end - slack } else { v <= end + slack };
            if !inside {
                return Ok(Some(ColumnTable::from_rows(values.len(), numbers)));
            }
            names.insert(variable, v);
            for result in working {
                let value = number(&result.expression, &names)?;
                names.insert(&result.name, value);
            }
            for value in values {
                numbers.push(number(value, &names)?);
            }
            v += step;
        }
        Err(TableError::TooManyRows)
    }

    fn names(&self, parameter: impl Fn(&str) -> Option<f64>) -> HashMap<&str, f64> {
        let value = |(name, own): &(String, f64)| parameter(name).unwrap_or(*own);
        self.parameters.iter().map(|each| (each.0.as_str(), value(each))).collect()
    }
}

/// The values of the names of an expression.
struct NameValues(Vec<Option<f64>>);

impl Scope for NameValues {
    fn variable(&self, slot: u32) -> Option<&[f64]> {
        self.0.get(slot as usize)?.as_ref().map(std::slice::from_ref)
    }
}

fn evaluate(expr: &Expr, names: &HashMap<&str, f64>) -> Result<Value, TableError> {
    let known = expr.names().iter().map(|name| names.get(name.as_str()).copied()).collect();
    expr.eval(&mut NameValues(known), &mut OperandStack::default()).map_err(|error| {
        TableError::Expression { expression: expr.text().into(), reason: error.to_string() }
    })
}

/// The words of a file and the position of reading.
struct FormulaWords<'t> {
    words: Vec<(usize, &'t str)>,
    at: usize,
}

impl<'t> FormulaWords<'t> {
    fn new(text: &'t str) -> Self {
        let of_line = |line: SourceLine<'t>| {
            line.text.split_ascii_whitespace().map(move |word| (line.number, word))
        };
        Self { words: lines(text).flat_map(of_line).collect(), at: 0 }
    }

    fn next(&mut self, expected: &str) -> Result<String, TableError> {
        let Some((_, word)) = self.words.get(self.at) else { return Err(self.expected(expected)) };
        self.at += 1;
        Ok((*word).to_owned())
    }

    fn keyword(&mut self, keyword: &str) -> Result<(), TableError> {
        let word = self.next(keyword)?;
        if word.eq_ignore_ascii_case(keyword) { Ok(()) } else { Err(self.expected(keyword)) }
    }

    /// The next word, unless it is the keyword.
    fn until(&mut self, keyword: &str) -> Result<Option<String>, TableError> {
        let word = self.next(keyword)?;
        Ok(Some(word).filter(|word| !word.eq_ignore_ascii_case(keyword)))
    }

    /// The remaining words, without white space.
    fn rest(&mut self) -> String {
        let rest = self.words[self.at..].iter().map(|word| word.1).collect();
        self.at = self.words.len();
        rest
    }

    fn expression(&self, text: &str) -> Result<Expr, TableError> {
        Expr::compile_library(text).map_err(|error| TableError::Expression {
            expression: text.into(),
            reason: error.to_string(),
        })
    }

    fn next_expression(&mut self, expected: &str) -> Result<Expr, TableError> {
        let text = self.next(expected)?;
        self.expression(&text)
    }

    fn constant(&self, text: &str) -> Result<f64, TableError> {
        evaluate(&self.expression(text)?, &HashMap::new()).map(|value| value.number())
    }

    /// The loop after FOR.
    fn body(&mut self) -> Result<FormulaBody, TableError> {
        let variable = self.next("the loop variable")?;
        self.keyword("FROM")?;
        let from = self.next_expression("the first value")?;
        self.keyword("TO")?;
        let to = self.next_expression("the last value")?;
        self.keyword("BY")?;
        let by = self.next_expression("the step")?;
        self.keyword("WORKING")?;
        let mut working = Vec::new();
        while let Some(name) = self.until("END")? {
            let expression = self.next_expression("an expression")?;
            working.push(Working { name, expression });
        }
        self.keyword("VALUES")?;
        let mut values = Vec::new();
        while let Some(text) = self.until("END")? {
            values.push(self.expression(&text)?);
        }
        if values.len() < 2 {
            return Err(self.expected("two columns or more behind VALUES"));
        }
        Ok(FormulaBody::Loop(Box::new(FormulaLoop { variable, from, to, by, working, values })))
    }

    /// The error at the word read last, or at the end.
    fn expected(&self, expected: &str) -> TableError {
        let place = self.words.get(self.at.saturating_sub(1)).or(self.words.last());
        TableError::Formula { line: place.map_or(1, |place| place.0), expected: expected.into() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_gives_the_columns_behind_the_first() {
        let text = "PARAMETERS ; Cauchy\n A 1.5\n B 0.004\n K 0.1\nEND\n@x:A+B/x^2,K*x\n";
        assert!(FormulaFile::is_formula(text));
        let file = FormulaFile::parse(text).unwrap();
        let value = file.columns_at(0.5, |_| None).unwrap().unwrap();
        assert_eq!(value.as_slice(), [1.5 + 0.004 / 0.25, 0.05]);
        let changed = file.columns_at(1.0, |name| (name == "B").then_some(0.5)).unwrap().unwrap();
        assert_eq!(changed.first(), 2.0);
    }

    #[test]
    fn a_loop_gives_a_table() {
        let text = "parameters a 2 end for v from 0 to 1 by 0.1 \
                    working w a*v u w+1 end values v u w^2 end";
        let table = FormulaFile::parse(text).unwrap().table(|_| None).unwrap().unwrap();
        assert_eq!((table.columns(), table.rows().len()), (3, 11));
        assert_eq!(table.rows().nth(5).unwrap(), [0.5, 2.0, 1.0]);
    }

    #[test]
    fn violations_of_the_grammar_are_reported_with_their_line() {
        let error = |text| FormulaFile::parse(text).unwrap_err();
        let line = |error| match error {
            TableError::Formula { line, .. } => line,
            other => panic!("{other:?}"),
        };
        assert_eq!(line(error("PARAMETERS\nA 1\nEND\nLOOP\n")), 4);
        assert_eq!(line(error("PARAMETERS\nA 1\n")), 2);
        assert_eq!(line(error("")), 1);
        assert_eq!(line(error("PARAMETERS END FOR x FROM 0\nTILL 1")), 2);
    }

    #[test]
    fn a_loop_without_end_is_refused() {
        let text = "PARAMETERS END FOR v FROM 0 TO 1 BY 0 WORKING END VALUES v v END";
        let file = FormulaFile::parse(text).unwrap();
        assert_eq!(file.table(|_| None), Err(TableError::TooManyRows));
    }
}
