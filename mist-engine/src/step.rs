//! One step of a run: everything that its evaluation needs, and nothing of the steps before.

use std::sync::Arc;

use mist_format::{
    expr::{Expr, Value},
    number::general,
};
use scattering::Stokes;
use smallvec::SmallVec;
use smol_str::SmolStr;

use crate::{
    parameters::ModelParameters,
    region::{Region, RegionError},
    sampling::{LayoutKey, SamplingRule},
    slots::same,
};

/// One combination of loop values, ready to be evaluated.
#[derive(Clone)]
pub struct Step {
    /// Number of the step, from 0.
    pub index: u64,
    /// The model's parameters.
    pub parameters: ModelParameters,
    /// Polar angle of incidence, radians.
    pub theta_i: f64,
    /// Sample rotation, radians.
    pub rotation: f64,
    /// One per integral, in the order of the program; shared with the step before if equal.
    pub integrals: Arc<Vec<StepIntegral>>,
    /// Sampling rule of its integrals; an error for a wrong `integrationmode`,
    /// which integrals of one direction do not need.
    pub(crate) rule: Result<SamplingRule, RegionError>,
    /// The incident light of integrals without INPOL.
    pub(crate) incident: Stokes,
    /// Contents of the columns of the loops.
    pub(crate) columns: LoopCells,
    /// Values of the variables that outputs read, parallel to the job's `reads`; shared with the
    /// step before if equal.
    pub(crate) values: Arc<[Option<Value>]>,
    /// Lines for the listing.
    pub(crate) listing: Listing,
    /// Number of advances of each loop since its reset; empty if no colours are computed.
    pub(crate) counts: Vec<u64>,
    /// Progress of the first declared loop, from 0 to 1.
    pub(crate) fraction: f64,
}

/// One integral of a step.
#[derive(Clone, Debug)]
pub struct StepIntegral {
    /// The solid angle.
    pub region: Region,
    /// Rule by which its directions are chosen; without effect for one direction.
    pub rule: SamplingRule,
    /// Sensitivity of the detector.
    pub pol: Stokes,
    /// Incident light.
    pub inpol: Stokes,
}

impl StepIntegral {
    /// Key of its directions.
    pub(crate) fn layout_key(&self) -> LayoutKey {
        LayoutKey::new(&self.region, &self.rule)
    }
}

/// An integral of a step that has been evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluated {
    /// Its value.
    pub value: f64,
    /// The estimated error; NaN for integrals over a grid, 0 for one direction.
    pub error: f64,
}

impl Evaluated {
    /// Value of an integral that was not evaluated.
    pub(crate) const NONE: Self = Self { value: f64::NAN, error: f64::NAN };
}

/// Lines for the listing, mostly none or one.
pub(crate) type Listing = SmallVec<[ListingLine; 1]>;

/// A parameter that was sent to the model: a line of the listing.
#[derive(Clone, Debug)]
pub(crate) struct ListingLine {
    /// The entry of VARIABLES that sent it.
    pub(crate) entry: usize,
    pub(crate) input: SentInput,
    /// The input as text, if it was made.
    pub(crate) text: Option<Arc<str>>,
}

/// The input that an entry sent to the model.
#[derive(Clone, Debug)]
pub(crate) enum SentInput {
    Text(Arc<str>),
    Value(Value),
}

/// Digits of numbers in loop columns; the program's `format` does not concern them.
pub(crate) const COLUMN_DIGITS: usize = 6;

/// Contents of the columns of the loops, without an allocation for a few loops.
pub(crate) type LoopCells = SmallVec<[LoopCell; 4]>;

/// Contents of a loop column.
#[derive(Clone, Debug)]
pub(crate) enum LoopCell {
    /// Text as it is; a short one, as nearly all are, is copied without counting who holds it.
    Text(SmolStr),
    /// A number, and the text that shows it.
    Number(f64, SmolStr),
    /// An expression of a LIST file, evaluated with the new variables.
    Expression(Arc<Expr>),
}

impl LoopCell {
    /// The number `x`.
    pub(crate) fn of(x: f64) -> Self {
        Self::Number(x, general(x, COLUMN_DIGITS).into())
    }
}

impl PartialEq for SentInput {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Text(a), Self::Text(b)) => Arc::ptr_eq(a, b) || a == b,
            (Self::Value(a), Self::Value(b)) => same(Some(a), Some(b)),
            _ => false,
        }
    }
}
