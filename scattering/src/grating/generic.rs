//! A grating drawn in a description file: vertices, and boundaries between materials.
//!
//! The blocks PARAMETERS, WORKING (optional), MATERIALS, VERTICES and BOUNDARIES each end with
//! END; `;` starts a comment. A boundary `v1 v2 left right` names the materials on its two sides
//! as seen from v1 to v2. Period and height are the extent of the vertices. The profile is cut
//! at the height of every vertex; each part then gets its share of `nlayers` slices by the
//! largest horizontal run of a boundary in it, and a slice has the materials at its middle.
//!
//! L. Li, J. Opt. Soc. Am. A 13, 1024 (1996), for profiles as stacks of lamellar slices.

use std::{collections::BTreeMap, sync::Arc};

use super::{
    COMMON, Grating, GratingCommon, GratingMaterial, LinePattern, LineProfile, LineSlice, levels,
};
use crate::spec::{Class, Laws, Parameter, ParameterError, ParameterKind, ParameterNode, Spec};

pub(crate) mod description;
mod expression;

use description::{DescriptionContext, GratingDescription};

/// The description file of a drawn grating.
pub(crate) const FILE: &[Parameter] = &[
    Parameter::file("filename", "File with the description"),
    Parameter {
        name: "pstring",
        kind: ParameterKind::Text,
        unit: "",
        doc: "Values of the file's PARAMETERS, (v1,v2,...)",
    },
];

const OWN: &[Parameter] = &[Parameter::integer("nlayers", 20, "Number of slices, about")];

/// Name, parameters and constructor of a [`GenericGrating`].
pub const SPEC: Spec<dyn Grating> = Spec {
    class: Class {
        name: "Generic_Grating",
        parent: "Grating",
        summary: "Line grating from a description file",
        equation: "materials between boundaries of a drawing",
        source: "li-1996b",
        params: &[COMMON, FILE, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(GenericGrating::read(node)?)),
};

/// A grating from a drawing.
#[derive(Clone, Debug)]
pub struct GenericGrating {
    common: GratingCommon,
    text: Arc<str>,
    values: Arc<str>,
    layers: usize,
}

impl GenericGrating {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        Ok(Self {
            common: GratingCommon::read(node)?,
            text: node.text("filename").into(),
            values: node.text("pstring").into(),
            layers: levels(node, "nlayers", 1)?,
        })
    }
}

impl Grating for GenericGrating {
    fn at(&self, lambda: f64) -> Result<LineProfile, ParameterError> {
        let surroundings = DescriptionContext {
            period: self.common.period,
            lambda,
            above: self.common.above.at(lambda),
            below: self.common.below.at(lambda),
        };
        let at_file = |problem: String| ParameterError::new("filename", problem);
        let description = GratingDescription::read(&self.text, &self.values, &surroundings)?;
        let drawing = LineDrawing::of(&description).map_err(at_file)?;
        let slices = drawing.slices(self.layers).map_err(at_file)?;
        let common = GratingCommon { period: drawing.right - drawing.left, ..self.common.clone() };
        Ok(common.profile(lambda, slices))
    }
}

/// A straight boundary, from lower to higher y, or to higher x where it is level.
struct Boundary {
    start: [f64; 2],
    end: [f64; 2],
    /// Material on the left going from start to end: −x of a steep one, above a level one.
    left: GratingMaterial,
    right: GratingMaterial,
}

impl Boundary {
    /// x at the height `y`, if the boundary passes it.
    fn x_at(&self, y: f64) -> Option<f64> {
        let ([x0, y0], [x1, y1]) = (self.start, self.end);
        (y0 < y && y < y1).then(|| x0 + (x1 - x0) * (y - y0) / (y1 - y0))
    }

    /// y at the place `x`, and the material above there.
    fn y_at(&self, x: f64) -> Option<(f64, GratingMaterial)> {
        let ([x0, y0], [x1, y1]) = (self.start, self.end);
        let above = if x1 > x0 { self.left } else { self.right };
        ((x0 < x && x < x1) || (x1 < x && x < x0))
            .then(|| (y0 + (y1 - y0) * (x - x0) / (x1 - x0), above))
    }
}

struct LineDrawing {
    boundaries: Vec<Boundary>,
    left: f64,
    right: f64,
    /// Distinct heights of vertices, ascending.
    heights: Vec<f64>,
}

impl LineDrawing {
    fn of(description: &GratingDescription) -> Result<Self, String> {
        let points = description.vertices::<2>()?;
        let boundaries = description
            .lines("BOUNDARIES")
            .map(|line| boundary(&line, description, &points))
            .collect::<Result<Vec<_>, _>>()?;
        let extent = |axis: usize| {
            points.values().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
                (low.min(p[axis]), high.max(p[axis]))
            })
        };
        let ((left, right), (low, high)) = (extent(0), extent(1));
        let usable = right > left && high > low && (right - left).is_finite();
        if !(usable && (high - low).is_finite()) {
            return Err("the vertices span no area".to_owned());
        }
        let mut heights: Vec<f64> = points.values().map(|p| p[1]).collect();
        heights.sort_by(f64::total_cmp);
        // Heights that differ by rounding are one.
        heights.dedup_by(|b, a| *b - *a <= 1e-12 * (high - low));
        Ok(Self { boundaries, left, right, heights })
    }

    /// All slices, the topmost first.
    fn slices(&self, layers: usize) -> Result<Vec<LineSlice>, String> {
        let parts = shares(&self.heights, layers, |low, high| self.run(low, high));
        let mut slices = Vec::new();
        for (low, high, count) in parts.into_iter().rev() {
            let thickness = (high - low) / count as f64;
            for k in (0..count).rev() {
                let pattern = self.pattern(low + (k as f64 + 0.5) * thickness)?;
                slices.push(LineSlice { thickness, pattern });
            }
        }
        Ok(slices)
    }

    /// The largest horizontal run of a boundary between two heights.
    fn run(&self, low: f64, high: f64) -> f64 {
        let middle = 0.5 * (low + high);
        self.boundaries
            .iter()
            .filter(|b| b.x_at(middle).is_some())
            .map(|b| ((b.end[0] - b.start[0]) / (b.end[1] - b.start[1])).abs() * (high - low))
            .fold(0.0, f64::max)
    }

    /// The materials along x at the height `y`.
    fn pattern(&self, y: f64) -> Result<LinePattern, String> {
        let mut crossings: Vec<(f64, &Boundary)> =
            self.boundaries.iter().filter_map(|b| Some((b.x_at(y)?, b))).collect();
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let period = self.right - self.left;
        let Some(&(first, _)) = crossings.first() else {
            return Ok(LinePattern::uniform(self.below(y)?, period));
        };
        let next = crossings.iter().cycle().skip(1);
        for ((x, here), (_, there)) in crossings.iter().zip(next) {
            if here.right != there.left {
                return Err(format!("two materials to the right of the boundary at ({x}, {y})"));
            }
        }
        let edges = crossings.iter().map(|c| c.0).chain([first + period]).collect();
        Ok(LinePattern::Bands { edges, materials: crossings.iter().map(|c| c.1.right).collect() })
    }

    /// The material at the height `y` where no boundary crosses it: that above the next one below.
    fn below(&self, y: f64) -> Result<GratingMaterial, String> {
        // Off the middle, where vertices are likely to be.
        let x = self.left + 0.381_966 * (self.right - self.left);
        self.boundaries
            .iter()
            .filter_map(|b| b.y_at(x))
            .filter(|(at, _)| *at < y)
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, material)| material)
            .ok_or_else(|| format!("no boundary tells the material at height {y}"))
    }
}

/// (bottom, top, number of slices) of the parts between neighbouring `heights`: of about `layers`
/// slices each part gets its share by its horizontal `run`, and at least one.
pub(crate) fn shares(
    heights: &[f64],
    layers: usize,
    run: impl Fn(f64, f64) -> f64,
) -> Vec<(f64, f64, usize)> {
    let runs: Vec<f64> = heights.windows(2).map(|y| run(y[0], y[1])).collect();
    let total: f64 = runs.iter().sum();
    let count = |run: f64| {
        let share = if total > 0.0 { (run / total * layers as f64 + 0.5).trunc() } else { 1.0 };
        (share as usize).max(1)
    };
    heights.windows(2).zip(runs).map(|(y, run)| (y[0], y[1], count(run))).collect()
}

fn boundary(
    line: &str,
    description: &GratingDescription,
    points: &BTreeMap<String, [f64; 2]>,
) -> Result<Boundary, String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let [start, end, left, right] = words[..] else {
        return Err(format!("boundary {line:?} is not two vertices and two materials"));
    };
    let point = |name: &str| {
        points.get(name).copied().ok_or_else(|| format!("boundary {line:?}: no vertex {name}"))
    };
    let (start, end) = (point(start)?, point(end)?);
    let (left, right) = (description.material(left)?, description.material(right)?);
    let turned = end[1] < start[1] || (end[1] == start[1] && end[0] < start[0]);
    Ok(if turned {
        Boundary { start: end, end: start, left: right, right: left }
    } else {
        Boundary { start, end, left, right }
    })
}
