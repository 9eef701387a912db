//! Shadowing of a Gaussian random surface, averaged over facet slopes.
//!
//! $$ G = g(\theta_i)\,g(\theta_s), \qquad
//!    g = \frac{1-\tfrac12\,\mathrm{erfc}(\mu/\sqrt2 w)}{1+\Lambda}, \qquad
//!    \mu = \cot|\theta| \qquad (1) $$
//!
//! $$ \Lambda = \tfrac12\left[\sqrt{2/\pi}\,\frac{w}{\mu}\,e^{-\mu^2/2w^2}
//!    - \mathrm{erfc}(\mu/\sqrt2 w)\right] \qquad (2) $$
//!
//! w is the rms slope along one axis: s/√2 for a Gaussian density of slopes. The numerator averages
//! over unknown slopes although the slope of the facet is known; the Sancer function does not.
//!
//! B. G. Smith, IEEE Trans. Antennas Propag. AP-15, 668 (1967).

use std::f64::consts::FRAC_1_SQRT_2;

use super::Shadow;
use crate::{
    Direction, Incidence,
    geometry::ScatteredRay,
    lanes::{LaneKernel, Real, SimdLevel, WIDTH, dispatch, filled_up},
    spec::{Class, Laws, Parameter, ParameterError, Spec},
    special::erf::{ROOT_PI, falling_and_scaled},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Shadow> = Spec {
    class: Class {
        name: "Smith_Shadow_Function",
        parent: "Shadow_Function",
        summary: "Gaussian surface, averaged over facet slopes",
        equation: "G = g(ti) g(ts), g = (1 - erfc(mu/(sqrt(2) w))/2)/(1 + Lambda), mu = cot theta",
        source: "smith-1967",
        params: &[&[Parameter::number("w", 0.35, "1", "Rms slope along one axis")]],
        laws: Laws::NONE,
    },
    build: |node| {
        let w = node.number("w");
        if !(w > 0.0 && w.is_finite()) {
            return Err(ParameterError::new("w", format!("{w} is not positive")));
        }
        Ok(Box::new(Smith { scale: FRAC_1_SQRT_2 / w }))
    },
};

struct Smith {
    /// 1/√2w.
    scale: f64,
}

/// From this x on, erfc x and Λ are below 3·10⁻¹⁷: g is 1 to the last bit.
const UNSHADOWED: f64 = 6.0;

impl Smith {
    /// g of a ray, or of a batch of rays. (1)
    ///
    /// With x = μ/√2w and erfc x = e^{−x²} f/(1 + 2x), numerator and denominator are multiplied by
    /// √π x (1 + 2x): one division instead of three.
    #[inline(always)]
    fn one_ray<R: Real>(&self, sin: R, cos: R) -> R {
        let mu = cos / sin.abs();
        let x = mu * self.scale;
        let [falling, scaled] = falling_and_scaled(x);
        let (root_pi_x, one_plus_2x) = (x * ROOT_PI, x * 2.0 + 1.0);
        // Each of these times √π x (1 + 2x): 1, erfc x and Λ (2).
        let one = root_pi_x * one_plus_2x;
        let erfc = falling * scaled * root_pi_x;
        let lambda = (falling * one_plus_2x - erfc) * 0.5;
        let shadowed = (one - erfc * 0.5) / (one + lambda);
        (x - UNSHADOWED).select(x.splat(1.0), shadowed)
    }
}

/// Unshadowed fractions of a batch of directions.
struct UnshadowedFractions<'a> {
    smith: &'a Smith,
    of_source: f64,
    directions: &'a [[Direction; WIDTH]],
    out: &'a mut [[f64; WIDTH]],
}

impl LaneKernel for UnshadowedFractions<'_> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, vectors: V) {
        for (directions, out) in self.directions.iter().zip(self.out) {
            let ScatteredRay { sin, cos, .. } = ScatteredRay::batch(vectors, directions);
            *out = vectors.store(self.smith.one_ray(sin, cos) * self.of_source);
        }
    }
}

impl Shadow for Smith {
    fn fraction(&self, incidence: &Incidence, direction: &Direction) -> f64 {
        self.one_ray(incidence.sin, incidence.cos) * self.one_ray(direction.sin, direction.cos)
    }

    fn fractions(&self, incidence: &Incidence, directions: &[Direction], out: &mut [f64]) {
        let of_source = self.one_ray(incidence.sin, incidence.cos);
        let (directions, rest) = directions.as_chunks();
        let (out, left) = out.as_chunks_mut();
        dispatch(UnshadowedFractions { smith: self, of_source, directions, out });
        if let Some(group) = filled_up(rest) {
            let mut fractions = [[0.0; WIDTH]];
            let out = &mut fractions;
            dispatch(UnshadowedFractions { smith: self, of_source, directions: &[group], out });
            left.copy_from_slice(&fractions[0][..rest.len()]);
        }
    }
}
