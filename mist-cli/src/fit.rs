//! `mist fit`: variables of a program from measured values.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use mist_engine::{
    Control,
    fit::{self, Fit, FitError, FitSettings, MeasuredTable},
    function::ProgramFunction,
};
use mist_format::number::general;
use rise_bridge::write::{self, Graph};

use super::{
    error::{CommandError, ExitStatus},
    input::InputText,
    output::print,
    plot,
    program::ProgramInput,
    reporter::Reporter,
    vary::{self, VaryArgs},
};

/// Fit variables of a program to measured values.
///
/// The variables named after --vary are changed until the outputs of the program come nearest to
/// the measured ones (least squares, Levenberg–Marquardt). Apertures, loops and everything else
/// stay what the program says. The measured file is a table like the results of the program: a
/// line of names, then numbers; columns of loops tell which line of the results a row is about,
/// columns of outputs hold what was measured, and `sigma(OUTPUT)`, `sigma` or `weight` its
/// uncertainty.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist fit glass.mist --measured scan.dat --vary s,gain
  mist fit glass.mist --measured scan.csv --vary s,n --start s=0.2 --bounds s=0.01:1 --json
  mist fit glass.mist --measured scan.dat --vary s --plot fit.pdf

The intervals are those of Student's t with the scatter of the residuals; with --absolute the
uncertainties in the file are taken as standard deviations.")]
pub(super) struct FitArgs {
    #[command(flatten)]
    vary: VaryArgs,
    /// Table of measured values.
    #[arg(long, value_name = "FILE")]
    measured: PathBuf,
    /// First values of variables, in place of the program's.
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',', value_parser = start)]
    start: Vec<(String, f64)>,
    /// The least and the largest value that variables may have.
    #[arg(long, value_name = "NAME=LOW:HIGH,…", value_delimiter = ',', value_parser = bounds)]
    bounds: Vec<(String, [f64; 2])>,
    /// Probability that an interval covers the true value.
    #[arg(long, value_name = "P", default_value_t = 0.95)]
    confidence: f64,
    /// Take the uncertainties in the file as standard deviations, not only as weights.
    #[arg(long)]
    absolute: bool,
    /// Step of the derivatives, relative to the value.
    #[arg(long, value_name = "STEP", default_value_t = 1e-4)]
    step: f64,
    /// Iterations at most.
    #[arg(long, value_name = "N", default_value_t = 100)]
    iterations: usize,
    /// Draw measured values as dots and fitted ones as curves: .svg, .png or .pdf.
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
}

fn start(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("must be NAME=VALUE")?;
    let value = value.trim().parse().map_err(|_| format!("{value:?} is not a number"))?;
    Ok((name.trim().to_owned(), value))
}

fn bounds(text: &str) -> Result<(String, [f64; 2]), String> {
    let (name, range) = text.split_once('=').ok_or("must be NAME=LOW:HIGH")?;
    let (low, high) = range.split_once(':').ok_or("must be NAME=LOW:HIGH")?;
    let number = |text: &str| text.trim().parse().map_err(|_| format!("{text:?} is not a number"));
    Ok((name.trim().to_owned(), [number(low)?, number(high)?]))
}

/// Fits and tells.
pub(super) fn fit(args: &FitArgs, reporter: &Reporter) -> Result<(), CommandError> {
    let input = ProgramInput::read(&args.vary.program)?;
    let program = args.vary.open(&input, reporter)?;
    let table = InputText::read(&args.measured)?;
    let measured = MeasuredTable::parse(&table.text, program.titles(), program.headers())
        .map_err(|error| CommandError::Refused(format!("{}: {error}", table.name())))?;
    let settings = FitSettings {
        start: args.start.iter().cloned().collect::<BTreeMap<_, _>>(),
        bounds: args.bounds.iter().cloned().collect(),
        step: args.step,
        confidence: args.confidence,
        absolute: args.absolute,
        iterations: args.iterations,
    };
    let run = |control: &Control| fit::fit(&program, &measured, &settings, control);
    let found = args.vary.watch("fit", run)?;
    if let (Ok(found), Some(path)) = (&found, &args.plot) {
        draw(path, (&program, &measured), found, args)?;
    }
    match found {
        Ok(found) if args.vary.json.json => print(&vary::json(&found, &reporter.warnings())?),
        Ok(found) => print(&describe(&found)),
        Err(error) => Err(stop(&error, &input.source, args, reporter)),
    }
}

/// Draws the fitted outputs and their measured values over the last loop.
fn draw(
    path: &Path,
    (program, measured): (&ProgramFunction, &MeasuredTable),
    found: &Fit,
    args: &FitArgs,
) -> Result<(), CommandError> {
    let values: Vec<f64> = found.parameters.iter().map(|parameter| parameter.value).collect();
    let run = |control: &Control| fit::compared(program, measured, &values, control);
    let all = args.vary.watch("plot", run)?;
    let all = all.map_err(|error| CommandError::Failed(error.to_string()))?;
    let [loops, outputs] = program.titles();
    let place = |at: usize, loops: &[String]| {
        loops.last().and_then(|cell| cell.trim().parse().ok()).unwrap_or(at as f64 + 1.0)
    };
    let across = loops.last().map_or("row", String::as_str);
    let graph = |(output, title): (usize, &String)| {
        let here = all.iter().enumerate().filter(|(_, value)| value.output == output);
        let values: Vec<(f64, f64, f64)> =
            here.map(|(at, v)| (place(at, &v.loops), v.measured, v.computed)).collect();
        (!values.is_empty()).then(|| plot::comparison(title, across, &values))
    };
    let graphs: Vec<Graph> = outputs.iter().enumerate().filter_map(graph).collect();
    plot::save(path, write::plot_graphs("fit", &graphs))
}

fn stop(error: &FitError, source: &InputText, args: &FitArgs, reporter: &Reporter) -> CommandError {
    if let Some(diagnostics) = error.diagnostics() {
        vary::tell(diagnostics, source, reporter);
        return CommandError::Reported(ExitStatus::Refused);
    }
    match error {
        FitError::MeasuredTable(error) => {
            CommandError::Refused(format!("{}: {error}", args.measured.display()))
        }
        FitError::Setting { .. } | FitError::TooFewData { .. } => {
            CommandError::Refused(error.to_string())
        }
        other => CommandError::Failed(other.to_string()),
    }
}

/// The numbers for people.
fn describe(found: &Fit) -> String {
    let width = found.parameters.iter().map(|p| p.name.chars().count()).max().unwrap_or(0);
    let percent = general(100.0 * found.confidence, 4);
    let mut text = String::new();
    for parameter in &found.parameters {
        let name = format!("{:width$}", parameter.name);
        let value = general(parameter.value, 7);
        text += &match (parameter.standard_error, parameter.interval) {
            (Some(error), Some([low, high])) => format!(
                "{name} = {value} ± {}   {percent} %: {} … {}   (start {})\n",
                general(error, 3),
                general(low, 6),
                general(high, 6),
                general(parameter.start, 6),
            ),
            _ => format!("{name} = {value}   at its bound: no interval\n"),
        };
    }
    if found.parameters.len() > 1 {
        text += "correlation\n";
        for (parameter, row) in found.parameters.iter().zip(&found.correlation) {
            let row: Vec<String> = row.iter().map(|c| format!("{c:8.4}")).collect();
            text += &format!("  {:width$} {}\n", parameter.name, row.join(""));
        }
    }
    let residuals = &found.residuals;
    let (row, output) = &residuals.largest_at;
    text += &format!(
        "residuals: rms {}, chi2 {} with {} degrees of freedom ({} each), largest {} standard \
         deviations (row {row}, {output}){}\n",
        general(residuals.rms, 4),
        general(residuals.chi_squared, 5),
        residuals.degrees_of_freedom,
        general(residuals.reduced_chi_squared, 4),
        general(residuals.largest, 3),
        residuals
            .correlation
            .map_or_else(String::new, |c| format!(", correlation {}", general(c, 6))),
    );
    text += &format!(
        "{} data, {} iterations, {} runs of the program\n",
        residuals.data, found.iterations, found.runs
    );
    if !found.ignored.is_empty() {
        text += &format!("not used: column {}\n", found.ignored.join(", column "));
    }
    text
}
