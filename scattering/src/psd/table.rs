//! Tabulated isotropic spectrum.
//!
//! $$ \mathrm{PSD} = T(f), \quad f = \sqrt{f_x^2 + f_y^2} $$
//!
//! The table holds its end values outside its range.
//!
//! J. C. Stover, *Optical Scattering: Measurement and Analysis*, 3rd ed. (SPIE, 2012), chapter 4.

use crate::{
    optics::RealFunction,
    psd::Psd,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`Tabulated`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Table_PSD_Function",
        parent: "PSD_Function",
        summary: "Tabulated against frequency",
        equation: "PSD = T(f)",
        source: "stover-2012",
        params: &[&[Parameter::table(
            "T",
            1.0,
            "um^4",
            "Spectral density as a function of spatial frequency (1/um)",
        )]],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(Tabulated { table: node.table("T").clone() })),
};

/// A tabulated spectrum.
#[derive(Clone, Debug)]
pub struct Tabulated {
    table: RealFunction,
}

impl Psd for Tabulated {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        self.table.at(fx.hypot(fy))
    }
}
