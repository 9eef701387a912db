//! Plateaus with elliptic outline at random places.
//!
//! $$ \mathrm{PSD} = D \left( h \frac{a_x a_y}{4} \frac{J_1(2\pi u)}{u} \right)^2,\quad
//!    u^2 = \left(\frac{f_x a_x}{2}\right)^2 + \left(\frac{f_y a_y}{2}\right)^2 $$
//!
//! a_x, a_y are the full axes of the ellipse, h its height (or depth), D the number per area.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (Cambridge, 1999), section 8.5.2: the
//! Fourier integral over a disc.

use super::{
    Psd,
    elliptic::{ELLIPTIC, Elliptic},
};
use crate::spec::{Class, Laws, Spec};

/// Name, parameters and constructor of elliptic plateaus.
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Elliptical_Mesa_PSD_Function",
        parent: "PSD_Function",
        summary: "Elliptic plateaus",
        equation: "PSD = density (height axisx axisy/4 J1(2 pi u)/u)^2",
        source: "born-1999",
        params: &[ELLIPTIC],
        laws: Laws::NONE,
    },
    // J1(z)/z is 1/2 at zero, where the spectrum is the square of the volume.
    build: |node| Ok(Box::new(Elliptic::<1>::read(node, 2.0, 1.0)?)),
};
