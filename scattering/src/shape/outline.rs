//! Outlines of straight edges with rounded corners.

use glam::DVec2;

use super::Shape;
use crate::ParameterError;

/// A corner of the outline at (distance from the axis, height down the axis), and the radius of
/// the circle that rounds it.
#[derive(Clone, Copy, Debug)]
pub(super) struct OutlineCorner {
    pub at: DVec2,
    pub radius: f64,
    /// The parameter that sets the radius.
    pub parameter: &'static str,
}

impl OutlineCorner {
    pub(super) fn new(rho: f64, z: f64, radius: f64, parameter: &'static str) -> Self {
        Self { at: DVec2::new(rho, z), radius, parameter }
    }
}

/// A piece of the outline.
enum OutlinePiece {
    /// n·x = d.
    Line { normal: DVec2, distance: f64 },
    /// |x − c| = R, seen from inside.
    Arc { centre: DVec2, radius: f64 },
}

impl OutlinePiece {
    /// r and dr/dθ on the ray at θ.
    fn radius(&self, theta: f64) -> (f64, f64) {
        let (sin, cos) = theta.sin_cos();
        let (ray, turned) = (DVec2::new(sin, cos), DVec2::new(cos, -sin));
        match self {
            Self::Line { normal, distance } => {
                let along = normal.dot(ray);
                (distance / along, -distance * normal.dot(turned) / (along * along))
            }
            Self::Arc { centre, radius } => {
                let (along, across) = (centre.dot(ray), centre.dot(turned));
                let root = (radius * radius - across * across).max(0.0).sqrt();
                (along + root, across * (1.0 + along / root))
            }
        }
    }
}

/// The convex body with these corners from the lower pole to the upper one; the first and the
/// last lie on the axis.
pub(super) fn convex(points: usize, corners: &[OutlineCorner]) -> Result<Shape, ParameterError> {
    let rounded: Vec<RoundedCorner> =
        (0..corners.len()).map(|at| RoundedCorner::new(corners, at)).collect::<Result<_, _>>()?;
    let mut pieces = Vec::new();
    let mut breaks = vec![0.0];
    let mut push = |piece: OutlinePiece, end: f64| {
        pieces.push(piece);
        breaks.push(end);
    };
    let last = rounded.len() - 1;
    for (at, corner) in rounded.iter().enumerate() {
        if at > 0 {
            let (from, to) = (&rounded[at - 1], corner);
            let edge = (corners[at].at - corners[at - 1].at).normalize();
            let normal = DVec2::new(-edge.y, edge.x);
            let distance = normal.dot(corners[at].at);
            if distance.is_nan() || distance <= 0.0 {
                return Err(ParameterError::new(corners[0].parameter, "the origin lies outside"));
            }
            // Corners may meet; the sum of two lengths is rounded.
            if from.leave + to.leave > from.length_after * (1.0 + 1e-12) {
                let problem = format!("a corner of {} um does not fit", corners[at - 1].radius);
                return Err(ParameterError::new(corners[at - 1].parameter, problem));
            }
            push(OutlinePiece::Line { normal, distance }, angle(to.enter));
        }
        let end = if at == last { std::f64::consts::PI } else { angle(corner.exit) };
        push(OutlinePiece::Arc { centre: corner.centre, radius: corners[at].radius }, end);
    }
    Ok(Shape::sample(points, &breaks, |piece, theta| pieces[piece].radius(theta)))
}

/// θ of a place, 0 straight down.
fn angle(place: DVec2) -> f64 {
    place.x.max(0.0).atan2(place.y)
}

/// A corner with its circle.
struct RoundedCorner {
    centre: DVec2,
    /// Ends of the circle.
    enter: DVec2,
    exit: DVec2,
    /// Distance from the corner.
    leave: f64,
    length_after: f64,
}

impl RoundedCorner {
    fn new(corners: &[OutlineCorner], at: usize) -> Result<Self, ParameterError> {
        let OutlineCorner { at: here, radius, parameter } = corners[at];
        if !(radius >= 0.0 && radius.is_finite()) {
            return Err(ParameterError::new(parameter, format!("{radius} um is not a radius")));
        }
        let mirrored = |place: DVec2| DVec2::new(-place.x, place.y);
        let next = corners.get(at + 1).map(|corner| corner.at);
        let before = at.checked_sub(1).map(|at| corners[at].at);
        let (before, after) = match (before, next) {
            (Some(before), Some(next)) => (before, next),
            (None, Some(next)) => (mirrored(next), next),
            (Some(before), None) => (before, mirrored(before)),
            (None, None) => (here, here),
        };
        let length_after = (after - here).length();
        let (a, b) = ((before - here).normalize(), (after - here).normalize());
        let middle = a + b;
        if radius == 0.0 || middle.length() < 1e-12 {
            return Ok(Self { centre: here, enter: here, exit: here, leave: 0.0, length_after });
        }
        // |a + b| = 2 cos of half the corner's angle.
        let cos = 0.5 * middle.length();
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let leave = radius * cos / sin;
        let centre = here + middle.normalize() * (radius / sin);
        Ok(Self { centre, enter: here + a * leave, exit: here + b * leave, leave, length_after })
    }
}
