//! Small spheres at one depth of a film stack.
//!
//! $$ \mathbf{F} = \frac{N}{\cos\theta_i \cos\theta_s}\,\mathbf{M}(\mathbf{J}), \quad
//!    J_{ss} = \alpha E_i E_s \cos\varphi, \ldots $$
//!
//! N is the `density`, α the polarizability, E the fields at the `depth` of the centre below the
//! outer face (`small_sphere.rs`). Negative depths lie above the films, depths beyond the films
//! in the substrate. At an interface the sphere counts to the film above it, without films and
//! at depth 0 to the substrate.
//!
//! T. A. Germer, *Polarized light scattering by microroughness and small defects in dielectric
//! layers*, J. Opt. Soc. Am. A 18, 1279 (2001).

use num_complex::Complex64;

use super::{
    LOCAL,
    small_sphere::{SmallSphere, SpherePosition},
};
use crate::{
    models::{Brdf, COMMON, CommonParameters},
    spec::{Class, Laws, Parameter, Spec},
    stack::{self, Stack},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Rayleigh_Stack_BRDF_Model",
        parent: "Local_BRDF_Model",
        summary: "Small spheres at one depth of a film stack",
        equation: "F = density/(cos_i cos_s) M(J), J = alpha E_i E_s",
        source: "germer-2001-layers",
        params: &[
            COMMON,
            LOCAL,
            &[
                Parameter::member("stack", &stack::FAMILY, "No_StackModel", "Films"),
                Parameter::number("depth", 0.0, "um", "Depth of the centre below the outer face"),
                Parameter::number("radius", 0.01, "um", "Radius of the sphere"),
                Parameter::index("sphere", (1.0, 0.0), "Index of the sphere"),
            ],
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| {
        let common = CommonParameters::read(node)?;
        let films = node.member::<Stack>("stack")?.at(common.lambda);
        let depth = node.number("depth");
        let place = SpherePosition { depth, medium: medium_at(depth, &films, common.substrate) };
        Ok(Box::new(SmallSphere::new(
            node,
            common,
            &films,
            place,
            node.index("sphere").at(common.lambda),
        )?))
    },
};

fn medium_at(depth: f64, films: &[(Complex64, f64)], substrate: Complex64) -> Complex64 {
    if depth < 0.0 {
        return Complex64::ONE;
    }
    let mut bottom = 0.0;
    for &(index, thickness) in films.iter().rev() {
        bottom += thickness;
        if depth <= bottom {
            return index;
        }
    }
    substrate
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Basis, Geometry, Mode, ParameterNode, models, optics::RefractiveIndex, spec::ParameterValue,
    };

    fn c(n: f64) -> Complex64 {
        n.into()
    }

    #[test]
    fn the_medium_is_that_of_the_depth() {
        let films = [(c(1.4), 0.2), (c(2.3), 0.1)];
        let at = |depth| medium_at(depth, &films, c(1.5));
        assert_eq!([-0.1, 0.0, 0.1, 0.2, 0.31].map(at), [1.0, 2.3, 2.3, 1.4, 1.5].map(c));
        assert_eq!(medium_at(0.0, &[], c(1.5)), c(1.5));
    }

    #[test]
    fn far_above_a_surface_without_contrast_it_is_a_free_rayleigh_sphere() {
        // dσ/dΩ of s light is k⁴r⁶|t|², the Rayleigh sphere's, for a substrate of index 1.
        let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound)
            .with("substrate", ParameterValue::Index(RefractiveIndex::constant(1.0, 0.0)))
            .and_then(|n| {
                n.with("sphere", ParameterValue::Index(RefractiveIndex::constant(1.5, 0.0)))
            })
            .and_then(|n| n.with("depth", ParameterValue::Number(-7.0)))
            .unwrap();
        let at = Geometry { theta_i: 0.3, theta_s: 0.8, phi_s: 0.0, rotation: 0.0 };
        let m = models::build(&node).unwrap().mueller(&at, Basis::Psps);
        let ss = 0.5 * (m[(0, 0)] + m[(0, 1)] + m[(1, 0)] + m[(1, 1)]);
        let k: f64 = std::f64::consts::TAU / 0.532;
        let t: f64 = (2.25 - 1.0) / (2.25 + 2.0);
        let expected = k.powi(4) * 0.01f64.powi(6) * t * t / (0.3f64.cos() * 0.8f64.cos());
        assert!((ss / expected - 1.0).abs() < 1e-13);
    }
}
