//! The 145 patches of the full Klems basis.

use std::f64::consts::TAU;

use glam::DVec3;

/// Upper polar angle (degrees) and number of patches of every ring of the full basis.
pub(super) const RINGS: [(f64, usize); 9] = [
    (5.0, 1),
    (15.0, 8),
    (25.0, 16),
    (35.0, 20),
    (45.0, 24),
    (55.0, 24),
    (65.0, 24),
    (75.0, 16),
    (90.0, 12),
];
/// Name of the basis.
pub(super) const BASIS: &str = "LBNL/Klems Full";

/// A patch: its polar angles, the azimuth of its centre and its width, in radians.
#[derive(Clone, Copy, Debug)]
pub(super) struct KlemsPatch {
    pub(super) lower: f64,
    pub(super) upper: f64,
    pub(super) phi: f64,
    pub(super) width: f64,
}

/// All patches, ring after ring.
pub(super) fn patches() -> Vec<KlemsPatch> {
    let mut all = Vec::new();
    let mut lower = 0.0_f64;
    for (upper, count) in RINGS {
        let width = TAU / count as f64;
        let ring = (0..count).map(|j| KlemsPatch {
            lower: lower.to_radians(),
            upper: upper.to_radians(),
            phi: width * j as f64,
            width,
        });
        all.extend(ring);
        lower = upper;
    }
    all
}

impl KlemsPatch {
    /// The direction at `(u, w)` in 0 … 1, uniform in projected solid angle.
    pub(super) fn direction(&self, u: f64, w: f64) -> DVec3 {
        let [a, b] = [self.lower, self.upper].map(|theta| theta.sin().powi(2));
        let sin2 = a + (b - a) * u;
        let (sin, cos) = (sin2.sqrt(), (1.0 - sin2).sqrt());
        let (sin_phi, cos_phi) = (self.phi + self.width * (w - 0.5)).sin_cos();
        DVec3::new(sin * cos_phi, sin * sin_phi, cos)
    }

    /// The centre of the patch; that of the first patch is the normal.
    pub(super) fn centre(&self) -> DVec3 {
        if self.lower == 0.0 { DVec3::Z } else { self.direction(0.5, 0.5) }
    }
}

/// The index of the patch that contains a direction.
pub(super) fn containing(direction: DVec3) -> usize {
    let theta = direction.x.hypot(direction.y).atan2(direction.z).to_degrees();
    let phi = direction.y.atan2(direction.x).rem_euclid(TAU);
    let mut first = 0;
    for (upper, count) in RINGS {
        if theta < upper {
            return first + (phi / TAU * count as f64).round() as usize % count;
        }
        first += count;
    }
    first - 1
}

/// The projected solid angle of every patch, sr; their sum is π.
pub fn projected_solid_angles() -> Vec<f64> {
    let angle = |patch: &KlemsPatch| {
        0.5 * patch.width * (patch.upper.sin().powi(2) - patch.lower.sin().powi(2))
    };
    let all: Vec<f64> = patches().iter().map(angle).collect();
    all
}
