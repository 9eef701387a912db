//! Evaluation of models for vectors towards the light and the viewer, in the frame of the surface.
//!
//! A renderer has directions, not the four angles of a goniometer. With n̂ the normal, x̂ the
//! fiducial axis projected on the surface, v_s and v_v the unit vectors to the source and to the
//! viewer, e = unit(v_s − (n̂·v_s) n̂) and the laboratory's axes X = −e, Y = n̂ × X:
//!
//! $$ \cos\theta_i = |\hat n\cdot v_s|,\quad \cos\theta_s = |\hat n\cdot v_v|,\quad
//!    \varphi_s = \mathrm{atan2}(v_v\cdot Y, v_v\cdot X),\quad
//!    r = \mathrm{atan2}(\hat x\cdot Y, \hat x\cdot X) $$
//!
//! The laboratory turns with the source, so psps, xyxy and plane are the bases of the angles: the
//! x of xyxy lies in the plane of incidence. At normal incidence that plane is the one of x̂ (e =
//! −x̂, r = 0). Sines and cosines come from scalar products.
//!
//! NIST's library has no e at normal incidence and gives NaN there; elsewhere it takes φ_s with
//! the opposite sign but turns the sample to its true side, so that a sample with a direction is
//! seen in the wrong place ([`Defect::VectorAzimuth`](crate::Defect::VectorAzimuth)).

use glam::DVec3;

use crate::{Basis, Direction, Incidence, Mode, Model, Mueller, Side};

/// A surface in space: where its normal points, and the axis that its parameters call x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    x: DVec3,
    y: DVec3,
    normal: DVec3,
}

/// Reason why vectors describe no surface.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// The normal has no direction.
    #[error("normal: {0} has no direction; give a finite vector that is not zero")]
    Normal(DVec3),
    /// The fiducial axis has no direction in the surface.
    #[error("fiducial axis: {0} has no direction in the surface; give a vector across the normal")]
    Fiducial(DVec3),
}

impl Surface {
    /// The surface of a local frame: normal along z, fiducial axis along x.
    pub const LOCAL: Self = Self { x: DVec3::X, y: DVec3::Y, normal: DVec3::Z };

    /// The surface with this `normal` and `fiducial` axis; neither need be a unit vector, nor the
    /// axis lie in the surface.
    ///
    /// # Errors
    ///
    /// If one of them is zero or not finite, or the axis lies along the normal.
    pub fn new(normal: DVec3, fiducial: DVec3) -> Result<Self, SurfaceError> {
        let n = unit(normal).ok_or(SurfaceError::Normal(normal))?;
        let along = unit(fiducial).ok_or(SurfaceError::Fiducial(fiducial))?;
        let across = along - along.dot(n) * n;
        // An axis along the normal leaves only rounding errors, not a direction.
        if across.length() < 1e-14 {
            return Err(SurfaceError::Fiducial(fiducial));
        }
        let x = across.normalize();
        Ok(Self { x, y: n.cross(x), normal: n })
    }

    /// The unit vector along `v` in the frame of the surface, if `v` has a direction.
    fn local(&self, v: DVec3) -> Option<DVec3> {
        unit(DVec3::new(v.dot(self.x), v.dot(self.y), v.dot(self.normal)))
    }
}

fn unit(v: DVec3) -> Option<DVec3> {
    // The largest component first, so that no square overflows or vanishes.
    let largest = v.abs().max_element();
    (largest > 0.0 && v.is_finite()).then(|| (v / largest).normalize())
}

/// The angles at which a model sees the unit vectors `source` and `viewer` of a local frame (z
/// normal, x fiducial), both away from the surface; nothing where the light does not pass on
/// `side`.
pub fn geometry(side: Side, source: DVec3, viewer: DVec3) -> Option<(Incidence, Direction)> {
    let is_there = (source.z < 0.0) == side.from_below() && (viewer.z < 0.0) == side.to_below();
    is_there.then(|| {
        let sin = length(source.x, source.y);
        let e =
            if sin == 0.0 { -DVec3::X } else { DVec3::new(source.x / sin, source.y / sin, 0.0) };
        (incidence(e, sin, source.z.abs()), direction(e, viewer))
    })
}

fn incidence(e: DVec3, sin: f64, cos: f64) -> Incidence {
    let (sin_rotation, cos_rotation) = (e.y, -e.x);
    Incidence::from_sin_cos((sin, cos), (sin_rotation, cos_rotation))
}

fn direction(e: DVec3, viewer: DVec3) -> Direction {
    let (x, y) = (-(viewer.x * e.x + viewer.y * e.y), viewer.x * e.y - viewer.y * e.x);
    let (sin, cos) = (length(x, y), viewer.z.abs());
    let (sin_phi, cos_phi) = if sin == 0.0 { (0.0, 1.0) } else { (y / sin, x / sin) };
    Direction::from_sin_cos((sin, cos), (sin_phi, cos_phi))
}

/// √(x² + y²) of numbers up to 1, whose squares need no care.
fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// The same light as NIST's library describes it, or nothing where it divides by zero.
fn nists(incidence: &Incidence, direction: &Direction) -> Option<(Incidence, Direction)> {
    // Its rotation is π away: x̂ is measured from e.
    let rotation = (-incidence.sin_rotation, -incidence.cos_rotation);
    let turned = Incidence::from_sin_cos((incidence.sin, incidence.cos), rotation);
    let mirrored = Direction::from_sin_cos(
        (direction.sin, direction.cos),
        (-direction.sin_phi, direction.cos_phi),
    );
    (incidence.sin != 0.0).then_some((turned, mirrored))
}

impl Model {
    /// Mueller BRDF (1/sr) of a `surface` for light that comes from where `source` points and goes
    /// where `viewer` points.
    ///
    /// Zero where that light does not pass on the model's side (`type`), at grazing directions,
    /// and for vectors without a direction. [`Mode::Compat`] evaluates like NIST's library.
    pub fn mueller_between(
        &self,
        surface: &Surface,
        source: DVec3,
        viewer: DVec3,
        basis: Basis,
        mode: Mode,
    ) -> Mueller {
        let side = self.common().side;
        let local = surface.local(source).zip(surface.local(viewer));
        let Some((incidence, direction)) = local.and_then(|(s, v)| geometry(side, s, v)) else {
            return Mueller::ZERO;
        };
        let asked = match mode {
            Mode::Sound => Some((incidence, direction)),
            Mode::Compat => nists(&incidence, &direction),
        };
        let mut out = [Mueller([[f64::NAN; 4]; 4])];
        if let Some((incidence, direction)) = asked {
            self.evaluate(&incidence, &[direction], basis, &mut out);
        }
        out[0]
    }

    /// Mueller BRDFs (1/sr) for many pairs (to the source, to the viewer) in the local frame of
    /// the surface: z is the normal, x the fiducial axis.
    ///
    /// As [`Model::mueller_between`]; pairs of one source that follow each other share its work.
    pub fn evaluate_local(&self, pairs: &[(DVec3, DVec3)], basis: Basis) -> Vec<Mueller> {
        let seen = DirectionPairs::new(self.common().side, pairs);
        let mut matrices = vec![Mueller::ZERO; seen.places.len()];
        self.evaluate_pairs(&seen, basis, &mut matrices);
        let mut out = vec![Mueller::ZERO; pairs.len()];
        for (place, m) in seen.places.iter().zip(&matrices) {
            out[*place] = *m;
        }
        out
    }

    /// Mueller BRDFs (1/sr) of the pairs that have light, in their order: `out` has one matrix for
    /// each of [`DirectionPairs::places`]. The model has the side for which the pairs were made.
    pub fn evaluate_pairs(&self, pairs: &DirectionPairs, basis: Basis, mut out: &mut [Mueller]) {
        let mut directions = &pairs.directions[..];
        for (incidence, count) in &pairs.sources {
            let (own, others) = directions.split_at(*count);
            let (matrices, rest) = out.split_at_mut(*count);
            self.evaluate(incidence, own, basis, matrices);
            (directions, out) = (others, rest);
        }
    }
}

/// Pairs of vectors in a local frame as models on one side see them: for many models, such as
/// those of many wavelengths, the angles are computed once.
#[derive(Clone, Debug, Default)]
pub struct DirectionPairs {
    /// Each source, and how many directions follow it.
    sources: Vec<(Incidence, usize)>,
    directions: Vec<Direction>,
    places: Vec<usize>,
}

impl DirectionPairs {
    /// The `pairs` (to the source, to the viewer) whose light passes on `side`.
    pub fn new(side: Side, pairs: &[(DVec3, DVec3)]) -> Self {
        let mut seen = Self {
            sources: Vec::new(),
            directions: Vec::with_capacity(pairs.len()),
            places: Vec::with_capacity(pairs.len()),
        };
        let mut place = 0;
        for run in pairs.chunk_by(|a, b| a.0 == b.0) {
            seen.add(side, run, place);
            place += run.len();
        }
        seen
    }

    /// Which of the pairs have light.
    pub fn places(&self) -> &[usize] {
        &self.places
    }

    /// Adds pairs of one source, the first of which has the number `first`.
    fn add(&mut self, side: Side, pairs: &[(DVec3, DVec3)], first: usize) {
        let Some(source) = unit(pairs[0].0) else { return };
        let before = self.directions.len();
        let mut beam = None;
        for (place, (_, viewer)) in (first..).zip(pairs) {
            let seen = unit(*viewer).and_then(|viewer| geometry(side, source, viewer));
            if let Some((incidence, direction)) = seen {
                beam = Some(incidence);
                self.places.push(place);
                self.directions.push(direction);
            }
        }
        if let Some(beam) = beam {
            self.sources.push((beam, self.directions.len() - before));
        }
    }
}
