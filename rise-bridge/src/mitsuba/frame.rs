//! Mitsuba 3's Stokes bases, and our matrices in them.
//!
//! With l to the light and v to the viewer, unit vectors away from the surface in the local frame
//! (z is the normal), light travels along k_i = −l and then k_s = v. In these frames x, y = k × x
//! and k are right handed, Q > 0 is light along x, and V > 0 turns clockwise seen towards the light,
//! the opposite of our sign: a matrix is multiplied by D = diag(1, 1, 1, −1) from both sides.
//!
//! | frame | x of both beams |
//! | --- | --- |
//! | a table of `measured_polarized` | unit(l × v): our basis `plane` |
//! | everything inside the renderer | [`stokes_basis`] of k_i and of k_s |
//!
//! Rotation of the frame by θ about k, from x towards y, multiplies Stokes vectors by
//!
//! $$ \mathbf R(\theta) = \begin{pmatrix} 1&0&0&0\\ 0&\cos 2\theta&\sin 2\theta&0\\
//!    0&-\sin 2\theta&\cos 2\theta&0\\ 0&0&0&1 \end{pmatrix} $$
//!
//! The basis of a direction is that of T. Duff et al., *Building an Orthonormal Basis, Revisited*,
//! JCGT 6(1), 1 (2017).

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;
use scattering::Mueller;

/// Below this sine of the polar angle a beam counts as one along the normal.
const ALONG_NORMAL: f64 = 1e-10;

/// x of Mitsuba's Stokes basis for light that travels along the unit vector `k`.
pub fn stokes_basis(k: DVec3) -> DVec3 {
    let sign = 1.0_f64.copysign(k.z);
    let a = -1.0 / (sign + k.z);
    DVec3::new(1.0 + sign * k.x * k.x * a, sign * k.x * k.y * a, -sign * k.x)
}

/// D M D: converts between matrices with V > 0 right (Mitsuba) and V > 0 left (ours).
pub fn with_opposite_handedness(mut m: Mueller) -> Mueller {
    for k in 0..3 {
        m[(k, 3)] = -m[(k, 3)];
        m[(3, k)] = -m[(3, k)];
    }
    m
}

/// R: transforms Stokes vectors to a frame rotated by `angle` (radians) from x towards y.
pub fn rotator(angle: f64) -> Mueller {
    let (s, c) = (2.0 * angle).sin_cos();
    Mueller([[1.0, 0.0, 0.0, 0.0], [0.0, c, s, 0.0], [0.0, -s, c, 0.0], [0.0, 0.0, 0.0, 1.0]])
}

/// The angle from `a` to `b`, radians, about the unit vector `k` that is perpendicular to both.
pub fn angle(k: DVec3, a: DVec3, b: DVec3) -> f64 {
    a.cross(b).dot(k).atan2(a.dot(b))
}

/// The matrix `psps` (our basis of this name) in Mitsuba's [`stokes_basis`] of both beams.
///
/// Both are unit vectors away from the surface, as in [`scattering::vectors`]. A renderer's BSDF is
/// this times the cosine of the light.
pub fn from_psps(psps: Mueller, to_light: DVec3, to_viewer: DVec3) -> Mueller {
    let (k_i, k_s) = (-to_light.normalize(), to_viewer.normalize());
    let horizontal = |k: DVec3| {
        let across = DVec3::Z.cross(k);
        (across.length() > ALONG_NORMAL).then(|| across.normalize())
    };
    let s_i = horizontal(k_i).unwrap_or(DVec3::Y);
    // Along the normal s is perpendicular to the plane of incidence.
    let s_s = horizontal(k_s).unwrap_or(s_i);
    rotated(with_opposite_handedness(psps), (k_i, s_i), (k_s, s_s))
}

/// The matrix of a table (`x` = unit(l × v) for both beams) in the [`stokes_basis`] of both beams.
///
/// Where l and v are parallel the table has no frame; the result is then not a number.
pub fn from_table(table: Mueller, to_light: DVec3, to_viewer: DVec3) -> Mueller {
    let (k_i, k_s) = (-to_light.normalize(), to_viewer.normalize());
    let x = to_light.cross(to_viewer).normalize();
    rotated(table, (k_i, x), (k_s, x))
}

/// `m` with the axes x of the beams replaced by those of [`stokes_basis`].
fn rotated(m: Mueller, (k_i, x_i): (DVec3, DVec3), (k_s, x_s): (DVec3, DVec3)) -> Mueller {
    let incoming = rotator(angle(k_i, x_i, stokes_basis(k_i)));
    let outgoing = rotator(angle(k_s, x_s, stokes_basis(k_s)));
    outgoing * m * incoming.transposed()
}

/// Half vector and difference angles of a table, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfAngles {
    /// Azimuth of the light about the half vector, −π … π; 0 points away from the normal.
    pub phi_d: f64,
    /// Angle between the half vector and the light, 0 … π/2.
    pub theta_d: f64,
    /// Angle between the half vector and the normal.
    pub theta_h: f64,
}

impl HalfAngles {
    /// The half angles of light from `to_light`, seen from `to_viewer`; none for mirror directions,
    /// whose azimuth is not defined, and for opposite directions.
    pub fn of(to_light: DVec3, to_viewer: DVec3) -> Option<Self> {
        let h = (to_light + to_viewer).try_normalize()?;
        let b = DVec3::Z.cross(h).try_normalize()?;
        let t = b.cross(h);
        let along = to_light.dot(h);
        let across = to_light - along * h;
        Some(Self {
            phi_d: b.dot(across).atan2(t.dot(across)),
            theta_d: across.length().atan2(along).clamp(0.0, FRAC_PI_2),
            theta_h: h.x.hypot(h.y).atan2(h.z),
        })
    }

    /// (l, v) with the half vector in the plane y = 0.
    pub fn directions(&self) -> (DVec3, DVec3) {
        let (sin_h, cos_h) = self.theta_h.sin_cos();
        let (sin_d, cos_d) = self.theta_d.sin_cos();
        let (sin_p, cos_p) = self.phi_d.sin_cos();
        let h = DVec3::new(sin_h, 0.0, cos_h);
        let across = DVec3::new(cos_p * cos_h, sin_p, -cos_p * sin_h);
        (cos_d * h + sin_d * across, cos_d * h - sin_d * across)
    }
}

#[cfg(test)]
mod tests {
    use scattering::{Basis, Mode, ParameterNode, models};

    use super::*;

    #[test]
    fn the_basis_is_across_the_beam_for_every_direction() {
        for k in [
            DVec3::Z,
            DVec3::NEG_Z,
            DVec3::X,
            DVec3::new(0.3, -0.5, 0.2).normalize(),
            DVec3::new(-0.3, 0.1, -0.9).normalize(),
        ] {
            let x = stokes_basis(k);
            assert!(x.dot(k).abs() < 1e-15 && (x.length() - 1.0).abs() < 1e-15, "{k}");
        }
    }

    #[test]
    fn half_angles_and_directions_are_inverse_to_each_other() {
        let at = HalfAngles { phi_d: -1.8, theta_d: 0.6, theta_h: 0.35 };
        let (l, v) = at.directions();
        let again = HalfAngles::of(l, v).unwrap();
        for (a, b) in
            [(at.phi_d, again.phi_d), (at.theta_d, again.theta_d), (at.theta_h, again.theta_h)]
        {
            assert!((a - b).abs() < 1e-14, "{again:?}");
        }
        assert_eq!(HalfAngles::of(DVec3::X, DVec3::NEG_X), None);
    }

    #[test]
    fn conversion_from_the_scattering_plane_equals_conversion_from_psps() {
        let class = &models::find("Diffuse_Subsurface_BRDF_Model").unwrap().class;
        let model = models::build(&ParameterNode::with_defaults(class, Mode::Sound)).unwrap();
        for (l, v) in [
            (DVec3::new(0.3, 0.2, 0.9), DVec3::new(-0.7, 0.1, 0.5)),
            (DVec3::new(0.3, 0.2, 0.9), DVec3::Z),
            (DVec3::Z, DVec3::new(-0.2, 0.8, 0.3)),
        ] {
            let (l, v) = (l.normalize(), v.normalize());
            let ask = |basis| model.evaluate_local(&[(l, v)], basis)[0];
            let direct = from_psps(ask(Basis::Psps), l, v);
            let table = with_opposite_handedness(ask(Basis::Plane));
            let error = (direct - from_table(table, l, v)).largest();
            assert!(error < 1e-14, "{l} {v}: {error:e}");
        }
    }
}
