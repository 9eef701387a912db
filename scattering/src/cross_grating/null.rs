//! No grating: the bare interface, with the periods of one.
//!
//! M. Born, E. Wolf, *Principles of Optics*, 7th ed., 1.5: the only order has Fresnel's
//! coefficients.

use super::{CrossGrating, CrossProfile, Lattice, MEDIA, Media, lean};
use crate::{
    grating::positive,
    spec::{Class, Laws, Node, Param, ParamError, Spec},
};

const OWN: &[Param] = &[
    Param::number("d1", "0.5", "um", "Period along axis 1"),
    Param::number("d2", "0.5", "um", "Period along axis 2"),
    Param::number("zeta", "0", "deg", "Angle from y to axis 2"),
];

/// How programs name, parameterize and build a [`Null`].
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
    build: |node| Ok(Box::new(Null::read(node)?)),
};

/// A bare interface.
#[derive(Clone, Debug)]
pub struct Null {
    media: Media,
    lattice: Lattice,
}

impl Null {
    fn read(node: &Node) -> Result<Self, ParamError> {
        let (d1, d2) = (positive(node, "d1")?, positive(node, "d2")?);
        let lattice = Lattice { d1, d2, zeta: lean(node, "zeta")? };
        Ok(Self { media: Media::read(node), lattice })
    }
}

impl CrossGrating for Null {
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParamError> {
        Ok(self.media.profile(lambda, self.lattice, Vec::new()))
    }
}
