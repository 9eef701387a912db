//! Pyramidal pits in the lower medium.
//!
//! In level n of N (`nlevels`) counted from the bottom the upper medium fills
//! |x|, |y| < a(n − ½)/(2N), a being the side of the opening.
//!
//! L. Li, J. Opt. Soc. Am. A 14, 2758 (1997).

use super::{
    CrossGrating, CrossPattern, CrossProfile, CrossSlice, MEDIA, Media,
    grid::{CELL, Cell},
};
use crate::{
    grating::{Material, levels, not_negative},
    spec::{Class, Laws, Node, Param, ParamError, Spec},
};

const OWN: &[Param] = &[
    Param::number("side", "0.05", "um", "Side of the opening"),
    Param::number("depth", "0.05", "um", "Depth"),
    Param::integer("nlevels", "10", "Number of slices"),
];

/// How programs name, parameterize and build a [`PyramidalPit`].
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
    media: Media,
    cell: Cell,
    side: f64,
    depth: f64,
    levels: usize,
}

impl PyramidalPit {
    fn read(node: &Node) -> Result<Self, ParamError> {
        Ok(Self {
            media: Media::read(node),
            cell: Cell::read(node)?,
            side: not_negative(node, "side")?,
            depth: not_negative(node, "depth")?,
            levels: levels(node, "nlevels", 1)?,
        })
    }
}

impl CrossGrating for PyramidalPit {
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParamError> {
        let media = [&self.media.below, &self.media.above];
        let materials = media.map(|n| Material::from_index(n.at(lambda)));
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
