//! Triangular (blazed) profile.
//!
//! $$ -\tfrac d2 + d\,a\,(1-h) \;\le\; x \;\le\; \tfrac d2 - d(1-a)(1-h) $$
//!
//! a (`aspect`) is the position of the ridge in the period, h the depth from 0 at the ridge to 1.
//!
//! M. G. Moharam, D. A. Pommet, E. B. Grann, T. K. Gaylord, J. Opt. Soc. Am. A 12, 1077 (1995).

use super::{
    COMMON, Grating, GratingCommon, GratingMaterial, LinePattern, LineProfile, LineSlice, levels,
    not_negative,
};
use crate::{
    optics::RefractiveIndex,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::index("material", (4.05, 0.05), "Index of the ridge"),
    Parameter::number("amplitude", 0.4, "um", "Height of the ridge"),
    Parameter::number("aspect", 0.5, "1", "Position of the ridge in the period, 0 to 1"),
    Parameter::integer("nlevels", 20, "Number of slices"),
];

/// Name, parameters and constructor of a [`TriangularGrating`].
pub const SPEC: Spec<dyn Grating> = Spec {
    class: Class {
        name: "Triangular_Grating",
        parent: "Grating",
        summary: "Triangular (blazed) profile",
        equation: "-d/2 + d aspect (1-h) < x < d/2 - d (1-aspect)(1-h)",
        source: "moharam-1995b",
        params: &[COMMON, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(TriangularGrating::read(node)?)),
};

/// A triangular profile.
#[derive(Clone, Debug)]
pub struct TriangularGrating {
    common: GratingCommon,
    material: RefractiveIndex,
    amplitude: f64,
    aspect: f64,
    levels: usize,
}

impl TriangularGrating {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let aspect = node.number("aspect");
        if !(0.0..=1.0).contains(&aspect) {
            return Err(ParameterError::new("aspect", format!("{aspect} is not from 0 to 1")));
        }
        Ok(Self {
            common: GratingCommon::read(node)?,
            material: node.index("material").clone(),
            amplitude: not_negative(node, "amplitude")?,
            aspect,
            levels: levels(node, "nlevels", 1)?,
        })
    }
}

impl Grating for TriangularGrating {
    fn at(&self, lambda: f64) -> Result<LineProfile, ParameterError> {
        let period = self.common.period;
        let inside = GratingMaterial::from_index(self.material.at(lambda));
        let outside = GratingMaterial::from_index(self.common.above.at(lambda));
        let thickness = self.amplitude / self.levels as f64;
        let slices = (0..self.levels).map(|level| {
            let rest = 1.0 - (level as f64 + 0.5) / self.levels as f64;
            let start = -0.5 * period + period * self.aspect * rest;
            let end = 0.5 * period - period * (1.0 - self.aspect) * rest;
            LineSlice { thickness, pattern: LinePattern::line(start, end, period, inside, outside) }
        });
        Ok(self.common.profile(lambda, slices))
    }
}
