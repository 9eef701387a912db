//! Key that distinguishes layouts.

use super::{Outlines, PlaneSampling, SamplingRule, accuracy::Accuracy};
use crate::region::Region;

/// Equal for layouts with the same directions: the bits of all numbers that define them.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LayoutKey {
    bits: Vec<u64>,
}

impl LayoutKey {
    /// The key of `region` with this rule; a layout and an adaptive integral never share one.
    pub fn new(region: &Region, rule: &SamplingRule) -> Self {
        let mut bits = shape(region);
        match rule {
            SamplingRule::Adaptive(Accuracy { tolerance, budget, is_required }) => {
                bits.extend([tolerance.to_bits(), *budget, u64::from(*is_required)]);
            }
            _ if matches!(region, Region::Differential { .. }) => {}
            SamplingRule::Grid(plane) => bits.extend(numbers(plane, None)),
            SamplingRule::MonteCarlo { plane, seed } => bits.extend(numbers(plane, Some(*seed))),
        }
        Self { bits }
    }
}

/// The numbers of a plane and of its points.
fn numbers(plane: &PlaneSampling, seed: Option<u64>) -> [u64; 6] {
    let PlaneSampling { projection, differential, min_samples, is_normalized, outlines } = *plane;
    let mode = 2 * projection as u64 + u64::from(is_normalized);
    let sides = match outlines {
        Outlines::Exact => u64::MAX,
        Outlines::Polygons { sides } => u64::from(sides.cast_unsigned()),
    };
    let min_samples = u64::from(min_samples.cast_unsigned());
    [differential.to_bits(), min_samples, mode, sides, u64::from(seed.is_some()), seed.unwrap_or(0)]
}

/// The numbers of a region.
fn shape(region: &Region) -> Vec<u64> {
    let mut bits = Vec::with_capacity(12);
    let mut numbers = |shape: u64, values: &[f64]| {
        bits.push(shape);
        bits.extend(values.iter().map(|v| v.to_bits()));
    };
    match region {
        Region::Differential { center } => numbers(0, &[center.0, center.1]),
        Region::Circle { center, alpha } => numbers(1, &[center.0, center.1, *alpha]),
        Region::Hemi => numbers(2, &[]),
        Region::Annulus { outer_center, outer_alpha, inner_center, inner_alpha } => {
            let (o, i) = (outer_center, inner_center);
            numbers(3, &[o.0, o.1, *outer_alpha, i.0, i.1, *inner_alpha]);
        }
        Region::Polygon { vertices, polarization_center: c } => {
            numbers(4, &[c.0, c.1]);
            vertices.iter().for_each(|v| numbers(5, &[v.0, v.1]));
        }
    }
    bits
}
