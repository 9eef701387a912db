//! The axes of a graph, with their names and units.

use std::fmt::Write as _;

use mist_format::number::general;

use super::page::{MARGIN, WIDTH, text};

/// Height of a graph.
pub(super) const HEIGHT: f64 = 320.0;
/// Height of a graph with the numbers and the name of its axis.
pub(super) const BLOCK: f64 = HEIGHT + 48.0;
/// Width of the name and the numbers left of the axis.
const LEFT: f64 = 72.0;
/// The ratio of maxima beyond which the scale is logarithmic.
const LINEAR_SPREAD: f64 = 30.0;
/// Maximum number of decades of a logarithmic scale.
const DECADES: f64 = 4.0;

/// The axes of a graph: from values to coordinates of the page.
pub(super) struct GraphAxes {
    range: [f64; 2],
    values: [f64; 2],
    logarithmic: bool,
    top: f64,
    /// Width of the labels right of the graph.
    right: f64,
}

impl GraphAxes {
    /// Linear axes whose upper edge is at `top`.
    pub(super) fn linear(range: [f64; 2], values: [f64; 2], top: f64) -> Self {
        Self { range, values, logarithmic: false, top, right: 0.0 }
    }

    /// Axes for the places `range` of curves with these least and greatest values; logarithmic if the
    /// maxima of positive curves differ much and the axes need not be linear.
    pub(super) fn of_curves(
        (range, extremes): ([f64; 2], &[[f64; 2]]),
        is_linear: bool,
        top: f64,
        right: f64,
    ) -> Self {
        let high = extremes.iter().map(|[_, high]| *high).fold(0.0, f64::max);
        let low = extremes.iter().map(|[low, _]| *low).fold(0.0, f64::min);
        let maxima = extremes.iter().map(|[_, high]| *high).filter(|high| *high > 0.0);
        let least = maxima.fold(f64::INFINITY, f64::min);
        let logarithmic = !is_linear && low >= 0.0 && high > LINEAR_SPREAD * least;
        let values = match (logarithmic, high > low) {
            (_, false) => [0.0, 1.0],
            (false, _) => [low, high + 0.05 * (high - low)],
            (true, _) => {
                let above = high.log10().ceil();
                let below = (least / 3.0).log10().floor().max(above - DECADES);
                [10_f64.powf(below), 10_f64.powf(above)]
            }
        };
        Self { range, values, logarithmic, top, right }
    }

    /// The least value that the axis shows.
    pub(super) fn least(&self) -> f64 {
        self.values[0]
    }

    /// Upper and lower edge of the graph.
    pub(super) fn edges(&self) -> [f64; 2] {
        [self.top, self.top + HEIGHT]
    }

    pub(super) fn x(&self, at: f64) -> f64 {
        let [low, high] = self.range;
        let width = WIDTH - LEFT - 2.0 * MARGIN - self.right;
        let part = if high > low { (at - low) / (high - low) } else { 0.5 };
        LEFT + MARGIN + part * width
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

    /// Draws the axes; `names` are those of the horizontal and the vertical axis with their units.
    pub(super) fn draw(&self, names: [&str; 2], svg: &mut String) {
        let [low, high] = [self.x(self.range[0]), self.x(self.range[1])];
        let bottom = self.top + HEIGHT;
        for value in self.value_ticks() {
            let y = self.y(value);
            line(svg, (low, y), (high, y), "#e4e4e4");
            text(svg, (low - 6.0, y + 4.0), "text-anchor=\"end\"", &general(value, 3));
        }
        let [first, last] = self.range;
        for at in ticks(first, last, 8.0) {
            let x = self.x(at);
            line(svg, (x, bottom), (x, bottom + 5.0), "#555");
            text(svg, (x, bottom + 18.0), "text-anchor=\"middle\"", &general(at, 6));
        }
        line(svg, (low, bottom), (high, bottom), "#555");
        line(svg, (low, self.top), (low, bottom), "#555");
        text(svg, ((low + high) / 2.0, bottom + 36.0), "text-anchor=\"middle\"", names[0]);
        let (x, y) = (MARGIN + 10.0, self.top + HEIGHT / 2.0);
        let turned = format!("text-anchor=\"middle\" transform=\"rotate(-90 {x:.1} {y:.1})\"");
        text(svg, (x, y), &turned, names[1]);
    }
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
    if !(high > low) {
        return vec![low];
    }
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
        assert_eq!(ticks(3.0, 3.0, 5.0), [3.0]);
    }

    #[test]
    fn maxima_far_apart_have_a_logarithmic_scale() {
        let axes = GraphAxes::of_curves(([0.0, 1.0], &[[0.0, 0.01], [0.0, 10.0]]), false, 0.0, 0.0);
        assert!(axes.logarithmic && axes.least() == 1e-3);
        let axes =
            GraphAxes::of_curves(([0.0, 1.0], &[[-1.0, 0.01], [0.0, 10.0]]), false, 0.0, 0.0);
        assert!(!axes.logarithmic && axes.least() == -1.0);
    }
}
