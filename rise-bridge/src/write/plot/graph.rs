//! The spectra as curves over the wavelength, each in the colour of its row.

use std::fmt::Write as _;

use mist_engine::colour::ColourTable;
use mist_format::number::general;

use super::{
    display::DisplayColours,
    page::{MARGIN, WIDTH, evenly_spaced, text},
};

pub(super) const HEIGHT: f64 = 320.0;
/// Width of the numbers left of the axis.
const LEFT: f64 = 64.0;
/// Maximum number of curves.
const CURVES: usize = 16;
/// The ratio of maxima beyond which the scale is logarithmic.
const LINEAR_SPREAD: f64 = 30.0;
/// Maximum number of decades of a logarithmic scale.
const DECADES: f64 = 4.0;

/// The axes of a graph: from values to coordinates of the page.
pub(super) struct GraphAxes {
    wavelengths: [f64; 2],
    values: [f64; 2],
    logarithmic: bool,
    top: f64,
}

impl GraphAxes {
    /// Linear axes whose upper edge is at `top`.
    pub(super) fn linear(wavelengths: [f64; 2], values: [f64; 2], top: f64) -> Self {
        Self { wavelengths, values, logarithmic: false, top }
    }

    pub(super) fn x(&self, wavelength: f64) -> f64 {
        let [low, high] = self.wavelengths;
        LEFT + MARGIN + (wavelength - low) / (high - low) * (WIDTH - LEFT - 2.0 * MARGIN)
    }

    pub(super) fn y(&self, value: f64) -> f64 {
        let [low, high] = self.values;
        let value = value.max(low);
        let part = if self.logarithmic {
            (value / low).ln() / (high / low).ln()
        } else {
            (value - low) / (high - low)
        };
        self.top + HEIGHT * (1.0 - part)
    }

    fn value_ticks(&self) -> Vec<f64> {
        let [low, high] = self.values;
        if self.logarithmic {
            let decades = (high / low).log10().round() as i32;
            return (0..=decades).map(|i| low * 10_f64.powi(i)).collect();
        }
        ticks(low, high, 5.0)
    }
}

/// Draws the graph below `top` and returns its lower edge.
pub(super) fn draw(
    table: &ColourTable,
    display: &DisplayColours,
    top: f64,
    svg: &mut String,
) -> f64 {
    let shown: Vec<usize> = evenly_spaced(table.rows.len(), CURVES)
        .into_iter()
        .filter(|&row| table.rows[row].spectra[0].len() == table.wavelengths.len())
        .collect();
    let axes = axes(table, &shown, top);
    let of = match (shown.len(), table.rows.len()) {
        (some, all) if some < all => format!("{}, {some} of {all} rows", table.quantity),
        _ => table.quantity.clone(),
    };
    let below = shown.iter().flat_map(|&row| &table.rows[row].spectra[0]);
    let cut = below.filter(|value| **value < axes.values[0]).count();
    let cut = match cut {
        0 => String::new(),
        count => {
            format!("; axis cut: {count} values below {} lie on it", general(axes.values[0], 3))
        }
    };
    draw_axes(&axes, &(of + &cut), svg);
    for row in shown {
        let values = &table.rows[row].spectra[0];
        let points: String = table
            .wavelengths
            .iter()
            .zip(values)
            .map(|(w, v)| format!("{:.1},{:.1} ", axes.x(*w), axes.y(*v)))
            .collect();
        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<polyline fill=\"none\" stroke=\"#999\" stroke-width=\"3.2\" points=\"{points}\"/>\n\
             <polyline fill=\"none\" stroke=\"{}\" stroke-width=\"2.2\" points=\"{points}\"/>",
            display.hex(table, row),
        );
    }
    top + HEIGHT + 48.0
}

fn axes(table: &ColourTable, shown: &[usize], top: f64) -> GraphAxes {
    let maxima: Vec<f64> = shown
        .iter()
        .map(|&row| table.rows[row].spectra[0].iter().copied().fold(0.0, f64::max))
        .collect();
    let high = maxima.iter().copied().fold(0.0, f64::max);
    let least = maxima.iter().copied().filter(|m| *m > 0.0).fold(f64::INFINITY, f64::min);
    let logarithmic = high > LINEAR_SPREAD * least;
    let values = match (logarithmic, high > 0.0) {
        (_, false) => [0.0, 1.0],
        (false, _) => [0.0, 1.05 * high],
        (true, _) => {
            let above = high.log10().ceil();
            let below = (least / 3.0).log10().floor().max(above - DECADES);
            [10_f64.powf(below), 10_f64.powf(above)]
        }
    };
    let first = table.wavelengths.first().copied().unwrap_or(0.0);
    let last = table.wavelengths.last().copied().unwrap_or(1.0);
    GraphAxes { wavelengths: [first, last], values, logarithmic, top }
}

pub(super) fn draw_axes(axes: &GraphAxes, quantity: &str, svg: &mut String) {
    let [low, high] = axes.wavelengths.map(|w| axes.x(w));
    let bottom = axes.top + HEIGHT;
    for value in axes.value_ticks() {
        let y = axes.y(value);
        line(svg, (low, y), (high, y), "#e4e4e4");
        text(svg, (low - 6.0, y + 4.0), "text-anchor=\"end\"", &general(value, 3));
    }
    let [first, last] = axes.wavelengths;
    for w in ticks(first, last, 8.0) {
        let x = axes.x(w);
        line(svg, (x, bottom), (x, bottom + 5.0), "#555");
        text(svg, (x, bottom + 18.0), "text-anchor=\"middle\"", &general(w, 6));
    }
    line(svg, (low, bottom), (high, bottom), "#555");
    text(svg, (high, bottom + 34.0), "text-anchor=\"end\"", "wavelength (nm)");
    text(svg, (low, bottom + 34.0), "", &format!("curves: {quantity}"));
}

pub(super) fn line(svg: &mut String, (x1, y1): (f64, f64), (x2, y2): (f64, f64), colour: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(
        svg,
        "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{colour}\"/>"
    );
}

/// About `count` round numbers from `low` to `high`.
fn ticks(low: f64, high: f64, count: f64) -> Vec<f64> {
    let raw = (high - low) / count;
    let decade = 10_f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * decade).into_iter().find(|s| *s >= raw);
    let step = step.unwrap_or(raw);
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    (first..=last).map(|i| i as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_numbers_inside_the_range() {
        assert_eq!(
            ticks(360.0, 750.0, 8.0),
            [400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0, 750.0]
        );
        assert_eq!(ticks(0.0, 1.05, 5.0), [0.0, 0.5, 1.0]);
    }
}
