//! Two line gratings, one over the other, their lines at an angle.
//!
//! The upper one varies along axis 1 (its lines run along axis 2), the lower one along axis 2;
//! ζ = 90° − `angle`, and both periods are measured across the lines: d = period / sin `angle`.
//!
//! L. Li, J. Opt. Soc. Am. A 14, 2758 (1997).

use super::{
    CrossGrating, CrossGratingMedia, CrossPattern, CrossProfile, CrossSlice, Lattice, MEDIA, same,
};
use crate::{
    grating::{self, Grating, GratingMaterial, LinePattern, not_negative},
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const fn part(name: &'static str, doc: &'static str) -> Parameter {
    Parameter::member(name, &grating::FAMILY, "Single_Line_Grating", doc)
}

const OWN: &[Parameter] = &[
    part("top", "The upper grating"),
    part("bottom", "The lower grating"),
    Parameter::number("angle", 90.0, "deg", "Angle between the lines"),
    Parameter::number("separation", 0.0, "um", "Distance between the two"),
];

/// Name, parameters and constructor of an [`Overlaid1D`].
pub const SPEC: Spec<dyn CrossGrating> = Spec {
    class: Class {
        name: "Overlaid_1D_CrossGrating",
        parent: "CrossGrating",
        summary: "Two line gratings at an angle",
        equation: "top along axis 1 over separation over bottom along axis 2",
        source: "li-1997",
        params: &[MEDIA, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(Overlaid1D::read(node)?)),
};

/// Two line gratings at an angle.
pub struct Overlaid1D {
    media: CrossGratingMedia,
    top: Box<dyn Grating>,
    bottom: Box<dyn Grating>,
    zeta: f64,
    separation: f64,
}

impl Overlaid1D {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let angle = node.number("angle");
        if !(angle > 0.0 && angle < 180.0) {
            return Err(ParameterError::new("angle", format!("{angle} is not between 0 and 180")));
        }
        Ok(Self {
            media: CrossGratingMedia::read(node),
            top: node.member::<dyn Grating>("top")?,
            bottom: node.member::<dyn Grating>("bottom")?,
            zeta: (90.0 - angle).to_radians(),
            separation: not_negative(node, "separation")?,
        })
    }
}

impl CrossGrating for Overlaid1D {
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParameterError> {
        let top = self.top.at(lambda).map_err(|error| error.inside("top"))?;
        let bottom = self.bottom.at(lambda).map_err(|error| error.inside("bottom"))?;
        self.media.starts_with(lambda, "top.medium_i", top.above)?;
        same("bottom.medium_i", bottom.above, top.below)?;
        self.media.ends_with(lambda, "bottom.medium_t", bottom.below)?;
        let between = LinePattern::uniform(GratingMaterial::from_index(top.below), bottom.period);
        let between = CrossSlice::gap(self.separation, CrossPattern::Along2(between));
        let lower = bottom
            .slices
            .into_iter()
            .map(|slice| CrossSlice::new(slice.thickness, CrossPattern::Along2(slice.pattern)));
        let slices = top
            .slices
            .into_iter()
            .map(|slice| CrossSlice::new(slice.thickness, CrossPattern::Along1(slice.pattern)))
            .chain((self.separation > 0.0).then_some(between))
            .chain(lower)
            .collect();
        let cos = self.zeta.cos();
        let lattice = Lattice { d1: top.period / cos, d2: bottom.period / cos, zeta: self.zeta };
        Ok(self.media.profile(lambda, lattice, slices))
    }
}
