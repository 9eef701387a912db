//! Programs: compiled, checked and run.

use std::{
    collections::BTreeMap,
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

use mist_engine::{
    Control, Job, Limits, Options, Warning, compile,
    function::{FunctionError, ProgramFunction},
};
use mist_format::{Diagnostic, Dialect};
use pyo3::{exceptions::PyValueError, prelude::*};
use scattering::Mode;

use crate::{
    error::{self, DiagnosticTuple},
    files::RecordedFiles,
    result::{NativeResult, ResultSink},
    watch,
};

/// Least time between two reports of progress.
const REPORT: Duration = Duration::from_millis(100);

/// A compiled program.
#[pyclass(frozen, name = "Program", module = "mist._native")]
pub(crate) struct NativeProgram {
    job: Job,
    text: String,
    files: Arc<RecordedFiles>,
    options: Options,
}

#[pymethods]
impl NativeProgram {
    #[new]
    #[pyo3(signature = (text, files, path, compat, seed, limits))]
    fn new(
        py: Python<'_>,
        text: String,
        files: BTreeMap<String, String>,
        path: Option<PathBuf>,
        compat: bool,
        seed: u64,
        limits: [Option<f64>; 4],
    ) -> PyResult<Self> {
        let mode = if compat { Mode::Compat } else { Mode::Sound };
        let job = path.as_ref().and_then(|path| path.file_stem());
        let job = job.map_or_else(|| "job".to_owned(), |stem| stem.to_string_lossy().into_owned());
        let options = Options { mode, job, seed, limits: limits_of(limits)? };
        let files = Arc::new(RecordedFiles::beside(files, &path.unwrap_or_default()));
        let compiled = py.detach(|| compile(&text, files.clone(), &options));
        match compiled {
            Ok(job) => Ok(Self { job, text, files, options }),
            Err(diagnostics) => Err(error::of_program(py, &diagnostics, &text)),
        }
    }

    /// The text.
    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    /// Names and texts of the data files that were read so far.
    #[getter]
    fn files(&self) -> BTreeMap<String, String> {
        self.files.read().into_iter().map(|(name, text)| (name, text.to_string())).collect()
    }

    /// Titles of the columns of the loops, of the outputs, and of the errors with the positions of
    /// their outputs.
    #[allow(clippy::type_complexity)] // The tuple that Python sees.
    fn columns(&self) -> (Vec<String>, Vec<String>, Vec<(String, Option<usize>)>) {
        let [loops, outputs] =
            self.job.columns().map(|all| all.into_iter().map(str::to_owned).collect());
        let errors = self.job.error_columns().into_iter();
        (loops, outputs, errors.map(|(title, after)| (title.to_owned(), after)).collect())
    }

    /// Name of the class of the model.
    #[getter]
    fn model(&self) -> &'static str {
        self.job.class().name
    }

    /// Everything that is probably a mistake.
    fn advice(&self) -> Vec<DiagnosticTuple> {
        error::tuples(&self.job.advice(), &self.text)
    }

    /// Number of steps of its loops.
    fn steps(&self, py: Python<'_>) -> PyResult<u64> {
        let counted = watch::run(
            py,
            None,
            |flag| self.job.count_steps(&Control { cancel: flag.clone(), progress: None }),
            |_| Ok(()),
        )?;
        counted.map_err(|failure| error::of_failure(py, &failure, &self.text))
    }

    /// Runs it with other values for some variables.
    #[pyo3(signature = (values, threads, progress))]
    fn run(
        &self,
        py: Python<'_>,
        values: Vec<(String, f64)>,
        threads: Option<usize>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<NativeResult> {
        let job = self.with_values(py, values)?;
        let done = Arc::new(AtomicU64::new(0));
        let mut told = Instant::now();
        let work = |flag: &Arc<AtomicBool>| {
            let done = done.clone();
            let report = move |part: f64| done.store(part.to_bits(), Ordering::Relaxed);
            let control = Control { cancel: flag.clone(), progress: Some(Box::new(report)) };
            let mut sink = ResultSink::default();
            job.run(&mut sink, &control).map(|summary| (sink, summary))
        };
        let look = |_: Python<'_>| match &progress {
            Some(progress) if told.elapsed() >= REPORT => {
                told = Instant::now();
                progress.call1((f64::from_bits(done.load(Ordering::Relaxed)),)).map(drop)
            }
            _ => Ok(()),
        };
        let (sink, summary) = watch::run(py, threads, work, look)?
            .map_err(|failure| error::of_failure(py, &failure, &self.text))?;
        if let Some(progress) = &progress {
            progress.call1((1.0,))?;
        }
        let slips = job.slips();
        let warnings = slips.iter().chain(&summary.warnings).collect::<Vec<&Diagnostic>>();
        let mut notices = error::tuples(warnings, &self.text);
        for notice in &summary.met {
            let code =
                if Warning::of_notice(notice).is_some() { "model/limit" } else { "model/defect" };
            notices.push(error::placeless(code, notice.to_string()));
        }
        Ok(NativeResult::new(sink, summary, notices))
    }
}

impl NativeProgram {
    /// The text.
    pub(crate) fn source(&self) -> &str {
        &self.text
    }

    /// The program as a function of the variables `names`.
    pub(crate) fn function(&self, names: &[String]) -> Result<ProgramFunction, FunctionError> {
        ProgramFunction::new(&self.text, self.files.clone(), self.options.clone(), names)
    }

    /// The job with other values for some variables.
    fn with_values(&self, py: Python<'_>, values: Vec<(String, f64)>) -> PyResult<Job> {
        if values.is_empty() {
            return Ok(self.job.clone());
        }
        let (names, values): (Vec<String>, Vec<f64>) = values.into_iter().unzip();
        let variables: Result<Vec<_>, _> =
            names.iter().map(|name| self.job.variable(name)).collect();
        let variables = variables.map_err(|error| {
            let message = error.to_string();
            error::exception(py, "ParameterError", &message, "program/variable", None, None)
        })?;
        self.job
            .with_values(&variables, &values)
            .map_err(|diagnostics| error::of_program(py, &diagnostics, &self.text))
    }
}

/// Limits of a run: evaluations, directions of an integral, steps, seconds; those that are none
/// are the engine's.
fn limits_of([evaluations, directions, steps, seconds]: [Option<f64>; 4]) -> PyResult<Limits> {
    let usual = Limits::default();
    let time =
        match seconds {
            None => None,
            Some(seconds) => Some(Duration::try_from_secs_f64(seconds).map_err(|error| {
                PyValueError::new_err(format!("a limit of {seconds} s: {error}"))
            })?),
        };
    Ok(Limits {
        evaluations: evaluations.unwrap_or(usual.evaluations),
        directions: directions.unwrap_or(usual.directions),
        steps: steps.map_or(usual.steps, |steps| steps as u64),
        time,
    })
}

/// The program in the layout of `mist fmt`.
#[pyfunction]
pub(crate) fn formatted(py: Python<'_>, text: &str, compat: bool) -> PyResult<String> {
    let dialect = if compat { Dialect::Compat } else { Dialect::Sound };
    mist_format::program::parse(text, dialect)
        .map(|program| program.to_string())
        .map_err(|diagnostics| error::of_program(py, &diagnostics, text))
}
