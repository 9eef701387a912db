//! Specular facets that shadow each other.
//!
//! $$ \mathbf F = G(\theta_i, \theta_s, \phi)\,\mathbf F_{facet} $$
//!
//! The same G is used for all sides of the surface. Light reflected twice is left out.
//!
//! K. E. Torrance and E. M. Sparrow, J. Opt. Soc. Am. 57, 1105 (1967).

use super::{FACET, bare::Facet, read_shadow};
use crate::{
    Direction, Incidence, Jones, Mueller,
    models::{Brdf, COMMON, Common},
    shadow::Shadow,
    spec::{Class, Family, Laws, Param, Spec},
};

/// The parameter of shadowed facets.
pub const SHADOW: &[Param] = &[Param::member(
    "shadow",
    Family::Shadow,
    "Shadow_Function",
    "Torrance_Sparrow_Shadow_Function",
    "Shadowing of facets by each other",
)];

/// How programs name, parameterize and build it.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Shadowed_Facet_BRDF_Model",
        parent: "Facet_BRDF_Model",
        summary: "Specular facets with shadowing",
        equation: "F = G F_facet",
        source: "torrance-1967",
        params: &[COMMON, FACET, SHADOW],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| {
        let facet = Facet::read(node)?;
        let shadow = read_shadow(node, "shadow", facet.slopes())?;
        Ok(Box::new(ShadowedFacet { facet, shadow }))
    },
};

struct ShadowedFacet {
    facet: Facet,
    shadow: Box<dyn Shadow>,
}

impl Brdf for ShadowedFacet {
    fn common(&self) -> &Common {
        self.facet.common()
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        self.facet.mueller(incidence, direction) * self.shadow.fraction(incidence, direction)
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        self.facet.mueller_batch(incidence, directions, out);
        self.shadow.shade(incidence, directions, out);
    }

    fn jones(&self, incidence: &Incidence, direction: &Direction) -> Option<Jones> {
        let fraction = self.shadow.fraction(incidence, direction);
        Some(self.facet.jones(incidence, direction)?.scaled(fraction.sqrt()))
    }

    fn is_coherent(&self) -> bool {
        true
    }
}
