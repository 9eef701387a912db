//! Convergence of diffraction efficiencies with the number of harmonics.
//!
//! A truncated series of harmonics has no bound of its error, and it conserves energy whatever its
//! error is. Sound runs compute every beam a second time with half the harmonics. The errors of
//! efficiencies fall at least as fast as one over the order, so that the distance of both results
//! is not less than the error of the one with all harmonics; for smooth profiles, which converge faster, it
//! is far more. The second computation costs an eighth of the first one, or less.
//!
//! L. Li, J. Opt. Soc. Am. A 13, 1870 (1996), on the rates of convergence.

use super::cone::OrderCone;
use crate::{Mode, ModelLimit, ParameterNode, rcw::PeriodicStructure, spec::SharedNotices};

/// Change of an efficiency from which on a result says so.
const STATED: f64 = 1e-3;
/// Part of the strongest efficiency below which others are compared with that part of it.
const WEAK: f64 = 1e-2;
/// Largest difference of the direction cosines of an order in both computations.
const SAME: f64 = 1e-9;

/// The order of the second computation: half, or more where half of it is nothing.
pub(super) fn other_order(order: usize) -> usize {
    match order {
        0 | 1 => order + 2,
        _ => order / 2,
    }
}

/// The same structure with another number of harmonics, to compare with.
pub(super) struct ConvergenceCheck {
    /// The structure with other harmonics.
    pub(super) structure: PeriodicStructure,
    notices: SharedNotices,
}

impl ConvergenceCheck {
    /// The check of a sound build; nothing under compat or if the `structure` cannot be had.
    pub(super) fn new(
        node: &ParameterNode,
        structure: impl FnOnce() -> Option<PeriodicStructure>,
    ) -> Option<Self> {
        if node.mode == Mode::Compat {
            return None;
        }
        Some(Self { structure: structure()?, notices: node.notices.clone() })
    }

    /// Notes the distance of the two results if it is not small.
    pub(super) fn compare(&self, cones: &[OrderCone], others: &[OrderCone]) {
        let change = distance(cones, others);
        if change > STATED {
            let limit = ModelLimit::HarmonicsUnconverged { millionths: rounded_up(change) };
            // A panic while the set was locked leaves a usable set.
            let mut notices =
                self.notices.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            notices.insert(limit.into());
        }
    }
}

/// The largest change of an efficiency, relative to itself or to [`WEAK`] of the strongest one.
fn distance(a: &[OrderCone], b: &[OrderCone]) -> f64 {
    let strength =
        |cones: &[OrderCone]| cones.iter().map(|cone| cone.mueller.largest()).fold(0.0, f64::max);
    let floor = WEAK * strength(a).max(strength(b));
    let found = |cone: &OrderCone, others: &[OrderCone]| {
        others.iter().find(|other| (other.axis - cone.axis).length() < SAME).copied()
    };
    let change = |cone: &OrderCone| match found(cone, b) {
        Some(other) => {
            let size = cone.mueller.largest().max(floor);
            if size > 0.0 { (cone.mueller - other.mueller).largest() / size } else { 0.0 }
        }
        None => 1.0,
    };
    let of_a = a.iter().map(change).fold(0.0, f64::max);
    // Orders that the first computation lacks.
    if b.iter().all(|cone| found(cone, a).is_some()) { of_a } else { of_a.max(1.0) }
}

/// In 10⁻⁶, rounded up to 1, 2 or 5 times a power of ten, so that similar errors give one notice.
fn rounded_up(error: f64) -> u32 {
    let millionths = error.min(1.0) * 1e6;
    let power = 10f64.powf(millionths.log10().floor());
    let digit = millionths / power;
    let steps = [1.0, 2.0, 5.0, 10.0];
    let digit = steps.into_iter().find(|step| digit <= step * (1.0 + 1e-9)).unwrap_or(10.0);
    (digit * power) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_rounded_up_to_a_few_values() {
        for (error, expected) in
            [(1.1e-3, 2000), (2e-3, 2000), (4.9e-3, 5000), (0.051, 100_000), (7.0, 1_000_000)]
        {
            assert_eq!(rounded_up(error), expected, "{error}");
        }
    }
}
