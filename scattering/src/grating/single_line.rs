//! Trapezoidal line, possibly leaning.
//!
//! $$ -\tfrac t2 - (b-t)\tfrac h2 - oh \;\le\; x \;\le\; \tfrac t2 + (b-t)\tfrac h2 - oh $$
//!
//! t (`topwidth`) and b (`bottomwidth`) are the widths, o (`offset`) the shift of the bottom
//! against the top, h the depth from 0 at the top to 1; every level takes the width at its middle.
//!
//! M. G. Moharam, E. B. Grann, D. A. Pommet, T. K. Gaylord, J. Opt. Soc. Am. A 12, 1068 (1995).

use super::{
    COMMON, Grating, GratingCommon, GratingMaterial, LinePattern, LineProfile, LineSlice, finite,
    levels, not_negative,
};
use crate::{
    optics::RefractiveIndex,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::index("material", (4.05, 0.05), "Index of the line"),
    Parameter::index("space", (1.0, 0.0), "Index between the lines"),
    Parameter::number("height", 0.2, "um", "Height of the line"),
    Parameter::number("topwidth", 0.2, "um", "Width at the top"),
    Parameter::number("bottomwidth", 0.2, "um", "Width at the bottom"),
    Parameter::number("offset", 0.0, "um", "Shift of the bottom against the top"),
    Parameter::integer("nlevels", 10, "Number of slices"),
];

/// Name, parameters and constructor of a [`SingleLine`].
pub const SPEC: Spec<dyn Grating> = Spec {
    class: Class {
        name: "Single_Line_Grating",
        parent: "Grating",
        summary: "Trapezoidal line",
        equation: "-t/2 - (b-t) h/2 - offset h < x < t/2 + (b-t) h/2 - offset h",
        source: "moharam-1995",
        params: &[COMMON, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(SingleLine::read(node)?)),
};

/// A trapezoidal line.
#[derive(Clone, Debug)]
pub struct SingleLine {
    common: GratingCommon,
    material: RefractiveIndex,
    space: RefractiveIndex,
    height: f64,
    top: f64,
    bottom: f64,
    offset: f64,
    levels: usize,
}

impl SingleLine {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = GratingCommon::read(node)?;
        let width = |name: &str| -> Result<f64, ParameterError> {
            let width = not_negative(node, name)?;
            if width <= common.period {
                return Ok(width);
            }
            Err(ParameterError::new(
                name,
                format!("{width} is wider than the period {}", common.period),
            ))
        };
        Ok(Self {
            material: node.index("material").clone(),
            space: node.index("space").clone(),
            height: not_negative(node, "height")?,
            top: width("topwidth")?,
            bottom: width("bottomwidth")?,
            offset: finite(node, "offset")?,
            levels: levels(node, "nlevels", 1)?,
            common,
        })
    }
}

impl Grating for SingleLine {
    fn at(&self, lambda: f64) -> Result<LineProfile, ParameterError> {
        let line = GratingMaterial::from_index(self.material.at(lambda));
        let space = GratingMaterial::from_index(self.space.at(lambda));
        let thickness = self.height / self.levels as f64;
        let slices = (0..self.levels).map(|level| {
            let h = (level as f64 + 0.5) / self.levels as f64;
            let half = 0.5 * self.top + 0.5 * (self.bottom - self.top) * h;
            let (start, end) = (-half - self.offset * h, half - self.offset * h);
            LineSlice {
                thickness,
                pattern: LinePattern::line(start, end, self.common.period, line, space),
            }
        });
        Ok(self.common.profile(lambda, slices))
    }
}
