//! Sum of two spectra: two independent kinds of roughness on one surface.
//!
//! $$ \mathrm{PSD} = \mathrm{PSD}_1 + \mathrm{PSD}_2 $$
//!
//! J. C. Stover, *Optical Scattering: Measurement and Analysis*, 3rd ed. (SPIE, 2012), chapter 4.

use crate::{
    psd::{FAMILY, Psd},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`DoublePsd`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Double_PSD_Function",
        parent: "PSD_Function",
        summary: "Sum of two spectra",
        equation: "PSD = PSD1 + PSD2",
        source: "stover-2012",
        params: &[&[part("psd1", "The first spectrum"), part("psd2", "The second spectrum")]],
        laws: Laws::NONE,
    },
    build: |node| {
        Ok(Box::new(DoublePsd {
            first: node.member::<dyn Psd>("psd1")?,
            second: node.member::<dyn Psd>("psd2")?,
        }))
    },
};

const fn part(name: &'static str, doc: &'static str) -> Parameter {
    Parameter::member(name, &FAMILY, "ABC_PSD_Function", doc)
}

/// A sum of two spectra.
pub struct DoublePsd {
    first: Box<dyn Psd>,
    second: Box<dyn Psd>,
}

impl Psd for DoublePsd {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        self.first.density(fx, fy) + self.second.density(fx, fy)
    }
}
