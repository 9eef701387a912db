//! Bodies of revolution: their outline r(θ) at the nodes of a quadrature.
//!
//! θ = 0 points down, to the substrate of a model with one. The outline is cut into smooth
//! pieces, each with ⌊n Δθ/π⌋ nodes of a Gauss–Legendre rule in θ, n = `npoints`; a piece too
//! short for a node is left out.

use std::f64::consts::PI;

use crate::{
    ParameterError, ParameterNode,
    spec::{Family, Member, Parameter, Spec},
    special::gauss,
};

pub mod chebyshev;
pub mod conical;
pub mod cylinder;
pub mod double_conical;
pub mod ellipsoid;
pub mod indented_ellipsoid;
mod outline;
pub mod table;

/// A body of revolution.
#[derive(Clone, Debug)]
pub struct Shape {
    nodes: Vec<SurfaceNode>,
}

/// A node of the outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceNode {
    /// Polar angle, radians.
    pub theta: f64,
    /// Weight of the node in an integral over θ.
    pub weight: f64,
    /// Distance from the origin, µm.
    pub r: f64,
    /// dr/dθ, µm.
    pub slope: f64,
}

/// The most nodes of an outline.
const MOST: i32 = 10_000;

/// The parameter of every shape.
pub(crate) const SHAPE: [Parameter; 1] =
    [Parameter::integer("npoints", "100", "Nodes of the outline from pole to pole")];

/// The parameter of shapes that depart from a simpler one.
pub(crate) const RENORM: [Parameter; 1] = [Parameter::integer(
    "renorm",
    "0",
    "1: scaled to the volume of the body without rounded corners or waves",
)];

impl Shape {
    /// The outline `profile`, which gives r and dr/dθ at θ on a piece, between the angles
    /// `breaks` that rise from 0 to π.
    pub(crate) fn sample(
        points: usize,
        breaks: &[f64],
        profile: impl Fn(usize, f64) -> (f64, f64),
    ) -> Self {
        let mut nodes = Vec::with_capacity(points);
        for (piece, ends) in breaks.windows(2).enumerate() {
            let count = (points as f64 * (ends[1] - ends[0]) / PI).max(0.0) as usize;
            for (theta, weight) in gauss::legendre(count, ends[0], ends[1]) {
                let (r, slope) = profile(piece, theta);
                nodes.push(SurfaceNode { theta, weight, r, slope });
            }
        }
        Self { nodes }
    }

    /// The nodes, in rising order of θ.
    pub fn nodes(&self) -> &[SurfaceNode] {
        &self.nodes
    }

    /// The largest distance from the origin at a node, µm.
    pub fn reach(&self) -> f64 {
        self.nodes.iter().map(|node| node.r).fold(0.0, f64::max)
    }

    /// The height of the origin over a plane that the body rests on, µm: the largest r cos θ at a
    /// node.
    pub fn height(&self) -> f64 {
        self.nodes.iter().map(|node| node.r * node.theta.cos()).fold(0.0, f64::max)
    }

    /// Volume, µm³.
    pub fn volume(&self) -> f64 {
        let part = |node: &SurfaceNode| node.weight * node.theta.sin() * node.r.powi(3);
        2.0 * PI / 3.0 * self.nodes.iter().map(part).sum::<f64>()
    }

    fn scaled(mut self, factor: f64) -> Self {
        for node in &mut self.nodes {
            node.r *= factor;
            node.slope *= factor;
        }
        self
    }

    /// The same scaled to `volume` µm³ if the parameter `renorm` requests it.
    pub(crate) fn renormalized(self, params: &ParameterNode, volume: impl FnOnce() -> f64) -> Self {
        if params.integer("renorm") == 0 {
            return self;
        }
        let factor = (volume() / self.volume()).cbrt();
        self.scaled(factor)
    }

    /// The same upside down.
    pub(crate) fn turned_over(mut self) -> Self {
        self.nodes.reverse();
        for node in &mut self.nodes {
            node.theta = PI - node.theta;
            node.slope = -node.slope;
        }
        self
    }

    /// The shape, if it has nodes and all of them are off the origin.
    pub(crate) fn checked(self, parameter: &str) -> Result<Box<Self>, ParameterError> {
        let good =
            |node: &SurfaceNode| node.r > 0.0 && node.r.is_finite() && node.slope.is_finite();
        if !self.nodes.is_empty() && self.nodes.iter().all(good) {
            return Ok(Box::new(self));
        }
        Err(ParameterError::new(parameter, "the outline does not go around the origin"))
    }
}

/// The parameter `npoints`.
pub(crate) fn points(params: &ParameterNode) -> Result<usize, ParameterError> {
    match params.integer("npoints") {
        n @ 1..=MOST => Ok(n as usize),
        n => Err(ParameterError::new("npoints", format!("{n} is not from 1 to {MOST}"))),
    }
}

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<Shape>] = &[
    &ellipsoid::SPEC,
    &cylinder::SPEC,
    &conical::SPEC,
    &double_conical::SPEC,
    &indented_ellipsoid::SPEC,
    &chebyshev::SPEC,
    &table::SPEC,
];

impl Member for Shape {
    const FAMILY: Family = Family::Shape;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mode, ParameterValue, optics::RealFunction, spec};

    fn build(name: &str, values: &[(&str, ParameterValue)]) -> Result<Box<Shape>, ParameterError> {
        let node = ParameterNode::with_defaults(spec::find_class(name).unwrap(), Mode::Sound);
        let node =
            values.iter().try_fold(node, |node, (name, value)| node.with(name, value.clone()))?;
        spec::build::<Shape>(&node)
    }

    #[test]
    fn slopes_are_the_derivatives_of_the_outlines() {
        for spec in ALL {
            let values = match spec.class.name {
                "Cylinder_Axisymmetric_Shape" => vec![("corner", ParameterValue::Number(0.01))],
                "Conical_Axisymmetric_Shape" => vec![
                    ("corner_base", ParameterValue::Number(0.005)),
                    ("corner_apex", ParameterValue::Number(0.01)),
                ],
                _ => vec![],
            };
            let shape = build(spec.class.name, &values).unwrap();
            // Closed outlines return to their start: ∫ r' dθ = r(π) − r(0), here from the
            // neighbours of the poles, and each step follows its slope up to curvature.
            for pair in shape.nodes().windows(2) {
                let step = pair[1].theta - pair[0].theta;
                let linear = pair[0].r + 0.5 * step * (pair[0].slope + pair[1].slope);
                assert!((pair[1].r - linear).abs() < 2e-3 * pair[1].r, "{}", spec.class.name);
            }
        }
    }

    #[test]
    fn volumes_are_those_of_geometry() {
        let close = |shape: Box<Shape>, expected: f64| {
            // The piece next to the cut of a node count differs by rounding of the count only.
            assert!((shape.volume() / expected - 1.0).abs() < 1e-6, "{}", shape.volume());
        };
        let [r, h] = [0.05f64, 0.1f64];
        close(build("Ellipsoid_Axisymmetric_Shape", &[]).unwrap(), 4.0 / 3.0 * PI * r.powi(3));
        close(build("Cylinder_Axisymmetric_Shape", &[]).unwrap(), PI * r * r * h);
        close(build("Conical_Axisymmetric_Shape", &[]).unwrap(), PI * r * r * h / 3.0);
        close(build("Double_Conical_Axisymmetric_Shape", &[]).unwrap(), PI * r * r * h / 3.0);
    }

    #[test]
    fn renormalized_bodies_have_the_volume_of_the_plain_ones() {
        for (name, values, plain) in [
            ("Cylinder_Axisymmetric_Shape", vec![("corner", 0.02)], PI * 0.05 * 0.05 * 0.1),
            ("Double_Conical_Axisymmetric_Shape", vec![("corner_waist", 0.01)], PI * 2.5e-4 / 3.0),
            ("Chebyshev_Axisymmetric_Shape", vec![], 4.0 / 3.0 * PI * 0.05f64.powi(3)),
        ] {
            let mut values: Vec<_> =
                values.into_iter().map(|(name, x)| (name, ParameterValue::Number(x))).collect();
            values.push(("renorm", ParameterValue::Integer(1)));
            let volume = build(name, &values).unwrap().volume();
            assert!((volume / plain - 1.0).abs() < 1e-4, "{name} {volume} {plain}");
        }
    }

    #[test]
    fn impossible_bodies_are_refused() {
        for (name, parameter, value) in [
            ("Ellipsoid_Axisymmetric_Shape", "vertical", 0.0),
            ("Ellipsoid_Axisymmetric_Shape", "offset", 0.06),
            ("Cylinder_Axisymmetric_Shape", "corner", 0.06),
            ("Cylinder_Axisymmetric_Shape", "radius", f64::NAN),
            ("Conical_Axisymmetric_Shape", "corner_apex", 1.0),
            ("Conical_Axisymmetric_Shape", "offset", 0.1),
            ("Double_Conical_Axisymmetric_Shape", "height", -1.0),
            ("Indented_Ellipsoid_Axisymmetric_Shape", "indent", 0.05),
            ("Chebyshev_Axisymmetric_Shape", "amplitude", 2.0),
            ("Table_Axisymmetric_Shape", "scale", -1.0),
        ] {
            let error = build(name, &[(parameter, ParameterValue::Number(value))]).unwrap_err();
            assert!(!error.problem.is_empty(), "{name}");
        }
        let table = [("table", ParameterValue::Table(RealFunction::constant(0.0)))];
        assert_eq!(build("Table_Axisymmetric_Shape", &table).unwrap_err().parameter, "table");
        let none = [("npoints", ParameterValue::Integer(0))];
        assert_eq!(build("Table_Axisymmetric_Shape", &none).unwrap_err().parameter, "npoints");
    }
}
