//! A stack of films grown one on the other: each film smooths the roughness below it and adds
//! its own.
//!
//! A film of thickness t replicates the profile below it with the factor
//!
//! $$ a = e^{-g t}, \quad g = [4\pi^2 (f_x^2 + f_y^2)]^{p/2}\, \ell^{\,p-1} \qquad (1) $$
//!
//! (ℓ `relaxation`, p `exponent`) and adds independent roughness with the spectrum
//! I(1 − a²), I `intrinsic`. The substrate has the spectrum `psd`. The profile that starts at
//! interface m therefore scatters with the amplitude
//!
//! $$ \mathbf{K}_L = \mathbf{J}_L, \quad \mathbf{K}_m = \mathbf{J}_m + a_m \mathbf{K}_{m+1} \qquad (2) $$
//!
//! $$ \mathbf{F} = \mathrm{PSD}\,\mathbf{M}(\mathbf{K}_0)
//!    + \sum_{m=1}^{L} I (1 - a_{m-1}^2)\,\mathbf{M}(\mathbf{K}_m) \qquad (3) $$
//!
//! where film m lies between the interfaces m and m + 1, and J_m are the first-order amplitudes
//! of the interfaces (`interfaces.rs`).
//!
//! D. G. Stearns, *Stochastic model for thin film growth and erosion*, Appl. Phys. Lett. 62, 1745
//! (1993); J. M. Elson, J. Opt. Soc. Am. A 12, 729 (1995).

use std::{f64::consts::PI, slice};

use super::{ROUGHNESS, RoughSurface, STACK, interfaces::StackContrast};
use crate::{
    Direction, Incidence, Jones, Mueller, ParameterError,
    models::{Brdf, COMMON, CommonParameters},
    psd::{self, Psd},
    spec::{Class, Laws, Parameter, Spec},
    stack::Stack,
};

/// Name, parameters and constructor of a [`GrowthStack`].
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Growth_Roughness_Stack_BRDF_Model",
        parent: "Roughness_BRDF_Model",
        summary: "Stack of films with partly replicated roughness",
        equation: "F = PSD M(K_0) + sum_m I (1 - a_(m-1)^2) M(K_m), K_m = J_m + a_m K_(m+1)",
        source: "stearns-1993 elson-1995",
        params: &[COMMON, ROUGHNESS, STACK, OWN],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| {
        let rough = RoughSurface::read(node)?;
        let films = node.member::<Stack>("stack")?.at(rough.common.lambda);
        let (relaxation, exponent) = (node.number("relaxation"), node.number("exponent"));
        let strength = relaxation.powf(exponent - 1.0);
        if !(relaxation >= 0.0 && strength.is_finite()) {
            let problem = format!("{relaxation} um has no power {}", exponent - 1.0);
            return Err(ParameterError::new("relaxation", problem));
        }
        Ok(Box::new(GrowthStack {
            interfaces: StackContrast::new(&rough.common, &films),
            intrinsic: node.member::<dyn Psd>("intrinsic")?,
            rough,
            thicknesses: films.iter().map(|&(_, thickness)| thickness).collect(),
            strength,
            half_exponent: 0.5 * exponent,
        }))
    },
};

const OWN: &[Parameter] = &[
    Parameter::number("relaxation", 0.0, "um", "Relaxation length of the growth"),
    Parameter::number("exponent", 2.0, "1", "Exponent of the relaxation"),
    Parameter::member(
        "intrinsic",
        &psd::FAMILY,
        "ABC_PSD_Function",
        "Spectrum of the intrinsic roughness of an infinitely thick film",
    ),
];

/// A film stack with partly replicated roughness.
pub struct GrowthStack {
    rough: RoughSurface,
    interfaces: StackContrast,
    intrinsic: Box<dyn Psd>,
    /// Thicknesses of the films, the one next to the substrate first, µm.
    thicknesses: Vec<f64>,
    /// ℓ^(p−1).
    strength: f64,
    half_exponent: f64,
}

impl GrowthStack {
    /// F from the amplitudes per √PSD of all interfaces at the frequency (fx, fy).
    fn grow(&self, jones: &[Jones], fx: f64, fy: f64) -> Mueller {
        let (substrate, intrinsic) =
            (self.rough.psd.density(fx, fy), self.intrinsic.density(fx, fy));
        let squared = 4.0 * PI * PI * (fx * fx + fy * fy);
        // (1)
        let g = squared.powf(self.half_exponent) * self.strength;
        let mut above = jones[jones.len() - 1];
        let mut sum = Mueller::ZERO;
        for (j, thickness) in jones.iter().zip(&self.thicknesses).rev() {
            let a = (-g * thickness).exp();
            // A term of (3), then (2).
            sum += above.mueller() * (intrinsic * (1.0 - a * a));
            above = *j + above.scaled(a);
        }
        sum + above.mueller() * substrate
    }
}

impl Brdf for GrowthStack {
    fn common(&self) -> &CommonParameters {
        &self.rough.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let mut out = [Mueller::ZERO];
        self.mueller_batch(incidence, slice::from_ref(direction), &mut out);
        out[0]
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        self.interfaces.amplitudes(
            incidence,
            directions,
            self.interfaces.every(),
            |place, jones| {
                let (fx, fy) = self.rough.frequency(incidence, &directions[place]);
                out[place] = self.grow(jones, fx, fy);
            },
        );
    }
}
