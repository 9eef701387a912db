//! Phase matrix whose elements are splines through given values.
//!
//! Every element over p(θ) is a cubic through its values at 0°, 60°, 120° and 180° with
//! continuous curvature and slope 0 at both ends. The symmetry at 0° and 180° is built in: P10 and
//! P23 vanish there, and P22 is P11 at 0° and −P11 at 180°. The values decide if the matrix is
//! realizable.
//!
//! H. C. van de Hulst, *Light Scattering by Small Particles* (Wiley, 1957), 5.2.

use std::f64::consts::FRAC_PI_3;

use super::{PolarizedPhase, SCALAR, ScalarPhase};
use crate::{
    Mueller,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`Constrained`] phase matrix.
pub const SPEC: Spec<dyn PolarizedPhase> = Spec {
    class: Class {
        name: "Constrained_Phase_Function",
        parent: "Polarized_Phase_Function",
        summary: "Elements given at four angles",
        equation: "P_ij = spline(value at 0, 60, 120, 180 deg) p",
        source: "vandehulst-1957",
        params: &[
            SCALAR,
            &[
                value("m11_0", 1.0, "P11/p at 0 deg, also P22/p there"),
                value("m11_60", 0.0, "P11/p at 60 deg"),
                value("m11_120", 0.0, "P11/p at 120 deg"),
                value("m11_180", 0.0, "P11/p at 180 deg, also -P22/p there"),
                value("m22_60", 0.0, "P22/p at 60 deg"),
                value("m22_120", 0.0, "P22/p at 120 deg"),
                value("m33_0", 1.0, "P33/p at 0 deg"),
                value("m33_60", 0.0, "P33/p at 60 deg"),
                value("m33_120", 0.0, "P33/p at 120 deg"),
                value("m33_180", 0.0, "P33/p at 180 deg"),
                value("m10_60", 0.0, "P10/p at 60 deg"),
                value("m10_120", 0.0, "P10/p at 120 deg"),
                value("m23_60", 0.0, "P23/p at 60 deg"),
                value("m23_120", 0.0, "P23/p at 120 deg"),
            ],
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let m = |name| node.number(name);
        Ok(Box::new(Constrained {
            scalar: ScalarPhase::read(node)?,
            m11: Spline::through([m("m11_0"), m("m11_60"), m("m11_120"), m("m11_180")]),
            m22: Spline::through([m("m11_0"), m("m22_60"), m("m22_120"), -m("m11_180")]),
            m33: Spline::through([m("m33_0"), m("m33_60"), m("m33_120"), m("m33_180")]),
            m10: Spline::through([0.0, m("m10_60"), m("m10_120"), 0.0]),
            m23: Spline::through([0.0, m("m23_60"), m("m23_120"), 0.0]),
        }))
    },
};

const fn value(name: &'static str, default: f64, doc: &'static str) -> Parameter {
    Parameter::number(name, default, "1", doc)
}

/// A phase matrix whose elements are splines.
struct Constrained {
    scalar: ScalarPhase,
    m11: Spline,
    m22: Spline,
    m33: Spline,
    m10: Spline,
    m23: Spline,
}

impl PolarizedPhase for Constrained {
    fn at_cosine(&self, cos: f64) -> Mueller {
        let at = SplinePosition::at(cos.clamp(-1.0, 1.0).acos());
        let p = self.scalar.phase.at_cosine(cos);
        let [m11, m22, m33, l, v] =
            [&self.m11, &self.m22, &self.m33, &self.m10, &self.m23].map(|s| p * s.value(&at));
        Mueller([[p, l, 0.0, 0.0], [l, m11, 0.0, 0.0], [0.0, 0.0, m22, v], [0.0, 0.0, -v, m33]])
    }

    fn absorption(&self) -> f64 {
        self.scalar.absorption
    }

    fn scattering(&self) -> f64 {
        self.scalar.scattering
    }
}

/// A cubic spline on 0°, 60°, 120°, 180° with slope 0 at both ends.
#[derive(Clone, Copy, Debug)]
struct Spline {
    y: [f64; 4],
    /// Slopes times the interval.
    m: [f64; 4],
}

/// A place between two nodes with the four weights of a cubic there.
struct SplinePosition {
    node: usize,
    weights: [f64; 4],
}

impl SplinePosition {
    fn at(theta: f64) -> Self {
        let node = ((theta / FRAC_PI_3) as usize).min(2);
        let t = theta / FRAC_PI_3 - node as f64;
        let (t2, t3) = (t * t, t * t * t);
        let weights = [2.0 * t3 - 3.0 * t2 + 1.0, t3 - 2.0 * t2 + t, 3.0 * t2 - 2.0 * t3, t3 - t2];
        Self { node, weights }
    }
}

impl Spline {
    /// Continuous curvature at the two inner nodes: m0 + 4m1 + m2 = 3(y2 − y0) and so on.
    fn through(y: [f64; 4]) -> Self {
        let (b1, b2) = (3.0 * (y[2] - y[0]), 3.0 * (y[3] - y[1]));
        Self { y, m: [0.0, (4.0 * b1 - b2) / 15.0, (4.0 * b2 - b1) / 15.0, 0.0] }
    }

    fn value(&self, at: &SplinePosition) -> f64 {
        let (j, w) = (at.node, at.weights);
        self.y[j] * w[0] + self.m[j] * w[1] + self.y[j + 1] * w[2] + self.m[j + 1] * w[3]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spline_passes_through_its_values_with_continuous_curvature() {
        let s = Spline::through([1.0, -0.3, 0.4, 0.2]);
        let at = |t: f64| s.value(&SplinePosition::at(t));
        for (j, y) in s.y.iter().enumerate() {
            assert!((at(j as f64 * FRAC_PI_3) - y).abs() < 1e-14);
        }
        // Second derivatives of the two cubics at the inner nodes, by their coefficients.
        for j in 1..3 {
            let left = 6.0 * (s.y[j - 1] - s.y[j]) + 2.0 * s.m[j - 1] + 4.0 * s.m[j];
            let right = 6.0 * (s.y[j + 1] - s.y[j]) - 4.0 * s.m[j] - 2.0 * s.m[j + 1];
            assert!((left - right).abs() < 1e-14);
        }
    }
}
