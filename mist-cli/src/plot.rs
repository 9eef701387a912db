//! Pictures of results for `--plot`.

use std::{collections::BTreeMap, path::Path};

use mist_format::{number::general, program::ColourKey};
use rise_bridge::{
    formats::ColourFormat,
    write::{self, Graph, Mark, Series},
};

use super::{error::CommandError, output::write_file};

/// The format of the picture `path`.
///
/// # Errors
///
/// If the name does not end with .svg, .png or .pdf.
pub(super) fn format(path: &Path) -> Result<ColourFormat, CommandError> {
    let is_of = |format: &ColourFormat| {
        format.writer.key == ColourKey::Plot && format.is_of(&path.to_string_lossy())
    };
    ColourFormat::all().find(is_of).ok_or_else(|| {
        let problem = "the name of a plot ends with .svg, .png or .pdf";
        CommandError::Refused(format!("{}: {problem}", path.display()))
    })
}

/// Writes the picture `svg` in the form that the extension of `path` tells.
///
/// # Errors
///
/// For another extension, and if the file cannot be written.
pub(super) fn save(path: &Path, svg: String) -> Result<(), CommandError> {
    let bytes = match format(path)?.extension {
        "png" => write::png(svg),
        "pdf" => write::pdf(svg),
        _ => Ok(svg.into_bytes()),
    };
    write_file(path, &bytes.map_err(|error| CommandError::Failed(error.to_string()))?)
}

/// The most curves of a graph and graphs of a picture.
const MOST: usize = 16;

/// A line of results: the columns of the loops, and the outputs.
pub(super) type ResultLine = (Vec<f64>, Vec<f64>);

/// Writes the picture `path` of results: a graph per output over the last loop, a curve for each
/// combination of the others. `titles` are those of the loops and of the outputs, with their units.
///
/// # Errors
///
/// If the program has no loop, or the file cannot be written.
pub(super) fn save_results(
    path: &Path,
    name: &str,
    [loops, outputs]: &[Vec<String>; 2],
    lines: &[ResultLine],
) -> Result<(), CommandError> {
    let Some((across, others)) = loops.split_last() else {
        let problem = "a plot needs a loop in VARY, whose values are the horizontal axis";
        return Err(CommandError::Refused(format!("{name}: {problem}")));
    };
    let graphs: Vec<Graph> = outputs
        .iter()
        .take(MOST)
        .enumerate()
        .map(|(at, output)| {
            let series = curves(lines, at);
            let shown = series.len().min(MOST);
            let of = |all: usize| {
                if all > shown { format!(", {shown} of {all}") } else { String::new() }
            };
            let by = if others.is_empty() {
                String::new()
            } else {
                format!(" by {}{}", others.join(" / "), of(series.len()))
            };
            Graph {
                title: format!("{output}{by}"),
                across: across.clone(),
                up: output.clone(),
                series: spread(series, shown),
                is_linear: false,
            }
        })
        .collect();
    save(path, write::plot_graphs(name, &graphs))
}

/// The curves of the output `at`, one for each combination of the loops before the last.
fn curves(lines: &[ResultLine], at: usize) -> Vec<Series> {
    let mut places: BTreeMap<Vec<u64>, usize> = BTreeMap::new();
    let mut series: Vec<Series> = Vec::new();
    for (loops, outputs) in lines {
        let Some((x, others)) = loops.split_last() else { continue };
        let key = others.iter().map(|value| value.to_bits()).collect();
        let place = *places.entry(key).or_insert_with(|| {
            let label = others.iter().map(|value| general(*value, 4)).collect::<Vec<_>>();
            series.push(Series { label: label.join(" / "), ..Series::default() });
            series.len() - 1
        });
        series[place].points.push((*x, outputs[at]));
    }
    series
}

/// `count` of the series, evenly spaced.
fn spread(series: Vec<Series>, count: usize) -> Vec<Series> {
    let (all, steps) = (series.len(), count.max(2) - 1);
    let kept: Vec<usize> = (0..count).map(|at| at * (all - 1) / steps).collect();
    let kept = |(at, each): (usize, Series)| kept.contains(&at).then_some(each);
    series.into_iter().enumerate().filter_map(kept).collect()
}

/// A graph of measured values as dots and computed ones as a curve, each a place and two values.
pub(super) fn comparison(title: &str, across: &str, values: &[(f64, f64, f64)]) -> Graph {
    let mut values = values.to_vec();
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let points = |of: fn(&(f64, f64, f64)) -> (f64, f64)| values.iter().map(of).collect();
    let series =
        |label: &str, points, mark| Series { label: label.into(), points, mark, colour: None };
    Graph {
        title: title.to_owned(),
        across: across.to_owned(),
        up: title.to_owned(),
        series: vec![
            series("computed", points(|(x, _, computed)| (*x, *computed)), Mark::Curve),
            series("measured", points(|(x, measured, _)| (*x, *measured)), Mark::Dots),
        ],
        is_linear: false,
    }
}
