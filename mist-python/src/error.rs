//! Errors of the engine as exceptions of the package.

use mist_engine::{Failure, material::MaterialError};
use mist_format::{Diagnostic, LineIndex};
use pyo3::{
    call::PyCallArgs,
    prelude::*,
    types::{PyDict, PyType},
};

/// The exception class `name` of the module `mist.errors`.
pub(crate) fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyType>> {
    Ok(py.import("mist.errors")?.getattr(name)?.cast_into::<PyType>()?)
}

/// An exception of `mist.errors`: its class, the stable code, the part at fault and the remedy.
pub(crate) fn exception(
    py: Python<'_>,
    name: &str,
    message: &str,
    code: &str,
    part: Option<&str>,
    help: Option<&str>,
) -> PyErr {
    let make = || {
        let keywords = PyDict::new(py);
        keywords.set_item("code", code)?;
        keywords.set_item("part", part)?;
        keywords.set_item("help", help)?;
        class(py, name)?.call((message,), Some(&keywords))
    };
    make().map_or_else(|error| error, PyErr::from_value)
}

/// A `MistError` without a remedy.
pub(crate) fn plain(py: Python<'_>, message: &str, code: &str, part: Option<&str>) -> PyErr {
    exception(py, "MistError", message, code, part, None)
}

/// The exception of an error of a material.
pub(crate) fn of_material(py: Python<'_>, error: &MaterialError) -> PyErr {
    let (name, code) = match error {
        MaterialError::Json(_) => ("ParameterError", "material/json"),
        MaterialError::Model { .. } => ("ParameterError", "model/unknown"),
        MaterialError::Set(error) if error.is_about_the_name() => {
            ("ParameterError", "model/unknown-parameter")
        }
        MaterialError::Set(_) => ("ParameterError", "model/value"),
        MaterialError::Build(_) => ("ParameterError", "model/parameter"),
        MaterialError::Limit(_) => ("LimitError", "run/limit"),
        MaterialError::Request(_) | MaterialError::Patch { .. } => ("MistError", "request"),
        MaterialError::NotFinite(_) => ("MistError", "model/not-finite"),
        MaterialError::Cancelled => ("MistError", "run/cancelled"),
        MaterialError::Program(_) => ("ProgramError", "program"),
    };
    exception(py, name, &error.to_string(), code, error.part(), error.help())
}

/// A diagnostic: code, severity, message, line, column, characters that it marks, help, notes.
pub(crate) type DiagnosticTuple =
    (&'static str, &'static str, String, usize, usize, usize, Option<String>, Vec<String>);

/// Diagnostics of the text of a program as tuples.
pub(crate) fn tuples<'a>(
    diagnostics: impl IntoIterator<Item = &'a Diagnostic>,
    text: &str,
) -> Vec<DiagnosticTuple> {
    let lines = LineIndex::new(text);
    let tuple = |found: &Diagnostic| {
        let at = lines.location(text, found.span.start);
        let severity = if found.is_error() { "error" } else { "warning" };
        let marked = found.span.of(text).lines().next().map_or(0, |part| part.chars().count());
        let notes = found.notes.iter().map(|note| note.message.clone()).collect();
        let (message, help) = (found.message.clone(), found.help.clone());
        (found.code, severity, message, at.line, at.column, marked, help, notes)
    };
    diagnostics.into_iter().map(tuple).collect()
}

/// A warning without a place.
pub(crate) fn placeless(code: &'static str, message: String) -> DiagnosticTuple {
    (code, "warning", message, 0, 0, 0, None, Vec::new())
}

/// The exception of a program that is refused.
pub(crate) fn of_program(py: Python<'_>, diagnostics: &[Diagnostic], text: &str) -> PyErr {
    raise(py, "program_error", (tuples(diagnostics, text), text))
}

/// The exception of a run that failed.
pub(crate) fn of_failure(py: Python<'_>, failure: &Failure, text: &str) -> PyErr {
    match failure {
        Failure::Program(diagnostics) => of_program(py, diagnostics, text),
        Failure::Step { step, fault } => {
            raise(py, "step_error", (*step, tuples([&**fault], text), text))
        }
        Failure::Limit(_) => {
            exception(py, "LimitError", &failure.to_string(), "run/limit", None, None)
        }
        Failure::Cancelled | Failure::Write(_) => {
            exception(py, "MistError", &failure.to_string(), "run/failed", None, None)
        }
    }
}

/// The exception that a function of `mist.errors` makes.
fn raise<'py>(py: Python<'py>, function: &str, arguments: impl PyCallArgs<'py>) -> PyErr {
    let make = || py.import("mist.errors")?.getattr(function)?.call1(arguments);
    make().map_or_else(|error| error, PyErr::from_value)
}
