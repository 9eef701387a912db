//! Reflectance of a scattering and absorbing layer on a backing, by two fluxes of diffuse light.
//!
//! $$ R = \frac{R_g + [S - (S+K)R_g]\,\tau}{1 + [S + K - S R_g]\,\tau}, \qquad
//!    \tau = \frac{\tanh\beta t}{\beta}, \qquad \beta = \sqrt{K(K + 2S)} $$
//!
//! K and S are the coefficients of absorption and scattering of diffuse light (1/µm), t the
//! thickness (µm), R_g the reflectance of the backing. One formula holds without absorption
//! (β → 0, τ → t), without scattering (R = R_g e^{−2Kt}) and for opaque layers (τ → 1/β), where
//! the exponential form of the textbooks overflows.
//!
//! P. Kubelka and F. Munk, *Ein Beitrag zur Optik der Farbanstriche*, Z. Tech. Phys. 12, 593
//! (1931); P. Kubelka, JOSA 38, 448 (1948).

use super::Reflectance;
use crate::{
    Defect, ParameterNode,
    optics::RealFunction,
    reflectance::FAMILY,
    spec::{Class, Laws, Parameter, ParameterError, Spec},
};

/// Name, parameters and constructor of a [`KubelkaMunk`] layer.
pub const SPEC: Spec<dyn Reflectance> = Spec {
    class: Class {
        name: "Kubelka_Munk_Reflectance",
        parent: "Reflectance",
        summary: "Layer of paint on a backing",
        equation: "R = (Rg + (S-(S+K)Rg)tau)/(1 + (S+K-S Rg)tau), tau = tanh(bt)/b, b^2 = K(K+2S)",
        source: "kubelka-munk-1931 kubelka-1948",
        params: &[&[
            Parameter::number("thickness", 1.0, "um", "Thickness of the layer"),
            Parameter::table(
                "absorption",
                1.0,
                "1/um",
                "Absorption coefficient against wavelength",
            ),
            Parameter::table(
                "scattering",
                1.0,
                "1/um",
                "Scattering coefficient against wavelength",
            ),
            Parameter::member(
                "substrate",
                &FAMILY,
                "Table_Reflectance",
                "Reflectance of the backing",
            ),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let thickness = node.number("thickness");
        if !(thickness >= 0.0) {
            return Err(ParameterError::new(
                "thickness",
                format!("{thickness} um is not a thickness"),
            ));
        }
        Ok(Box::new(KubelkaMunk {
            thickness,
            absorption: node.table("absorption").clone(),
            scattering: node.table("scattering").clone(),
            backing: node.member::<dyn Reflectance>("substrate")?,
            node: node.clone(),
        }))
    },
};

/// A Kubelka–Munk layer on a backing.
pub struct KubelkaMunk {
    thickness: f64,
    absorption: RealFunction,
    scattering: RealFunction,
    backing: Box<dyn Reflectance>,
    /// Asked whether to reproduce the overflow, which depends on the wavelength.
    node: ParameterNode,
}

impl Reflectance for KubelkaMunk {
    fn at(&self, lambda: f64) -> f64 {
        let (k, s) = (self.absorption.at(lambda), self.scattering.at(lambda));
        if self.overflows(k, s) && self.node.reproduces(Defect::KubelkaOverflow) {
            return f64::NAN;
        }
        layer(k, s, self.thickness, self.backing.at(lambda))
    }
}

impl KubelkaMunk {
    /// True if e^{2βt} of the textbook form leaves the range of numbers.
    fn overflows(&self, k: f64, s: f64) -> bool {
        k != 0.0 && s != 0.0 && 2.0 * beta(k, s) * self.thickness > f64::MAX.ln()
    }
}

fn beta(k: f64, s: f64) -> f64 {
    (k * (k + 2.0 * s)).sqrt()
}

/// R of a layer of thickness `t` with coefficients `k`, `s` on a backing of reflectance `r_g`.
fn layer(k: f64, s: f64, t: f64, r_g: f64) -> f64 {
    let beta = beta(k, s);
    let tau = if beta == 0.0 { t } else { (beta * t).tanh() / beta };
    (r_g + (s - (s + k) * r_g) * tau) / (1.0 + (s + k - s * r_g) * tau)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mode, ParameterValue, spec};

    fn build(mode: Mode, thickness: f64) -> (Box<dyn Reflectance>, ParameterNode) {
        let node = ParameterNode::with_defaults(&SPEC.class, mode)
            .with("thickness", ParameterValue::Number(thickness))
            .unwrap();
        (spec::build::<dyn Reflectance>(&node).unwrap(), node)
    }

    #[test]
    fn without_scattering_the_backing_is_seen_through_two_passes() {
        // Differences of tanh from 1 cost a few rounding errors.
        assert!((layer(0.2, 0.0, 3.0, 0.3) - 0.3 * (-1.2f64).exp()).abs() < 1e-15);
    }

    #[test]
    fn without_absorption_nothing_is_lost_on_a_white_backing() {
        for t in [0.0, 0.1, 10.0, 1e6] {
            assert!((layer(0.0, 0.5, t, 1.0) - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn a_layer_on_a_layer_is_the_thicker_layer() {
        let (k, s, r_g) = (0.2, 0.5, 0.3);
        let stacked = layer(k, s, 1.2, layer(k, s, 1.8, r_g));
        assert!((stacked - layer(k, s, 3.0, r_g)).abs() < 1e-15);
    }

    #[test]
    fn opaque_layers_reflect_the_limit_soundly_and_nan_in_compat() {
        // K = S = 1/µm: a = 2, R∞ = 2 − √3.
        let (sound, node) = build(Mode::Sound, 1000.0);
        assert!((sound.at(0.5) - (2.0 - 3f64.sqrt())).abs() < 1e-15);
        assert!(node.notices.lock().unwrap().contains(&Defect::KubelkaOverflow.into()));
        assert!(build(Mode::Compat, 1000.0).0.at(0.5).is_nan());
        assert!(build(Mode::Compat, 100.0).0.at(0.5).is_finite());
    }

    #[test]
    fn a_negative_thickness_is_refused() {
        let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound)
            .with("thickness", ParameterValue::Number(-1.0))
            .unwrap();
        let error = spec::build::<dyn Reflectance>(&node).err().unwrap();
        assert_eq!(error.parameter, "thickness");
    }
}
