//! Size distributions: numbers of particles per volume or area and per diameter.

use crate::spec::{Family, Member, Spec};

pub mod cc1246e;
pub mod regular;

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

/// The distributions over a volume, in the order they are listed to users.
pub const VOLUME: &[&Spec<dyn VolumeSize>] = &[&regular::VOLUME];

/// The distributions over an area, in the order they are listed to users.
pub const SURFACE: &[&Spec<dyn SurfaceSize>] = &[&regular::SURFACE, &cc1246e::SPEC];

impl Member for dyn VolumeSize {
    const FAMILY: Family = Family::VolumeSize;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(VOLUME.iter().copied())
    }
}

impl Member for dyn SurfaceSize {
    const FAMILY: Family = Family::SurfaceSize;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(SURFACE.iter().copied())
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ladder_sums_a_power_law_to_its_integral() {
        // ∫ d⁻² dd from 1 to 10 is 0.9; a rectangle sum with 10⁻⁴ steps is off by half a step.
        let sum: f64 = ladder(1.0, 10.0, 1e-4).map(|(d, width)| width / (d * d)).sum();
        assert!((sum - 0.9).abs() < 1e-4);
    }

    #[test]
    fn ladders_that_do_not_rise_are_known() {
        for (start, end, step) in [(1.0, 2.0, 0.0), (0.0, 2.0, 0.1), (1.0, 1e300, 1e-6)] {
            assert!(!is_ladder(start, end, step));
        }
        assert!(is_ladder(1.0, 1.0, 0.1));
    }
}
