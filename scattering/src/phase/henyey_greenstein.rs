//! Henyey–Greenstein phase functions with one lobe and with two.
//!
//! $$ p_g = \frac{1 - g^2}{4\pi\,(1 + g^2 - 2g\cos\theta)^{3/2}} \qquad (1) $$
//!
//! $$ p = \left|\tfrac12(1+c)\,p_{g_1} + \tfrac12(1-c)\,p_{g_2}\right| \qquad (2) $$
//!
//! g is the mean cosine of the scattering angle, |g| < 1. With |c| ≤ 1 the sum is a density; for
//! other c its absolute value does not integrate to 1.
//!
//! L. G. Henyey and J. L. Greenstein, Astrophys. J. 93, 70 (1941).

use std::f64::consts::FRAC_1_PI;

use super::Phase;
use crate::{
    ParameterNode,
    spec::{Class, Laws, Parameter, ParameterError, Spec},
};

/// Name, parameters and constructor of a phase function of one [`HenyeyGreenstein`].
pub const SPEC: Spec<dyn Phase> = Spec {
    class: Class {
        name: "Henyey_Greenstein_Phase_Function",
        parent: "Phase_Function",
        summary: "One lobe with a given mean cosine",
        equation: "p = (1-g^2)/(4 pi (1+g^2-2g cos(theta))^(3/2))",
        source: "henyey-greenstein-1941",
        params: &[&[Parameter::number("g", 0.01, "1", "Mean cosine, -1 < g < 1")]],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(HenyeyGreenstein::new(asymmetry(node, "g")?))),
};

/// Name, parameters and constructor of a [`DoubleHenyeyGreenstein`] phase function.
pub const DOUBLE: Spec<dyn Phase> = Spec {
    class: Class {
        name: "Double_Henyey_Greenstein_Phase_Function",
        parent: "Phase_Function",
        summary: "Two lobes with given mean cosines",
        equation: "p = |(1+c)/2 HG(g1) + (1-c)/2 HG(g2)|",
        source: "henyey-greenstein-1941",
        params: &[&[
            Parameter::number("g1", 0.01, "1", "Mean cosine of the first lobe, -1 < g1 < 1"),
            Parameter::number("g2", 0.01, "1", "Mean cosine of the second lobe, -1 < g2 < 1"),
            Parameter::number(
                "c",
                0.1,
                "1",
                "Balance of the lobes: 1 only the first, -1 the second",
            ),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let c = node.number("c");
        Ok(Box::new(DoubleHenyeyGreenstein {
            first: HenyeyGreenstein::new(asymmetry(node, "g1")?),
            second: HenyeyGreenstein::new(asymmetry(node, "g2")?),
            shares: (0.5 * (1.0 + c), 0.5 * (1.0 - c)),
        }))
    },
};

/// The mean cosine `name`, strictly between −1 and 1.
pub(super) fn asymmetry(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let g = node.number(name);
    if g.abs() < 1.0 {
        return Ok(g);
    }
    Err(ParameterError::new(name, format!("{g} is not between -1 and 1")))
}

/// One Henyey–Greenstein lobe.
#[derive(Clone, Copy, Debug)]
pub struct HenyeyGreenstein {
    g: f64,
    /// (1 − g²)/4π.
    norm: f64,
}

impl HenyeyGreenstein {
    fn new(g: f64) -> Self {
        Self { g, norm: 0.25 * FRAC_1_PI * (1.0 - g * g) }
    }
}

impl Phase for HenyeyGreenstein {
    fn at_cosine(&self, cos: f64) -> f64 {
        let d = 1.0 + self.g * self.g - 2.0 * self.g * cos;
        // (1)
        self.norm / (d * d.sqrt())
    }
}

/// Two Henyey–Greenstein lobes.
#[derive(Clone, Copy, Debug)]
pub struct DoubleHenyeyGreenstein {
    first: HenyeyGreenstein,
    second: HenyeyGreenstein,
    /// (1 + c)/2 and (1 − c)/2.
    shares: (f64, f64),
}

impl Phase for DoubleHenyeyGreenstein {
    fn at_cosine(&self, cos: f64) -> f64 {
        let (share_1, share_2) = self.shares;
        // (2)
        (share_1 * self.first.at_cosine(cos) + share_2 * self.second.at_cosine(cos)).abs()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::special::gauss;

    #[test]
    fn g_is_the_mean_cosine() {
        for g in [-0.6, 0.0, 0.3, 0.8] {
            let lobe = HenyeyGreenstein::new(g);
            let mean = gauss::integrate(200, -1.0, 1.0, |c| TAU * c * lobe.at_cosine(c));
            assert!((mean - g).abs() < 1e-12, "{mean} {g}");
        }
    }
}
