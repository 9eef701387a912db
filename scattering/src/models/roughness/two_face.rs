//! One film with one rough face.
//!
//! $$ \mathbf{F} = \mathrm{PSD}(f_x, f_y)\,\mathbf{M}(\mathbf{J}_m) $$
//!
//! m = 0 for the buried face (`face` = 1), m = 1 for the exposed one (`face` = 2); J_m is the
//! first-order amplitude of that interface (`interfaces.rs`). The polarization of the scattered
//! light distinguishes the two.
//!
//! T. A. Germer, *Measurement of roughness of two interfaces of a dielectric film by scattering
//! ellipsometry*, Phys. Rev. Lett. 85, 349 (2000).

use super::{ROUGHNESS, coherent::CorrelatedInterfaces};
use crate::{
    ParameterError,
    models::{Brdf, COMMON},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Two_Face_BRDF_Model",
        parent: "Roughness_BRDF_Model",
        summary: "One film with one rough face",
        equation: "F = PSD M(J_m)",
        source: "germer-2000",
        params: &[
            COMMON,
            ROUGHNESS,
            &[
                Parameter::index("film", (1.46, 0.0), "Index of the film"),
                Parameter::number("thickness", 0.05, "um", "Thickness of the film"),
                Parameter::integer("face", 1, "The rough face: 1 buried, 2 exposed"),
            ],
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| match node.integer("face") {
        1 => CorrelatedInterfaces::one_film(node, 0..1),
        2 => CorrelatedInterfaces::one_film(node, 1..2),
        face => Err(ParameterError::new("face", format!("{face} is neither 1 nor 2"))),
    },
};
