//! Division of the light of a pigmented coating between its flakes and the gaps between them.

use std::f64::consts::PI;

use super::body::nonnegative;
use crate::{ParameterError, ParameterNode};

/// Division of the light between flakes and binder.
pub(super) struct FlakeCover {
    /// τ.
    pub(super) depth: f64,
    /// 2 − c.
    pub(super) passes: f64,
    /// κL.
    pub(super) binder: f64,
    /// The flakes' weight of equation 11, if it is taken as printed.
    pub(super) printed: bool,
}

impl FlakeCover {
    pub(super) fn read(
        node: &ParameterNode,
        lambda: f64,
        k: f64,
        printed: bool,
    ) -> Result<Self, ParameterError> {
        let thickness = nonnegative(node, "thickness")?;
        let depth =
            nonnegative(node, "flake_density")? * nonnegative(node, "flake_area")? * thickness;
        let correlation = node.number("correlation");
        if !(0.0..=1.0).contains(&correlation) {
            let problem = format!("{correlation} is not from 0 to 1");
            return Err(ParameterError::new("correlation", problem));
        }
        let binder = 4.0 * PI * k * thickness / lambda;
        Ok(Self { depth, passes: 2.0 - correlation, binder, printed })
    }

    /// ω_s for rays with these cosines inside.
    pub(super) fn flakes(&self, cos_i: f64, cos_s: f64) -> f64 {
        if self.printed {
            return (-self.depth).exp();
        }
        let mut whole = self.passes * self.depth;
        if self.binder > 0.0 {
            whole += self.binder * (1.0 / cos_i + 1.0 / cos_s);
        }
        if whole > 0.0 { -self.depth * (-whole).exp_m1() / whole } else { 0.0 }
    }

    /// ω_s without absorption.
    pub(super) fn covered(&self) -> f64 {
        -(-self.passes * self.depth).exp_m1() / self.passes
    }

    /// ω_d without absorption.
    pub(super) fn gaps(&self) -> f64 {
        (-self.passes * self.depth).exp()
    }

    /// Transmittance of the binder for a ray with this cosine over the fraction `part` of the thickness.
    pub(super) fn left(&self, part: f64, cos: f64) -> f64 {
        if self.binder > 0.0 { (-self.binder * part / cos).exp() } else { 1.0 }
    }

    /// Mean depth of the visible flakes over the thickness of the coat.
    pub(super) fn level(&self) -> f64 {
        let whole = self.passes * self.depth;
        if whole < 1e-4 { 0.5 - whole / 12.0 } else { 1.0 / whole - 1.0 / whole.exp_m1() }
    }
}
