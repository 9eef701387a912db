//! Size distributions: numbers of particles per volume or area and per diameter.

use crate::spec::{Member, Spec};

pub mod cc1246e;
mod family;
pub mod regular;

pub use family::{
    MOST_RUNGS, SURFACE_FAMILY, SurfaceSize, VOLUME_FAMILY, VolumeSize, is_ladder, ladder,
};

/// The distributions over a volume, in the order they are listed to users.
pub const VOLUME: &[&Spec<dyn VolumeSize>] = &[&regular::VOLUME];

impl Member for dyn VolumeSize {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[VOLUME];
}

/// The distributions over an area, in the order they are listed to users.
pub const SURFACE: &[&Spec<dyn SurfaceSize>] = &[&regular::SURFACE, &cc1246e::SPEC];

impl Member for dyn SurfaceSize {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[SURFACE];
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
