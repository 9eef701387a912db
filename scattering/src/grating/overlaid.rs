//! One grating over another of the same period, moved sideways.
//!
//! From the top: the slices of `top` moved by +`overlay`, a uniform layer of `separation` of the
//! medium between them, the slices of `bottom`.
//!
//! M. G. Moharam, D. A. Pommet, E. B. Grann, T. K. Gaylord, J. Opt. Soc. Am. A 12, 1077 (1995).

use super::{
    COMMON, Grating, GratingCommon, GratingMaterial, LinePattern, LineProfile, LineSlice, finite,
    not_negative,
};
use crate::{
    grating::FAMILY,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const fn part(name: &'static str, doc: &'static str) -> Parameter {
    Parameter::member(name, &FAMILY, "Single_Line_Grating", doc)
}

const OWN: &[Parameter] = &[
    part("top", "The upper grating"),
    part("bottom", "The lower grating"),
    Parameter::number("overlay", 0.0, "um", "Shift of the upper grating along x"),
    Parameter::number("separation", 0.0, "um", "Distance between the two"),
];

/// Name, parameters and constructor of an [`OverlaidGrating`].
pub const SPEC: Spec<dyn Grating> = Spec {
    class: Class {
        name: "Overlaid_Grating",
        parent: "Grating",
        summary: "One grating over another",
        equation: "top(x - overlay) over separation over bottom(x)",
        source: "moharam-1995b",
        params: &[COMMON, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(OverlaidGrating::read(node)?)),
};

/// Two gratings, one over the other.
pub struct OverlaidGrating {
    common: GratingCommon,
    top: Box<dyn Grating>,
    bottom: Box<dyn Grating>,
    overlay: f64,
    separation: f64,
}

impl OverlaidGrating {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = GratingCommon::read(node)?;
        Ok(Self {
            top: node.member::<dyn Grating>("top")?,
            bottom: node.member::<dyn Grating>("bottom")?,
            overlay: finite(node, "overlay")?,
            separation: not_negative(node, "separation")?,
            common,
        })
    }
}

/// An error at `name` unless what stands there is the same.
fn same<T: PartialEq + std::fmt::Display>(
    name: &str,
    this: T,
    other: T,
) -> Result<(), ParameterError> {
    if this == other {
        return Ok(());
    }
    Err(ParameterError::new(name, format!("{this} differs from its neighbour, {other}")))
}

impl Grating for OverlaidGrating {
    fn at(&self, lambda: f64) -> Result<LineProfile, ParameterError> {
        let period = self.common.period;
        let top = self.top.at(lambda).map_err(|error| error.inside("top"))?;
        let bottom = self.bottom.at(lambda).map_err(|error| error.inside("bottom"))?;
        same("top.period", top.period, period)?;
        same("bottom.period", bottom.period, period)?;
        same("top.medium_i", top.above, self.common.above.at(lambda))?;
        same("bottom.medium_i", bottom.above, top.below)?;
        same("bottom.medium_t", bottom.below, self.common.below.at(lambda))?;
        let between = LineSlice {
            thickness: self.separation,
            pattern: LinePattern::uniform(GratingMaterial::from_index(top.below), period),
        };
        let upper = top.slices.iter().map(|slice| LineSlice {
            thickness: slice.thickness,
            pattern: slice.pattern.shifted(self.overlay),
        });
        let parts = upper.chain((self.separation > 0.0).then_some(between)).chain(bottom.slices);
        Ok(self.common.profile(lambda, parts))
    }
}
