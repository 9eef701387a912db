//! `mist run`: programs in, tables out.

use std::{
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

use mist_engine::{Control, Failure, Job, RunSummary, Warning};
use mist_runner::{
    run::{RunError, ShardRun, WrittenFile, run_shard, run_to_files},
    shard::Shard,
};

use super::{
    error::{CommandError, ExitStatus},
    flags::{EngineFlags, MessageFlag},
    interrupt,
    output::print,
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
/// Data files are looked up in the working folder, beside the program, and along SCATMECH.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist run paint.mist
  mist run --compat --out nist old/*.mist
  mist run --job glossy --threads 4 paint.mist
  mist run --shard 3/16 paint.mist    the third of 16 parts; see `mist merge`")]
pub(super) struct RunArgs {
    /// Programs; with --compat a second name that is not a file names the job, as NIST's program
    /// has it.
    #[arg(required = true)]
    programs: Vec<PathBuf>,
    /// Name of the job: files that the program does not name are called after it [default: the
    /// program's name].
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
    #[command(flatten)]
    message: MessageFlag,
}

impl RunArgs {
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
    let args = &args;
    fs::create_dir_all(&args.out).map_err(|error| {
        CommandError::Failed(format!("cannot make the folder {}: {error}", args.out.display()))
    })?;
    if args.job.is_some() && args.programs.len() > 1 {
        return Err(CommandError::Refused(
            "--job names one job, but there are several programs".into(),
        ));
    }
    let pool = args.threads.pool()?;
    let cancel = interrupt::flag();
    let runs = || -> Result<Vec<ExitStatus>, CommandError> {
        let mut statuses = Vec::new();
        for program in &args.programs {
            let control = Control { cancel: cancel.clone(), progress: None };
            statuses.push(run_one(args, program, control, reporter)?);
            if cancel.load(std::sync::atomic::Ordering::Relaxed) {
                break;
            }
        }
        Ok(statuses)
    };
    let statuses = pool.install(runs)?;
    if args.programs.len() > 1 {
        print(&total(&statuses, args.programs.len()))?;
    }
    reporter.check()?;
    statuses.into_iter().max().unwrap_or(ExitStatus::Success).into_result()
}

fn run_one(
    args: &RunArgs,
    program: &Path,
    mut control: Control,
    reporter: &Reporter,
) -> Result<ExitStatus, CommandError> {
    let program = match ProgramInput::read(program) {
        Ok(program) => program,
        Err(CommandError::Refused(message)) => {
            report::print_line(&format!("error: {message}"));
            return Ok(ExitStatus::Refused);
        }
        Err(stop) => return Err(stop),
    };
    let source = &program.source;
    let options = program.options(args.engine, args.job.as_deref());
    let format = args.message.message_format;
    let tell = |diagnostics: &[_]| reporter.diagnostics(diagnostics, source, format);
    let job = match program.compile(&options) {
        Ok(job) => job,
        Err(diagnostics) => {
            tell(&diagnostics);
            return Ok(ExitStatus::Refused);
        }
    };
    reporter.warn_of_program(&job.slips(), source, format);
    if reporter.status() == ExitStatus::Refused {
        return Ok(ExitStatus::Refused);
    }
    let progress = TerminalProgress::new(&options.job);
    let bar = progress.clone();
    control.progress = Some(Box::new(move |part| bar.set(part)));
    let done = match args.shard {
        Some(shard) => run_shard(&job, (&options, &source.text), shard, &args.out, &control)
            .map(|run| (describe_shard(&options.job, shard, &run, &job), run.summary)),
        None => run_to_files(&job, &args.out, &control)
            .map(|(summary, files)| (describe(&options.job, &summary, &files), summary)),
    };
    progress.finish();
    match done {
        Ok((said, summary)) => {
            note(&source.name(), &summary, reporter);
            reporter.warn_of_program(&summary.warnings, source, format);
            if let Some(table) = &summary.colour {
                reporter.warn(&source.name(), &table.warnings);
            }
            print(&said)?;
            Ok(ExitStatus::Success)
        }
        Err(RunError::Engine(Failure::Program(diagnostics))) => {
            tell(&diagnostics);
            Ok(ExitStatus::Refused)
        }
        Err(RunError::Engine(Failure::Step { step, fault })) => {
            tell(&[fault.note(format!("in step {}", step + 1))]);
            Ok(ExitStatus::Failed)
        }
        Err(error) => {
            report::print_line(&format!("error: {}: {error}", source.name()));
            Ok(if error.is_refusal() { ExitStatus::Refused } else { ExitStatus::Failed })
        }
    }
}

/// The message of a finished run.
fn describe(job: &str, summary: &RunSummary, files: &[WrittenFile]) -> String {
    let mut text = format!(
        "{job}: {} step{}, {:.3e} evaluations, {:.2} s\n",
        summary.steps,
        if summary.steps == 1 { "" } else { "s" },
        summary.evaluations,
        summary.seconds,
    );
    for file in files {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {:<14} {}", file.title, shown(&file.path).display());
    }
    text
}

/// The message of a finished shard.
fn describe_shard(name: &str, shard: Shard, run: &ShardRun, job: &Job) -> String {
    let ShardRun { summary, steps, steps_before, job_steps, .. } = run;
    let mut text = format!(
        "{name}: shard {shard}: {steps} of {job_steps} steps, {steps_before} of them done before, {:.3e} evaluations, {:.2} s\n",
        summary.evaluations, summary.seconds,
    );
    // Writing to a string cannot fail.
    let _ = writeln!(text, "  {:<14} {}", "shard", shown(&run.path).display());
    if job.colour().is_some() {
        text.push_str(
            "  note: shards have no colours; see `mist table --from` for the merged table\n",
        );
    }
    text
}

/// A path without the working folder before it.
fn shown(path: &Path) -> &Path {
    path.strip_prefix(".").unwrap_or(path)
}

/// Tells the defects that the run avoided, and the limits of models that it passed.
fn note(file: &str, summary: &RunSummary, reporter: &Reporter) {
    for notice in &summary.met {
        match Warning::of_notice(notice) {
            Some(warning) => reporter.warn(file, &[warning]),
            None => report::print_line(&format!("note: {file}: {notice}")),
        }
    }
}

/// One line for many programs.
fn total(statuses: &[ExitStatus], programs: usize) -> String {
    let count = |status| statuses.iter().filter(|each| **each == status).count();
    format!(
        "{programs} programs: {} good, {} failed, {} refused, {} not started\n",
        count(ExitStatus::Success),
        count(ExitStatus::Failed),
        count(ExitStatus::Refused),
        programs - statuses.len(),
    )
}
