//! A line grating as a crossed one: its lines run along axis 2.
//!
//! The period of the line grating is measured across the lines, so d₁ = period / cos ζ.
//!
//! L. Li, J. Opt. Soc. Am. A 14, 2758 (1997).

use super::{
    CrossGrating, CrossGratingMedia, CrossPattern, CrossProfile, CrossSlice, Lattice, MEDIA, lean,
};
use crate::{
    grating::{self, Grating, positive},
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::number("d2", 0.5, "um", "Period along axis 2"),
    Parameter::number("zeta", 0.0, "deg", "Angle from y to axis 2"),
    Parameter::member("grating", &grating::FAMILY, "Single_Line_Grating", "The line grating"),
];

/// Name, parameters and constructor of a [`LineCrossGrating`].
pub const SPEC: Spec<dyn CrossGrating> = Spec {
    class: Class {
        name: "OneD_CrossGrating",
        parent: "CrossGrating",
        summary: "Line grating as a crossed grating",
        equation: "lines along axis 2",
        source: "li-1997",
        params: &[MEDIA, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(LineCrossGrating::read(node)?)),
};

/// A line grating.
pub struct LineCrossGrating {
    media: CrossGratingMedia,
    d2: f64,
    zeta: f64,
    grating: Box<dyn Grating>,
}

impl LineCrossGrating {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        Ok(Self {
            media: CrossGratingMedia::read(node),
            d2: positive(node, "d2")?,
            zeta: lean(node, "zeta")?,
            grating: node.member::<dyn Grating>("grating")?,
        })
    }
}

impl CrossGrating for LineCrossGrating {
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParameterError> {
        let lines = self.grating.at(lambda).map_err(|error| error.inside("grating"))?;
        self.media.starts_with(lambda, "grating.medium_i", lines.above)?;
        self.media.ends_with(lambda, "grating.medium_t", lines.below)?;
        let d1 = lines.period / self.zeta.cos();
        let slices = lines
            .slices
            .into_iter()
            .map(|slice| CrossSlice::new(slice.thickness, CrossPattern::Along1(slice.pattern)))
            .collect();
        let lattice = Lattice { d1, d2: self.d2, zeta: self.zeta };
        Ok(self.media.profile(lambda, lattice, slices))
    }
}
