//! The bodies that can be rendered, and their intersection with rays.

use glam::DVec3;

use crate::{
    mesh::Mesh,
    ray::{SceneRay, SurfaceHit},
};

/// A body in the unit sphere.
#[derive(Clone, Debug)]
pub enum BodyShape {
    /// The sphere of radius 0.95.
    Sphere,
    /// A square of side 1.8, seen at this polar angle (rad); it leans back.
    Plane(f64),
    /// Triangles.
    Mesh(Mesh),
}

const RADIUS: f64 = 0.95;
const HALF_SIDE: f64 = 0.9;

impl BodyShape {
    /// The nearest point at which `ray` meets the body.
    pub(crate) fn hit(&self, ray: SceneRay) -> Option<SurfaceHit> {
        match self {
            Self::Sphere => sphere(ray),
            Self::Plane(tilt) => plane(ray, *tilt),
            Self::Mesh(mesh) => mesh.hit(ray),
        }
    }

    /// True if the body blocks the ray from one of its points in the direction `along`.
    pub(crate) fn shades(&self, hit: &SurfaceHit, along: DVec3) -> bool {
        match self {
            Self::Sphere | Self::Plane(_) => false,
            Self::Mesh(mesh) => mesh.hit(hit.leaving(along)).is_some(),
        }
    }
}

fn sphere(SceneRay { from, along }: SceneRay) -> Option<SurfaceHit> {
    let half = from.dot(along);
    let root = (half * half - from.length_squared() + RADIUS * RADIUS).sqrt();
    let distance = -half - root;
    // A root of a negative number is NaN, and so is the distance.
    (distance > 0.0).then(|| {
        let point = from + distance * along;
        let normal = point.normalize();
        SurfaceHit { distance, point, normal, true_normal: normal }
    })
}

fn plane(SceneRay { from, along }: SceneRay, tilt: f64) -> Option<SurfaceHit> {
    let normal = DVec3::new(0.0, tilt.sin(), tilt.cos());
    let up = DVec3::new(0.0, tilt.cos(), -tilt.sin());
    let distance = -from.dot(normal) / along.dot(normal);
    let point = from + distance * along;
    let inside = point.x.abs() <= HALF_SIDE && point.dot(up).abs() <= HALF_SIDE;
    (distance > 0.0 && along.dot(normal) < 0.0 && inside).then_some(SurfaceHit {
        distance,
        point,
        normal,
        true_normal: normal,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn down(x: f64, y: f64) -> SceneRay {
        SceneRay { from: DVec3::new(x, y, 10.0), along: -DVec3::Z }
    }

    #[test]
    fn a_ray_meets_the_near_side_of_the_sphere_or_nothing() {
        let hit = BodyShape::Sphere.hit(down(0.3, 0.4)).unwrap();
        assert!((hit.point.length() - RADIUS).abs() < 1e-14 && hit.point.z > 0.0);
        assert!(BodyShape::Sphere.hit(down(0.8, 0.8)).is_none());
    }

    #[test]
    fn a_tilted_plane_is_foreshortened() {
        let tilted = BodyShape::Plane(60_f64.to_radians());
        assert!(tilted.hit(down(0.0, 0.44)).is_some());
        assert!(tilted.hit(down(0.0, 0.46)).is_none());
        assert!(tilted.hit(down(0.89, 0.0)).is_some());
    }
}
