//! The polygons that NIST's program takes for circles, rings and the hemisphere.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};
use scattering::lanes::Real;

use super::{PolarAngles, Polygon, Region, RegionError, unit};

/// A polygonal outline and the projected solid angle (sr) that NIST's program gives it.
#[derive(Clone, Debug)]
pub(crate) struct PolygonOutline {
    pub(crate) polygon: Polygon,
    pub(crate) projected_solid_angle: f64,
}

/// The outline of `region` with `sides` edges per circle; a differential region has none.
///
/// # Errors
///
/// For a negative number of sides, and for polygons whose edges cross or that reach below the
/// horizon.
pub(crate) fn outline(region: &Region, sides: i32) -> Result<PolygonOutline, RegionError> {
    if sides < 0 && matches!(region, Region::Circle { .. } | Region::Hemi) {
        return Err(RegionError::PolygonSides(sides));
    }
    match region {
        Region::Differential { .. } => Ok(of(Vec::new())),
        Region::Circle { center, alpha } => Ok(circle(*center, *alpha, sides)),
        Region::Hemi => {
            let rim = steps(sides).map(|t| unit((FRAC_PI_2, t)).truncate()).collect();
            Ok(PolygonOutline { projected_solid_angle: PI, ..of(rim) })
        }
        Region::Annulus { outer_center, outer_alpha, inner_center, inner_alpha } => {
            Ok(annulus((*outer_center, *outer_alpha), (*inner_center, *inner_alpha), sides))
        }
        Region::Polygon { vertices, .. } => {
            above_horizon(vertices)?;
            let outline = of(vertices.iter().map(|v| unit(*v).truncate()).collect());
            refuse_crossing(outline.polygon.crossing(false))?;
            Ok(outline)
        }
    }
}

/// An error for a vertex below the horizon; 90° exactly is fine.
///
/// # Errors
///
/// With the first such vertex.
pub(crate) fn above_horizon(vertices: &[PolarAngles]) -> Result<(), RegionError> {
    match vertices.iter().position(|v| unit(*v).z < 0.0) {
        Some(k) => Err(RegionError::BelowHorizon { number: k + 1, theta: vertices[k].0 }),
        None => Ok(()),
    }
}

/// An error that names the two edges of a crossing.
///
/// # Errors
///
/// If there is one.
pub(crate) fn refuse_crossing(found: Option<(usize, usize)>) -> Result<(), RegionError> {
    match found {
        Some((j, i)) => Err(RegionError::Crossing { first: j + 1, second: i + 1 }),
        None => Ok(()),
    }
}

fn of(vertices: Vec<DVec2>) -> PolygonOutline {
    let polygon = Polygon::new(vertices);
    PolygonOutline { projected_solid_angle: polygon.area(), polygon }
}

/// 0, s, 2s, … up to 2π by repeated addition, s = 2π/`sides`.
fn steps(sides: i32) -> impl Iterator<Item = f64> {
    let step = TAU / f64::from(sides);
    std::iter::successors(Some(0.0), move |t| Some(t + step)).take_while(|t| *t <= TAU)
}

fn circle(center: PolarAngles, alpha: f64, sides: i32) -> PolygonOutline {
    let frame = AxisRotation::new(center);
    let rim =
        steps(sides).map(|t| raised(frame.turn(unit((alpha, t)).to_array()).into())).collect();
    let mut outline = of(rim);
    if center.0 + alpha.abs() <= FRAC_PI_2 {
        outline.projected_solid_angle = PI * alpha.sin().powi(2) * center.0.cos();
    }
    outline
}

/// The projection of a rim point; one at or below the horizon is moved onto it, in NIST's way
/// towards +x+y and not radially.
fn raised(v: DVec3) -> DVec2 {
    if v.z > 0.0 {
        return v.truncate();
    }
    unit((0.0_f64.acos(), (v.y - v.z).atan2(v.x - v.z))).truncate()
}

/// The turn that takes the normal to a given direction: about y, then about z.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AxisRotation {
    sin: f64,
    cos: f64,
    sin_phi: f64,
    cos_phi: f64,
}

impl AxisRotation {
    /// The turn that takes the normal to `axis`.
    pub(crate) fn new(axis: PolarAngles) -> Self {
        let ((sin, cos), (sin_phi, cos_phi)) = (axis.0.sin_cos(), axis.1.sin_cos());
        Self { sin, cos, sin_phi, cos_phi }
    }

    /// The turned vector, or several.
    #[inline(always)]
    pub(crate) fn turn<R: Real>(&self, [x, y, z]: [R; 3]) -> [R; 3] {
        let (x, z) = (z * self.sin + x * self.cos, z * self.cos - x * self.sin);
        [x * self.cos_phi - y * self.sin_phi, x * self.sin_phi + y * self.cos_phi, z]
    }
}

/// Both rings as one polygon, the inner one first.
fn annulus(outer: (PolarAngles, f64), inner: (PolarAngles, f64), sides: i32) -> PolygonOutline {
    let (mut vertices, inner_tilt) = ring(inner.0, inner.1, sides);
    let (rest, outer_tilt) = ring(outer.0, outer.1, sides);
    vertices.extend(rest);
    let mut outline = of(vertices);
    if !(inner_tilt || outer_tilt) {
        let disk = |(center, alpha): (PolarAngles, f64)| alpha.sin().powi(2) * center.0.cos();
        outline.projected_solid_angle = PI * (disk(outer) - disk(inner)).abs();
    }
    outline
}

/// The points of a ring, moved radially to the horizon where they lie below it, and whether any
/// does.
fn ring(center: PolarAngles, alpha: f64, sides: i32) -> (Vec<DVec2>, bool) {
    let v = unit(center);
    let across = DVec3::Z.cross(v);
    let p = if across.length() > 0.0 { across.normalize() } else { DVec3::Y };
    let (q, n) = (v.cross(p), f64::from(sides));
    let mut tilted = false;
    let mut at = |i: i32| {
        let t = TAU * f64::from(i) / n + 0.01 * PI / 180.0;
        let w = v * alpha.cos() + (q * t.cos() + p * t.sin()) * alpha.sin();
        if w.z < 0.0 {
            tilted = true;
            return DVec2::from_angle(w.y.atan2(w.x));
        }
        w.truncate()
    };
    let points = (0..=sides).map(&mut at).collect();
    (points, tilted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fine_outlines_have_the_exact_areas() {
        // A regular polygon of n sides lacks 2π²/3n² of its circle: 2e-6 for 1800.
        let annulus = Region::Annulus {
            outer_center: (0.5, 0.3),
            outer_alpha: 0.6,
            inner_center: (0.45, 0.4),
            inner_alpha: 0.2,
        };
        let regions = [Region::Hemi, Region::Circle { center: (0.5, 0.3), alpha: 0.6 }, annulus];
        for region in regions {
            let exact = region.projected_solid_angle();
            let outline = outline(&region, 1800).unwrap();
            assert!((outline.projected_solid_angle - exact).abs() < 1e-14);
        }
        let rim = circle((0.5, 0.3), 0.6, 1800).polygon.area();
        let disk = PI * f64::sin(0.6).powi(2) * f64::cos(0.5);
        assert!((rim / disk - 1.0).abs() < 3e-6);
    }

    #[test]
    fn vertices_of_polygons_stay_above_the_horizon() {
        let polygon = |theta| Region::Polygon {
            vertices: vec![(0.1, 0.0), (theta, 1.0), (0.3, 2.0)],
            polarization_center: (0.0, 0.0),
        };
        assert!(outline(&polygon(FRAC_PI_2), 360).is_ok());
        let refused = outline(&polygon(1.6), 360).unwrap_err();
        assert_eq!(refused, RegionError::BelowHorizon { number: 2, theta: 1.6 });
    }

    #[test]
    fn circles_with_a_negative_number_of_sides_are_refused() {
        let circle = Region::Circle { center: (0.0, 0.0), alpha: 0.1 };
        assert_eq!(outline(&circle, -1).unwrap_err(), RegionError::PolygonSides(-1));
        assert!(outline(&circle, 0).is_ok());
    }
}
