//! Holes or posts, round or of any outline given by a radius.
//!
//! $$ r \le r_b(\varphi) + \tfrac{n - 1/2}{N}\,(r_t(\varphi) - r_b(\varphi)) $$
//!
//! in level n of N (`nlevels`) counted from the bottom; the radii are functions of the azimuth φ
//! in degrees.
//!
//! L. Li, J. Opt. Soc. Am. A 14, 2758 (1997).

use super::{
    CrossGrating, CrossGratingMedia, CrossPattern, CrossProfile, CrossSlice, MEDIA,
    grid::{CELL, UnitCell},
};
use crate::{
    grating::{GratingMaterial, levels, not_negative},
    optics::{RealFunction, RefractiveIndex},
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::table("rtop", 0.1, "um", "Radius at the top against azimuth in degrees"),
    Parameter::table("rbottom", 0.1, "um", "Radius at the bottom against azimuth in degrees"),
    Parameter::number("thickness", 0.1, "um", "Height"),
    Parameter::integer("nlevels", 1, "Number of slices"),
    Parameter::index("inside", (1.0, 0.0), "Index inside"),
    Parameter::index("outside", (1.5, 0.0), "Index outside"),
];

/// Name, parameters and constructor of a [`CylinderGrating`].
pub const SPEC: Spec<dyn CrossGrating> = Spec {
    class: Class {
        name: "Cylinder_CrossGrating",
        parent: "Gridded_CrossGrating",
        summary: "Holes or posts",
        equation: "r <= rbottom(phi) + (n-1/2)/nlevels (rtop(phi) - rbottom(phi))",
        source: "li-1997",
        params: &[MEDIA, CELL, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(CylinderGrating::read(node)?)),
};

/// Holes or posts.
#[derive(Clone, Debug)]
pub struct CylinderGrating {
    media: CrossGratingMedia,
    cell: UnitCell,
    top: RealFunction,
    bottom: RealFunction,
    thickness: f64,
    levels: usize,
    inside: RefractiveIndex,
    outside: RefractiveIndex,
}

impl CylinderGrating {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        Ok(Self {
            media: CrossGratingMedia::read(node),
            cell: UnitCell::read(node)?,
            top: node.table("rtop").clone(),
            bottom: node.table("rbottom").clone(),
            thickness: not_negative(node, "thickness")?,
            levels: levels(node, "nlevels", 1)?,
            inside: node.index("inside").clone(),
            outside: node.index("outside").clone(),
        })
    }
}

impl CrossGrating for CylinderGrating {
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParameterError> {
        let materials =
            [&self.outside, &self.inside].map(|n| GratingMaterial::from_index(n.at(lambda)));
        let count = self.levels as f64;
        let slices = (0..self.levels).rev().map(|level| {
            let up = (level as f64 + 0.5) / count;
            let grid = self.cell.paint(materials.to_vec(), |x, y| {
                let phi = y.atan2(x).to_degrees();
                let foot = self.bottom.at(phi);
                u8::from(x.hypot(y) <= foot + up * (self.top.at(phi) - foot))
            });
            CrossSlice::new(self.thickness / count, CrossPattern::Grid(grid))
        });
        Ok(self.media.profile(lambda, self.cell.lattice, slices.collect()))
    }
}
