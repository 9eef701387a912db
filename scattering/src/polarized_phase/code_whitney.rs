//! Phase matrix with the polarization of Rayleigh scattering, scaled.
//!
//! With c = cos θ, the elements over p(θ) are
//!
//! $$ P_{00} = P_{11} = 1, \quad P_{01} = P_{10} = -p_l\frac{1-c^2}{1+c^2}, \quad
//!    P_{22} = P_{33} = \frac{2c}{1+c^2}, \quad
//!    P_{32} = -P_{23} = p_c\frac{1-c_f^2}{1+c_f^2} \qquad (1) $$
//!
//! $$ c_f = \cos[\theta\,(1 + 3.13\,s\,e^{-7\theta/\pi})] \qquad (2) $$
//!
//! p_l (`plmax`) and p_c (`pcmax`) are the greatest linear and circular polarizations, s skews the
//! circular one. Light has no more polarization than intensity where
//! P_10² + P_22² + P_32² ≤ P_00², which is p_l² + p_c² ≤ 1 without skew; elsewhere a build notes
//! [`ModelLimit::Unrealizable`].
//!
//! A. D. Code and B. A. Whitney, Astrophys. J. 441, 400 (1995).

use std::f64::consts::PI;

use super::{PolarizedPhase, SCALAR, ScalarPhase};
use crate::{
    ModelLimit, Mueller,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`CodeWhitney`] phase matrix.
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
                Parameter::number("plmax", 1.0, "1", "Greatest linear polarization"),
                Parameter::number("pcmax", 0.0, "1", "Greatest circular polarization"),
                Parameter::number("s", 0.0, "1", "Skew of the circular polarization"),
            ],
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let phase = CodeWhitney {
            scalar: ScalarPhase::read(node)?,
            linear: node.number("plmax"),
            circular: node.number("pcmax"),
            skew: node.number("s"),
        };
        if !phase.is_realizable() {
            node.note_limit(ModelLimit::Unrealizable);
        }
        Ok(Box::new(phase))
    },
};

/// A phase matrix with Rayleigh-like polarization.
struct CodeWhitney {
    scalar: ScalarPhase,
    /// p_l.
    linear: f64,
    /// p_c.
    circular: f64,
    /// s.
    skew: f64,
}

impl PolarizedPhase for CodeWhitney {
    fn at_cosine(&self, cos: f64) -> Mueller {
        // (1)
        let p00 = self.scalar.phase.at_cosine(cos);
        let p10 = -p00 * self.linear * polarization(cos);
        let p22 = p00 * 2.0 * cos / (1.0 + cos * cos);
        let p32 = p00 * self.circular * polarization(self.skewed(cos));
        Mueller([
            [p00, p10, 0.0, 0.0],
            [p10, p00, 0.0, 0.0],
            [0.0, 0.0, p22, -p32],
            [0.0, 0.0, p32, p22],
        ])
    }

    fn absorption(&self) -> f64 {
        self.scalar.absorption
    }

    fn scattering(&self) -> f64 {
        self.scalar.scattering
    }
}

impl CodeWhitney {
    /// True if no light gets more polarization than intensity, checked at every degree.
    fn is_realizable(&self) -> bool {
        (0..=180).all(|degree| {
            let cos = f64::from(degree).to_radians().cos();
            let linear = self.linear * polarization(cos);
            let circular = self.circular * polarization(self.skewed(cos));
            let rest = 2.0 * cos / (1.0 + cos * cos);
            linear * linear + circular * circular + rest * rest <= 1.0 + 1e-12
        })
    }

    /// c_f, the cosine of the skewed angle. (2)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mode, ParameterNode, ParameterValue, spec};

    #[test]
    fn more_polarization_than_light_is_told() {
        let told = |params: &[(&str, f64)]| {
            let node = params
                .iter()
                .fold(ParameterNode::with_defaults(&SPEC.class, Mode::Sound), |node, (name, x)| {
                    node.with(name, ParameterValue::Number(*x)).unwrap()
                });
            spec::build::<dyn PolarizedPhase>(&node).unwrap();
            let met = node.notices.lock().unwrap();
            met.contains(&ModelLimit::Unrealizable.into())
        };
        assert!(!told(&[]));
        assert!(!told(&[("plmax", 0.8), ("pcmax", 0.6)]));
        assert!(told(&[("pcmax", 0.4)]));
        assert!(told(&[("plmax", -1.1)]));
        // The skew moves circular polarization to where linear light has none to spare.
        assert!(told(&[("plmax", 0.8), ("pcmax", 0.6), ("s", 1.0)]));
    }
}
