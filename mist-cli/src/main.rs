//! The program `mist`. Each command has a file of its own with its arguments, help and work.
//!
//! Exit codes: 0 good, 1 the run failed, 2 the program or the arguments are wrong, 130 interrupted.

mod bridge;
mod check;
mod color;
mod compare_spectra;
mod completions;
mod convert;
mod diff;
mod error;
mod eval;
mod export;
mod fit;
mod flags;
mod fmt;
mod help;
mod input;
mod interrupt;
mod key;
mod man;
mod material;
mod merge;
mod models;
mod new;
mod output;
mod plot;
mod preview;
mod program;
mod progress;
mod report;
mod reporter;
mod run;
mod serve;
mod table;
mod threads;
mod tolerance;
mod vary;

use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use reporter::Reporter;

/// From the physics of a material to its colour in a renderer.
#[derive(Parser)]
#[command(name = "mist", version, after_help = EXAMPLES, disable_help_subcommand = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Fail if there is a warning; warnings that are known before the work stop it.
    #[arg(long, global = true)]
    deny_warnings: bool,
    /// Print errors, warnings and what was asked for; no progress, notes or names of files.
    #[arg(long, short, global = true)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  mist new --from metallic-paint      a commented program to begin with
  mist run paint.mist                 run a program, write its tables here
  mist check paint.mist               look for mistakes without running
  mist models Facet_BRDF_Model        what a model is and which parameters it has
  mist table paint.json --grid thetai=0:10:80,thetas=0:10:80,phis=0:20:180 --lambda 400:20:700 -o paint.mtab
  mist export gold.json --lambda 450,500,550,600,650 -o gold.pbsdf
  mist diff test.exr reference.exr    which part of a difference an observer sees
  mist serve                          answer renderers on http://127.0.0.1:8650
  mist help units                     a topic; `mist help` lists them

Exit codes: 0 good, 1 the run failed, 2 the program or the arguments are wrong, 130 interrupted.";

#[derive(Subcommand)]
enum Command {
    New(new::NewArgs),
    Run(run::RunArgs),
    Merge(merge::MergeArgs),
    Check(check::CheckArgs),
    Models(models::ModelsArgs),
    Table(Box<table::TableArgs>),
    Preview(Box<preview::PreviewArgs>),
    Export(export::ExportArgs),
    Bridge(bridge::BridgeArgs),
    Eval(eval::EvalArgs),
    Color(color::ColorArgs),
    Fmt(fmt::FmtArgs),
    Convert(convert::ConvertArgs),
    Diff(diff::DiffArgs),
    CompareSpectra(compare_spectra::CompareSpectraArgs),
    Fit(Box<fit::FitArgs>),
    Tolerance(tolerance::ToleranceArgs),
    Serve(Box<serve::ServeArgs>),
    Key(key::KeyArgs),
    Completions(completions::CompletionsArgs),
    Man(man::ManArgs),
    Help(help::HelpArgs),
}

/// Runs the command that the arguments of the process name.
fn main() -> ExitCode {
    let Cli { command, deny_warnings, quiet } = Cli::parse();
    let reporter = &Reporter::new(deny_warnings, quiet);
    if quiet {
        progress::be_quiet();
    }
    let done = match command {
        Command::New(args) => new::new(&args),
        Command::Run(args) => run::run(args, reporter),
        Command::Merge(args) => merge::merge(&args),
        Command::Check(args) => check::check(&args, reporter),
        Command::Models(args) => models::models(&args),
        Command::Color(args) => color::color(&args, reporter),
        Command::Fmt(args) => fmt::fmt(&args),
        Command::Convert(args) => convert::convert(&args),
        Command::Diff(args) => diff::diff(&args),
        Command::CompareSpectra(args) => compare_spectra::compare_spectra(&args, reporter),
        Command::Fit(args) => fit::fit(&args, reporter),
        Command::Tolerance(args) => tolerance::tolerance(&args, reporter),
        Command::Table(args) => table::table(&args, reporter),
        Command::Preview(args) => preview::preview(&args, reporter),
        Command::Export(args) => export::export(&args, reporter),
        Command::Bridge(args) => bridge::bridge(&args, reporter),
        Command::Eval(args) => eval::eval(&args, reporter),
        Command::Serve(args) => serve::serve(&args),
        Command::Key(args) => key::key(&args),
        Command::Completions(args) => completions::completions(&args, Cli::command()),
        Command::Man(args) => man::man(&args, Cli::command()),
        Command::Help(args) => help::help(&args, Cli::command()),
    };
    match done.and_then(|()| reporter.check()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => error.exit(),
    }
}
