//! Rectangular (or oblique) holes or posts.
//!
//! $$ |x - y\tan\zeta_a| < \tfrac{\ell_1}{2}, \qquad |y/\cos\zeta_a| < \tfrac{\ell_2}{2} $$
//!
//! ℓ₁, ℓ₂ (`length1`, `length2`) are the sides, ζ_a (`zetaa`) their lean.
//!
//! L. Li, J. Opt. Soc. Am. A 14, 2758 (1997).

use super::{
    CrossGrating, CrossGratingMedia, CrossPattern, CrossProfile, CrossSlice, MEDIA,
    grid::{CELL, UnitCell},
    lean,
};
use crate::{
    grating::{GratingMaterial, not_negative},
    optics::RefractiveIndex,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::number("length1", 0.1, "um", "Side along x"),
    Parameter::number("length2", 0.1, "um", "Side along the other direction"),
    Parameter::number("zetaa", 0.0, "deg", "Angle from y to the second side"),
    Parameter::number("thickness", 0.1, "um", "Height"),
    Parameter::index("inside", (1.0, 0.0), "Index inside"),
    Parameter::index("outside", (1.5, 0.0), "Index outside"),
];

/// Name, parameters and constructor of a [`RectangleGrating`].
pub const SPEC: Spec<dyn CrossGrating> = Spec {
    class: Class {
        name: "Rectangle_CrossGrating",
        parent: "Gridded_CrossGrating",
        summary: "Rectangular holes or posts",
        equation: "|x - y tan(zetaa)| < length1/2 and |y/cos(zetaa)| < length2/2",
        source: "li-1997",
        params: &[MEDIA, CELL, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(RectangleGrating::read(node)?)),
};

/// Rectangular holes or posts.
#[derive(Clone, Debug)]
pub struct RectangleGrating {
    media: CrossGratingMedia,
    cell: UnitCell,
    half: (f64, f64),
    lean: f64,
    thickness: f64,
    inside: RefractiveIndex,
    outside: RefractiveIndex,
}

impl RectangleGrating {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let half = |name: &str| not_negative(node, name).map(|length| 0.5 * length);
        Ok(Self {
            media: CrossGratingMedia::read(node),
            cell: UnitCell::read(node)?,
            half: (half("length1")?, half("length2")?),
            lean: lean(node, "zetaa")?,
            thickness: not_negative(node, "thickness")?,
            inside: node.index("inside").clone(),
            outside: node.index("outside").clone(),
        })
    }
}

impl CrossGrating for RectangleGrating {
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParameterError> {
        let materials =
            [&self.outside, &self.inside].map(|n| GratingMaterial::from_index(n.at(lambda)));
        let (tan, cos) = (self.lean.tan(), self.lean.cos());
        let grid = self.cell.paint(materials.to_vec(), |x, y| {
            u8::from((x - y * tan).abs() < self.half.0 && (y / cos).abs() < self.half.1)
        });
        let slice = CrossSlice::new(self.thickness, CrossPattern::Grid(grid));
        Ok(self.media.profile(lambda, self.cell.lattice, vec![slice]))
    }
}
