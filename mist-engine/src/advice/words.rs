//! The words of an expression with their places: enough to point at a number or a name.

use std::ops::Range;

/// Kind of a word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// A number without a sign.
    Number(f64),
    /// A variable or function.
    Name,
    /// An operator, a parenthesis, a comma.
    Mark,
}

/// One word.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Word<'t> {
    pub(super) kind: Kind,
    pub(super) text: &'t str,
    pub(super) range: Range<usize>,
}

impl Word<'_> {
    pub(super) fn is(&self, text: &str) -> bool {
        self.text == text
    }
}

/// The words of `text` in their order.
pub(super) fn words(text: &str) -> Vec<Word<'_>> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        let (kind, len) = if first.is_ascii_digit() || first == '.' {
            let len = number_length(rest);
            (Kind::Number(rest[..len].parse().unwrap_or(f64::NAN)), len)
        } else if first.is_ascii_alphabetic() || matches!(first, '#' | '$' | '@') {
            let ends = |c: char| !(c.is_ascii_alphanumeric() || "#$@._".contains(c));
            (Kind::Name, rest.find(ends).unwrap_or(rest.len()))
        } else {
            (Kind::Mark, first.len_utf8())
        };
        if !first.is_whitespace() {
            found.push(Word { kind, text: &rest[..len], range: at..at + len });
        }
        at += len;
    }
    found
}

/// Digits, a point and an exponent.
fn number_length(text: &str) -> usize {
    let digits = |from: usize| {
        let rest = &text[from..];
        rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len())
    };
    let mut len = digits(0);
    if text[len..].starts_with('.') {
        len += 1 + digits(len + 1);
    }
    if text[len..].starts_with(['e', 'E']) {
        let sign = usize::from(text[len + 1..].starts_with(['+', '-']));
        let exponent = digits(len + 1 + sign);
        if exponent > 0 {
            len += 1 + sign + exponent;
        }
    }
    len
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_numbers_names_and_marks() {
        let texts: Vec<_> = words("-2.5e-3*sin( #a.b ,µ.)").into_iter().map(|w| w.text).collect();
        assert_eq!(texts, ["-", "2.5e-3", "*", "sin", "(", "#a.b", ",", "µ", ".", ")"]);
        assert_eq!(words("3exp(1)")[0].kind, Kind::Number(3.0));
        assert_eq!(words("1e5 ")[0].range, 0..3);
    }
}
