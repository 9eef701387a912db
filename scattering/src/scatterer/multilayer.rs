//! Sphere with any number of coats.
//!
//! The coefficients of [`layered`](super::layered). The films of `stack` lie within the radius, the first one on
//! the core.
//!
//! W. Yang, Appl. Opt. 42, 1710 (2003).

use super::{FREE_SPACE, HostMedium, SPHERE, Scatterer, layered::SphereShell, mie::Mie, series};
use crate::{
    spec::{Class, Laws, Parameter, ParameterError, Spec},
    stack::{self, Stack},
};

/// Name, parameters and constructor of a sphere with coats.
pub const SPEC: Spec<dyn Scatterer> = Spec {
    class: Class {
        name: "MultilayerCoatedMieScatterer",
        parent: "SphericalScatterer",
        summary: "Sphere with any number of coats",
        equation: "Mie series with the coefficients of many layers",
        source: "yang-2003",
        params: &[
            FREE_SPACE,
            SPHERE,
            &[Parameter::member(
                "stack",
                &stack::FAMILY,
                "No_StackModel",
                "Coats, the innermost first",
            )],
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let around = HostMedium::read(node)?;
        let sphere = around.relative_index(node, "sphere")?;
        let stack = node.member::<Stack>("stack")?.at(around.lambda);
        let coats: Vec<SphereShell> = stack
            .into_iter()
            .map(|(index, thickness)| Ok((around.relative(index, "stack")?, thickness)))
            .collect::<Result<_, _>>()?;
        let indices: Vec<_> = coats.iter().map(|coat| coat.0).chain([sphere]).collect();
        let radius = around.radius(node, &indices)?;
        let total: f64 = coats.iter().map(|coat| coat.1).sum();
        if !(0.0..=radius).contains(&total) {
            let problem = format!("coats of {total} um do not fit in the radius {radius} um");
            return Err(ParameterError::new("stack", problem));
        }
        let k = around.wave_number();
        let mut r = radius - total;
        let mut layers: Vec<SphereShell> = vec![(sphere, k * r)];
        for (index, thickness) in coats {
            r += thickness;
            layers.push((index, k * r));
        }
        Ok(Box::new(Mie::layered(around, &layers, series::terms_for(node, k * radius))))
    },
};

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{Mode, ParameterNode, ParameterValue, optics::RefractiveIndex, spec};

    fn coated(thickness: f64) -> Result<Box<dyn Scatterer>, ParameterError> {
        let film = ParameterNode::with_defaults(
            crate::registry::find_class("SingleFilm_StackModel").unwrap(),
            Mode::Sound,
        )
        .with("material", ParameterValue::Index(RefractiveIndex::constant(1.4, 0.3)))?
        .with("thickness", ParameterValue::Number(thickness))?;
        let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound)
            .with("radius", ParameterValue::Number(0.3))?
            .with("stack", ParameterValue::Member(Arc::new(film)))?;
        spec::build::<dyn Scatterer>(&node)
    }

    #[test]
    fn one_coat_is_the_coated_sphere() {
        let node = ParameterNode::with_defaults(&super::super::coated::SPEC.class, Mode::Sound)
            .with("radius", ParameterValue::Number(0.3))
            .and_then(|n| {
                n.with("coating", ParameterValue::Index(RefractiveIndex::constant(1.4, 0.3)))
            })
            .and_then(|n| n.with("thickness", ParameterValue::Number(0.1)))
            .unwrap();
        let expected = spec::build::<dyn Scatterer>(&node).unwrap();
        let (a, b) = (coated(0.1).unwrap(), expected);
        let (a, b) = (a.round().unwrap().amplitudes(0.3), b.round().unwrap().amplitudes(0.3));
        assert!((a.ss - b.ss).norm() < 1e-14 * b.ss.norm());
    }

    #[test]
    fn coats_thicker_than_the_radius_are_refused() {
        assert_eq!(coated(0.31).err().unwrap().parameter, "stack");
    }
}
