//! Spheres in a layer, as in an opal.
//!
//! Level n of N (`nlevels`) is a disc of radius r = (2n − 1)D/(2N), growing to the equator and
//! shrinking again; it reaches from the height at which the sphere of diameter D has the radius
//! r − D/(2N) to that where it has r + D/(2N). `above` and `below` are layers without spheres.
//!
//! L. Li, J. Opt. Soc. Am. A 14, 2758 (1997).

use super::{
    CrossGrating, CrossGratingMedia, CrossPattern, CrossProfile, CrossSlice, MEDIA,
    grid::{CELL, UnitCell},
};
use crate::{
    grating::{GratingMaterial, LinePattern, levels, not_negative, positive},
    optics::RefractiveIndex,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::number("diameter", 0.05, "um", "Diameter of the spheres"),
    Parameter::number("above", 0.05, "um", "Thickness of the layer above the spheres"),
    Parameter::number("below", 0.05, "um", "Thickness of the layer below the spheres"),
    Parameter::integer("nlevels", 7, "Number of slices of the spheres"),
    Parameter::index("sphere", (1.0, 0.0), "Index of the spheres"),
    Parameter::index("surrounding", (1.5, 0.0), "Index around them"),
];

/// Name, parameters and constructor of a [`SphereGrating`].
pub const SPEC: Spec<dyn CrossGrating> = Spec {
    class: Class {
        name: "Sphere_CrossGrating",
        parent: "Gridded_CrossGrating",
        summary: "Spheres in a layer",
        equation: "discs of radius (2n-1) diameter/(2 nlevels)",
        source: "li-1997",
        params: &[MEDIA, CELL, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(SphereGrating::read(node)?)),
};

/// Spheres in a layer.
#[derive(Clone, Debug)]
pub struct SphereGrating {
    media: CrossGratingMedia,
    cell: UnitCell,
    diameter: f64,
    above: f64,
    below: f64,
    levels: usize,
    sphere: RefractiveIndex,
    surrounding: RefractiveIndex,
}

impl SphereGrating {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        Ok(Self {
            media: CrossGratingMedia::read(node),
            cell: UnitCell::read(node)?,
            diameter: positive(node, "diameter")?,
            above: not_negative(node, "above")?,
            below: not_negative(node, "below")?,
            levels: levels(node, "nlevels", 1)?,
            sphere: node.index("sphere").clone(),
            surrounding: node.index("surrounding").clone(),
        })
    }

    /// Radius and thickness of a level.
    fn level(&self, level: usize) -> (f64, f64) {
        let (radius, step) = (0.5 * self.diameter, 0.5 * self.diameter / self.levels as f64);
        let mirrored = self.levels - 1 - level;
        let r = (2 * level.min(mirrored) + 1) as f64 * step;
        let height = |r: f64| (radius * radius - r * r).max(0.0).sqrt();
        let upper = height(r - step);
        (r, if level == mirrored { 2.0 * upper } else { upper - height(r + step) })
    }
}

impl CrossGrating for SphereGrating {
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParameterError> {
        let around = GratingMaterial::from_index(self.surrounding.at(lambda));
        let materials = vec![around, GratingMaterial::from_index(self.sphere.at(lambda))];
        let plain = |thickness: f64| {
            let pattern = LinePattern::uniform(around, self.cell.lattice.d1);
            (thickness > 0.0).then(|| CrossSlice::new(thickness, CrossPattern::Along1(pattern)))
        };
        let spheres = (0..self.levels).map(|level| {
            let (radius, thickness) = self.level(level);
            let grid = self.cell.paint(materials.clone(), |x, y| u8::from(x.hypot(y) <= radius));
            CrossSlice::new(thickness, CrossPattern::Grid(grid))
        });
        let slices = plain(self.above).into_iter().chain(spheres).chain(plain(self.below));
        Ok(self.media.profile(lambda, self.cell.lattice, slices.collect()))
    }
}

#[cfg(test)]
mod tests {
    use crate::{Mode, ParameterNode, ParameterValue, cross_grating::CrossGrating, spec};

    #[test]
    fn slices_of_the_spheres_are_as_high_as_the_spheres() {
        for levels in [1, 2, 7, 8] {
            let node = ParameterNode::with_defaults(&super::SPEC.class, Mode::Sound)
                .with("nlevels", ParameterValue::Integer(levels))
                .and_then(|node| node.with("grid1", ParameterValue::Integer(8)))
                .and_then(|node| node.with("grid2", ParameterValue::Integer(8)))
                .unwrap();
            let profile = spec::build::<dyn CrossGrating>(&node).unwrap().at(0.5).unwrap();
            let height: f64 = profile.slices.iter().map(|slice| slice.thickness).sum();
            // Above, below and the diameter are 0.05 each.
            assert!((height - 0.15).abs() < 1e-14, "{levels} levels: {height}");
        }
    }
}
