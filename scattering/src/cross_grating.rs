//! Crossed gratings: profiles that repeat along two axes, cut into slices.
//!
//! Axis 1 is x; axis 2 leans from y towards x by ζ (`zeta`), so that a place with the oblique
//! coordinates (x₁, x₂) is at x = x₁ + x₂ sin ζ, y = x₂ cos ζ. Slices are listed from the top.

use num_complex::Complex64;

use crate::{
    optics::RefractiveIndex,
    spec::{Family, Member, Parameter, ParameterError, ParameterNode, Spec},
};

pub mod cylinder;
pub mod generic;
mod grid;
pub mod null;
pub mod one_d;
pub mod overlaid;
pub mod overlaid_1d;
mod pattern;
pub mod pyramidal_pit;
pub mod rectangle;
pub mod sphere;

pub use grid::PixelGrid;
pub use pattern::{CrossPattern, HarmonicTruncation};

/// A crossed grating.
pub trait CrossGrating: Send + Sync {
    /// The grating at the vacuum wavelength `lambda` µm.
    ///
    /// # Errors
    ///
    /// If the materials at that wavelength do not fit together.
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParameterError>;
}

/// A crossed grating at one wavelength.
#[derive(Clone, Debug)]
pub struct CrossProfile {
    /// The two periods and their angle.
    pub lattice: Lattice,
    /// Index of the medium above.
    pub above: Complex64,
    /// Index of the medium below.
    pub below: Complex64,
    /// Slices, the topmost first.
    pub slices: Vec<CrossSlice>,
}

/// The periods of a crossed grating.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Period along axis 1, µm.
    pub d1: f64,
    /// Period along axis 2, µm.
    pub d2: f64,
    /// Angle from y to axis 2, radians.
    pub zeta: f64,
}

impl Lattice {
    /// Lateral wave vector, in units of 2π/`lambda`, of the order (i, j).
    pub fn harmonic(&self, i: isize, j: isize, lambda: f64) -> (f64, f64) {
        let (a, b) = (i as f64 * lambda / self.d1, j as f64 * lambda / self.d2);
        (a, (b - a * self.zeta.sin()) / self.zeta.cos())
    }
}

/// A slice in which the material does not depend on z.
#[derive(Clone, Debug)]
pub struct CrossSlice {
    /// Thickness, µm.
    pub thickness: f64,
    /// The material along both axes.
    pub pattern: CrossPattern,
    /// Shift along both axes, as fractions of the periods.
    pub shift: (f64, f64),
}

impl CrossSlice {
    /// A slice that is not shifted.
    pub fn new(thickness: f64, pattern: CrossPattern) -> Self {
        Self { thickness, pattern, shift: (0.0, 0.0) }
    }
}

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn CrossGrating>] = &[
    &one_d::SPEC,
    &cylinder::SPEC,
    &rectangle::SPEC,
    &sphere::SPEC,
    &pyramidal_pit::SPEC,
    &generic::SPEC,
    &overlaid::SPEC,
    &overlaid_1d::SPEC,
    &null::SPEC,
];

impl Member for dyn CrossGrating {
    const FAMILY: Family = Family::CrossGrating;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}

/// The media on both sides: the first group of every crossed grating.
pub const MEDIA: &[Parameter] = &[
    Parameter::index("medium_i", "(1,0)", "Index of the medium above"),
    Parameter::index("medium_t", "(4.05,0.05)", "Index of the medium below"),
];

/// The media on both sides of a crossed grating.
#[derive(Clone, Debug)]
pub struct CrossGratingMedia {
    /// The medium above.
    pub above: RefractiveIndex,
    /// The medium below.
    pub below: RefractiveIndex,
}

impl CrossGratingMedia {
    /// Reads the parameters of [`MEDIA`].
    pub fn read(node: &ParameterNode) -> Self {
        Self { above: node.index("medium_i").clone(), below: node.index("medium_t").clone() }
    }

    /// The profile between these media.
    pub fn profile(&self, lambda: f64, lattice: Lattice, slices: Vec<CrossSlice>) -> CrossProfile {
        let (above, below) = (self.above.at(lambda), self.below.at(lambda));
        CrossProfile { lattice, above, below, slices }
    }

    /// An error at `name` unless the medium above is that of the part that lies on top.
    pub(crate) fn starts_with(
        &self,
        lambda: f64,
        name: &str,
        part: Complex64,
    ) -> Result<(), ParameterError> {
        same(name, part, self.above.at(lambda))
    }

    /// An error at `name` unless the medium below is that of the lowest part.
    pub(crate) fn ends_with(
        &self,
        lambda: f64,
        name: &str,
        part: Complex64,
    ) -> Result<(), ParameterError> {
        same(name, part, self.below.at(lambda))
    }
}

/// An error at `name` unless two neighbours have the same medium between them.
pub(crate) fn same(name: &str, this: Complex64, other: Complex64) -> Result<(), ParameterError> {
    if this == other {
        return Ok(());
    }
    Err(ParameterError::new(name, format!("{this} differs from its neighbour, {other}")))
}

/// The angle `name` in degrees, if two axes can enclose it.
pub(crate) fn lean(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let angle = node.number(name);
    if angle.abs() < 90.0 {
        return Ok(angle.to_radians());
    }
    Err(ParameterError::new(name, format!("{angle} is not between -90 and 90")))
}
