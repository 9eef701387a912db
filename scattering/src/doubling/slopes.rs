//! Gaussian slopes of facets and plates: density, shadowing, quadrature.
//!
//! S(ζ) = e^{−ζ²/2σ²}/(2πσ²), and for a ray Λ = ½[e^{−x²}/(√π x) − erfc x], x = cot θ/(√2 σ):
//! 1 + Λ is the projected area of all facets that face the ray. The shadowing of reflected light is
//! 1/(1 + Λ_i + Λ_o). Refracted light leaves on the other side of the same facet, where a height that
//! exposes one ray shadows the other; its shadowing is Euler's beta function B(1 + Λ_i, 1 + Λ_t).
//!
//! M. I. Sancer, IEEE Trans. Antennas Propag. AP-17, 577 (1969); B. Walter et al., Proc. EGSR
//! (2007), for facets that refract; E. Heitz et al., ACM Trans. Graph. 35, 58 (2016).

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

use glam::DVec3;

use crate::{shadow::sancer, special::gauss};

/// Largest slope in standard deviations: the density falls to e^{−40}.
const REACH: f64 = 9.0;

/// Gaussian slopes with one standard deviation along every azimuth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianSlopes {
    /// σ.
    pub sigma: f64,
}

impl GaussianSlopes {
    /// S of the facet with the unit normal `n` over n_z⁴.
    pub fn density(&self, n: DVec3) -> f64 {
        let z2 = n.z * n.z;
        let slope2 = (n.x * n.x + n.y * n.y) / z2;
        let s2 = self.sigma * self.sigma;
        (-0.5 * slope2 / s2).exp() / (TAU * s2 * z2 * z2)
    }

    /// Λ of a ray with the cosine `mu` > 0.
    pub fn lambda(&self, mu: f64) -> f64 {
        let sine = (1.0 - mu * mu).max(0.0).sqrt();
        if sine == 0.0 { 0.0 } else { sancer::lambda(mu / sine * FRAC_1_SQRT_2 / self.sigma) }
    }

    /// Normals with their weights S dζ, `radial` × `azimuths` of them; azimuths from 0 to π, so
    /// that each stands for two.
    pub fn quadrature(&self, radial: usize, azimuths: usize) -> Vec<(DVec3, f64)> {
        let mut all = Vec::with_capacity(radial * azimuths);
        for (r, w) in gauss::legendre(radial, 0.0, REACH) {
            let weight = w * r * (-0.5 * r * r).exp() / azimuths as f64;
            for k in 0..azimuths {
                let phi = PI * (k as f64 + 0.5) / azimuths as f64;
                let slope = r * self.sigma;
                let n = DVec3::new(slope * phi.cos(), slope * phi.sin(), 1.0);
                all.push((n.normalize(), weight));
            }
        }
        all
    }
}

/// B(1 + a, 1 + b).
pub fn beta(a: f64, b: f64) -> f64 {
    if a == 0.0 && b == 0.0 {
        return 1.0;
    }
    (libm::lgamma(1.0 + a) + libm::lgamma(1.0 + b) - libm::lgamma(2.0 + a + b)).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn projected_areas_are_those_of_the_shadowing() {
        let slopes = GaussianSlopes { sigma: 0.3 };
        for mu in [0.9, 0.4, 0.1] {
            let k = DVec3::new((1.0f64 - mu * mu).sqrt(), 0.0, mu);
            let facing: f64 = slopes
                .quadrature(60, 400)
                .into_iter()
                .map(|(n, w)| w * (n.dot(k) / n.z).max(0.0) / mu)
                .sum();
            let expected = 1.0 + slopes.lambda(mu);
            assert!((facing - expected).abs() < 1e-4 * expected, "{mu}: {facing} {expected}");
        }
        assert!((beta(0.0, 2.0) - 1.0 / 3.0).abs() < 1e-14);
    }
}
