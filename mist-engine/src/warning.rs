//! Warnings about requests and materials, which have no place in the text of a program.

use std::fmt;

use mist_format::Diagnostic;
use scattering::Notice;
use serde::Serialize;
use spectra::case::CaseWarning;

/// A remark on a result that is probably not what was meant.
///
/// Mistakes in the text of a program are [`Diagnostic`]s of the severity warning, which have a
/// place; `From` makes a warning of one.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Warning {
    /// Stable code, such as `angle/degrees`.
    pub code: &'static str,
    /// The problem, with the part of the request that it is about; in lower case without full stop.
    pub message: String,
    /// The remedy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub help: Option<String>,
}

impl Warning {
    /// A warning without help.
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), help: None }
    }

    /// The warning with a remedy.
    #[must_use]
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// The warning that a model is outside of its range, if `notice` is one.
    pub fn of_notice(notice: &Notice) -> Option<Self> {
        match notice {
            Notice::Limit(_) => Some(Self::new("model/limit", notice.to_string())),
            Notice::Defect(_) => None,
        }
    }
}

impl From<&Diagnostic> for Warning {
    fn from(found: &Diagnostic) -> Self {
        Self { code: found.code, message: found.message.clone(), help: found.help.clone() }
    }
}

impl From<&CaseWarning> for Warning {
    fn from(found: &CaseWarning) -> Self {
        let CaseWarning { id, code, message, help } = found;
        Self::new(code, format!("case {id}: {message}")).help(help)
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "warning[{}]: {}", self.code, self.message)?;
        match &self.help {
            Some(help) => write!(f, "; {help}"),
            None => Ok(()),
        }
    }
}
