//! Measured spectra as dots, simulated spectra as lines, unscaled and scaled to the dots.

use std::fmt::Write as _;

use mist_format::number::general;
use spectra::compare::SpectrumComparison;

use super::{
    axes::{BLOCK, GraphAxes, line},
    page::{MARGIN, TITLE, WIDTH, page, text},
};

/// Colour of the simulated curve.
const SIMULATED: &str = "#1f5fbf";

/// The pictures of comparisons, one below the other; with each the names of the measured and the
/// simulated spectrum.
pub fn plot_comparisons(comparisons: &[([&str; 2], &SpectrumComparison)]) -> String {
    let mut body = String::new();
    let mut y = MARGIN;
    for (names, comparison) in comparisons {
        y = draw(*names, comparison, y, &mut body);
    }
    page(y, &body)
}

fn draw(
    [measured, simulated]: [&str; 2],
    c: &SpectrumComparison,
    top: f64,
    svg: &mut String,
) -> f64 {
    let scaled: Vec<f64> = c.simulated.iter().map(|v| c.scale * v).collect();
    let all = || c.measured.iter().chain(&c.simulated).chain(&scaled).copied();
    let (low, high) = (all().fold(0.0, f64::min), all().fold(0.0, f64::max));
    let high = if high > low { high } else { low + 1.0 };
    let ends = [c.wavelengths[0], c.wavelengths[c.wavelengths.len() - 1]];
    let axes = GraphAxes::linear(ends, [low, high + 0.05 * (high - low)], top + TITLE);
    axes.draw(["wavelength (nm)", "value (1: perfect diffuser)"], svg);
    let legend = "dots measured, line simulated, dashes simulated × factor";
    text(svg, (WIDTH - MARGIN, top + 16.0), "text-anchor=\"end\" fill=\"#555\"", legend);
    text(svg, (MARGIN, top + 16.0), "font-size=\"16\"", measured);
    text(svg, (MARGIN, top + 34.0), &format!("fill=\"{SIMULATED}\""), simulated);
    let correlation = c.correlation.map_or_else(|| "none".to_owned(), |r| format!("{r:.4}"));
    let numbers = format!(
        "rms {}, best factor {}, correlation {correlation}, CIEDE2000 {:.2}, {:.2} after the factor",
        general(c.rms, 4),
        general(c.scale, 4),
        c.delta_e,
        c.scaled_delta_e,
    );
    text(svg, (MARGIN, top + 50.0), "fill=\"#555\"", &numbers);
    for (values, dashes) in [(&c.simulated, ""), (&scaled, " stroke-dasharray=\"6 4\"")] {
        let points = c.wavelengths.iter().zip(values);
        let points: String =
            points.map(|(w, v)| format!("{:.1},{:.1} ", axes.x(*w), axes.y(*v))).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<polyline fill=\"none\" stroke=\"{SIMULATED}\" stroke-width=\"2\"{dashes} \
             points=\"{points}\"/>"
        );
    }
    for (w, v) in c.wavelengths.iter().zip(&c.measured) {
        let (x, y) = (axes.x(*w), axes.y(*v));
        let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"#222\"/>");
    }
    if low < 0.0 {
        line(svg, (axes.x(ends[0]), axes.y(0.0)), (axes.x(ends[1]), axes.y(0.0)), "#999");
    }
    top + TITLE + BLOCK + 8.0
}
