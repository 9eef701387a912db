//! The upper face of a slab: its material, films and roughness.
//!
//! `sdf` is `Unit_Slope_Distribution_Function` for a smooth face, otherwise Gaussian. The light
//! inside sees the isotropic slopes σ² = ½(σ_x² + σ_y²); the uppermost face of a stack reflects with
//! those of `sdf`.

use super::interface::{RoughnessParameters, facets};
use crate::{
    Mode, ParameterNode, ParameterValue,
    models::Brdf,
    optics::RefractiveIndex,
    shadow,
    slope::{self, SlopeDistribution},
    spec::{self, Class, Family, Laws, Member, Parameter, ParameterError, Spec},
    stack::{self, Stack},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<PaintFace> = Spec {
    class: Class {
        name: "Coated_Face",
        parent: "Face",
        summary: "Smooth or rough face with films",
        equation: "R + T = 1 without absorption",
        source: "born-1999 sancer-1969 heitz-2016",
        params: &[&[
            Parameter::index("material", (1.5, 0.0), "Index of the slab below; n at least 1"),
            Parameter::member(
                "stack",
                &stack::FAMILY,
                "No_StackModel",
                "Films on the face, which interfere",
            ),
            Parameter::member(
                "sdf",
                &slope::FAMILY,
                "Unit_Slope_Distribution_Function",
                "Slopes of the face, Gaussian; Unit_Slope_Distribution_Function: smooth",
            ),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let slopes = match node.child("sdf").class.name {
            name if name == slope::unit::SPEC.class.name => None,
            name if name == slope::gaussian::SPEC.class.name
                || name == slope::anisotropic_gaussian::SPEC.class.name =>
            {
                node.member::<dyn SlopeDistribution>("sdf")?.deviations()
            }
            name => {
                let problem = format!(
                    "{name}: faces of slabs have Gaussian slopes (Gaussian_Slope_Distribution_Function \
                     or Anisotropic_Gaussian_Slope_Distribution_Function)"
                );
                return Err(ParameterError::new("sdf", problem));
            }
        };
        Ok(Box::new(PaintFace {
            material: node.index("material").clone(),
            films: *node.member::<Stack>("stack")?,
            deviations: slopes,
            node: node.clone(),
        }))
    },
};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<PaintFace>] = &[&SPEC];

impl Member for PaintFace {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}

/// The family of faces of slabs.
pub static FAMILY: Family = Family::new("Face", "Faces of slabs", spec::classes::<PaintFace>);

/// The face of a slab.
pub struct PaintFace {
    /// Index of the slab.
    pub(super) material: RefractiveIndex,
    /// Films on it.
    pub(super) films: Stack,
    /// (σ_x, σ_y) of a rough face.
    pub(super) deviations: Option<(f64, f64)>,
    node: ParameterNode,
}

impl PaintFace {
    /// σ of the isotropic slopes; nothing if it is smooth.
    pub(super) fn sigma(&self) -> Option<f64> {
        self.deviations.map(|(x, y)| (0.5 * (x * x + y * y)).sqrt())
    }

    /// The facets of the face as they are seen from air, at the vacuum wavelength `lambda`.
    pub(super) fn facets(&self, lambda: f64) -> Result<Box<dyn Brdf>, ParameterError> {
        let shadow = ParameterNode::with_defaults(&shadow::sancer::SPEC.class, Mode::Sound)
            .with("azimuth", ParameterValue::Integer(1))?;
        let roughness = RoughnessParameters { slopes: self.node.child("sdf"), shadow: &shadow };
        let index = self.material.at(lambda);
        let node = facets(index.re.into(), &self.films.at(lambda), lambda, &roughness)?;
        spec::build::<dyn Brdf>(&node)
    }
}
