//! Results of runs: the texts, and the numbers before they are rounded.

use std::io;

use mist_engine::{OutputStream, RunSummary, Sink, TableLine};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

use crate::error::DiagnosticTuple;

/// Keeps the texts of a run and the numbers of its rows.
#[derive(Default)]
pub(crate) struct ResultSink {
    texts: [String; 3],
    loops: Vec<String>,
    coordinates: Vec<f64>,
    outputs: Vec<f64>,
    errors: Vec<f64>,
    rows: usize,
}

impl Sink for ResultSink {
    fn write(&mut self, stream: OutputStream, text: &str) -> io::Result<()> {
        self.texts[stream as usize].push_str(text);
        Ok(())
    }

    fn row(&mut self, line: &TableLine) -> io::Result<()> {
        self.loops.extend(line.loops().map(str::to_owned));
        self.coordinates.extend(line.coordinates());
        self.outputs.extend(line.outputs());
        self.errors.extend(line.errors());
        self.rows += 1;
        Ok(())
    }
}

/// The result of a run.
#[pyclass(frozen, name = "Result", module = "mist._native")]
pub(crate) struct NativeResult {
    sink: ResultSink,
    steps: u64,
    evaluations: f64,
    seconds: f64,
    notices: Vec<DiagnosticTuple>,
}

impl NativeResult {
    pub(crate) fn new(
        sink: ResultSink,
        summary: RunSummary,
        notices: Vec<DiagnosticTuple>,
    ) -> Self {
        let RunSummary { steps, evaluations, seconds, .. } = summary;
        Self { sink, steps, evaluations, seconds, notices }
    }

    fn text(&self, stream: OutputStream) -> &str {
        &self.sink.texts[stream as usize]
    }

    /// Numbers as an array with a row per step.
    fn rows<'py>(&self, py: Python<'py>, numbers: &[f64]) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows = self.sink.rows;
        let columns = if rows == 0 { 0 } else { numbers.len() / rows };
        PyArray1::from_slice(py, numbers).reshape([rows, columns])
    }
}

#[pymethods]
impl NativeResult {
    /// The table as `mist run` writes it.
    #[getter]
    fn results(&self) -> &str {
        self.text(OutputStream::Results)
    }

    /// The listing.
    #[getter]
    fn listing(&self) -> &str {
        self.text(OutputStream::Listing)
    }

    /// The samples.
    #[getter]
    fn samples(&self) -> &str {
        self.text(OutputStream::Samples)
    }

    /// Texts of the columns of the loops, row by row.
    #[getter]
    fn loops(&self) -> Vec<String> {
        self.sink.loops.clone()
    }

    /// Values of the loops.
    fn coordinates<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.rows(py, &self.sink.coordinates)
    }

    /// Values of the outputs.
    fn outputs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.rows(py, &self.sink.outputs)
    }

    /// Estimated errors, in the order of their columns.
    fn errors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.rows(py, &self.sink.errors)
    }

    /// Number of steps.
    #[getter]
    fn steps(&self) -> u64 {
        self.steps
    }

    /// Evaluations of the model.
    #[getter]
    fn evaluations(&self) -> f64 {
        self.evaluations
    }

    /// Seconds it took.
    #[getter]
    fn seconds(&self) -> f64 {
        self.seconds
    }

    /// Warnings of the program and of its run.
    #[getter]
    fn notices(&self) -> Vec<DiagnosticTuple> {
        self.notices.clone()
    }
}
