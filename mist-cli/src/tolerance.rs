//! `mist tolerance`: how far the colours of a program move per unit of its variables.

use std::path::PathBuf;

use mist_engine::{
    Control, Failure,
    tolerance::{self, ColourSensitivity, ColourShift, ColourTolerance, ToleranceError},
};
use mist_format::number::general;
use rise_bridge::write::{self, Graph, Series};

use super::{
    error::{CommandError, ExitStatus},
    output::print,
    plot,
    program::ProgramInput,
    reporter::Reporter,
    vary::{self, VaryArgs},
};

/// Tell how far colours move (CIEDE2000) when variables change.
///
/// The program needs a section COLOR. For each variable named after --vary it is run at its value
/// minus and plus --step times the value; the distance of the two colours over the distance of the
/// two values is how far a colour moves per unit, in every row of the colour table.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist tolerance gold.mist --vary sdf.s
  mist tolerance gold.mist --vary sdf.s,incidentangle --step 0.01 --json
  mist tolerance gold.mist --vary sdf.s --plot tolerance.pdf")]
pub(super) struct ToleranceArgs {
    #[command(flatten)]
    vary: VaryArgs,
    /// Step of the differences, relative to the value (absolute for a value of 0).
    #[arg(long, value_name = "STEP", default_value_t = 1e-3)]
    step: f64,
    /// Draw the changes of the colours over the rows: .svg, .png or .pdf.
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
}

/// Computes and tells.
pub(super) fn tolerance(args: &ToleranceArgs, reporter: &Reporter) -> Result<(), CommandError> {
    let input = ProgramInput::read(&args.vary.program)?;
    let program = args.vary.open(&input, reporter)?;
    let run = |control: &Control| tolerance::tolerance(&program, args.step, control);
    let found = args.vary.watch("tolerance", run)?;
    if let (Ok(found), Some(path)) = (&found, &args.plot) {
        plot::save(path, write::plot_graphs("tolerance", &graphs(found)))?;
    }
    match found {
        Ok(found) if args.vary.json.json => print(&vary::json(&found, &reporter.warnings())?),
        Ok(found) => print(&describe(&found)),
        Err(ToleranceError::Run { failure: Failure::Program(diagnostics), .. }) => {
            vary::tell(&diagnostics, &input.source, reporter);
            Err(CommandError::Reported(ExitStatus::Refused))
        }
        Err(error @ ToleranceError::Run { .. }) => Err(CommandError::Failed(error.to_string())),
        Err(error) => Err(CommandError::Refused(format!("{}: {error}", input.source.name()))),
    }
}

/// A graph per variable: the change of each row's colour.
fn graphs(found: &ColourTolerance) -> Vec<Graph> {
    let graph = |parameter: &ColourSensitivity| {
        let points = |of: fn(&ColourShift) -> f64| {
            parameter.rows.iter().enumerate().map(|(at, row)| (at as f64 + 1.0, of(row))).collect()
        };
        let series = |label: &str, of| Series {
            label: label.to_owned(),
            points: points(of),
            ..Series::default()
        };
        Graph {
            title: format!("{} = {}", parameter.name, general(parameter.value, 6)),
            across: "row of the colour table".into(),
            up: format!("change per unit of {}", parameter.name),
            series: vec![
                series("ΔE (CIEDE2000)", |row| row.delta_e),
                series("ΔL*", |row| row.lab[0]),
                series("Δa*", |row| row.lab[1]),
                series("Δb*", |row| row.lab[2]),
            ],
            is_linear: true,
        }
    };
    found.parameters.iter().map(graph).collect()
}

/// The numbers for people: one line per variable, then its most and least sensitive rows.
fn describe(found: &ColourTolerance) -> String {
    let width = found.parameters.iter().map(|p| p.name.chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for parameter in &found.parameters {
        let [low, high] = parameter.between.map(|value| general(value, 6));
        text += &format!(
            "{:width$} = {}: {} dE per unit on the average, {} at most",
            parameter.name,
            general(parameter.value, 6),
            general(parameter.mean, 4),
            general(parameter.largest, 4),
        );
        text += &match parameter.for_one {
            Some(change) => format!("; ±{} moves a colour by 1 dE", general(change, 3)),
            None => "; no colour moves".to_owned(),
        };
        text += &format!("   ({low} to {high})\n");
        let larger = |a: &&tolerance::ColourShift, b: &&tolerance::ColourShift| {
            a.delta_e.total_cmp(&b.delta_e)
        };
        if let Some(row) = parameter.rows.iter().max_by(larger) {
            let [l, a, b] = row.lab.map(|change| general(change, 4));
            let leading = found.leading.iter().zip(&row.leading);
            let leading: String =
                leading.map(|(name, value)| format!("{name} = {}, ", general(*value, 6))).collect();
            text += &format!(
                "{:width$}   most at {leading}thetai {}, thetas {}, phis {}: dL* {l}, da* {a}, \
                 db* {b} per unit\n",
                "",
                general(row.thetai, 5),
                general(row.thetas, 5),
                general(row.phis, 5),
            );
        }
    }
    text
}
