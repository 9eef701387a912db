//! Unstructured films, possibly anisotropic and magnetic.
//!
//! Film k has ε_x = n_x², ε_y = n_y², ε_z = n_z² and μ likewise, each index from its own stack.
//! A stack without films for y or z repeats the one for x; without any for μ, μ = 1.
//!
//! L. Li, J. Opt. Soc. Am. A 13, 1024 (1996), for stacks of layers without instabilities.

use num_complex::Complex64;

use super::{COMMON, Grating, GratingCommon, GratingMaterial, LinePattern, LineProfile, LineSlice};
use crate::{
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
    stack::{self, Stack},
};

const fn stack(name: &'static str, doc: &'static str) -> Parameter {
    Parameter::member(name, &stack::FAMILY, "No_StackModel", doc)
}

const NAMES: [&str; 6] =
    ["stackepsx", "stackepsy", "stackepsz", "stackmux", "stackmuy", "stackmuz"];

const OWN: &[Parameter] = &[
    stack("stackepsx", "Films with the index along x"),
    stack("stackepsy", "The same films with the index along y; empty: as along x"),
    stack("stackepsz", "The same films with the index along z; empty: as along x"),
    stack("stackmux", "The same films with the root of the permeability along x; empty: 1"),
    stack("stackmuy", "The same along y; empty: as along x"),
    stack("stackmuz", "The same along z; empty: as along x"),
];

/// Name, parameters and constructor of a [`DielectricStack`].
pub const SPEC: Spec<dyn Grating> = Spec {
    class: Class {
        name: "Dielectric_Stack_Grating",
        parent: "Grating",
        summary: "Unstructured films, possibly anisotropic",
        equation: "eps = diag(nx^2, ny^2, nz^2) in every film",
        source: "li-1996b",
        params: &[COMMON, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(DielectricStack::read(node)?)),
};

/// Films without structure.
#[derive(Clone, Debug)]
pub struct DielectricStack {
    common: GratingCommon,
    /// In the order of [`NAMES`].
    stacks: [Stack; 6],
}

impl DielectricStack {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let mut stacks: [Stack; 6] = Default::default();
        for (stack, name) in stacks.iter_mut().zip(NAMES) {
            *stack = *node.member::<Stack>(name)?;
        }
        let thicknesses =
            |s: &Stack| -> Vec<f64> { s.films.iter().map(|film| film.thickness).collect() };
        let first = thicknesses(&stacks[0]);
        for (stack, name) in stacks.iter().zip(NAMES) {
            if !stack.films.is_empty() && thicknesses(stack) != first {
                let problem = "number or thickness of the films differ from stackepsx";
                return Err(ParameterError::new(name, problem));
            }
        }
        Ok(Self { common: GratingCommon::read(node)?, stacks })
    }

    /// Squares of the indices of film `k` along x, y, z from three stacks.
    fn squares(stacks: &[Stack], k: usize, lambda: f64) -> [Complex64; 3] {
        let of = |stack: &Stack| stack.films.get(k).map(|film| film.index.at(lambda).powi(2));
        let x = of(&stacks[0]).unwrap_or(Complex64::ONE);
        [x, of(&stacks[1]).unwrap_or(x), of(&stacks[2]).unwrap_or(x)]
    }
}

impl Grating for DielectricStack {
    fn at(&self, lambda: f64) -> Result<LineProfile, ParameterError> {
        let films = self.stacks[0].films.iter().enumerate().rev();
        let slices = films.map(|(k, film)| {
            let material = GratingMaterial {
                epsilon: Self::squares(&self.stacks[..3], k, lambda),
                mu: Self::squares(&self.stacks[3..], k, lambda),
            };
            let pattern = LinePattern::uniform(material, self.common.period);
            LineSlice { thickness: film.thickness, pattern }
        });
        Ok(self.common.profile(lambda, slices))
    }
}
