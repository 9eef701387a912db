//! Power law, the spectrum of a self-affine surface.
//!
//! $$ \mathrm{PSD} = A / f^{\,n} $$
//!
//! f = √(f_x² + f_y²), n the exponent. Infinite at f = 0.
//!
//! E. L. Church, *Fractal surface finish*, Appl. Opt. 27, 1518 (1988).

use crate::{
    psd::{Psd, strength},
    spec::{Class, Laws, Param, Spec},
};

/// How programs name, parameterize and build a [`Fractal`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Fractal_PSD_Function",
        parent: "PSD_Function",
        summary: "Power law",
        equation: "PSD = A/f^exponent",
        source: "church-1988",
        params: &[&[
            Param::number("A", "0.01", "um^(4-exponent)", "Density at 1/um"),
            Param::number("exponent", "2.5", "1", "Exponent of the fall"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let exponent = node.number("exponent");
        Ok(Box::new(Fractal { a: strength(node, "A")?, power: -0.5 * exponent }))
    },
};

/// A power law.
#[derive(Clone, Debug)]
pub struct Fractal {
    a: f64,
    power: f64,
}

impl Psd for Fractal {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        self.a * (fx * fx + fy * fy).powf(self.power)
    }
}
