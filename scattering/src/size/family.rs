//! The family of size distributions: its interface, and what its classes share.

use crate::spec::{self, Family};

/// The family of size distributions per volume.
pub static VOLUME_FAMILY: Family = Family::new(
    "VolumeParticleSizeDistribution",
    "Particle sizes per volume",
    spec::classes::<dyn VolumeSize>,
);

/// The family of size distributions per area.
pub static SURFACE_FAMILY: Family = Family::new(
    "SurfaceParticleSizeDistribution",
    "Particle sizes per area",
    spec::classes::<dyn SurfaceSize>,
);

/// Particles per volume.
pub trait VolumeSize: Send + Sync {
    /// Number density in 1/(µm³ µm) at the diameter `d` µm.
    fn density(&self, d: f64) -> f64;
}

/// Particles per area.
pub trait SurfaceSize: Send + Sync {
    /// Number density in 1/(µm² µm) at the diameter `d` µm.
    fn density(&self, d: f64) -> f64;
}

/// The diameters start·(1 + step)^j ≤ `end` of a logarithmic sum, each with its width d·step.
///
/// Every diameter is the one before times 1 + `step`, so that the last one is in or out of the
/// sum as in programs that count up the same way.
pub fn ladder(start: f64, end: f64, step: f64) -> impl Iterator<Item = (f64, f64)> {
    std::iter::successors(Some(start), move |d| Some(d * (1.0 + step)))
        .take_while(move |d| *d <= end)
        .map(move |d| (d, d * step))
}

/// The most rungs that a [`ladder`] of a model may have.
pub const MOST_RUNGS: f64 = 1e5;

/// True if a ladder rises and has at most [`MOST_RUNGS`] rungs.
pub fn is_ladder(start: f64, end: f64, step: f64) -> bool {
    let rises = start > 0.0 && step > 0.0 && end.is_finite();
    rises && (end / start).ln() < MOST_RUNGS * step.ln_1p()
}
