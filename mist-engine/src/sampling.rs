//! Layout of the directions of an integral.
//!
//! A square grid or random points in a plane are projected onto a cone around the region, and
//! the points above the horizon and inside the region are kept. A [`Layout`] depends neither on
//! the wavelength nor on the model, so runs share it; large ones, and those that one integral
//! wants, are not stored but laid out chunk by chunk.

use std::{
    f64::consts::{FRAC_PI_2, PI, TAU},
    sync::OnceLock,
};

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use scattering::{Direction, geometry::is_above};

use crate::region::{AxisRotation, Polygon, Region, RegionError};
use crate::region::{above_horizon, outline, refuse_crossing};

mod accuracy;
pub mod adaptive;
mod chunk;
mod key;
mod lifting;
mod pattern;
mod points;
mod projection;
mod rule;
pub(crate) mod sensitivity_rotation;

pub(crate) use chunk::{DirectionChunk, Scratch};
pub use key::LayoutKey;
pub(crate) use pattern::truncated;
pub use projection::Projection;
pub(crate) use rule::IntegrationMode;
pub use rule::{Outlines, PlaneSampling, SamplingRule};

use chunk::seen_group;
use lifting::{Membership, PointClassifier, UndecidedPoint};
use pattern::PointPattern;
use sensitivity_rotation::SensitivityRotation;

/// Points of the plane per chunk: the unit of work and of addition.
const CHUNK: u64 = 512;

/// Layouts of at most so many points of the plane are stored (72 bytes per direction kept).
const STORED: u64 = 1 << 18;

/// The directions of a region with what an integral needs to know about them.
#[derive(Clone, Debug)]
pub struct Layout {
    plan: LayoutPlan,
    stored: OnceLock<Vec<DirectionChunk>>,
}

/// Scale from a weighted sum to an integral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Scale {
    /// Times a projected solid angle, over the sum of the weights.
    Normalized(f64),
    /// Times a solid angle per point.
    Fixed(f64),
}

#[derive(Clone, Debug)]
struct LayoutPlan {
    pattern: PointPattern,
    projection: Projection,
    frame: AxisRotation,
    inside: Membership,
    turn: SensitivityRotation,
    scale: Scale,
    outlines: Outlines,
}

impl Layout {
    /// Lays out `region` with a grid in `plane`, or with random points if there is a `seed`.
    ///
    /// # Errors
    ///
    /// For polygons that cross themselves or reach below the horizon, for cones that the projection
    /// does not cover, and for polygons with a negative number of sides.
    pub fn new(
        region: &Region,
        plane: &PlaneSampling,
        seed: Option<u64>,
    ) -> Result<Self, RegionError> {
        let layout = Self::planned(region, plane, seed)?;
        layout.store();
        Ok(layout)
    }

    /// [`Layout::new`] for a single integral: directions are made when they are evaluated.
    ///
    /// # Errors
    ///
    /// As [`Layout::new`].
    pub(crate) fn planned(
        region: &Region,
        plane: &PlaneSampling,
        seed: Option<u64>,
    ) -> Result<Self, RegionError> {
        Ok(Self { plan: LayoutPlan::new(region, plane, seed)?, stored: OnceLock::new() })
    }

    /// Stores the directions, unless there are too many.
    pub(crate) fn store(&self) {
        if self.plan.points() <= STORED {
            self.stored.get_or_init(|| self.plan.all_chunks());
        }
    }

    /// About how many directions and vertices a layout has, before it is made.
    ///
    /// Infinite or huge for extreme values of `differential`, `min_samples` and `sides`.
    pub fn estimate(region: &Region, plane: &PlaneSampling) -> f64 {
        let sides = match (region, plane.outlines) {
            (Region::Polygon { vertices, .. }, _) => vertices.len() as f64,
            (Region::Differential { .. }, _) | (_, Outlines::Exact) => 0.0,
            (Region::Annulus { .. }, Outlines::Polygons { sides }) => 2.0 * f64::from(sides),
            (_, Outlines::Polygons { sides }) => f64::from(sides),
        };
        let points = match region {
            Region::Differential { .. } => 1.0,
            _ => {
                let (step, radius) = grid(region, plane);
                PI * (radius / step).powi(2)
            }
        };
        sides.max(0.0) + if points.is_nan() { 0.0 } else { points }
    }

    /// The distance (rad) of neighbouring directions in the middle of a region.
    pub(crate) fn spacing(region: &Region, plane: &PlaneSampling) -> f64 {
        let (step, _) = grid(region, plane);
        step * plane.projection.area_per_area().sqrt()
    }

    /// The number of chunks; a chunk has at most 512 directions.
    pub(crate) fn chunks(&self) -> usize {
        usize::try_from(self.plan.points().div_ceil(CHUNK)).unwrap_or(usize::MAX)
    }

    /// Chunk `k`, made in `scratch` if it is not stored.
    pub(crate) fn chunk<'a>(&'a self, k: usize, scratch: &'a mut Scratch) -> &'a DirectionChunk {
        match self.stored.get() {
            Some(chunks) => &chunks[k],
            None => {
                self.plan.make_chunk(k as u64, scratch);
                &scratch.chunk
            }
        }
    }

    pub(crate) fn scale(&self) -> Scale {
        self.plan.scale
    }

    /// True if the region is one direction.
    pub(crate) fn is_single_direction(&self) -> bool {
        matches!(self.plan.inside, Membership::One(_))
    }

    /// Number of its directions; an upper bound for a layout that is not stored.
    pub fn directions(&self) -> usize {
        match self.stored.get() {
            Some(chunks) => chunks.iter().map(|chunk| chunk.directions.len()).sum(),
            None => usize::try_from(self.plan.points()).unwrap_or(usize::MAX),
        }
    }

    /// Memory of the directions if they are stored, at most, bytes.
    pub fn bytes(&self) -> usize {
        let per_direction = size_of::<Direction>() + 3 * size_of::<f64>();
        let most = if self.plan.points() <= STORED { self.plan.points() as usize } else { 0 };
        size_of::<Self>() + most * per_direction
    }
}

impl LayoutPlan {
    fn new(region: &Region, plane: &PlaneSampling, seed: Option<u64>) -> Result<Self, RegionError> {
        if let Region::Differential { center } = region {
            return Ok(Self::single(Direction::new(center.0, center.1)));
        }
        let PlaneSampling { projection, outlines, .. } = *plane;
        let turn = SensitivityRotation::towards(region.polarization_center());
        let ordered;
        let (region, inside, projected) = match outlines {
            Outlines::Polygons { sides } => {
                let outline = outline(region, sides)?;
                (region, Membership::Polygon(outline.polygon), outline.projected_solid_angle)
            }
            Outlines::Exact => {
                ordered = region.ordered();
                (&ordered, exact(&ordered, projection)?, ordered.projected_solid_angle())
            }
        };
        let (step, radius) = grid(region, plane);
        let pattern = PointPattern::new(step, radius, seed);
        let scale = if plane.is_normalized {
            Scale::Normalized(projected)
        } else {
            Scale::Fixed(projection.area_per_area() * pattern.area_per_point())
        };
        let inside = match inside {
            Membership::Polygon(polygon) => {
                Membership::Polygon(polygon.for_points(pattern.points()))
            }
            other => other,
        };
        let frame = AxisRotation::new(region.cone().axis);
        Ok(Self { pattern, projection, frame, inside, turn, scale, outlines })
    }

    fn single(direction: Direction) -> Self {
        Self {
            pattern: PointPattern::One,
            projection: Projection::EqualArea,
            frame: AxisRotation::new((0.0, 0.0)),
            inside: Membership::One(direction),
            turn: SensitivityRotation::towards((0.0, 0.0)),
            scale: Scale::Fixed(1.0),
            outlines: Outlines::Exact,
        }
    }

    fn points(&self) -> u64 {
        self.pattern.points()
    }

    fn all_chunks(&self) -> Vec<DirectionChunk> {
        let count = self.points().div_ceil(CHUNK);
        let made = |scratch: &mut Scratch, k| {
            self.make_chunk(k, scratch);
            scratch.chunk.clone()
        };
        if count == 1 {
            return vec![made(&mut Scratch::default(), 0)];
        }
        (0..count).into_par_iter().map_init(Scratch::default, made).collect()
    }

    /// Makes chunk `k` in `scratch`.
    fn make_chunk(&self, k: u64, Scratch { points, lifted, chunk }: &mut Scratch) {
        if let Membership::One(direction) = self.inside {
            chunk.fill_with_one(direction.is_above().then_some(direction));
            return;
        }
        self.pattern.part(k * CHUNK..self.points().min((k + 1) * CHUNK), points);
        let known = PointClassifier::new(self.projection, &self.frame, &self.inside);
        lifted.fill(points, &known, |point| self.kept(point));
        chunk.fill(lifted, &self.turn);
    }

    /// The direction of `point` and its weight times cos θ, if it belongs to the region.
    fn kept(
        &self,
        UndecidedPoint { plane, mut v, mut weight }: UndecidedPoint,
    ) -> Option<(DVec3, f64)> {
        if !(self.projection.clearance(plane.to_array(), v.z) >= 0.0) {
            let u;
            (u, weight) = self.projection.lift_by_angles(plane);
            v = self.frame.turn(u.to_array()).into();
        }
        let is_above = match self.outlines {
            Outlines::Polygons { .. } => v.z > 0.0,
            Outlines::Exact => is_above(v.z),
        };
        let belongs = is_above
            && match &self.inside {
                Membership::Cone => true,
                Membership::Polygon(polygon) => polygon.contains(projected(v)),
                Membership::Outside { axis, cos } => axis.dot(v) <= *cos,
                Membership::One(_) => false,
            };
        belongs.then_some((v, weight * v.z))
    }
}

/// x and y of a direction with the unit vector `v`.
///
/// Next to an axis they are taken of the angles, as NIST's program does: a vertex may lie there,
/// and then the rounding of cos π/2 decides.
fn projected(v: DVec3) -> DVec2 {
    if v.x.abs().min(v.y.abs()) > AXIS {
        return v.truncate();
    }
    crate::region::unit((v.z.acos(), v.y.atan2(v.x))).truncate()
}

/// Closer to an axis than this, rounding decides.
const AXIS: f64 = 1e-12;

/// The test that makes a grid on the cone of `region` a grid on the region itself.
fn exact(region: &Region, projection: Projection) -> Result<Membership, RegionError> {
    match region {
        Region::Polygon { vertices, .. } => {
            above_horizon(vertices)?;
            let corners = vertices.iter().map(|v| crate::region::unit(*v).truncate());
            let polygon = Polygon::new(corners.collect());
            refuse_crossing(polygon.crossing(true))?;
            Ok(Membership::Polygon(polygon))
        }
        Region::Circle { alpha, .. } => {
            reachable(*alpha, projection)?;
            Ok(Membership::Cone)
        }
        Region::Annulus { outer_alpha, inner_center, inner_alpha, .. } => {
            reachable(*outer_alpha, projection)?;
            let axis = crate::region::unit(*inner_center);
            Ok(Membership::Outside { axis, cos: inner_alpha.cos() })
        }
        Region::Hemi => Ok(Membership::Cone),
        Region::Differential { center } => Ok(Membership::One(Direction::new(center.0, center.1))),
    }
}

fn reachable(alpha: f64, projection: Projection) -> Result<(), RegionError> {
    if projection == Projection::Orthographic && alpha.abs() > FRAC_PI_2 {
        return Err(RegionError::WideOrthographic { alpha: alpha.abs() });
    }
    Ok(())
}

/// Step and radius of the grid in the plane.
fn grid(region: &Region, plane: &PlaneSampling) -> (f64, f64) {
    let solid_angle = match plane.outlines {
        Outlines::Exact => region.ordered().cone().solid_angle,
        Outlines::Polygons { .. } => region.cone().solid_angle,
    };
    let least = (f64::from(plane.min_samples).sqrt() + 0.9999999).floor().powi(2);
    let mut per_point = plane.differential;
    if solid_angle / per_point < least {
        per_point = solid_angle / least;
    }
    let alpha = (1.0 - solid_angle / TAU).acos();
    let projection = plane.projection;
    ((per_point / projection.area_per_area()).sqrt(), projection.radius(alpha))
}
