//! Lookup by name; an unknown name is answered with the accepted names.

use std::fmt::Write as _;

use thiserror::Error;

/// An unknown name.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("unknown {what} `{text}`{}", self.help())]
pub struct UnknownName {
    /// The kind of name: `illuminant`, `observer`, …
    pub what: &'static str,
    /// The text as given.
    pub text: String,
    /// The accepted names similar to the text, best first; often empty.
    pub similar: Vec<String>,
    /// All accepted names, and forms such as `D(kelvin)`.
    pub accepted: Vec<String>,
}

impl UnknownName {
    /// Collects the names similar to `text` out of the accepted ones.
    pub(crate) fn new(what: &'static str, text: &str, accepted: Vec<String>) -> Self {
        let similar = similar(text, accepted.iter().map(String::as_str));
        Self { what, text: text.to_owned(), similar, accepted }
    }

    fn help(&self) -> String {
        let mut help = String::new();
        // Writing to a string does not fail.
        if let Some((best, others)) = self.similar.split_first() {
            let _ = write!(help, "; did you mean {best}");
            for other in others {
                let _ = write!(help, " or {other}");
            }
            help.push('?');
        }
        let _ = write!(help, "; accepted: {}", self.accepted.join(", "));
        help
    }
}

/// The candidates that `text` may be a misspelling of, best first, at most three.
pub(crate) fn similar<'a>(text: &str, candidates: impl Iterator<Item = &'a str>) -> Vec<String> {
    // 0.8 lets one wrong or missing letter in a word of five pass and unrelated words not.
    const ENOUGH: f64 = 0.8;
    let folded = fold(text);
    let mut scored: Vec<(f64, &str)> = candidates
        .map(|name| (strsim::jaro_winkler(&folded, &fold(name)), name))
        .filter(|(score, _)| *score >= ENOUGH)
        .collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    scored.into_iter().take(3).map(|(_, name)| name.to_owned()).collect()
}

/// Lower case without blanks, `-` and `_`, for the comparison of names.
pub(crate) fn fold(text: &str) -> String {
    text.chars()
        .filter(|c| !(c.is_whitespace() || matches!(c, '-' | '_')))
        .flat_map(char::to_lowercase)
        .collect()
}

/// The arguments of `name(a, b, …)` or `name(a b …)`: the folded name and the numbers.
///
/// `None` if the text does not have this form or an argument is not a finite number.
pub(crate) fn call(text: &str) -> Option<(String, Vec<f64>)> {
    let (name, rest) = text.trim().split_once('(')?;
    Some((fold(name), numbers(rest.strip_suffix(')')?)?))
}

/// Finite numbers separated by blanks or commas; `None` if one is not a number.
pub(crate) fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split([',', ' ', '\t'])
        .filter(|piece| !piece.is_empty())
        .map(|piece| piece.parse().ok().filter(|number: &f64| number.is_finite()))
        .collect()
}

/// One value of a closed list, with its name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NamedValue<T>(pub(crate) &'static str, pub(crate) T);

impl<T: Copy + PartialEq> NamedValue<T> {
    /// The value called `text`, ignoring case, blanks, `-` and `_`.
    pub(crate) fn find(what: &'static str, text: &str, list: &[Self]) -> Result<T, UnknownName> {
        let folded = fold(text);
        match list.iter().find(|named| fold(named.0) == folded) {
            Some(named) => Ok(named.1),
            None => {
                let accepted = list.iter().map(|named| named.0.to_owned()).collect();
                Err(UnknownName::new(what, text, accepted))
            }
        }
    }

    /// The first name of a value; empty if it has none.
    pub(crate) fn name_of(list: &[Self], value: T) -> &'static str {
        list.iter().find(|named| named.1 == value).map_or("", |named| named.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_name_is_answered_with_the_similar_ones() {
        let list = [NamedValue("Bradford", 1), NamedValue("CAT02", 2), NamedValue("CAT16", 3)];
        assert_eq!(NamedValue::find("adaptation", "cat_02", &list), Ok(2));
        let unknown = NamedValue::find("adaptation", "Bradfrod", &list).unwrap_err();
        assert_eq!(unknown.similar, ["Bradford"]);
        assert_eq!(
            unknown.to_string(),
            "unknown adaptation `Bradfrod`; did you mean Bradford?; \
             accepted: Bradford, CAT02, CAT16"
        );
    }

    #[test]
    fn calls_are_read_with_their_numbers() {
        assert_eq!(call(" linear(0.5, 1,0) "), Some(("linear".to_owned(), vec![0.5, 1.0, 0.0])));
        assert_eq!(call("D( 5003 )"), Some(("d".to_owned(), vec![5003.0])));
        for bad in ["linear", "linear(", "linear(x)", "linear(nan)", "linear(1) 2"] {
            assert_eq!(call(bad), None, "{bad}");
        }
    }
}
