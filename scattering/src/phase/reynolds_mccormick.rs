//! Reynolds–McCormick phase functions: Henyey–Greenstein with a free exponent.
//!
//! $$ p_g = K\,(1 + g^2 - 2g\cos\theta)^{-(\alpha+1)} \qquad (1) $$
//!
//! $$ K = \frac{\alpha g}{\pi}\,\frac{(1-g^2)^{2\alpha}}{(1+g)^{2\alpha} - (1-g)^{2\alpha}}
//!    = \frac{1}{4\pi}\,\frac{g}{\mathrm{artanh}\,g}\,(1-g^2)^\alpha\,\frac{y}{\sinh y}, \quad
//!    y = 2\alpha\,\mathrm{artanh}\,g \qquad (2) $$
//!
//! $$ p = \left|\tfrac12(1+c)\,p_g + \tfrac12(1-c)\,p_{-g}\right| \qquad (3) $$
//!
//! |g| < 1; α = 1/2 is Henyey–Greenstein. The second form of K has no singular cases. (3) is the
//! form with two lobes.
//!
//! L. O. Reynolds and N. J. McCormick, JOSA 70, 1206 (1980).

use std::f64::consts::{FRAC_1_PI, PI};

use super::{Phase, henyey_greenstein::asymmetry};
use crate::{
    Defect, ParameterNode,
    spec::{Class, Laws, Parameter, ParameterError, Spec},
};

/// Name, parameters and constructor of a phase function of one [`ReynoldsMcCormick`].
pub const SPEC: Spec<dyn Phase> = Spec {
    class: Class {
        name: "Reynolds_McCormick_Phase_Function",
        parent: "Phase_Function",
        summary: "One lobe with a free exponent",
        equation: "p = K (1+g^2-2g cos(theta))^-(alpha+1)",
        source: "reynolds-mccormick-1980",
        params: &[LOBE],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(ReynoldsMcCormick::read(node)?)),
};

/// Name, parameters and constructor of a [`DoubleReynoldsMcCormick`] phase function.
pub const DOUBLE: Spec<dyn Phase> = Spec {
    class: Class {
        name: "Double_Reynolds_McCormick_Phase_Function",
        parent: "Phase_Function",
        summary: "A forward and a backward lobe with a free exponent",
        equation: "p = |(1+c)/2 RM(g) + (1-c)/2 RM(-g)|",
        source: "reynolds-mccormick-1980",
        params: &[
            LOBE,
            &[Parameter::number("c", 0.1, "1", "Balance: 1 only the lobe of g, -1 that of -g")],
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let c = node.number("c");
        let lobe = ReynoldsMcCormick::read(node)?;
        Ok(Box::new(DoubleReynoldsMcCormick { lobe, shares: (0.5 * (1.0 + c), 0.5 * (1.0 - c)) }))
    },
};

const LOBE: &[Parameter] = &[
    Parameter::number("g", 0.01, "1", "Asymmetry, -1 < g < 1"),
    Parameter::number("alpha", 0.5, "1", "Exponent; 0.5 is Henyey-Greenstein"),
];

/// One Reynolds–McCormick lobe.
#[derive(Clone, Copy, Debug)]
pub struct ReynoldsMcCormick {
    g: f64,
    alpha: f64,
    /// K.
    norm: f64,
}

impl ReynoldsMcCormick {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let (g, alpha) = (asymmetry(node, "g")?, node.number("alpha"));
        if !alpha.is_finite() {
            return Err(ParameterError::new("alpha", format!("{alpha} is not an exponent")));
        }
        let compat = node.reproduces(Defect::ReynoldsNorm);
        let norm = if compat { compat_norm(g, alpha) } else { norm(g, alpha) };
        Ok(Self { g, alpha, norm })
    }
}

/// K for which ∫ p dΩ = 1, by the second form of (2).
fn norm(g: f64, alpha: f64) -> f64 {
    let over = |x: f64, f: f64| if x == 0.0 { 1.0 } else { x / f };
    let y = 2.0 * alpha * g.atanh();
    0.25 * FRAC_1_PI * over(g, g.atanh()) * (1.0 - g * g).powf(alpha) * over(y, y.sinh())
}

/// K by the first form of (2) with g² in place of g in the denominator.
fn compat_norm(g: f64, alpha: f64) -> f64 {
    let (g2, twice) = (g * g, 2.0 * alpha);
    alpha * g / PI * (1.0 - g2).powf(twice) / ((1.0 + g2).powf(twice) - (1.0 - g2).powf(twice))
}

impl Phase for ReynoldsMcCormick {
    fn at_cosine(&self, cos: f64) -> f64 {
        // (1)
        self.norm * (1.0 + self.g * self.g - 2.0 * self.g * cos).powf(-self.alpha - 1.0)
    }
}

/// A lobe and its image in the plane across the beam.
#[derive(Clone, Copy, Debug)]
pub struct DoubleReynoldsMcCormick {
    lobe: ReynoldsMcCormick,
    /// (1 + c)/2 and (1 − c)/2.
    shares: (f64, f64),
}

impl Phase for DoubleReynoldsMcCormick {
    fn at_cosine(&self, cos: f64) -> f64 {
        let (share_1, share_2) = self.shares;
        // (3): p_{−g}(θ) = p_g(π − θ).
        (share_1 * self.lobe.at_cosine(cos) + share_2 * self.lobe.at_cosine(-cos)).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_norm_is_the_one_of_the_paper() {
        for (g, alpha) in [(0.5f64, 0.8f64), (-0.3, 1.7), (0.9, -0.4)] {
            let twice = 2.0 * alpha;
            let printed = alpha * g / PI * (1.0 - g * g).powf(twice)
                / ((1.0 + g).powf(twice) - (1.0 - g).powf(twice));
            assert!((norm(g, alpha) / printed - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn alpha_one_half_is_henyey_greenstein() {
        let g = 0.6f64;
        assert!((norm(g, 0.5) - 0.25 * FRAC_1_PI * (1.0 - g * g)).abs() < 1e-16);
    }
}
