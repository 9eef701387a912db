//! A smooth substrate with films: a mirror. Its BRDF is 0, because a mirror beam is not part of one.
//!
//! Below the layers of `Adding_Doubling_BRDF_Model` it reflects what reaches it.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999), section 1.5.

use crate::{
    Direction, Incidence, Mueller,
    models::{Brdf, COMMON, CommonParameters},
    spec::{Class, Laws, Parameter, Spec},
    stack::{self, Stack},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Smooth_Surface_BRDF_Model",
        parent: "BRDF_Model",
        summary: "Smooth substrate below layers; alone it scatters nothing",
        equation: "F = 0",
        source: "born-1999",
        params: &[
            COMMON,
            &[Parameter::member(
                "stack",
                &stack::FAMILY,
                "No_StackModel",
                "Films on the substrate",
            )],
        ],
        laws: Laws::ALL,
    },
    build: |node| {
        node.member::<Stack>("stack")?;
        Ok(Box::new(SmoothSurface(CommonParameters::read(node)?)))
    },
};

/// A smooth substrate.
struct SmoothSurface(CommonParameters);

impl Brdf for SmoothSurface {
    fn common(&self) -> &CommonParameters {
        &self.0
    }

    fn mueller(&self, _: &Incidence, _: &Direction) -> Mueller {
        Mueller::ZERO
    }

    fn is_quick(&self) -> bool {
        true
    }
}
