//! Films listed one by one.

use super::{Stack, check_thickness};
use crate::spec::{Class, Laws, Parameter, ParameterKind, Spec};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<Stack> = Spec {
    class: Class {
        name: "Stack_StackModel",
        parent: "StackModel",
        summary: "Films listed one by one",
        equation: "(n_1, t_1), (n_2, t_2), ... from the substrate outwards",
        source: "born-1999",
        params: &[&[Parameter {
            name: "stack",
            kind: ParameterKind::Films,
            unit: "um",
            doc: "Films as pairs of material and thickness, in order of growth",
        }]],
        laws: Laws::NONE,
    },
    build: |node| {
        let films = node.films("stack").to_vec();
        for film in &films {
            check_thickness("stack", film.thickness)?;
        }
        Ok(Box::new(Stack { films }))
    },
};

#[cfg(test)]
mod tests {
    use crate::{
        Mode, ParameterNode, ParameterValue,
        optics::RefractiveIndex,
        spec,
        stack::{Film, Stack},
    };

    #[test]
    fn films_keep_their_order() {
        let film = |n, thickness| Film { index: RefractiveIndex::constant(n, 0.0), thickness };
        let films = vec![film(2.3, 0.1), film(1.4, 0.2)];
        let node = ParameterNode::with_defaults(&super::SPEC.class, Mode::Sound)
            .with("stack", ParameterValue::Films(films))
            .unwrap();
        let stack = spec::build::<Stack>(&node).unwrap().at(0.5);
        assert_eq!(
            stack.iter().map(|(n, t)| (n.re, *t)).collect::<Vec<_>>(),
            [(2.3, 0.1), (1.4, 0.2)]
        );
    }
}
