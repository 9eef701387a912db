//! The solid angles over which a program integrates.
//!
//! Directions are (θ, φ) in radians; x, y and z are sin θ cos φ, sin θ sin φ and cos θ.
//! Projected means on the plane of the sample, where the area of a region is its projected
//! solid angle ∫ cos θ dΩ.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;
use thiserror::Error;

mod caps;
mod direction;
mod outline;
mod polar_cell;
mod polygon;

pub(crate) use outline::{AxisRotation, above_horizon, outline, refuse_crossing};
pub(crate) use polygon::{CellContent, Polygon, PolygonCells};

pub use direction::PolarAngles;
pub(crate) use direction::unit;
pub use polar_cell::PolarCell;

use caps::Cap;

/// The shape of an integral, and the centre towards which a sensitivity is turned.
#[derive(Clone, Debug, PartialEq)]
pub enum Region {
    /// One direction; the integral is the integrand times cos θ.
    Differential {
        /// The direction.
        center: PolarAngles,
    },
    /// The cone of half angle `alpha` around `center`.
    Circle {
        /// The axis, also the centre of polarization.
        center: PolarAngles,
        /// The half angle, radians; its sign does not matter.
        alpha: f64,
    },
    /// Everything above the horizon.
    Hemi,
    /// A cone without a smaller one. Exact apertures take the larger of the two as the outer
    /// one; NIST's cover what lies in exactly one of them.
    Annulus {
        /// Axis of the outer cone, also the centre of polarization.
        outer_center: PolarAngles,
        /// Half angle of the outer cone, radians.
        outer_alpha: f64,
        /// Axis of the inner cone.
        inner_center: PolarAngles,
        /// Half angle of the inner cone, radians.
        inner_alpha: f64,
    },
    /// The polygon whose edges are straight in the projection, closed from last to first.
    Polygon {
        /// The corners, none below the horizon.
        vertices: Vec<PolarAngles>,
        /// The centre of polarization.
        polarization_center: PolarAngles,
    },
}

/// A region that cannot be sampled.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum RegionError {
    /// A value of `integrationmode` that stands for no sampling rule.
    #[error("integrationmode {0} is none of 1 to 6, 11 to 16 and 20")]
    Mode(i32),
    /// Two edges of a polygon cross; edge `k` runs to vertex `k`, counted from 1.
    #[error(
        "segments cross in polygon: the edge to vertex {first} and the edge to vertex {second}"
    )]
    Crossing {
        /// The edge that comes first.
        first: usize,
        /// The other one.
        second: usize,
    },
    /// A vertex lies below the horizon.
    #[error("vertex {number} is below the horizon: theta = {theta} rad is more than pi/2")]
    BelowHorizon {
        /// The vertex, counted from 1.
        number: usize,
        /// Its polar angle, radians.
        theta: f64,
    },
    /// NIST's program never ends for these.
    #[error("polygonsides is {0}, expected 0 or more")]
    PolygonSides(i32),
    /// An orthographic grid covers no more than a hemisphere around its axis.
    #[error(
        "alpha = {alpha} rad is more than pi/2, which an orthographic grid (integrationmode 3, 6, 13, 16) does not reach: use 1 or 2"
    )]
    WideOrthographic {
        /// The half angle, radians.
        alpha: f64,
    },
}

/// The circular cone that is sampled to cover a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BoundingCone {
    /// Its axis.
    pub(crate) axis: PolarAngles,
    /// Its solid angle, sr.
    pub(crate) solid_angle: f64,
}

impl Region {
    /// The cone of half angle `alpha` (radians) around `center`.
    ///
    /// That of 90° around the normal is the hemisphere, of which it has every direction: integrals
    /// over both share their matrices.
    pub fn around(center: PolarAngles, alpha: f64) -> Self {
        if center == (0.0, 0.0) && alpha == FRAC_PI_2 {
            return Self::Hemi;
        }
        Self::Circle { center, alpha }
    }

    /// The centre towards which a sensitivity is turned.
    pub fn polarization_center(&self) -> PolarAngles {
        match self {
            Self::Differential { center } | Self::Circle { center, .. } => *center,
            Self::Hemi => (0.0, 0.0),
            Self::Annulus { outer_center, .. } => *outer_center,
            Self::Polygon { polarization_center, .. } => *polarization_center,
        }
    }

    /// True if NIST's program takes a polygon for it (`Outlines::Polygons` of the sampling).
    pub(crate) fn is_round(&self) -> bool {
        matches!(self, Self::Circle { .. } | Self::Hemi | Self::Annulus { .. })
    }

    /// The region with the larger circle of an annulus as its outer one.
    ///
    /// The centre of polarization goes along, so it is read before.
    pub(crate) fn ordered(&self) -> Self {
        match *self {
            Self::Annulus { outer_center, outer_alpha, inner_center, inner_alpha }
                if inner_alpha.abs() > outer_alpha.abs() =>
            {
                Self::Annulus {
                    outer_center: inner_center,
                    outer_alpha: inner_alpha,
                    inner_center: outer_center,
                    inner_alpha: outer_alpha,
                }
            }
            _ => self.clone(),
        }
    }

    /// The cone around the region.
    pub(crate) fn cone(&self) -> BoundingCone {
        use std::f64::consts::PI;
        let around =
            |axis, alpha: f64| BoundingCone { axis, solid_angle: 2.0 * PI * (1.0 - alpha.cos()) };
        match self {
            Self::Differential { center } => BoundingCone { axis: *center, solid_angle: 0.0 },
            Self::Circle { center, alpha } => around(*center, *alpha),
            Self::Hemi => BoundingCone { axis: (0.0, 0.0), solid_angle: 2.0 * PI },
            Self::Annulus { outer_center, outer_alpha, inner_alpha, .. } => {
                around(*outer_center, outer_alpha.max(*inner_alpha))
            }
            Self::Polygon { vertices, .. } => cone_of_polygon(vertices),
        }
    }

    /// The exact projected solid angle (sr) above the horizon; of an annulus, that of the larger
    /// circle without the part it shares with the smaller one.
    pub fn projected_solid_angle(&self) -> f64 {
        match &self.ordered() {
            Self::Differential { .. } => 0.0,
            Self::Circle { center, alpha } => caps::area(&[Cap::new(*center, *alpha)]),
            Self::Hemi => std::f64::consts::PI,
            Self::Annulus { outer_center, outer_alpha, inner_center, inner_alpha } => {
                let outer = Cap::new(*outer_center, *outer_alpha);
                caps::area(&[outer]) - caps::area(&[outer, Cap::new(*inner_center, *inner_alpha)])
            }
            Self::Polygon { vertices, .. } => {
                Polygon::new(vertices.iter().map(|v| unit(*v).truncate()).collect()).area()
            }
        }
    }
}

/// The cone around a polygon: its axis is the middle of the projected extent, raised by 1.
fn cone_of_polygon(vertices: &[PolarAngles]) -> BoundingCone {
    let corners: Vec<DVec3> = vertices.iter().map(|v| unit(*v)).collect();
    let Some(first) = corners.first() else {
        return BoundingCone { axis: (0.0, 0.0), solid_angle: 0.0 };
    };
    let low = corners.iter().fold(*first, |a, b| a.min(*b));
    let high = corners.iter().fold(*first, |a, b| a.max(*b));
    let axis = DVec3::new(low.x + high.x, low.y + high.y, 2.0).normalize();
    let smallest = corners.iter().fold(1.0, |m: f64, v| m.min(axis.dot(*v)));
    BoundingCone {
        axis: (axis.z.acos(), axis.y.atan2(axis.x)),
        solid_angle: 2.0 * std::f64::consts::PI * (1.0 - smallest),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cone_of_a_polygon_holds_its_corners() {
        let vertices = vec![(1.5, 0.1), (1.2, 0.9), (0.3, 0.5), (0.9, -0.4)];
        let cone = cone_of_polygon(&vertices);
        let cosine = 1.0 - cone.solid_angle / (2.0 * std::f64::consts::PI);
        for v in vertices {
            assert!(unit(cone.axis).dot(unit(v)) >= cosine - 1e-15);
        }
    }

    #[test]
    fn the_sign_of_a_half_angle_does_not_matter() {
        let area = |alpha| Region::Circle { center: (0.9, 0.2), alpha }.projected_solid_angle();
        for alpha in [0.1, 0.8, 1.5] {
            assert!(area(alpha) > 0.0);
            assert_eq!(area(alpha), area(-alpha));
        }
    }

    #[test]
    fn the_larger_circle_of_an_ordered_annulus_is_outside() {
        let annulus = |outer_alpha, inner_alpha| Region::Annulus {
            outer_center: (0.0, 0.0),
            outer_alpha,
            inner_center: (0.0, 0.0),
            inner_alpha,
        };
        assert_eq!(annulus(0.2, 0.5).ordered(), annulus(0.5, 0.2));
        assert_eq!(annulus(0.5, 0.2).ordered(), annulus(0.5, 0.2));
    }
}
