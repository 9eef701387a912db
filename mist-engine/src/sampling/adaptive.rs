//! Adaptive cubature over exact apertures: a Mueller integral with an error estimate.
//!
//! The region is seen in polar coordinates (t, p) around the direction in which a smooth surface
//! would send the light. Along each ray p it is a set of intervals of t whose ends are known in
//! closed form; between the azimuths at which this set changes, (p, t) is mapped smoothly to
//! unit squares. Along a ray t = ε sinh w, where ε is the width of the peak that a few
//! evaluations around the pole have shown. The squares are halved where Gauss's rule is not
//! yet good enough, until the sum of the errors is small enough; then, while there are evaluations
//! left, where a cell is much longer than its neighbours ([`balance`]).
//!
//! Peaks in the directions of mirror, retro-reflection and refraction are found at any width
//! ([`peaks`]), and so are the cones into which gratings diffract; the rims of these cut the
//! squares. A peak of another place that is narrower than the first squares, about 0.1 rad, can
//! be missed.

use glam::DVec3;
use rayon::prelude::*;
use scattering::{Basis, Incidence, Model, Mueller, Stokes};
use thiserror::Error;

use crate::region::{Region, RegionError};

mod balance;
mod boundary;
mod cell;
mod domain;
mod estimate;
mod first;
mod gauss;
mod integrand;
mod peaks;
mod rays;
mod slice;

pub use super::accuracy::Accuracy;
pub use domain::{Domain, KnownPeaks};
pub use estimate::{Estimate, FLOOR};

use cell::{CubatureCell, MeasuredCell, NODES};
use integrand::Integrand;
use rays::Rays;

/// The estimated error of what a detector of the sensitivity `pol` sees under `inpol`, from the
/// errors of the elements.
pub fn contracted_error(error: &Mueller, pol: &Stokes, inpol: &Stokes) -> f64 {
    let [pol, inpol] = [pol, inpol].map(|s| Stokes(s.0.map(f64::abs)));
    pol.dot(&(*error * inpol))
}

/// Reason why there is no estimate.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum AdaptiveError {
    /// The region does not exist.
    #[error(transparent)]
    Region(#[from] RegionError),
    /// The tolerance was not met within the budget.
    #[error(
        "the tolerance {tolerance:e} is not reached: the relative error is {reached:.1e} after {evaluations} evaluations of the model"
    )]
    Budget {
        /// The relative error that was asked for.
        tolerance: f64,
        /// The relative error that was reached.
        reached: f64,
        /// Evaluations of the model.
        evaluations: u64,
    },
    /// The model is infinite or not a number somewhere.
    #[error("the model is infinite or not a number in the aperture")]
    NotFinite,
    /// Somebody ended it.
    #[error("stopped")]
    Stopped,
}

/// The Mueller integral of `model` over `region`, to this `accuracy`.
///
/// The bits do not depend on the number of threads.
///
/// # Errors
///
/// For regions that do not exist, when `stop` ends it, and, if the accuracy is required, where the
/// budget does not suffice or the integrand is not finite. Otherwise the estimate stands with its
/// error.
pub fn integrate(
    model: &Model,
    incidence: &Incidence,
    basis: Basis,
    region: &Region,
    accuracy: &Accuracy,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Estimate, AdaptiveError> {
    if let Region::Differential { center } = region {
        return Ok(Integrand::new(model, incidence, basis, None).one(*center));
    }
    let peaks = KnownPeaks::find(model, incidence, basis);
    let domain = Domain::Region(region.clone());
    let mut found = over((model, incidence, basis), &domain, &peaks, accuracy, stop)?;
    found.evaluations += peaks.evaluations;
    Ok(found)
}

/// [`integrate`] over any domain, with peaks that are known.
///
/// # Errors
///
/// Those of [`integrate`].
pub fn over(
    (model, incidence, basis): (&Model, &Incidence, Basis),
    domain: &Domain,
    peaks: &KnownPeaks,
    accuracy: &Accuracy,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Estimate, AdaptiveError> {
    let integrand = Integrand::new(model, incidence, basis, domain.rotation());
    Cubature::new(&integrand, domain, peaks, stop)?.refine(accuracy)
}

/// The width (rad) of the narrowest lobe of `model` in the likely directions, infinite if it has none
/// that is narrower than a radian.
pub(crate) fn narrowest_lobe(model: &Model, incidence: &Incidence, basis: Basis) -> f64 {
    KnownPeaks::find(model, incidence, basis).narrowest()
}

/// The directions at which the cells that [`integrate`] ends with have their nodes, and the
/// matrices there; they are computed again.
///
/// # Errors
///
/// Those of [`integrate`].
pub(crate) fn nodes(
    model: &Model,
    incidence: &Incidence,
    basis: Basis,
    region: &Region,
    accuracy: &Accuracy,
    visit: &mut dyn FnMut(DVec3, &Mueller),
) -> Result<(), AdaptiveError> {
    let (peaks, domain) =
        (KnownPeaks::find(model, incidence, basis), Domain::Region(region.clone()));
    let integrand = Integrand::new(model, incidence, basis, domain.rotation());
    let mut cubature = Cubature::new(&integrand, &domain, &peaks, &|| false)?;
    cubature.refine(accuracy)?;
    for measured in &cubature.cells {
        let mut at = measured.cell.nodes(&measured.cell.fan(&cubature.rays));
        at.weights = at.v[2].map(f64::recip);
        let mut values = [Mueller::ZERO; NODES];
        integrand.values(&at, &mut values);
        for (k, m) in values.iter().enumerate() {
            if at.v[2][k] > 0.0 {
                visit(at.at(k), m);
            }
        }
    }
    Ok(())
}

/// An integral on its way.
struct Cubature<'a> {
    integrand: &'a Integrand<'a>,
    rays: Rays,
    stop: &'a (dyn Fn() -> bool + Sync),
    cells: Vec<MeasuredCell>,
    evaluations: u64,
}

impl<'a> Cubature<'a> {
    /// The first cells of `domain`, measured.
    fn new(
        integrand: &'a Integrand<'a>,
        domain: &Domain,
        peaks: &KnownPeaks,
        stop: &'a (dyn Fn() -> bool + Sync),
    ) -> Result<Self, AdaptiveError> {
        let (rays, towards) = domain.rays(peaks)?;
        let first = rays.first_cells(towards);
        let mut cubature = Self { integrand, rays, stop, cells: Vec::new(), evaluations: 0 };
        cubature.cells = cubature.measure(first)?;
        Ok(cubature)
    }

    /// Halves cells until the sum of their errors meets `accuracy`.
    fn refine(&mut self, accuracy: &Accuracy) -> Result<Estimate, AdaptiveError> {
        loop {
            let sum = self.total();
            if !sum.is_finite() {
                return if accuracy.is_required { Err(AdaptiveError::NotFinite) } else { Ok(sum) };
            }
            let (largest, error) = (sum.matrix.largest(), sum.error.largest());
            let target = (accuracy.tolerance * largest).max(FLOOR);
            let is_reached = error <= target;
            let split =
                if is_reached { balance::too_long(&self.cells) } else { self.worst(target) };
            let fits = self.evaluations + (2 * NODES * split.len()) as u64 <= accuracy.budget;
            if is_reached && (split.is_empty() || !fits) {
                return Ok(sum);
            }
            if !fits && !accuracy.is_required {
                return Ok(sum);
            }
            if !fits {
                let (tolerance, evaluations) = (accuracy.tolerance, self.evaluations);
                let reached = error / largest;
                return Err(AdaptiveError::Budget { tolerance, reached, evaluations });
            }
            let halves = split.iter().flat_map(|(k, along_p)| self.cells[*k].cell.halves(*along_p));
            let mut halves = self.measure(halves.collect())?.into_iter();
            for (k, _) in split {
                self.cells[k] = halves.next().expect("a cell has two halves");
                self.cells.extend(halves.next());
            }
        }
    }

    fn measure(&mut self, cells: Vec<CubatureCell>) -> Result<Vec<MeasuredCell>, AdaptiveError> {
        let (rays, integrand, stop) = (&self.rays, self.integrand, self.stop);
        self.evaluations += (NODES * cells.len()) as u64;
        // Cells behind each other on the same rays, as most are, share them.
        let groups: Vec<&[CubatureCell]> = cells.chunk_by(CubatureCell::shares_rays).collect();
        let measured: Option<Vec<Vec<MeasuredCell>>> = groups
            .into_par_iter()
            .map(|cells| {
                let fan = cells[0].fan(rays);
                let measure =
                    |cell: &CubatureCell| (!stop()).then(|| cell.measure(&fan, integrand));
                cells.par_iter().map(measure).collect()
            })
            .collect();
        Ok(measured.ok_or(AdaptiveError::Stopped)?.into_iter().flatten().collect())
    }

    fn total(&self) -> Estimate {
        let mut sum = Estimate { evaluations: self.evaluations, ..Estimate::default() };
        for MeasuredCell { matrix, error, .. } in &self.cells {
            sum.matrix += *matrix;
            sum.error += *error;
        }
        sum
    }

    /// The cells to be halved, in order, and whether along p: those without which the rest would be
    /// below `target`.
    fn worst(&self, target: f64) -> Vec<(usize, bool)> {
        let mut by_error: Vec<(f64, usize)> =
            self.cells.iter().enumerate().map(|(k, c)| (c.error.largest(), k)).collect();
        by_error.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let least = WORTH * by_error[0].0;
        let mut rest: f64 = by_error.iter().map(|(error, _)| error).sum();
        let mut chosen = Vec::new();
        for (error, k) in by_error {
            if !chosen.is_empty() && (rest <= ENOUGH * target || error < least) {
                break;
            }
            rest -= error;
            chosen.push((k, self.cells[k].along_p));
        }
        chosen.sort_unstable();
        chosen
    }
}

/// Cells with errors of less than this part of the worst one wait for the next round.
const WORTH: f64 = 0.1;

/// The part of the allowed error that the cells which are not halved may have.
const ENOUGH: f64 = 0.8;

#[cfg(test)]
mod tests;
