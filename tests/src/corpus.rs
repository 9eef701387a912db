//! The conformance programs with their files and tolerances, and runs of them.

use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

use mist_engine::{
    Control, Failure, FileError, Files, Job, MemorySink, Options, RunSummary, compile,
};
use mist_format::Diagnostic;
use scattering::Mode;
use serde::Deserialize;

/// A conformance program as the file `test.json` in its folder describes it.
#[derive(Clone, Debug, Deserialize)]
pub struct Case {
    /// Name of the program and its folder.
    #[serde(default)]
    pub name: String,
    /// Subject, such as `shapes/CIRCLE`.
    pub area: String,
    /// `ok`, `mc`, `error` or `hang`.
    pub kind: String,
    /// Arguments of NIST's program: the program and maybe a job name.
    pub args: Vec<String>,
    /// Allowed relative difference.
    #[serde(default)]
    pub rtol: f64,
    /// Allowed difference as a fraction of the largest output of the row.
    #[serde(default)]
    pub atol_frac: f64,
    /// Lines of text at the top of the results.
    #[serde(default)]
    pub header_lines: usize,
    /// Loop columns of the results.
    #[serde(default)]
    pub loop_columns: usize,
    /// The files that NIST's program wrote.
    #[serde(default)]
    pub files: Vec<Written>,
    /// Mean and standard deviation of Monte Carlo results, one per row.
    #[serde(default)]
    pub mc: Vec<MonteCarlo>,
}

/// A file that NIST's program wrote.
#[derive(Clone, Debug, Deserialize)]
pub struct Written {
    /// Its name.
    pub name: String,
    /// `results`, `listing` or `samples`.
    pub role: String,
}

/// Statistics of many Monte Carlo runs of NIST's program.
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct MonteCarlo {
    /// Mean.
    pub mean: f64,
    /// Standard deviation of one run.
    pub sigma: f64,
}

/// The folder with the programs.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/programs")
}

/// Every program below `folder`, in the order of their names.
///
/// # Panics
///
/// If a folder has no readable `test.json`.
pub fn cases(folder: &Path) -> Vec<Case> {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let folders = entries.map(|entry| entry.expect("the folder can be read").path());
    let mut cases: Vec<Case> =
        folders.filter(|path| path.is_dir()).map(|path| case(&path)).collect();
    cases.sort_by(|a, b| a.name.cmp(&b.name));
    cases
}

fn case(folder: &Path) -> Case {
    let file = folder.join("test.json");
    let text = fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let read: Case =
        serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Case { name, ..read }
}

/// The files of one folder.
struct Folder(PathBuf);

impl Files for Folder {
    fn read(&self, name: &str) -> Result<Arc<str>, FileError> {
        let bytes = fs::read(self.0.join(name))
            .map_err(|e| FileError { name: name.into(), reason: e.to_string() })?;
        Ok(latin1(&bytes).into())
    }
}

/// The text of a file that need not be UTF-8.
fn latin1(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec())
        .unwrap_or_else(|_| bytes.iter().map(|byte| char::from(*byte)).collect())
}

/// RunOutcome of a run.
pub type RunOutcome = Result<(MemorySink, RunSummary), Failure>;

/// A program with the folder of its data files.
pub struct ConformanceProgram {
    /// Name of the job.
    pub name: String,
    /// Its text.
    pub text: String,
    folder: PathBuf,
}

impl ConformanceProgram {
    /// The program of `case`, in the folder of the programs.
    ///
    /// # Panics
    ///
    /// If its file cannot be read.
    pub fn of(case: &Case) -> Self {
        Self::read(&folder(), case).expect("the program can be read")
    }

    fn read(folder: &Path, case: &Case) -> Option<Self> {
        let folder = folder.join(&case.name);
        let file = &case.args[0];
        let bytes = fs::read(folder.join(file)).ok()?;
        let stem = file.rsplit_once('.').map_or(file.as_str(), |(stem, _)| stem);
        let name = case.args.get(1).map_or(stem, String::as_str).to_owned();
        Some(Self { name, text: latin1(&bytes), folder })
    }

    fn compile(&self, mode: Mode) -> Result<Job, Vec<Diagnostic>> {
        let options = Options { mode, job: self.name.clone(), ..Options::default() };
        compile(&self.text, Arc::new(Folder(self.folder.clone())), &options)
    }

    /// Findings of `mist check` in `mode`.
    pub fn check(&self, mode: Mode) -> Vec<Diagnostic> {
        self.compile(mode).map_or_else(|found| found, |job| job.advice())
    }

    /// Runs it in `mode`.
    ///
    /// # Errors
    ///
    /// Errors of the program.
    pub fn run(&self, mode: Mode) -> RunOutcome {
        let job = self.compile(mode).map_err(Failure::Program)?;
        let mut sink = MemorySink::default();
        let summary = job.run(&mut sink, &Control::default())?;
        Ok((sink, summary))
    }
}

/// Every program in the folder `root` and in its folders, by name.
///
/// # Panics
///
/// If a folder or a program cannot be read.
pub fn programs(root: &Path) -> Vec<ConformanceProgram> {
    let entries = |folder: &Path| {
        let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        entries.map(|entry| entry.expect("the folder can be read").path()).collect::<Vec<_>>()
    };
    let mut found = Vec::new();
    for path in entries(root) {
        let files = if path.is_dir() { entries(&path) } else { vec![path] };
        let is_program = |path: &PathBuf| path.extension().is_some_and(|name| name == "mist");
        for file in files.into_iter().filter(is_program) {
            let bytes = fs::read(&file).expect("a program can be read");
            let stem = file.file_stem().unwrap_or_default();
            found.push(ConformanceProgram {
                name: stem.to_string_lossy().into_owned(),
                text: latin1(&bytes),
                folder: file.parent().map(Path::to_owned).unwrap_or_default(),
            });
        }
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    found
}

/// Runs `case` of `folder` in `mode`.
///
/// # Errors
///
/// Errors of the program.
pub fn run(folder: &Path, case: &Case, mode: Mode) -> RunOutcome {
    let Some(program) = ConformanceProgram::read(folder, case) else {
        let missing = Diagnostic::error("file", mist_format::Span::new(0, 0), "no such program");
        return Err(Failure::Program(vec![missing]));
    };
    program.run(mode)
}

/// The text that NIST's program wrote into `name`.
///
/// # Panics
///
/// If it is missing.
pub fn expected(folder: &Path, case: &Case, name: &str) -> String {
    let path = folder.join(&case.name).join("expected").join(name);
    latin1(&fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display())))
}
