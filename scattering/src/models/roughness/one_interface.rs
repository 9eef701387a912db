//! One rough interface in a stack of films, all others smooth.
//!
//! $$ \mathbf{F} = \mathrm{PSD}(f_x, f_y)\,\mathbf{M}(\mathbf{J}_m) $$
//!
//! m is `this_layer`: 0 the face of the substrate, 1 the outer face of the first film, and so
//! on; J_m is the first-order amplitude of that interface (`interfaces.rs`).
//!
//! J. M. Elson, *Multilayer-coated optics: guided-wave coupling and scattering by means of
//! interface random roughness*, J. Opt. Soc. Am. A 12, 729 (1995).

use super::{ROUGHNESS, RoughSurface, STACK, coherent::CorrelatedInterfaces};
use crate::{
    ParameterError,
    models::{Brdf, COMMON},
    spec::{Class, Laws, Parameter, Spec},
    stack::Stack,
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Roughness_Stack_BRDF_Model",
        parent: "Roughness_BRDF_Model",
        summary: "One rough interface in a stack of films",
        equation: "F = PSD M(J_m)",
        source: "elson-1995",
        params: &[COMMON, ROUGHNESS, STACK, OWN],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| {
        let rough = RoughSurface::read(node)?;
        let films = node.member::<Stack>("stack")?.at(rough.common.lambda);
        let layer = node.integer("this_layer");
        let interface =
            usize::try_from(layer).ok().filter(|&m| m <= films.len()).ok_or_else(|| {
                let problem = format!("{layer} is not an interface from 0 to {}", films.len());
                ParameterError::new("this_layer", problem)
            })?;
        Ok(Box::new(CorrelatedInterfaces::new(rough, &films, interface..interface + 1)))
    },
};

const OWN: &[Parameter] =
    &[Parameter::integer("this_layer", 0, "The rough interface; 0 is the face of the substrate")];

#[cfg(test)]
mod tests {
    use crate::{Basis, Geometry, Mode, ParameterNode, models, spec::ParameterValue};

    fn node(name: &str) -> ParameterNode {
        ParameterNode::with_defaults(crate::registry::find_class(name).unwrap(), Mode::Sound)
    }

    #[test]
    fn without_films_it_is_the_bare_surface() {
        let at = Geometry { theta_i: 0.9, theta_s: 0.5, phi_s: 2.1, rotation: 0.3 };
        for side in [0, 1, 2, 3] {
            let build = |name: &str| {
                let node = node(name).with("type", ParameterValue::Integer(side)).unwrap();
                let glass = crate::optics::RefractiveIndex::constant(1.5, 0.0);
                models::build(&node.with("substrate", ParameterValue::Index(glass)).unwrap())
                    .unwrap()
            };
            let bare = build("Microroughness_BRDF_Model").mueller(&at, Basis::Psps);
            let stack = build("Roughness_Stack_BRDF_Model").mueller(&at, Basis::Psps);
            assert!((bare - stack).largest() < 1e-13 * bare.largest(), "type {side}");
        }
    }

    #[test]
    fn an_interface_that_does_not_exist_is_refused() {
        for layer in [-1, 1] {
            let node = node("Roughness_Stack_BRDF_Model");
            let error =
                models::build(&node.with("this_layer", ParameterValue::Integer(layer)).unwrap());
            assert_eq!(error.err().unwrap().parameter, "this_layer");
        }
    }
}
