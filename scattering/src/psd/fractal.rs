//! Power law, the spectrum of a self-affine surface.
//!
//! $$ \mathrm{PSD} = A / f^{\,n} $$
//!
//! f = √(f_x² + f_y²), n the exponent. It grows without bound as f falls; waves longer than a metre
//! count as those of a metre, since no sample is larger. NIST's library is infinite at f = 0.
//!
//! E. L. Church, *Fractal surface finish*, Appl. Opt. 27, 1518 (1988).

use crate::{
    Mode, ParameterError,
    psd::{Psd, strength},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`Fractal`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Fractal_PSD_Function",
        parent: "PSD_Function",
        summary: "Power law",
        equation: "PSD = A/f^exponent",
        source: "church-1988",
        params: &[&[
            Parameter::number("A", 0.01, "um^(4-exponent)", "Density at 1/um"),
            Parameter::number("exponent", 2.5, "1", "Exponent of the fall"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let exponent = node.number("exponent");
        let is_sound = node.mode == Mode::Sound;
        if is_sound && exponent.abs() > STEEPEST {
            let problem = format!("{exponent} is not from -{STEEPEST} to {STEEPEST}");
            return Err(ParameterError::new("exponent", problem));
        }
        let least = if is_sound { LEAST_SQUARED } else { 0.0 };
        Ok(Box::new(Fractal { a: strength(node, "A")?, power: -0.5 * exponent, least }))
    },
};

/// Square of the smallest frequency that is distinguished from 0, 1/µm².
const LEAST_SQUARED: f64 = 1e-12;
/// The largest exponent in magnitude: no surface has a larger one, and its powers overflow.
const STEEPEST: f64 = 30.0;

/// A power law.
#[derive(Clone, Debug)]
pub struct Fractal {
    /// A, µm^(4−n).
    a: f64,
    /// −n/2.
    power: f64,
    /// The smallest f², 1/µm².
    least: f64,
}

impl Psd for Fractal {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        let f2 = (fx * fx + fy * fy).max(self.least);
        self.a * f2.powf(self.power)
    }
}
