//! What tells one layout from another.

use crate::region::{Apertures, Region};

use super::{Sampling, adaptive::Accuracy};

/// Equal for layouts with the same directions: the bits of all numbers that define them.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LayoutKey {
    bits: Vec<u64>,
}

impl LayoutKey {
    /// The key of the layout of `region`.
    pub fn new(region: &Region, sampling: &Sampling) -> Self {
        let mut bits = shape(region);
        if matches!(region, Region::Differential { .. }) {
            return Self { bits };
        }
        bits.extend([sampling.differential.to_bits(), sampling.min_samples.to_bits()]);
        bits.push(u64::from(sampling.mode.cast_unsigned()));
        match sampling.apertures {
            Apertures::Exact => bits.push(u64::MAX),
            Apertures::Nist => bits.push(u64::from(sampling.polygon_sides.cast_unsigned())),
        }
        bits.push(sampling.seed);
        Self { bits }
    }

    /// The key of adaptive integrals over `region`; no layout has it.
    pub fn adaptive(region: &Region, accuracy: &Accuracy) -> Self {
        let mut bits = shape(region);
        bits.extend([accuracy.tolerance.to_bits(), accuracy.budget]);
        Self { bits }
    }
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
