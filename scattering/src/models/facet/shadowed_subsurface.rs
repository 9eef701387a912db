//! Flakes, or a rough substrate, under a smooth clear coat, that shadow each other.
//!
//! $$ \mathbf F = G(\theta_i', \theta_s', \phi)\,\mathbf F_{flake} $$
//!
//! G is evaluated at the angles inside the coat, sin θ' = sin θ/n, where the flakes meet the light.
//!
//! T. A. Germer and E. Marx, Appl. Opt. 43, 1266 (2004), for the flakes; M. I. Sancer, IEEE Trans.
//! Antennas Propag. AP-17, 577 (1969), for shadowing by known slopes.

use super::{
    parameters::{FACET, read_shadow},
    subsurface::{OVERCOAT, SubsurfaceFacet},
};
use crate::{
    Direction, Incidence, Jones, Mueller,
    models::{Brdf, COMMON, CommonParameters},
    shadow::{self, Shadow},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Shadowed_Subsurface_Facet_BRDF_Model",
        parent: "Subsurface_Facet_BRDF_Model",
        summary: "Flakes under a clear coat with shadowing",
        equation: "F = G(ti', ts') F_flake",
        source: "germer-2004 sancer-1969",
        params: &[
            COMMON,
            FACET,
            OVERCOAT,
            &[Parameter::member(
                "shadow",
                &shadow::FAMILY,
                "Unit_Shadow_Function",
                "Shadowing of flakes by each other, at the angles inside the coat",
            )],
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| {
        let flakes = SubsurfaceFacet::read(node)?;
        let shadow = read_shadow(node, "shadow", flakes.slopes())?;
        Ok(Box::new(ShadowedFlakes { flakes, shadow }))
    },
};

struct ShadowedFlakes {
    flakes: SubsurfaceFacet,
    shadow: Box<dyn Shadow>,
}

impl ShadowedFlakes {
    fn fraction(&self, incidence: &Incidence, direction: &Direction) -> f64 {
        let inside = self.flakes.inside(incidence, direction);
        self.shadow.fraction(&inside.incidence, &inside.direction)
    }
}

impl Brdf for ShadowedFlakes {
    fn common(&self) -> &CommonParameters {
        self.flakes.common()
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        self.flakes.mueller(incidence, direction) * self.fraction(incidence, direction)
    }

    fn jones(&self, incidence: &Incidence, direction: &Direction) -> Option<Jones> {
        let fraction = self.fraction(incidence, direction);
        Some(self.flakes.jones(incidence, direction)?.scaled(fraction.sqrt()))
    }

    fn is_coherent(&self) -> bool {
        true
    }
}
