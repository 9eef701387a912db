//! The family of line gratings: its interface, and what its classes share.

use num_complex::Complex64;

use super::pattern::LinePattern;
use crate::{
    optics::RefractiveIndex,
    spec::{self, Family, Parameter, ParameterError, ParameterNode},
};

/// The family of line gratings.
pub static FAMILY: Family = Family::new("Grating", "Gratings", spec::classes::<dyn Grating>);

/// A line grating.
pub trait Grating: Send + Sync {
    /// The grating at the vacuum wavelength `lambda` µm.
    ///
    /// # Errors
    ///
    /// If the materials at that wavelength do not fit together.
    fn at(&self, lambda: f64) -> Result<LineProfile, ParameterError>;
}

/// A grating at one wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct LineProfile {
    /// Period, µm.
    pub period: f64,
    /// Index of the medium above.
    pub above: Complex64,
    /// Index of the medium below.
    pub below: Complex64,
    /// Slices, the topmost first.
    pub slices: Vec<LineSlice>,
}

/// A slice in which the material does not depend on z.
#[derive(Clone, Debug, PartialEq)]
pub struct LineSlice {
    /// Thickness, µm.
    pub thickness: f64,
    /// The material along x.
    pub pattern: LinePattern,
}

/// The parameters of [`GratingCommon`]: the first group of every line grating.
pub const COMMON: &[Parameter] = &[
    Parameter::number("period", 1.0, "um", "Period"),
    Parameter::index("medium_i", (1.0, 0.0), "Index of the medium above"),
    Parameter::index("medium_t", (4.05, 0.05), "Index of the medium below"),
];

/// Parameters of every line grating.
#[derive(Clone, Debug)]
pub struct GratingCommon {
    /// Period, µm.
    pub period: f64,
    /// The medium above.
    pub above: RefractiveIndex,
    /// The medium below.
    pub below: RefractiveIndex,
}

impl GratingCommon {
    /// Reads the common parameters of `node`.
    ///
    /// # Errors
    ///
    /// If the period is not positive.
    pub fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        Ok(Self {
            period: positive(node, "period")?,
            above: node.index("medium_i").clone(),
            below: node.index("medium_t").clone(),
        })
    }

    /// The profile with these slices; neighbours with the same pattern become one slice.
    pub fn profile(&self, lambda: f64, slices: impl IntoIterator<Item = LineSlice>) -> LineProfile {
        let mut merged: Vec<LineSlice> = Vec::new();
        for slice in slices {
            match merged.last_mut() {
                Some(last) if last.pattern == slice.pattern => last.thickness += slice.thickness,
                _ => merged.push(slice),
            }
        }
        LineProfile {
            period: self.period,
            above: self.above.at(lambda),
            below: self.below.at(lambda),
            slices: merged,
        }
    }
}

/// The number `name`, if it is finite and > 0.
pub(crate) fn positive(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let x = node.number(name);
    if x > 0.0 && x.is_finite() {
        return Ok(x);
    }
    Err(ParameterError::new(name, format!("{x} is not greater than 0")))
}

/// The number `name`, if it is finite and ≥ 0.
pub(crate) fn not_negative(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let x = node.number(name);
    if x >= 0.0 && x.is_finite() {
        return Ok(x);
    }
    Err(ParameterError::new(name, format!("{x} is not 0 or greater")))
}

/// The number `name`, if it is finite.
pub(crate) fn finite(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let x = node.number(name);
    if x.is_finite() {
        return Ok(x);
    }
    Err(ParameterError::new(name, format!("{x} is not a finite number")))
}

/// Most slices a grating is cut into: beyond it the matrices would fill the memory.
const MOST_LEVELS: i32 = 10_000;

/// The integer `name` as a number of slices, at least `least`.
pub(crate) fn levels(
    node: &ParameterNode,
    name: &str,
    least: i32,
) -> Result<usize, ParameterError> {
    let n = node.integer(name);
    if (least..=MOST_LEVELS).contains(&n) {
        return Ok(n.unsigned_abs() as usize);
    }
    Err(ParameterError::new(name, format!("{n} is not from {least} to {MOST_LEVELS}")))
}
