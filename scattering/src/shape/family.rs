//! The family of bodies of revolution: its interface, and what its classes share.

use std::f64::consts::PI;

use crate::{
    ParameterError, ParameterNode,
    spec::{self, Family, Parameter},
    special::gauss,
};

/// The family of bodies of revolution.
pub static FAMILY: Family =
    Family::new("Axisymmetric_Shape", "Shapes of bodies of revolution", spec::classes::<Shape>);

/// A body of revolution.
#[derive(Clone, Debug)]
pub struct Shape {
    nodes: Vec<SurfaceNode>,
    spheroid: Option<Spheroid>,
}

/// A spheroid with its centre at the origin, half axes in µm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spheroid {
    /// Along the axis of revolution.
    pub vertical: f64,
    /// Across it.
    pub horizontal: f64,
}

impl Spheroid {
    /// The longer half axis over the shorter one.
    pub fn aspect(&self) -> f64 {
        (self.vertical / self.horizontal).max(self.horizontal / self.vertical)
    }
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
    [Parameter::integer("npoints", 100, "Nodes of the outline from pole to pole")];

/// The parameter of shapes that depart from a simpler one.
pub(crate) const RENORM: [Parameter; 1] = [Parameter::integer(
    "renorm",
    0,
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
        Self { nodes, spheroid: None }
    }

    /// The same, known to be this spheroid if it is one.
    pub(crate) fn known_as(self, spheroid: Option<Spheroid>) -> Self {
        Self { spheroid, ..self }
    }

    /// The spheroid that this is, if it is one about its centre.
    pub fn spheroid(&self) -> Option<Spheroid> {
        self.spheroid
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
