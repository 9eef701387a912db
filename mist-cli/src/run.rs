//! `mist run`: programs in, tables out.

mod messages;

use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use mist_engine::{Control, Failure, Job, Options, RunSummary};
use mist_runner::{
    run::{RunError, run_and_watch, run_shard},
    shard::Shard,
    targets::{Permissions, Targets},
};
use rise_bridge::write;
use scattering::{Defect, Mode};

use super::{
    error::{CommandError, ExitStatus},
    flags::{EngineFlags, MessageFlag},
    input::InputText,
    interrupt,
    plot::{self, ResultLine},
    program::ProgramInput,
    progress::TerminalProgress,
    report,
    reporter::Reporter,
    threads::ThreadsFlag,
};

/// Run programs and write their tables.
///
/// Results, listing, samples and the files of the section COLOR are written into the working
/// folder, or into --out, under the names the program gives them; a file appears when it is whole.
/// Names that end in .csv make CSV with units in the titles, plots may be .svg, .png or .pdf.
/// Data files are looked up in the working folder, beside the program, and along SCATMECH.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist run paint.mist
  mist run --compat --out nist old/*.mist
  mist run --job glossy --threads 4 paint.mist    glossy.dat, glossy.mtab, glossy.svg
  mist run --no-clobber --quiet paint.mist
  mist run --plot paint.pdf paint.mist
  mist run --shard 3/16 paint.mist    the third of 16 parts; see `mist merge`")]
pub(super) struct RunArgs {
    /// Programs; with --compat a second name that is not a file names the job, as NIST's program
    /// has it.
    #[arg(required = true)]
    programs: Vec<PathBuf>,
    /// Name of the job: all files are called after it [default: the program's name, for files that
    /// the program does not name; with --compat only for those].
    #[arg(long, value_name = "NAME")]
    job: Option<String>,
    #[command(flatten)]
    engine: EngineFlags,
    #[command(flatten)]
    threads: ThreadsFlag,
    /// Folder for the results.
    #[arg(long, value_name = "DIR", default_value = ".")]
    out: PathBuf,
    /// Run part K of N of the steps, into JOB.K-of-N; the same command goes on after an
    /// interruption. `mist merge` puts the parts together.
    #[arg(long, value_name = "K/N")]
    shard: Option<Shard>,
    /// Refuse to replace files that exist.
    #[arg(long)]
    no_clobber: bool,
    /// Let the program write files that are not below the folder of results.
    #[arg(long)]
    allow_outside: bool,
    /// Draw the colours, or else the outputs over the last loop: .svg, .png or .pdf.
    #[arg(long, value_name = "FILE", conflicts_with = "shard")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    message: MessageFlag,
}

impl RunArgs {
    fn permissions(&self) -> Permissions {
        // A shard goes on with its own journal, and writes no other file.
        let replace = !self.no_clobber || self.shard.is_some();
        Permissions { replace, outside: self.allow_outside }
    }

    /// NIST's program takes a second argument for the name of the job.
    fn take_job_name(&mut self) {
        let [_, second] = &self.programs[..] else { return };
        if self.engine.compat.compat && self.job.is_none() && !second.exists() {
            self.job = Some(second.to_string_lossy().into_owned());
            self.programs.truncate(1);
        }
    }
}

/// Runs the programs one after the other; each uses all threads.
pub(super) fn run(mut args: RunArgs, reporter: &Reporter) -> Result<(), CommandError> {
    args.take_job_name();
    fs::create_dir_all(&args.out).map_err(|error| {
        CommandError::Failed(format!("cannot make the folder {}: {error}", args.out.display()))
    })?;
    for (flag, is_given) in [("job", args.job.is_some()), ("plot", args.plot.is_some())] {
        if is_given && args.programs.len() > 1 {
            let problem = format!("--{flag} is for one program, but there are several");
            return Err(CommandError::Refused(problem));
        }
    }
    args.plot.as_deref().map(plot::format).transpose()?;
    let pool = args.threads.pool()?;
    let progress = TerminalProgress::new("");
    let mut runs = Runs::new(&args, progress, reporter);
    let statuses = pool.install(|| runs.all())?;
    if args.programs.len() > 1 {
        reporter.say(&messages::total(&statuses, args.programs.len()))?;
    }
    if let Some(line) = messages::defects(&runs.defects) {
        reporter.note(&line);
    }
    reporter.check()?;
    statuses.into_iter().max().unwrap_or(ExitStatus::Success).into_result()
}

/// The runs of the programs of one command.
struct Runs<'a> {
    args: &'a RunArgs,
    reporter: &'a Reporter,
    progress: TerminalProgress,
    cancel: Arc<AtomicBool>,
    targets: Targets,
    defects: BTreeSet<Defect>,
}

impl<'a> Runs<'a> {
    fn new(args: &'a RunArgs, progress: TerminalProgress, reporter: &'a Reporter) -> Self {
        let (cancel, targets) = (interrupt::flag(), Targets::default());
        Self { args, reporter, progress, cancel, targets, defects: BTreeSet::new() }
    }

    /// Runs all programs, until the command is interrupted.
    fn all(&mut self) -> Result<Vec<ExitStatus>, CommandError> {
        let mut statuses = Vec::new();
        for (at, program) in self.args.programs.iter().enumerate() {
            statuses.push(self.one(at, program)?);
            if self.cancel.load(Ordering::Relaxed) {
                break;
            }
        }
        Ok(statuses)
    }

    fn one(&mut self, at: usize, path: &Path) -> Result<ExitStatus, CommandError> {
        let program = match ProgramInput::read(path) {
            Ok(program) => program,
            Err(CommandError::Refused(message)) => {
                report::print_line(&format!("error: {message}"));
                return Ok(ExitStatus::Refused);
            }
            Err(stop) => return Err(stop),
        };
        let (source, args) = (&program.source, self.args);
        let options = program.options(args.engine, args.job.as_deref());
        let format = args.message.message_format;
        let mut job = match program.compile(&options) {
            Ok(job) => job,
            Err(diagnostics) => {
                self.reporter.diagnostics(&diagnostics, source, format);
                return Ok(ExitStatus::Refused);
            }
        };
        if args.job.is_some() && options.mode == Mode::Sound {
            job = job.with_files_named_after_it();
        }
        if let Err(error) = self.targets.add((&source.name(), &job), &args.out, args.permissions())
        {
            report::print_line(&format!("error: {}: {error}", source.name()));
            return Ok(ExitStatus::Refused);
        }
        self.reporter.warn_of_program(&job.slips(), source, format);
        if self.reporter.status() == ExitStatus::Refused {
            return Ok(ExitStatus::Refused);
        }
        let done = self.evaluate(at, &job, &options, source)?;
        self.tell(path, source, done)
    }

    /// Runs `job`, with its progress among that of all programs.
    fn evaluate(
        &self,
        at: usize,
        job: &Job,
        options: &Options,
        source: &InputText,
    ) -> Result<Result<(String, RunSummary), RunError>, CommandError> {
        let (args, mut lines) = (self.args, Vec::new());
        let (bar, programs) = (self.progress.clone(), args.programs.len() as f64);
        let progress = move |part: f64| bar.set((at as f64 + part) / programs);
        let control = Control { cancel: self.cancel.clone(), progress: Some(Box::new(progress)) };
        self.progress.show(&options.job);
        let mut done = match args.shard {
            Some(shard) => run_shard(job, (options, &source.text), shard, &args.out, &control)
                .map(|run| (messages::describe_shard(&options.job, shard, &run, job), run.summary)),
            None => run_and_watch(job, &args.out, &control, &mut |line| {
                if args.plot.is_some() {
                    lines.push((line.coordinates().to_vec(), line.outputs().to_vec()));
                }
            })
            .map(|(summary, files)| (messages::describe(&options.job, &summary, &files), summary)),
        };
        self.progress.hide();
        if let (Ok((said, summary)), Some(path)) = (&mut done, &args.plot) {
            draw(path, job, summary, &lines)?;
            said.push_str(&messages::file_line("plot", path));
        }
        Ok(done)
    }

    /// Tells what a run has given.
    fn tell(
        &mut self,
        path: &Path,
        source: &InputText,
        done: Result<(String, RunSummary), RunError>,
    ) -> Result<ExitStatus, CommandError> {
        let format = self.args.message.message_format;
        match done {
            Ok((said, summary)) => {
                self.defects.extend(messages::notices(&source.name(), &summary, self.reporter));
                self.reporter.warn_of_program(&summary.warnings, source, format);
                if let Some(table) = &summary.colour {
                    self.reporter.warn(&source.name(), &table.warnings);
                }
                self.reporter.say(&said)?;
                Ok(ExitStatus::Success)
            }
            Err(RunError::Engine(Failure::Program(diagnostics))) => {
                self.reporter.diagnostics(&diagnostics, source, format);
                Ok(ExitStatus::Refused)
            }
            Err(RunError::Engine(Failure::Step { step, fault })) => {
                let fault = fault.note(format!("in step {}", step + 1));
                self.reporter.diagnostics(&[fault], source, format);
                Ok(ExitStatus::Failed)
            }
            Err(RunError::Engine(Failure::Cancelled) | RunError::ShardCancelled) => {
                let job = self.args.job.clone().unwrap_or_else(|| source.stem());
                let kept = self.args.shard.map(|s| (s, self.args.out.join(s.file_name(&job))));
                let kept = kept.as_ref().map(|(shard, file)| (*shard, file.as_path()));
                report::print_line(&messages::interrupted(path, kept));
                Ok(ExitStatus::Interrupted)
            }
            Err(error) => {
                report::print_line(&format!("error: {}: {error}", source.name()));
                Ok(if error.is_refusal() { ExitStatus::Refused } else { ExitStatus::Failed })
            }
        }
    }
}

/// Draws the colours of a run into `path`, or its outputs if it has no colours.
fn draw(
    path: &Path,
    job: &Job,
    summary: &RunSummary,
    lines: &[ResultLine],
) -> Result<(), CommandError> {
    if let Some(table) = &summary.colour {
        return plot::save(path, write::plot(table));
    }
    let titled = |title: &str| match job.unit(title) {
        Some(unit) => format!("{title} ({unit})"),
        None => title.to_owned(),
    };
    let titles = job.columns().map(|titles| titles.into_iter().map(titled).collect());
    plot::save_results(path, job.class().name, &titles, lines)
}
