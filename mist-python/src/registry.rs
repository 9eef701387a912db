//! The classes of the registry, for signatures, completion and documents.

use mist_runner::registry;
use pyo3::prelude::*;

/// All classes with their parameters, by family, as JSON.
#[pyfunction]
pub(crate) fn families() -> String {
    registry::list().to_string()
}
