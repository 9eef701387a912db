//! One thick layer of a layered coating: a homogeneous medium under an interface.
//!
//! Thick means: many times the wavelength over the coherence of the light, so that light reflected
//! at its two faces does not interfere. Films that interfere belong into `stack`. A layer of
//! thickness 0 is ignored with its interface and films.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999), section 1.6.

use crate::{
    ParameterNode,
    optics::RefractiveIndex,
    shadow, slope,
    spec::{self, Class, Family, Laws, Member, Parameter, ParameterError, Spec},
    stack,
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<CoatingLayer> = Spec {
    class: Class {
        name: "Coat_Layer",
        parent: "Layer",
        summary: "Thick homogeneous layer",
        equation: "A = exp(-4 pi k t/(lambda cos(theta')))",
        source: "born-1999",
        params: &[&[
            Parameter::index("material", (1.5, 0.0), "Index of the layer; n at least 1"),
            Parameter::number("thickness", 10.0, "um", "Thickness; 0: no layer"),
            Parameter::member(
                "stack",
                &stack::FAMILY,
                "No_StackModel",
                "Films on the upper face, which interfere",
            ),
            Parameter::member(
                "sdf",
                &slope::FAMILY,
                "Unit_Slope_Distribution_Function",
                "Slopes of the upper face; Unit_Slope_Distribution_Function: smooth",
            ),
            Parameter::member(
                "shadow",
                &shadow::FAMILY,
                "Sancer_Shadow_Function",
                "Shadowing of the upper face; not asked for if it is smooth",
            ),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let thickness = node.number("thickness");
        if !(thickness >= 0.0 && thickness.is_finite()) {
            return Err(ParameterError::new(
                "thickness",
                format!("{thickness} um is not a thickness"),
            ));
        }
        Ok(Box::new(CoatingLayer {
            material: node.index("material").clone(),
            thickness,
            node: node.clone(),
        }))
    },
};

/// A thick layer.
#[derive(Clone, Debug)]
pub struct CoatingLayer {
    /// Its index.
    pub material: RefractiveIndex,
    /// Its thickness, µm.
    pub thickness: f64,
    /// Node with the films and the roughness of its upper face.
    pub(super) node: ParameterNode,
}

/// The layer classes, in the order they are listed to users.
pub const ALL: &[&Spec<CoatingLayer>] = &[&SPEC];

impl Member for CoatingLayer {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}

/// The family of the layers of a coating.
pub static FAMILY: Family =
    Family::new("Layer", "Layers of coatings", spec::classes::<CoatingLayer>);
