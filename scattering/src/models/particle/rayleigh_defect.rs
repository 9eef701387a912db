//! Small spheres below the lower face of a film stack.
//!
//! $$ \mathbf{F} = \frac{N}{\cos\theta_i \cos\theta_s}\,\mathbf{M}(\mathbf{J}), \quad
//!    J_{ss} = \alpha E_i E_s \cos\varphi, \ldots $$
//!
//! N is the `density`, α the polarizability, E the fields at the `distance` below the face of
//! the substrate (`small_sphere.rs`). NIST's library adds a loss of 10⁻¹⁰ to light that comes
//! from the substrate's side ([`Defect::TinyLoss`]).
//!
//! T. A. Germer, *Angular dependence and polarization of out-of-plane optical scattering from
//! particulate contamination, subsurface defects, and surface microroughness*, Appl. Opt. 36,
//! 8798 (1997); *Polarized light scattering by microroughness and small defects in dielectric
//! layers*, J. Opt. Soc. Am. A 18, 1279 (2001).

use super::{
    LOCAL,
    small_sphere::{SmallSphere, SpherePosition, total},
};
use crate::{
    Defect, ParameterError, Side,
    models::{Brdf, COMMON, CommonParameters},
    spec::{Class, Laws, Parameter, Spec},
    stack::{self, Stack},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Rayleigh_Defect_BRDF_Model",
        parent: "Local_BRDF_Model",
        summary: "Small spheres in the substrate, below its films",
        equation: "F = density/(cos_i cos_s) M(J), J = alpha E_i E_s",
        source: "germer-1997 germer-2001-layers",
        params: &[
            COMMON,
            LOCAL,
            &[
                Parameter::member("stack", &stack::FAMILY, "No_StackModel", "Films"),
                Parameter::number("radius", 0.001, "um", "Radius of the sphere"),
                Parameter::number(
                    "distance",
                    0.0,
                    "um",
                    "Depth of the centre below the face of the substrate; with a negative one the wave of the \
                     substrate is continued upwards",
                ),
                Parameter::index("defect", (1.0, 0.0), "Index of the sphere"),
            ],
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| {
        let common = CommonParameters::read(node)?;
        let films = node.member::<Stack>("stack")?.at(common.lambda);
        let distance = node.number("distance");
        if !distance.is_finite() {
            return Err(ParameterError::new(
                "distance",
                format!("{distance} um is not a distance"),
            ));
        }
        let place = SpherePosition { depth: total(&films) + distance, medium: common.substrate };
        let defect = node.index("defect").at(common.lambda);
        let sphere = SmallSphere::new(node, common, &films, place, defect)?;
        let lossy = common.side != Side::DownUp && node.reproduces(Defect::TinyLoss);
        let own_wave = lossy || distance < 0.0;
        Ok(Box::new(if own_wave { sphere.in_substrate(&films, distance, lossy) } else { sphere }))
    },
};

#[cfg(test)]
mod tests {
    use crate::{
        Basis, Geometry, Mode, ParameterNode, models, optics::RefractiveIndex, spec::ParameterValue,
    };

    #[test]
    fn the_loss_of_light_from_the_substrate_is_compats_and_tiny() {
        let at = Geometry { theta_i: 0.5, theta_s: 0.9, phi_s: 0.7, rotation: 0.0 };
        for (side, expected) in [(0, 0.0), (1, 1e-10), (2, 1e-10), (3, 1e-10)] {
            let [sound, compat] = [Mode::Sound, Mode::Compat].map(|mode| {
                let node = ParameterNode::with_defaults(&super::SPEC.class, mode)
                    .with("substrate", ParameterValue::Index(RefractiveIndex::constant(1.5, 0.0)))
                    .and_then(|n| n.with("distance", ParameterValue::Number(0.2)))
                    .and_then(|n| n.with("type", ParameterValue::Integer(side)))
                    .unwrap();
                models::build(&node).unwrap().mueller(&at, Basis::Psps)
            });
            let difference = (sound - compat).largest() / sound.largest();
            // The loss is 10⁻¹⁰ of the index; what it does depends on the angle.
            assert!(difference <= 30.0 * expected && difference >= expected / 30.0, "{difference}");
        }
    }
}
