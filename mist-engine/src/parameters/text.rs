//! The texts of numbers, integers and class names.

use mist_format::{
    number::{integer_prefix, number_prefix, whole_number, without_unit},
    suggestion::did_you_mean,
};
use scattering::{Family, Mode, registry, spec::number_text};

use super::error::SetError;
use crate::deviation::EngineDeviation;

/// A number: the whole text, or under compat its longest numeric beginning (0 without one).
pub(super) fn number(text: &str, mode: Mode) -> Result<f64, SetError> {
    if let Some(x) = whole_number(text) {
        return Ok(x);
    }
    let prefix = number_prefix(text.as_bytes());
    if EngineDeviation::NumericPrefix.applies_in(mode) {
        return Ok(prefix.value.unwrap_or(0.0));
    }
    let error = SetError::value(format!("{text:?} is not a number"));
    let unit = prefix
        .value
        .and_then(|_| without_unit(text[..prefix.taken].trim(), text[prefix.taken..].trim()));
    if let Some(help) = unit {
        return Err(error.help(help));
    }
    Err(match prefix.value {
        Some(x) => error.help(format!(
            "write {x}, or use `#` in place of `$` for an expression; NIST's program reads {x}"
        )),
        None => error.help("NIST's program reads 0; use `#` in place of `$` for an expression"),
    })
}

pub(super) fn integer(text: &str, mode: Mode) -> Result<i32, SetError> {
    let prefix = integer_prefix(text);
    let value = prefix.value.and_then(|value| i32::try_from(value).ok());
    if EngineDeviation::NumericPrefix.applies_in(mode) {
        return Ok(value.unwrap_or(0));
    }
    let whole = prefix.taken == text.trim_end().len();
    value.filter(|_| whole).ok_or_else(|| {
        SetError::value(format!("{text:?} is not an integer"))
            .help(format!("NIST's program reads {}", value.unwrap_or(0)))
    })
}

/// The class called `name`, at or below `base`.
pub(super) fn member(
    name: &str,
    family: &Family,
    base: &str,
) -> Result<&'static scattering::Class, SetError> {
    let found = family.class(name);
    let found = found.filter(|class| family.is_below(class.name, base));
    found.ok_or_else(|| {
        let abstract_class = name == base || registry::is_abstract(name);
        let problem = if abstract_class {
            format!("{name} is a family of classes, not one of them")
        } else {
            format!("there is no {base} called {name:?}")
        };
        let classes = family.classes().into_iter().map(|class| class.name);
        let choices: Vec<&str> = classes.filter(|choice| family.is_below(choice, base)).collect();
        let all = format!("choose one of {}", choices.join(", "));
        SetError::value(problem).help(all).help_if(did_you_mean(name, choices))
    })
}

/// The shortest text of numbers as an element of a vector, such as `(1.5,0)`.
pub(super) fn vector(values: &[f64]) -> String {
    match values {
        [x] => number_text(*x),
        values => {
            let texts: Vec<String> = values.iter().copied().map(number_text).collect();
            format!("({})", texts.join(","))
        }
    }
}
