//! A stack of films in which all interfaces repeat one rough profile.
//!
//! $$ \mathbf{F} = \mathrm{PSD}(f_x, f_y)\,\mathbf{M}\!\left(\sum_{m=0}^{L} \mathbf{J}_m\right) $$
//!
//! J_m are the first-order amplitudes of the L + 1 interfaces (`interfaces.rs`).
//!
//! J. M. Elson, *Multilayer-coated optics: guided-wave coupling and scattering by means of
//! interface random roughness*, J. Opt. Soc. Am. A 12, 729 (1995).

use super::{ROUGHNESS, RoughSurface, STACK, coherent::CorrelatedInterfaces};
use crate::{
    models::{Brdf, COMMON},
    spec::{Class, Laws, Spec},
    stack::Stack,
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Correlated_Roughness_Stack_BRDF_Model",
        parent: "Roughness_BRDF_Model",
        summary: "Stack of films with the same roughness at every interface",
        equation: "F = PSD M(sum_m J_m)",
        source: "elson-1995",
        params: &[COMMON, ROUGHNESS, STACK],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| {
        let rough = RoughSurface::read(node)?;
        let films = node.member::<Stack>("stack")?.at(rough.common.lambda);
        Ok(Box::new(CorrelatedInterfaces::new(rough, &films, 0..films.len() + 1)))
    },
};
