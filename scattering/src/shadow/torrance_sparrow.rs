//! Shadowing and masking in V-shaped grooves.
//!
//! $$ G = \min\left(1, \frac{2 n_z\cos\theta_i}{\cos\iota},
//!    \frac{2 n_z\cos\theta_s}{\cos\iota}\right) $$
//!
//! n̂ is the normal of the facet that connects the two directions and ι the angle of incidence on
//! it.
//!
//! K. E. Torrance and E. M. Sparrow, J. Opt. Soc. Am. 57, 1105 (1967); in this form J. F. Blinn,
//! Proc. SIGGRAPH 192 (1977).

use super::Shadow;
use crate::{
    Direction, Incidence,
    spec::{Class, Laws, Spec},
};

/// Name and constructor of the class.
pub const SPEC: Spec<dyn Shadow> = Spec {
    class: Class {
        name: "Torrance_Sparrow_Shadow_Function",
        parent: "Shadow_Function",
        summary: "V-shaped grooves",
        equation: "G = min(1, 2 nz cos(ti)/cos(iota), 2 nz cos(ts)/cos(iota))",
        source: "torrance-1967",
        params: &[],
        laws: Laws::NONE,
    },
    build: |_| Ok(Box::new(TorranceSparrow)),
};

struct TorranceSparrow;

impl Shadow for TorranceSparrow {
    fn fraction(&self, incidence: &Incidence, direction: &Direction) -> f64 {
        // h = k_s − k_i has the direction of the normal and |h| = 2 cos ι.
        let h = direction.k() - incidence.k();
        (4.0 * h.z * incidence.cos.min(direction.cos) / h.length_squared()).min(1.0)
    }
}
