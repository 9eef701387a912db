//! Curves and dots in a graph, with their labels at the ends of the curves.

use std::fmt::Write as _;

use super::{
    axes::{BLOCK, GraphAxes},
    page::text,
};

/// Width of the labels right of the graph.
const LABELS: f64 = 150.0;
/// Distance of labels.
const LABEL_HEIGHT: f64 = 13.0;
/// Colours of curves that have none of their own: those of Okabe and Ito, without yellow.
const COLOURS: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000"];

/// The mark at the points of a series.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mark {
    /// As a curve.
    #[default]
    Curve,
    /// As dots.
    Dots,
}

/// The points of one curve.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Its name, written at its end.
    pub label: String,
    /// Places and values; those that are not finite are left out.
    pub points: Vec<(f64, f64)>,
    /// The mark at the points.
    pub mark: Mark,
    /// Its colour as `#rrggbb`; one of a palette if there is none.
    pub colour: Option<String>,
}

/// A graph of several series.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Graph {
    /// The text above it.
    pub title: String,
    /// Name and unit of the horizontal axis.
    pub across: String,
    /// Name and unit of the vertical axis.
    pub up: String,
    /// The series.
    pub series: Vec<Series>,
    /// True if the vertical axis is linear; if not, it is logarithmic for maxima far apart.
    pub is_linear: bool,
}

impl Graph {
    /// Draws the graph below `top` and returns its lower edge.
    pub(super) fn draw(&self, top: f64, svg: &mut String) -> f64 {
        let graph_top = top + if self.title.is_empty() { 0.0 } else { 22.0 };
        let axes = self.axes(graph_top);
        let below = |(_, value): &&(f64, f64)| *value < axes.least();
        let cut = self.series.iter().flat_map(|series| series.points.iter().filter(below)).count();
        let cut = match cut {
            0 => String::new(),
            count => format!("; {count} values below the axis lie on it"),
        };
        text(svg, (axes.x(self.range()[0]), top + 12.0), "", &format!("{}{cut}", self.title));
        axes.draw([&self.across, &self.up], svg);
        let mut ends = Vec::new();
        for (at, series) in self.series.iter().enumerate() {
            let own = series.colour.as_deref();
            let colour = own.unwrap_or(COLOURS[at % COLOURS.len()]);
            let points: Vec<(f64, f64)> =
                series.finite().map(|(x, y)| (axes.x(x), axes.y(y))).collect();
            match series.mark {
                Mark::Curve => curve(svg, &points, colour, own.is_some()),
                Mark::Dots => dots(svg, &points, colour),
            }
            if let (Some(end), false) = (points.last(), series.label.is_empty()) {
                let ink = if own.is_some() { "#333" } else { colour };
                ends.push((*end, series.label.as_str(), ink));
            }
        }
        labels(svg, axes.x(self.range()[1]), axes.edges(), ends);
        graph_top + BLOCK
    }

    fn axes(&self, top: f64) -> GraphAxes {
        let extremes = |series: &Series| {
            let start = [f64::INFINITY, f64::NEG_INFINITY];
            series.finite().fold(start, |[low, high], (_, y)| [low.min(y), high.max(y)])
        };
        let drawn = self.series.iter().filter(|series| series.finite().next().is_some());
        let extremes: Vec<[f64; 2]> = drawn.map(extremes).collect();
        GraphAxes::of_curves((self.range(), &extremes), self.is_linear, top, LABELS)
    }

    /// The least and the greatest place.
    fn range(&self) -> [f64; 2] {
        let places = || self.series.iter().flat_map(Series::finite).map(|(x, _)| x);
        let (low, high) =
            (places().fold(f64::INFINITY, f64::min), places().fold(f64::NEG_INFINITY, f64::max));
        if low <= high { [low, high] } else { [0.0, 1.0] }
    }
}

impl Series {
    fn finite(&self) -> impl Iterator<Item = (f64, f64)> {
        self.points.iter().copied().filter(|(x, y)| x.is_finite() && y.is_finite())
    }
}

/// A curve; with an outline if its colour may be that of the page.
fn curve(svg: &mut String, points: &[(f64, f64)], colour: &str, outlined: bool) {
    let places: String = points.iter().map(|(x, y)| format!("{x:.1},{y:.1} ")).collect();
    let outline = outlined.then_some(("#999", 3.2));
    for (colour, width) in outline.into_iter().chain([(colour, 2.2)]) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<polyline fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" points=\"{places}\"/>"
        );
    }
}

fn dots(svg: &mut String, points: &[(f64, f64)], colour: &str) {
    for (x, y) in points {
        // Writing to a string cannot fail.
        let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{colour}\"/>");
    }
}

/// Writes the labels right of the graph, none over another, each with a line to its curve.
fn labels(
    svg: &mut String,
    right: f64,
    [top, bottom]: [f64; 2],
    mut ends: Vec<((f64, f64), &str, &str)>,
) {
    ends.sort_by(|a, b| a.0.1.total_cmp(&b.0.1));
    let wanted: Vec<f64> = ends.iter().map(|((_, y), ..)| *y).collect();
    for (((x, y), label, ink), place) in ends.iter().zip(spread(&wanted, top, bottom)) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{:.1}\" y2=\"{place:.1}\" stroke=\"#bbb\"/>",
            right + 12.0
        );
        text(svg, (right + 15.0, place + 4.0), &format!("fill=\"{ink}\""), label);
    }
}

/// Heights near the `wanted` ones, in their order, that keep their distance.
fn spread(wanted: &[f64], top: f64, bottom: f64) -> Vec<f64> {
    let distance = LABEL_HEIGHT.min((bottom - top) / wanted.len().max(1) as f64);
    let mut places = Vec::new();
    let mut free = top;
    for y in wanted {
        places.push(y.max(free));
        free = places[places.len() - 1] + distance;
    }
    let mut limit = bottom;
    for place in places.iter_mut().rev() {
        *place = place.min(limit);
        limit = *place - distance;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_keep_their_distance_and_stay_inside() {
        let places = spread(&[0.0, 1.0, 99.0, 100.0], 0.0, 100.0);
        assert_eq!(places, [0.0, 13.0, 87.0, 100.0]);
        assert!(spread(&[50.0; 20], 0.0, 100.0).windows(2).all(|pair| pair[1] > pair[0]));
    }
}
