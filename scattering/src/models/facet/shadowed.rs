//! Specular facets that shadow each other.
//!
//! $$ \mathbf F = G(\theta_i, \theta_s, \phi)\,\mathbf F_{facet} $$
//!
//! The same G is used for all sides of the surface. Light reflected twice is left out.
//!
//! K. E. Torrance and E. M. Sparrow, J. Opt. Soc. Am. 57, 1105 (1967).

use super::{
    bare::Facet,
    parameters::{FACET, read_shadow},
};
use crate::{
    Direction, Incidence, Jones, Mueller,
    models::{BATCH, Brdf, COMMON, CommonParameters},
    polarization::SignedWeights,
    shadow::{self, Shadow},
    spec::{Class, Laws, Parameter, Spec},
};

/// The parameter of shadowed facets.
pub const SHADOW: &[Parameter] = &[Parameter::member(
    "shadow",
    &shadow::FAMILY,
    "Torrance_Sparrow_Shadow_Function",
    "Shadowing of facets by each other",
)];

/// Name, parameters and constructor of the class.
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
    fn common(&self) -> &CommonParameters {
        self.facet.common()
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        self.facet.mueller(incidence, direction) * self.shadow.fraction(incidence, direction)
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        self.facet.mueller_batch(incidence, directions, out);
        let mut fractions = [0.0; BATCH];
        for (directions, out) in directions.chunks(BATCH).zip(out.chunks_mut(BATCH)) {
            let fractions = &mut fractions[..directions.len()];
            self.shadow.fractions(incidence, directions, fractions);
            for (m, fraction) in out.iter_mut().zip(fractions) {
                *m *= *fraction;
            }
        }
    }

    fn sum(
        &self,
        incidence: &Incidence,
        directions: &[Direction],
        weights: SignedWeights<'_>,
    ) -> Mueller {
        let mut sum = Mueller::ZERO;
        let mut shadowed = [0.0; BATCH];
        for (number, directions) in directions.chunks(BATCH).enumerate() {
            let weights = weights.part(number * BATCH..number * BATCH + directions.len());
            let shadowed = &mut shadowed[..directions.len()];
            self.shadow.fractions(incidence, directions, shadowed);
            for (shadowed, weight) in shadowed.iter_mut().zip(weights.weight) {
                *shadowed *= weight;
            }
            sum += self.facet.sum(
                incidence,
                directions,
                SignedWeights { weight: shadowed, ..weights },
            );
        }
        sum
    }

    fn jones(&self, incidence: &Incidence, direction: &Direction) -> Option<Jones> {
        let fraction = self.shadow.fraction(incidence, direction);
        Some(self.facet.jones(incidence, direction)?.scaled(fraction.sqrt()))
    }

    fn is_coherent(&self) -> bool {
        true
    }

    fn is_quick(&self) -> bool {
        self.facet.is_quick()
    }
}
