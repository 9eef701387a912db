//! Pyramidal pits in the lower medium.
//!
//! In level n of N (`nlevels`) counted from the bottom the upper medium fills
//! |x|, |y| < a(n − ½)/(2N), a being the side of the opening.
//!
//! L. Li, J. Opt. Soc. Am. A 14, 2758 (1997).

use super::{
    CrossGrating, CrossGratingMedia, CrossPattern, CrossProfile, CrossSlice, MEDIA,
    grid::{CELL, UnitCell},
};
use crate::{
    grating::{GratingMaterial, levels, not_negative},
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::number("side", 0.05, "um", "Side of the opening"),
    Parameter::number("depth", 0.05, "um", "Depth"),
    Parameter::integer("nlevels", 10, "Number of slices"),
];

/// Name, parameters and constructor of a [`PyramidalPit`].
pub const SPEC: Spec<dyn CrossGrating> = Spec {
    class: Class {
        name: "Pyramidal_Pit_CrossGrating",
        parent: "Gridded_CrossGrating",
        summary: "Pyramidal pits",
        equation: "|x|, |y| < side (n-1/2)/(2 nlevels)",
        source: "li-1997",
        params: &[MEDIA, CELL, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(PyramidalPit::read(node)?)),
};

/// Pyramidal pits.
#[derive(Clone, Debug)]
pub struct PyramidalPit {
    media: CrossGratingMedia,
    cell: UnitCell,
    side: f64,
    depth: f64,
    levels: usize,
}

impl PyramidalPit {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        Ok(Self {
            media: CrossGratingMedia::read(node),
            cell: UnitCell::read(node)?,
            side: not_negative(node, "side")?,
            depth: not_negative(node, "depth")?,
            levels: levels(node, "nlevels", 1)?,
        })
    }
}

impl CrossGrating for PyramidalPit {
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParameterError> {
        let media = [&self.media.below, &self.media.above];
        let materials = media.map(|n| GratingMaterial::from_index(n.at(lambda)));
        let count = self.levels as f64;
        let slices = (0..self.levels).rev().map(|level| {
            let half = 0.5 * self.side * (level as f64 + 0.5) / count;
            let grid = self
                .cell
                .paint(materials.to_vec(), |x, y| u8::from(x.abs() < half && y.abs() < half));
            CrossSlice::new(self.depth / count, CrossPattern::Grid(grid))
        });
        Ok(self.media.profile(lambda, self.cell.lattice, slices.collect()))
    }
}
