//! Any BRDF model as the surface below a paint: modes of its BRDF inside the last slab.

use std::{f64::consts::PI, fmt};

use crate::{
    Basis, Direction, Geometry, Incidence, Model, Mueller, ParameterError,
    doubling::{
        azimuth,
        block::{RealMatrix, Stokes4},
        nodes::MediumDirections,
        scaling,
        stack::SurfaceModes,
    },
    special::gauss,
};

/// Azimuths of the modes.
const AZIMUTHS: usize = 128;
/// Polar angles and azimuths of the reflectance of a beam.
const HEMISPHERE: (usize, usize) = (64, 64);
/// A model that looks more different than this when it is turned or mirrored has a direction.
const SAME: f64 = 1e-9;

/// A model immersed in the last slab.
pub(super) struct Backing(Model);

impl fmt::Debug for Backing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Backing")
    }
}

impl Backing {
    /// `model`, which must look the same when the sample is turned or mirrored.
    pub(super) fn new(model: Model) -> Result<Self, ParameterError> {
        for (theta_i, theta_s, phi_s) in [(0.4, 0.9, 0.7), (1.1, 0.3, -2.0), (0.8, 1.2, 1.4)] {
            let at = |phi_s, rotation| {
                model.mueller(&Geometry { theta_i, theta_s, phi_s, rotation }, Basis::Psps)
            };
            let (plain, turned, mut mirrored) = (at(phi_s, 0.0), at(phi_s, 1.1), at(-phi_s, 0.0));
            for i in 0..4 {
                for j in 0..4 {
                    if i / 2 != j / 2 {
                        mirrored[(i, j)] *= -1.0;
                    }
                }
            }
            let bound = SAME * plain.largest();
            let differs = |m: Mueller| (m - plain).largest() > bound;
            if differs(turned) || differs(mirrored) {
                let problem = "it has a direction or a handedness; below a paint a model looks \
                               the same when it is turned and mirrored";
                return Err(ParameterError::new("model", problem));
            }
        }
        Ok(Self(model))
    }

    /// Reflectance of an unpolarized beam.
    fn reflectance(&self, mu: f64) -> f64 {
        let incidence = Incidence::new(mu.acos(), 0.0);
        let (polar, azimuths) = HEMISPHERE;
        let mut sum = 0.0;
        for (t, w) in gauss::legendre(polar, 0.0, 0.5 * PI) {
            let directions: Vec<Direction> = (0..azimuths)
                .map(|k| Direction::new(t, PI * (k as f64 + 0.5) / azimuths as f64))
                .collect();
            let mut out = vec![Mueller::ZERO; azimuths];
            self.0.evaluate(&incidence, &directions, Basis::Psps, &mut out);
            let mean: f64 = out.iter().map(|m| m[(0, 0)]).sum::<f64>() / azimuths as f64;
            sum += 2.0 * PI * mean * t.sin() * t.cos() * w;
        }
        sum
    }
}

impl SurfaceModes for Backing {
    fn modes(&self, directions: &MediumDirections, last: usize) -> Vec<RealMatrix> {
        let count = directions.len();
        let theta: Vec<f64> = directions.mu.iter().map(|mu| mu.acos()).collect();
        let mut modes = azimuth::modes((count, count), last, AZIMUTHS, |i, j, (cos, sin)| {
            let incidence = Incidence::new(theta[j], 0.0);
            let mut out = [Mueller::ZERO];
            let direction = Direction::new(theta[i], sin.atan2(cos));
            self.0.evaluate(&incidence, &[direction], Basis::Psps, &mut out);
            let m: Stokes4 = out[0].0;
            m
        });
        // Narrow lobes fall between the nodes: what comes back in all is known better.
        let flux: Vec<f64> = (0..count).map(|i| directions.root_flux(i)).collect();
        let returned = |(mu, e): (&f64, &f64)| self.reflectance(*mu) * e;
        let target: Vec<f64> = directions.mu.iter().zip(&flux).map(returned).collect();
        let s = scaling::factors(&flux, &target, |i, j| {
            2.0 * PI * flux[i] * flux[j] * modes[0][(4 * i, 4 * j)].max(0.0)
        });
        for m in &mut modes {
            for j in 0..4 * count {
                for i in 0..4 * count {
                    m[(i, j)] *= s[i / 4] * s[j / 4];
                }
            }
        }
        modes
    }
}
