//! Dimples of elliptic outline and parabolic depth at random places.
//!
//! $$ \mathrm{PSD} = D \left( h \frac{a_x a_y}{4} \frac{\pi J_2(2\pi u)}{(\pi u)^2} \right)^2,\quad u^2 = \left(\frac{f_x a_x}{2}\right)^2 + \left(\frac{f_y a_y}{2}\right)^2 $$
//!
//! The depth is h (1 − (2x/a_x)² − (2y/a_y)²) inside the ellipse with full axes a_x, a_y; D is the
//! number per area.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (Cambridge, 1999), section 8.5.2: the
//! Fourier integral over a disc; Sonine's integral for the parabola.

use std::f64::consts::{PI, TAU};

use crate::{
    psd::{Psd, strength},
    spec::{Class, Laws, Param, Spec},
    special::bessel::bessel_over_power,
};

/// How programs name, parameterize and build a [`ParabolicDimple`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Parabolic_Dimple_PSD_Function",
        parent: "PSD_Function",
        summary: "Parabolic dimples",
        equation: "PSD = density (height axisx axisy/4 pi J2(2 pi u)/(pi u)^2)^2",
        source: "born-1999",
        params: &[&[
            Param::number("axisx", "1.5", "um", "Full axis along x"),
            Param::number("axisy", "1.5", "um", "Full axis along y"),
            Param::number("height", "0.01", "um", "Height of one"),
            Param::number("density", "0.01", "1/um^2", "Number per area"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let (ax, ay) = (node.number("axisx"), node.number("axisy"));
        let volume = PI / 8.0 * ax * ay * node.number("height");
        Ok(Box::new(ParabolicDimple {
            semi_axes: (0.5 * ax, 0.5 * ay),
            peak: strength(node, "density")? * (8.0 * volume).powi(2),
        }))
    },
};

/// Parabolic dimples; `peak` is 64 times the density at zero frequency.
#[derive(Clone, Debug)]
pub struct ParabolicDimple {
    semi_axes: (f64, f64),
    peak: f64,
}

impl Psd for ParabolicDimple {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        let u = (fx * self.semi_axes.0).hypot(fy * self.semi_axes.1);
        self.peak * bessel_over_power::<2>(TAU * u).powi(2)
    }
}
