//! Phase matrix with the polarization of Rayleigh scattering, scaled.
//!
//! With c = cos θ and c_f = cos[θ(1 + 3.13 s e^{−7θ/π})], the elements over p(θ) are
//!
//! $$ P_{00} = P_{11} = 1, \quad P_{01} = P_{10} = -p_l\frac{1-c^2}{1+c^2}, \quad
//!    P_{22} = P_{33} = \frac{2c}{1+c^2}, \quad
//!    P_{32} = -P_{23} = p_c\frac{1-c_f^2}{1+c_f^2} $$
//!
//! p_l (`plmax`) and p_c (`pcmax`) are the greatest linear and circular polarizations, s skews the
//! circular one. It is realizable where
//! p_l² + p_c² ≤ 1 nearly; p_l = 1 with p_c = 0.4 is not.
//!
//! A. D. Code and B. A. Whitney, Astrophys. J. 441, 400 (1995).

use std::f64::consts::PI;

use super::{PolarizedPhase, SCALAR, Scalar};
use crate::{
    Mueller,
    spec::{Class, Laws, Param, Spec},
};

/// How programs name, parameterize and build a [`CodeWhitney`] phase matrix.
pub const SPEC: Spec<dyn PolarizedPhase> = Spec {
    class: Class {
        name: "CodeWhitney_Phase_Function",
        parent: "Polarized_Phase_Function",
        summary: "Rayleigh-like polarization of given strength",
        equation: "P10 = -plmax (1-c^2)/(1+c^2) p, P22 = 2c/(1+c^2) p, P32 = pcmax (1-cf^2)/(1+cf^2) p",
        source: "code-whitney-1995",
        params: &[
            SCALAR,
            &[
                Param::number("plmax", "1", "1", "Greatest linear polarization"),
                Param::number("pcmax", "0", "1", "Greatest circular polarization"),
                Param::number("s", "0", "1", "Skew of the circular polarization"),
            ],
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        Ok(Box::new(CodeWhitney {
            scalar: Scalar::read(node)?,
            linear: node.number("plmax"),
            circular: node.number("pcmax"),
            skew: node.number("s"),
        }))
    },
};

/// A phase matrix with Rayleigh-like polarization.
struct CodeWhitney {
    scalar: Scalar,
    linear: f64,
    circular: f64,
    skew: f64,
}

impl PolarizedPhase for CodeWhitney {
    fn at_cosine(&self, cos: f64) -> Mueller {
        let p = self.scalar.phase.at_cosine(cos);
        let l = -p * self.linear * polarization(cos);
        let d = p * 2.0 * cos / (1.0 + cos * cos);
        let v = p * self.circular * polarization(self.skewed(cos));
        Mueller([[p, l, 0.0, 0.0], [l, p, 0.0, 0.0], [0.0, 0.0, d, -v], [0.0, 0.0, v, d]])
    }

    fn absorption(&self) -> f64 {
        self.scalar.absorption
    }

    fn scattering(&self) -> f64 {
        self.scalar.scattering
    }
}

impl CodeWhitney {
    /// cos of the skewed angle.
    fn skewed(&self, cos: f64) -> f64 {
        if self.skew == 0.0 {
            return cos;
        }
        let theta = cos.clamp(-1.0, 1.0).acos();
        (theta * (1.0 + 3.13 * self.skew * (-7.0 * theta / PI).exp())).cos()
    }
}

/// (1 − c²)/(1 + c²).
fn polarization(c: f64) -> f64 {
    (1.0 - c * c) / (1.0 + c * c)
}
