//! Plateaus with elliptic outline at random places.
//!
//! $$ \mathrm{PSD} = D \left( h \frac{a_x a_y}{4} \frac{J_1(2\pi u)}{u} \right)^2,\quad u^2 = \left(\frac{f_x a_x}{2}\right)^2 + \left(\frac{f_y a_y}{2}\right)^2 $$
//!
//! a_x, a_y are the full axes of the ellipse, h its height (or depth), D the number per area.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (Cambridge, 1999), section 8.5.2: the
//! Fourier integral over a disc.

use std::f64::consts::{PI, TAU};

use crate::{
    psd::{Psd, strength},
    spec::{Class, Laws, Param, Spec},
    special::bessel::bessel_over_power,
};

/// How programs name, parameterize and build an [`EllipticalMesa`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Elliptical_Mesa_PSD_Function",
        parent: "PSD_Function",
        summary: "Elliptic plateaus",
        equation: "PSD = density (height axisx axisy/4 J1(2 pi u)/u)^2",
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
        let volume = PI / 4.0 * ax * ay * node.number("height");
        Ok(Box::new(EllipticalMesa {
            semi_axes: (0.5 * ax, 0.5 * ay),
            peak: strength(node, "density")? * (2.0 * volume).powi(2),
        }))
    },
};

/// Elliptic plateaus; `peak` is four times the density at zero frequency.
#[derive(Clone, Debug)]
pub struct EllipticalMesa {
    semi_axes: (f64, f64),
    peak: f64,
}

impl Psd for EllipticalMesa {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        let u = (fx * self.semi_axes.0).hypot(fy * self.semi_axes.1);
        self.peak * bessel_over_power::<1>(TAU * u).powi(2)
    }
}
