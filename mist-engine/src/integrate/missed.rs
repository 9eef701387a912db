//! Lobes that fall between the directions of a grid.

use scattering::{Basis, Incidence, Model, Mueller};

use crate::{
    region::Region,
    sampling::{
        Layout, PlaneSampling,
        adaptive::{self, Accuracy, Estimate},
    },
};

/// Relative error of a grid, of the integral for unpolarized light, above which a warning is given.
const NOTICED: f64 = 1e-3;

/// A lobe that is narrower than the distance of directions, and that the grid integrates wrongly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MissedLobe {
    /// The width of the lobe, rad.
    pub(crate) width: f64,
    /// The distance of directions, rad.
    pub(crate) spacing: f64,
    /// The integral over the grid.
    pub(crate) grid: Mueller,
    /// The adaptive integral over the exact region.
    pub(crate) adaptive: Estimate,
}

impl MissedLobe {
    /// The lobe that makes `grid`, the integral over directions in `plane`, wrong; nothing if all
    /// lobes are wider than the distance of directions, or the integral is right nevertheless.
    ///
    /// The adaptive integral is computed only if a lobe is narrower than the distance.
    pub(crate) fn find(
        (model, incidence, basis): (&Model, &Incidence, Basis),
        (region, plane): (&Region, &PlaneSampling),
        grid: &Mueller,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Option<Self> {
        let spacing = Layout::spacing(region, plane);
        let width = adaptive::narrowest_lobe(model, incidence, basis);
        if !(incidence.is_above() && spacing > width) {
            return None;
        }
        let accuracy = &Accuracy::DEFAULT;
        let adaptive = adaptive::integrate(model, incidence, basis, region, accuracy, stop).ok()?;
        let off = (grid[(0, 0)] - adaptive.matrix[(0, 0)]).abs();
        let noticed = NOTICED * adaptive.matrix.largest() + adaptive.error.largest();
        (off > noticed).then_some(Self { width, spacing, grid: *grid, adaptive })
    }
}
