//! Solid angles of adaptive integrals.

use scattering::{Basis, Incidence, Model, models::LobeSupport};

use super::{
    boundary::RegionBoundary,
    integrand::Integrand,
    peaks::{self, Peak},
    rays::Rays,
};
use crate::{
    region::{PolarCell, Region, RegionError, unit},
    sampling::sensitivity_rotation::SensitivityRotation,
};

/// A solid angle that is integrated over.
#[derive(Clone, Debug, PartialEq)]
pub enum Domain {
    /// An aperture of a program.
    Region(Region),
    /// A cell of a grid in the polar angles.
    Cell(PolarCell),
}

/// Directions in which the light of one beam is concentrated; they serve all domains.
#[derive(Clone, Debug)]
pub struct KnownPeaks {
    /// The narrowest first.
    pub(super) peaks: Vec<Peak>,
    pub(super) supports: Vec<LobeSupport>,
    /// Evaluations of the model that it took to find them.
    pub(super) evaluations: u64,
}

impl KnownPeaks {
    /// Looks for the peaks of `model` under one beam.
    pub fn find(model: &Model, incidence: &Incidence, basis: Basis) -> Self {
        let integrand = Integrand::new(model, incidence, basis, None);
        let (peaks, evaluations) = peaks::find(&integrand);
        Self { peaks, supports: integrand.lobe_supports(), evaluations }
    }

    /// The width (rad) of the narrowest lobe, infinite if none is narrower than a radian.
    pub(super) fn narrowest(&self) -> f64 {
        let peaks = self.peaks.iter().map(|peak| peak.width).filter(|width| *width < peaks::SMOOTH);
        let cones = self.supports.iter().map(|cone| 2.0 * cone.half_angle);
        peaks.chain(cones).fold(f64::INFINITY, f64::min)
    }
}

impl Domain {
    /// The domain of a region.
    ///
    /// # Errors
    ///
    /// For regions that do not exist.
    pub fn region(region: Region) -> Result<Self, RegionError> {
        RegionBoundary::new(&region.ordered(), &[])?;
        Ok(Self::Region(region))
    }

    /// The rotation of sensitivities that are given at its centre.
    pub(super) fn rotation(&self) -> Option<SensitivityRotation> {
        match self {
            Self::Region(region) => {
                Some(SensitivityRotation::towards(region.polarization_center()))
            }
            Self::Cell(cell) => cell.center.map(SensitivityRotation::towards),
        }
    }

    /// Its rays, and the peaks towards which its first cells become small.
    pub(super) fn rays<'p>(
        &self,
        known: &'p KnownPeaks,
    ) -> Result<(Rays, &'p [Peak]), RegionError> {
        match self {
            Self::Region(region) => {
                let rays = Rays::new(region, pole(region, known.peaks[0]), &known.supports)?;
                Ok((rays, &known.peaks[1..]))
            }
            // The pole is the normal, whose peak is one like the others.
            Self::Cell(cell) => Ok((Rays::of_cell(cell, &known.supports)?, &known.peaks)),
        }
    }
}

/// The pole of the coordinates: the narrowest peak, or the axis of the region if there is none, for
/// then the ends of the intervals change least.
fn pole(region: &Region, narrowest: Peak) -> Peak {
    let axis = unit(region.cone().axis);
    let is_usable = narrowest.width >= peaks::SMOOTH && axis.z > HORIZON;
    if is_usable { Peak { at: axis, ..narrowest } } else { narrowest }
}

/// z of the lowest axis that is a pole.
const HORIZON: f64 = 1e-3;
