//! One film whose two faces repeat one rough profile.
//!
//! $$ \mathbf{F} = \mathrm{PSD}(f_x, f_y)\,\mathbf{M}(\mathbf{J}_0 + \mathbf{J}_1) $$
//!
//! J_0 and J_1 are the first-order amplitudes of the buried and the exposed face
//! (`interfaces.rs`).
//!
//! J. M. Elson, *Multilayer-coated optics: guided-wave coupling and scattering by means of
//! interface random roughness*, J. Opt. Soc. Am. A 12, 729 (1995).

use super::{ROUGHNESS, coherent::CorrelatedInterfaces};
use crate::{
    models::{Brdf, COMMON},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Correlated_Roughness_BRDF_Model",
        parent: "Roughness_BRDF_Model",
        summary: "One film with the same roughness at both faces",
        equation: "F = PSD M(J_0 + J_1)",
        source: "elson-1995",
        params: &[
            COMMON,
            ROUGHNESS,
            &[
                Parameter::number("thickness", 0.05, "um", "Thickness of the film"),
                Parameter::index("film", (1.46, 0.0), "Index of the film"),
            ],
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| CorrelatedInterfaces::one_film(node, 0..2),
};
