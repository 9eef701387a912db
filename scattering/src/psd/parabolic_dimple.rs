//! Dimples of elliptic outline and parabolic depth at random places.
//!
//! $$ \mathrm{PSD} = D \left( h \frac{a_x a_y}{4} \frac{\pi J_2(2\pi u)}{(\pi u)^2} \right)^2,\quad
//!    u^2 = \left(\frac{f_x a_x}{2}\right)^2 + \left(\frac{f_y a_y}{2}\right)^2 $$
//!
//! The depth is h (1 − (2x/a_x)² − (2y/a_y)²) inside the ellipse with full axes a_x, a_y; D is the
//! number per area.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (Cambridge, 1999), section 8.5.2: the
//! Fourier integral over a disc; Sonine's integral for the parabola.

use super::{
    Psd,
    elliptic::{ELLIPTIC, Elliptic},
};
use crate::spec::{Class, Laws, Spec};

/// Name, parameters and constructor of parabolic dimples.
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Parabolic_Dimple_PSD_Function",
        parent: "PSD_Function",
        summary: "Parabolic dimples",
        equation: "PSD = density (height axisx axisy/4 pi J2(2 pi u)/(pi u)^2)^2",
        source: "born-1999",
        params: &[ELLIPTIC],
        laws: Laws::NONE,
    },
    // J2(z)/z² is 1/8 at zero; the volume is half that of a plateau.
    build: |node| Ok(Box::new(Elliptic::<2>::read(node, 8.0, 0.5)?)),
};
