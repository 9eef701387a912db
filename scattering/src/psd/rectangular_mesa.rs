//! Plateaus with rectangular outline at random places.
//!
//! $$ \mathrm{PSD} = D\,[h l_x l_y\,\mathrm{sinc}(\pi f_x l_x)\,\mathrm{sinc}(\pi f_y l_y)]^2 $$
//!
//! l_x, l_y are the sides, h the height (or depth), D the number per area, sinc t = sin t / t.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (Cambridge, 1999), section 8.5.1: the
//! Fourier integral over a rectangle.

use std::f64::consts::PI;

use crate::{
    psd::{Psd, sinc, strength},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`RectangularMesa`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Rectangular_Mesa_PSD_Function",
        parent: "PSD_Function",
        summary: "Rectangular plateaus",
        equation: "PSD = density (height lx ly sinc(pi fx lx) sinc(pi fy ly))^2",
        source: "born-1999",
        params: &[&[
            Parameter::number("lengthx", 1.5, "um", "Length of the side along x"),
            Parameter::number("lengthy", 1.5, "um", "Length of the side along y"),
            Parameter::number("height", 0.01, "um", "Height of one"),
            Parameter::number("density", 0.01, "1/um^2", "Number per area"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let (lx, ly) = (node.number("lengthx"), node.number("lengthy"));
        let volume = lx * ly * node.number("height");
        Ok(Box::new(RectangularMesa {
            pi_sides: (PI * lx, PI * ly),
            peak: strength(node, "density")? * volume.powi(2),
        }))
    },
};

/// Rectangular plateaus.
#[derive(Clone, Debug)]
pub struct RectangularMesa {
    /// π l_x and π l_y, µm.
    pi_sides: (f64, f64),
    /// D (h l_x l_y)², µm⁴.
    peak: f64,
}

impl Psd for RectangularMesa {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        self.peak * (sinc(fx * self.pi_sides.0) * sinc(fy * self.pi_sides.1)).powi(2)
    }
}
