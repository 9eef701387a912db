//! One crossed grating over another of the same periods, moved sideways along both axes.
//!
//! L. Li, J. Opt. Soc. Am. A 14, 2758 (1997).

use super::{CrossGrating, CrossGratingMedia, CrossPattern, CrossProfile, CrossSlice, MEDIA, same};
use crate::{
    cross_grating::FAMILY,
    grating::{GratingMaterial, LinePattern, finite, not_negative},
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const fn part(name: &'static str, doc: &'static str) -> Parameter {
    Parameter::member(name, &FAMILY, "OneD_CrossGrating", doc)
}

const OWN: &[Parameter] = &[
    part("top", "The upper grating"),
    part("bottom", "The lower grating"),
    Parameter::number("overlay1", 0.0, "um", "Shift of the upper grating along axis 1"),
    Parameter::number("overlay2", 0.0, "um", "Shift of the upper grating along axis 2"),
    Parameter::number("separation", 0.0, "um", "Distance between the two"),
];

/// Name, parameters and constructor of an [`OverlaidCrossGrating`].
pub const SPEC: Spec<dyn CrossGrating> = Spec {
    class: Class {
        name: "Overlaid_CrossGrating",
        parent: "CrossGrating",
        summary: "One crossed grating over another",
        equation: "top(x1 - overlay1, x2 - overlay2) over separation over bottom(x1, x2)",
        source: "li-1997",
        params: &[MEDIA, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(OverlaidCrossGrating::read(node)?)),
};

/// Two crossed gratings, one over the other.
pub struct OverlaidCrossGrating {
    media: CrossGratingMedia,
    top: Box<dyn CrossGrating>,
    bottom: Box<dyn CrossGrating>,
    overlay: (f64, f64),
    separation: f64,
}

impl OverlaidCrossGrating {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        Ok(Self {
            media: CrossGratingMedia::read(node),
            top: node.member::<dyn CrossGrating>("top")?,
            bottom: node.member::<dyn CrossGrating>("bottom")?,
            overlay: (finite(node, "overlay1")?, finite(node, "overlay2")?),
            separation: not_negative(node, "separation")?,
        })
    }
}

impl CrossGrating for OverlaidCrossGrating {
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParameterError> {
        let top = self.top.at(lambda).map_err(|error| error.inside("top"))?;
        let bottom = self.bottom.at(lambda).map_err(|error| error.inside("bottom"))?;
        let lattice = top.lattice;
        if lattice != bottom.lattice {
            let problem = "its periods or their angle differ from those of top";
            return Err(ParameterError::new("bottom", problem));
        }
        self.media.starts_with(lambda, "top.medium_i", top.above)?;
        same("bottom.medium_i", bottom.above, top.below)?;
        self.media.ends_with(lambda, "bottom.medium_t", bottom.below)?;
        let by = (self.overlay.0 / lattice.d1, self.overlay.1 / lattice.d2);
        let between = LinePattern::uniform(GratingMaterial::from_index(top.below), lattice.d1);
        let between = CrossSlice::gap(self.separation, CrossPattern::Along1(between));
        let slices = top
            .slices
            .into_iter()
            .map(|s| CrossSlice { shift: (s.shift.0 + by.0, s.shift.1 + by.1), ..s })
            .chain((self.separation > 0.0).then_some(between))
            .chain(bottom.slices)
            .collect();
        Ok(self.media.profile(lambda, lattice, slices))
    }
}
