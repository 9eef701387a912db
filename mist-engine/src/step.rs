//! One step of a run: everything that its evaluation needs, and nothing of the steps before.

use mist_format::expr::Value;
use scattering::Stokes;

use crate::{parameters::Parameters, region::Region, sampling::Sampling};

/// One combination of loop values, ready to be evaluated.
pub struct Step {
    /// Number of the step, from 0.
    pub index: u64,
    /// The model's parameters.
    pub parameters: Parameters,
    /// Polar angle of incidence, radians.
    pub theta_i: f64,
    /// Sample rotation, radians.
    pub rotation: f64,
    /// One per integral, in the order of the program.
    pub integrals: Vec<Integral>,
    /// How its integrals are sampled.
    pub(crate) sampling: Sampling,
    /// The incident light of integrals without INPOL.
    pub(crate) incident: Stokes,
    /// What the columns of the loops show.
    pub(crate) columns: Vec<Cell>,
    /// Values of the variables that outputs read, parallel to the job's `reads`.
    pub(crate) values: Vec<Option<Value>>,
    /// Lines for the listing.
    pub(crate) listing: String,
    /// How often each loop was advanced since its reset.
    pub(crate) counts: Vec<u64>,
    /// How far the first declared loop is, from 0 to 1.
    pub(crate) fraction: f64,
}

/// One integral of a step.
pub struct Integral {
    /// The solid angle.
    pub region: Region,
    /// How it is sampled.
    pub sampling: Sampling,
    /// Sensitivity of the detector.
    pub pol: Stokes,
    /// Incident light.
    pub inpol: Stokes,
}

/// What a loop column shows.
#[derive(Clone, Debug)]
pub(crate) enum Cell {
    /// Text as it is.
    Text(String),
    /// A number, printed with six digits.
    Number(f64),
    /// An expression of a LIST file, evaluated with the new variables.
    Expression(Box<mist_format::expr::Expr>),
}
