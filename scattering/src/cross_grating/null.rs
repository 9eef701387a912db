//! No grating: the bare interface, with the periods of one.
//!
//! M. Born, E. Wolf, *Principles of Optics*, 7th ed., 1.5: the only order has Fresnel's
//! coefficients.

use super::{CrossGrating, CrossGratingMedia, CrossProfile, Lattice, MEDIA, lean};
use crate::{
    grating::positive,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::number("d1", 0.5, "um", "Period along axis 1"),
    Parameter::number("d2", 0.5, "um", "Period along axis 2"),
    Parameter::number("zeta", 0.0, "deg", "Angle from y to axis 2"),
];

/// Name, parameters and constructor of a [`NullGrating`].
pub const SPEC: Spec<dyn CrossGrating> = Spec {
    class: Class {
        name: "Null_CrossGrating",
        parent: "CrossGrating",
        summary: "Bare interface",
        equation: "no slices",
        source: "born-1999",
        params: &[MEDIA, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(NullGrating::read(node)?)),
};

/// A bare interface.
#[derive(Clone, Debug)]
pub struct NullGrating {
    media: CrossGratingMedia,
    lattice: Lattice,
}

impl NullGrating {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let (d1, d2) = (positive(node, "d1")?, positive(node, "d2")?);
        let lattice = Lattice { d1, d2, zeta: lean(node, "zeta")? };
        Ok(Self { media: CrossGratingMedia::read(node), lattice })
    }
}

impl CrossGrating for NullGrating {
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParameterError> {
        Ok(self.media.profile(lambda, self.lattice, Vec::new()))
    }
}
