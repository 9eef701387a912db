//! Reads the fields of a JSON object; errors name the case and the field.

use std::fmt::Display;

use serde_json::{Map, Value};

use super::error::CaseError;
use crate::name::similar;

/// An object of a request, with its path.
#[derive(Clone, Copy)]
pub(super) struct CaseFields<'a> {
    case: &'a str,
    path: &'a str,
    object: &'a Map<String, Value>,
}

impl<'a> CaseFields<'a> {
    /// The fields of `value`, which is `path` (empty: the case itself) of a case.
    pub(super) fn new(case: &'a str, path: &'a str, value: &'a Value) -> Result<Self, CaseError> {
        match value.as_object() {
            Some(object) => Ok(Self { case, path, object }),
            None => Err(CaseError::new(
                case,
                path,
                format!("expected an object, got {}", json_type(value)),
            )),
        }
    }

    pub(super) fn case(&self) -> &'a str {
        self.case
    }

    /// An error at a field.
    pub(super) fn error(&self, name: &str, problem: impl Display) -> CaseError {
        CaseError::new(self.case, &self.path_to(name), problem)
    }

    /// The path of a field of this object.
    pub(super) fn path_to(&self, name: &str) -> String {
        if self.path.is_empty() { name.to_owned() } else { format!("{}.{name}", self.path) }
    }

    /// Refuses fields that resemble one of `known`. Other fields are notes.
    pub(super) fn refuse_misspelt(&self, known: &[&str]) -> Result<(), CaseError> {
        for name in self.object.keys().filter(|name| !known.contains(&name.as_str())) {
            let absent = known.iter().copied().filter(|known| !self.object.contains_key(*known));
            if let Some(meant) = similar(name, absent).first().filter(|m| close(name, m)) {
                return Err(self.error(name, format!("unknown field; did you mean {meant}?")));
            }
        }
        Ok(())
    }

    /// A field; absent and null are the same.
    pub(super) fn get(&self, name: &str) -> Option<&'a Value> {
        self.object.get(name).filter(|value| !value.is_null())
    }

    /// True if the field exists, even as null.
    pub(super) fn has(&self, name: &str) -> bool {
        self.object.contains_key(name)
    }

    pub(super) fn required(&self, name: &str) -> Result<&'a Value, CaseError> {
        self.get(name).ok_or_else(|| self.error(name, "missing"))
    }

    pub(super) fn number(&self, name: &str) -> Result<Option<f64>, CaseError> {
        self.get(name).map(|value| self.as_number(name, value)).transpose()
    }

    pub(super) fn required_number(&self, name: &str) -> Result<f64, CaseError> {
        self.as_number(name, self.required(name)?)
    }

    pub(super) fn text(&self, name: &str) -> Result<Option<&'a str>, CaseError> {
        let as_text = |value: &'a Value| {
            value
                .as_str()
                .ok_or_else(|| self.error(name, format!("expected text, got {}", json_type(value))))
        };
        self.get(name).map(as_text).transpose()
    }

    pub(super) fn list(&self, name: &str) -> Result<Option<&'a [Value]>, CaseError> {
        let as_list = |value: &'a Value| match value.as_array() {
            Some(list) => Ok(list.as_slice()),
            None => Err(self.error(name, format!("expected a list, got {}", json_type(value)))),
        };
        self.get(name).map(as_list).transpose()
    }

    pub(super) fn required_numbers(&self, name: &str) -> Result<Vec<f64>, CaseError> {
        self.as_numbers(name, self.required(name)?)
    }

    /// A list of numbers; `name` may be a path such as `stokes[2]`.
    pub(super) fn as_numbers(&self, name: &str, value: &Value) -> Result<Vec<f64>, CaseError> {
        let Some(list) = value.as_array() else {
            return Err(
                self.error(name, format!("expected a list of numbers, got {}", json_type(value)))
            );
        };
        let numbers = list.iter().enumerate();
        numbers.map(|(i, value)| self.as_number(&format!("{name}[{i}]"), value)).collect()
    }

    fn as_number(&self, name: &str, value: &Value) -> Result<f64, CaseError> {
        match value.as_f64().filter(|number| number.is_finite()) {
            Some(number) => Ok(number),
            None => {
                Err(self.error(name, format!("expected a finite number, got {}", json_type(value))))
            }
        }
    }
}

/// True if two field names differ by at most two letters.
fn close(name: &str, meant: &str) -> bool {
    strsim::damerau_levenshtein(name, meant) <= 2
}

fn json_type(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "a truth value",
        Value::Number(_) => "a number",
        Value::String(_) => "text",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    }
}
