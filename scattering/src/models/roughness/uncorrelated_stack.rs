//! A stack of films in which all interfaces are rough alike, but independently.
//!
//! $$ \mathbf{F} = \mathrm{PSD}(f_x, f_y) \sum_{m=0}^{L} \mathbf{M}(\mathbf{J}_m) $$
//!
//! J_m are the first-order amplitudes of the L + 1 interfaces (`interfaces.rs`).
//!
//! J. M. Elson, *Multilayer-coated optics: guided-wave coupling and scattering by means of
//! interface random roughness*, J. Opt. Soc. Am. A 12, 729 (1995).

use std::slice;

use super::{ROUGHNESS, RoughSurface, STACK, interfaces::StackContrast};
use crate::{
    Direction, Incidence, Mueller,
    models::{Brdf, COMMON, CommonParameters},
    spec::{Class, Laws, Spec},
    stack::Stack,
};

/// Name, parameters and constructor of an [`UncorrelatedStack`].
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Uncorrelated_Roughness_Stack_BRDF_Model",
        parent: "Roughness_BRDF_Model",
        summary: "Stack of films with independent roughness at every interface",
        equation: "F = PSD sum_m M(J_m)",
        source: "elson-1995",
        params: &[COMMON, ROUGHNESS, STACK],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| {
        let rough = RoughSurface::read(node)?;
        let films = node.member::<Stack>("stack")?.at(rough.common.lambda);
        let interfaces = StackContrast::new(&rough.common, &films);
        Ok(Box::new(UncorrelatedStack { rough, interfaces }))
    },
};

/// A film stack with independent roughness at every interface.
pub struct UncorrelatedStack {
    rough: RoughSurface,
    interfaces: StackContrast,
}

impl Brdf for UncorrelatedStack {
    fn common(&self) -> &CommonParameters {
        &self.rough.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let mut out = [Mueller::ZERO];
        self.mueller_batch(incidence, slice::from_ref(direction), &mut out);
        out[0]
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        self.interfaces.amplitudes(
            incidence,
            directions,
            self.interfaces.every(),
            |place, jones| {
                let sum = jones.iter().fold(Mueller::ZERO, |sum, j| sum + j.mueller());
                out[place] = sum * self.rough.density(incidence, &directions[place]);
            },
        );
    }
}
