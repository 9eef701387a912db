//! Shards of `mist run --shard`, merged.

use std::path::PathBuf;

use mist_runner::merge;
use pyo3::prelude::*;

use crate::error;

/// Merges shards into the table `output`, with listing and samples beside it; gives the number of steps.
#[pyfunction]
pub(crate) fn merge_shards(py: Python<'_>, shards: Vec<PathBuf>, output: PathBuf) -> PyResult<u64> {
    let merged = py.detach(|| merge::merge(&shards, Some(&output)));
    merged.map(|merged| merged.steps).map_err(|failure| {
        let code = if failure.is_refusal() { "sweep/shards" } else { "sweep/disk" };
        error::exception(py, "MistError", &failure.to_string(), code, None, None)
    })
}
