//! Errors of setting a parameter.

use mist_format::{Diagnostic, Span};

/// A parameter that cannot be set, with its dotted name and what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("parameter {path}: {problem}")]
pub struct SetError {
    /// The name as the program wrote it.
    pub path: String,
    /// Description of the error.
    pub problem: String,
    /// Text to write instead.
    pub help: Option<String>,
    about_the_name: bool,
}

impl SetError {
    /// A text that is not a value of the parameter.
    pub(crate) fn value(problem: impl Into<String>) -> Self {
        Self { path: String::new(), problem: problem.into(), help: None, about_the_name: false }
    }

    /// A name that is not known.
    pub(crate) fn name(problem: impl Into<String>) -> Self {
        Self { about_the_name: true, ..Self::value(problem) }
    }

    pub(crate) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    pub(crate) fn help_if(self, help: Option<String>) -> Self {
        Self { help: help.or(self.help), ..self }
    }

    pub(crate) fn named(self, path: &str) -> Self {
        Self { path: path.to_owned(), ..self }
    }

    /// True if the name is wrong, not the value.
    pub fn is_about_the_name(&self) -> bool {
        self.about_the_name
    }

    /// The error as a diagnostic at `span`.
    pub fn diagnostic(&self, span: Span) -> Diagnostic {
        let code = if self.about_the_name { "model/unknown-parameter" } else { "model/value" };
        let usual = if self.about_the_name {
            "`mist models NAME` lists the parameters of a class"
        } else {
            "`mist models NAME` says what a parameter takes; files are looked for in the working \
             folder, beside the program and along SCATMECH"
        };
        Diagnostic::error(code, span, self.to_string()).help(usual).help_if(self.help.clone())
    }
}
