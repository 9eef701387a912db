//! Adaptive cubature over exact apertures: a Mueller integral with an error estimate.
//!
//! The region is seen in polar coordinates (t, p) around the direction in which a smooth surface
//! would send the light. Along each ray p it is a set of intervals of t whose ends are known in
//! closed form; between the azimuths at which this set changes, (p, t) is mapped smoothly to
//! unit squares. Along a ray t = ε sinh w, so that a lobe of any width down to ε is as wide as
//! one step of w. The squares are halved where a pair of Gauss and Kronrod rules disagrees,
//! until the sum of the disagreements is small enough.
//!
//! A peak of another place that is narrower than the first squares, about 0.1 rad, can be
//! missed.

use glam::DVec3;
use rayon::prelude::*;
use scattering::{Basis, Direction, Incidence, Model, Mueller, Side, Stokes};
use thiserror::Error;

use super::turn::Turn;
use crate::region::{Angles, Region, RegionError, unit};

mod cell;
mod rays;

use cell::Cell;
use rays::Rays;

/// How accurate an integral must become, and what it may cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// Largest error of an element, relative to the largest element.
    pub tolerance: f64,
    /// Evaluations of the model, at most.
    pub budget: u64,
}

/// A Mueller integral and how far from the truth it may be.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The integral.
    pub matrix: Mueller,
    /// The estimated error of each element, not negative.
    pub error: Mueller,
    /// Evaluations of the model.
    pub evaluations: u64,
}

impl Estimate {
    /// The estimated error of what a detector of the sensitivity `pol` sees under `inpol`.
    pub fn contracted_error(&self, pol: &Stokes, inpol: &Stokes) -> f64 {
        let [pol, inpol] = [pol, inpol].map(|s| Stokes(s.0.map(f64::abs)));
        pol.dot(&(self.error * inpol))
    }
}

/// Why there is no estimate.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum AdaptiveError {
    /// The region does not exist.
    #[error(transparent)]
    Region(#[from] RegionError),
    /// The tolerance was not met within the budget.
    #[error(
        "tolerance not reached: the relative error is {reached:e} after {evaluations} evaluations of the model"
    )]
    Budget {
        /// The relative error that was reached.
        reached: f64,
        /// Evaluations of the model.
        evaluations: u64,
    },
    /// The model is infinite or not a number somewhere.
    #[error("the integrand is not finite")]
    NotFinite,
    /// Somebody ended it.
    #[error("stopped")]
    Stopped,
}

/// The Mueller integral of `model` over `region`, to the accuracy that `demand` asks for.
///
/// The bits do not depend on the number of threads.
///
/// # Errors
///
/// For regions that do not exist, where the budget does not suffice or the integrand is not
/// finite, and when `stop` ends it.
pub fn integrate(
    model: &Model,
    incidence: &Incidence,
    basis: Basis,
    region: &Region,
    demand: &Demand,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Estimate, AdaptiveError> {
    let integrand = Integrand {
        model,
        incidence,
        basis,
        turn: Turn::towards(region.polarization_center()),
        flip: if model.common().side.to_below() { -1.0 } else { 1.0 },
    };
    if let Region::Differential { center } = region {
        return Ok(integrand.one(*center));
    }
    let rays = Rays::new(region, peak(model, incidence))?;
    let mut cells = measure(&rays, &integrand, rays.first_cells(), stop)?;
    loop {
        let sum = total(&cells);
        let largest = sum.matrix.largest();
        if !sum.is_finite() {
            return Err(AdaptiveError::NotFinite);
        }
        let target = demand.tolerance * largest;
        if sum.error.largest() <= target {
            return Ok(sum);
        }
        let split = worst(&mut cells, target);
        let next = sum.evaluations + 2 * cell::NODES as u64 * split as u64;
        if next > demand.budget {
            let reached = sum.error.largest() / largest;
            return Err(AdaptiveError::Budget { reached, evaluations: sum.evaluations });
        }
        let halves = cells.drain(..split).flat_map(|c| c.cell.halves(c.along_p)).collect();
        cells.extend(measure(&rays, &integrand, halves, stop)?);
        // What the halved cells cost stays in the count.
        if let Some(first) = cells.first_mut() {
            first.estimate.evaluations += (cell::NODES * split) as u64;
        }
    }
}

/// The direction around which scattered light gathers: reflected, or refracted.
fn peak(model: &Model, incidence: &Incidence) -> DVec3 {
    let common = model.common();
    let sin = match common.side {
        Side::DownUp | Side::UpDown => return unit((incidence.theta, 0.0)),
        Side::DownDown => incidence.sin / common.substrate.re,
        Side::UpUp => incidence.sin * common.substrate.re,
    };
    unit((sin.clamp(-1.0, 1.0).asin(), 0.0))
}

/// A cell with its part of the integral.
struct Measured {
    cell: Cell,
    estimate: Estimate,
    /// Whether the rules disagree more along p than along t.
    along_p: bool,
}

fn measure(
    rays: &Rays,
    integrand: &Integrand<'_>,
    cells: Vec<Cell>,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<Measured>, AdaptiveError> {
    let measured: Option<Vec<Measured>> = cells
        .into_par_iter()
        .map(|cell| {
            (!stop()).then(|| {
                let (estimate, along_p) = cell.measure(rays, integrand);
                Measured { cell, estimate, along_p }
            })
        })
        .collect();
    measured.ok_or(AdaptiveError::Stopped)
}

fn total(cells: &[Measured]) -> Estimate {
    let mut sum = Estimate::default();
    for Measured { estimate, .. } in cells {
        sum.matrix += estimate.matrix;
        sum.error += estimate.error;
        sum.evaluations += estimate.evaluations;
    }
    sum
}

impl Estimate {
    fn is_finite(&self) -> bool {
        let finite = |m: &Mueller| m.0.iter().flatten().all(|x| x.is_finite());
        finite(&self.matrix) && finite(&self.error)
    }
}

/// Cells with errors of less than this part of the worst one wait for the next round.
const WORTH: f64 = 0.03;

/// Sorts the cells by their errors, and says how many of the first are to be halved: those
/// without which the rest would be well below `target`.
fn worst(cells: &mut [Measured], target: f64) -> usize {
    // The sort is stable, so equal errors keep an order that depends on nothing else.
    cells.sort_by(|a, b| b.estimate.error.largest().total_cmp(&a.estimate.error.largest()));
    let least = WORTH * cells[0].estimate.error.largest();
    let mut rest: f64 = cells.iter().map(|c| c.estimate.error.largest()).sum();
    let mut count = 0;
    for cell in cells.iter() {
        let error = cell.estimate.error.largest();
        if count > 0 && (rest <= 0.25 * target || error < least) {
            break;
        }
        rest -= error;
        count += 1;
    }
    count
}

/// R(β)ᵀ M cos θ as a function of the direction.
struct Integrand<'a> {
    model: &'a Model,
    incidence: &'a Incidence,
    basis: Basis,
    turn: Turn,
    flip: f64,
}

impl Integrand<'_> {
    /// The values at the unit vectors `at`, above the horizon.
    fn values(&self, at: &[DVec3], out: &mut [Mueller]) {
        let mut directions = [Direction::new(0.0, 0.0); cell::NODES];
        for (direction, v) in directions.iter_mut().zip(at) {
            *direction = super::seen(*v);
        }
        self.model.evaluate(self.incidence, &directions[..at.len()], self.basis, out);
        for (m, v) in out.iter_mut().zip(at) {
            let (c, s) = self.turn.at(*v);
            let s = self.flip * s;
            let [first, second] = [m.0[1], m.0[2]];
            for k in 0..4 {
                m.0[1][k] = c * first[k] - s * second[k];
                m.0[2][k] = s * first[k] + c * second[k];
            }
            *m = *m * v.z;
        }
    }

    /// One direction: nothing is left to estimate, and nothing is turned.
    fn one(&self, center: Angles) -> Estimate {
        let direction = Direction::new(center.0, center.1);
        let mut out = [Mueller::ZERO];
        self.model.evaluate(self.incidence, &[direction], self.basis, &mut out);
        Estimate { matrix: out[0] * direction.cos, error: Mueller::ZERO, evaluations: 1 }
    }
}

#[cfg(test)]
mod tests;
