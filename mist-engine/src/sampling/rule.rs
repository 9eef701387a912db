//! Sampling rules: how the directions of an integral are chosen.
//!
//! The numbers that the language gives to the rules (`integrationmode`) exist only in
//! [`IntegrationMode::decode`].

use super::{accuracy::Accuracy, projection::Projection};
use crate::region::RegionError;

/// Rule by which the directions of an integral are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SamplingRule {
    /// A square grid in a plane that is projected onto the sphere.
    Grid(PlaneSampling),
    /// Random points in that plane, uniformly distributed over a disk.
    MonteCarlo {
        /// The plane and the number of points.
        plane: PlaneSampling,
        /// Selects the points: equal seeds give equal points.
        seed: u64,
    },
    /// Adaptive cubature with an error estimate, over exact outlines.
    Adaptive(Accuracy),
}

impl SamplingRule {
    /// The plane of a grid or of random points, with the seed of the latter.
    pub fn plane(&self) -> Option<(&PlaneSampling, Option<u64>)> {
        match self {
            Self::Grid(plane) => Some((plane, None)),
            Self::MonteCarlo { plane, seed } => Some((plane, Some(*seed))),
            Self::Adaptive(_) => None,
        }
    }

    /// The accuracy of an adaptive integral.
    pub fn accuracy(&self) -> Option<&Accuracy> {
        match self {
            Self::Adaptive(accuracy) => Some(accuracy),
            Self::Grid(_) | Self::MonteCarlo { .. } => None,
        }
    }
}

/// The points of a plane that are projected onto the sphere: how many, and how they are weighted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneSampling {
    /// From the plane to the sphere.
    pub projection: Projection,
    /// Solid angle per direction, sr.
    pub differential: f64,
    /// Smallest number of directions in the cone around a region.
    pub min_samples: i32,
    /// True if the weights are scaled so that they sum to the projected solid angle of the region;
    /// without it a point stands for its share of the plane.
    pub is_normalized: bool,
    /// The outlines of circles and hemispheres.
    pub outlines: Outlines,
}

/// Of the patches of material tables: at most (0.5°)² per direction and at least 100 directions in
/// an equal-area grid over exact outlines.
impl Default for PlaneSampling {
    fn default() -> Self {
        Self {
            projection: Projection::EqualArea,
            differential: 0.5_f64.to_radians().powi(2),
            min_samples: 100,
            is_normalized: true,
            outlines: Outlines::Exact,
        }
    }
}

/// The outlines of circles, rings and the hemisphere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Outlines {
    /// Cones and the hemisphere, cut by the horizon and nothing else.
    #[default]
    Exact,
    /// The polygons that NIST's program takes for them.
    Polygons {
        /// Edges per circle, `polygonsides`.
        sides: i32,
    },
}

/// A decoded value of the variable `integrationmode`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum IntegrationMode {
    /// A grid (`is_random` false) or random points.
    Plane { projection: Projection, is_random: bool, is_normalized: bool },
    /// Adaptive cubature.
    Adaptive,
}

impl IntegrationMode {
    /// Decodes 1–3 (grids), 4–6 (random points), 10 more for sums without normalization, and 20
    /// (adaptive).
    ///
    /// As in NIST's program, other tens are read like 10.
    ///
    /// # Errors
    ///
    /// For all other numbers.
    pub(crate) fn decode(mode: i32) -> Result<Self, RegionError> {
        if mode == 20 {
            return Ok(Self::Adaptive);
        }
        let projection = match mode % 10 {
            1 | 4 => Projection::Equidistant,
            2 | 5 => Projection::EqualArea,
            3 | 6 => Projection::Orthographic,
            _ => return Err(RegionError::Mode(mode)),
        };
        let (is_random, is_normalized) = (mode % 10 > 3, mode / 10 == 0);
        Ok(Self::Plane { projection, is_random, is_normalized })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_no_mode_are_refused() {
        for mode in [0, 7, 10, 17, -1, 30] {
            assert_eq!(IntegrationMode::decode(mode), Err(RegionError::Mode(mode)));
        }
    }

    #[test]
    fn modes_have_their_projection_points_and_normalization() {
        let plane = |mode| match IntegrationMode::decode(mode) {
            Ok(IntegrationMode::Plane { projection, is_random, is_normalized }) => {
                (projection, is_random, is_normalized)
            }
            other => panic!("{mode}: {other:?}"),
        };
        assert_eq!(plane(1), (Projection::Equidistant, false, true));
        assert_eq!(plane(5), (Projection::EqualArea, true, true));
        assert_eq!(plane(13), (Projection::Orthographic, false, false));
        assert_eq!(plane(24), (Projection::Equidistant, true, false));
        assert_eq!(IntegrationMode::decode(20), Ok(IntegrationMode::Adaptive));
    }
}
