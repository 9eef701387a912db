//! Parameters of a pigmented coating besides those of its surface, flakes and binder.

use crate::{
    reflectance, scatterer, shadow, slope,
    spec::{Parameter, ParameterKind},
};

/// Parameters of `Pigmented_Coating_BRDF_Model` itself.
pub(super) const OWN: &[Parameter] = &[
    Parameter::member(
        "surface_sdf",
        &slope::FAMILY,
        "Anisotropic_Gaussian_Slope_Distribution_Function",
        "Density of the slopes of the coat's surface",
    ),
    Parameter::member(
        "surface_shadow",
        &shadow::FAMILY,
        "Sancer_Shadow_Function",
        "Shadowing of the coat's surface",
    ),
    Parameter::number("flake_density", 0.0001, "1/um^3", "Flakes per volume"),
    Parameter::number("flake_area", 300.0, "um^2", "Area of a flake"),
    Parameter::number("thickness", 30.0, "um", "Thickness of the coat"),
    Parameter::number(
        "correlation",
        1.0,
        "1",
        "Probability that light leaves by the gap by which it entered, 0 to 1",
    ),
    Parameter::member(
        "particle",
        &scatterer::FAMILY,
        "MieScatterer",
        "Particle of the body; its lambda, medium and radius are set by the coating",
    ),
    Parameter::number("particle_radius", 0.1, "um", "Radius of the particles"),
    Parameter::number("particle_density", 0.0, "1/um^3", "Particles per volume"),
    Parameter::member(
        "backing",
        &reflectance::FAMILY,
        "Table_Reflectance",
        "Reflectance of what lies below the coat, for diffuse light inside it",
    ),
    Parameter::integer(
        "printed",
        0,
        "0 consistent; 1 the body as in the paper's equation 9; 2 the flakes' weight of equation 11 too",
    ),
    Parameter::member(
        "flake_shadow",
        &shadow::FAMILY,
        "Sancer_Shadow_Function",
        "Shadowing of flakes by each other, at the angles inside the coat",
    ),
    Parameter::number(
        "flake_spread",
        0.0,
        "1",
        "Relative standard deviation of the thickness of the flakes' films, below 1/3",
    ),
    Parameter::integer("albedo", 0, "Albedo of the body: 0 adding and doubling, 1 Kubelka-Munk"),
    Parameter::integer("exchange", 0, "Light between flakes and surface: 0 left out, 1 taken in"),
    Parameter::integer("printed_surface", 0, "1: the surface as in the paper's equations 4 to 6"),
    Parameter::integer("printed_flakes", 0, "1: the flakes as in the paper's equation 8"),
    Parameter {
        name: "body",
        kind: ParameterKind::Text,
        unit: "",
        doc: "scalar (if empty): the body depolarizes; doubling: all light with its polarization",
    },
];
