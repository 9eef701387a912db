//! Titles of families and names of kinds of parameters, for people.

use scattering::{Family, spec};

/// Title of a family's list.
pub(super) fn title(family: Family) -> &'static str {
    match family {
        Family::Brdf => "BRDF models",
        Family::Slope => "Slope distributions",
        Family::Shadow => "Shadowing functions",
        Family::Psd => "Power spectral densities",
        Family::Stack => "Film stacks",
        Family::Reflectance => "Reflectances",
        Family::Grating => "Gratings",
        Family::CrossGrating => "Crossed gratings",
        Family::Shape => "Shapes of bodies of revolution",
        Family::Layer => "Layers of coatings",
        Family::Phase => "Phase functions",
        Family::PolarizedPhase => "Polarized phase functions",
        Family::Scatterer => "Free-space scatterers",
        Family::Distribution => "Distributions of a diameter",
        Family::VolumeSize => "Particle sizes per volume",
        Family::SurfaceSize => "Particle sizes per area",
    }
}

/// The kind of a parameter, for people.
pub(super) fn kind(kind: spec::ParameterKind) -> String {
    match kind {
        spec::ParameterKind::Number => "number".into(),
        spec::ParameterKind::Integer => "integer".into(),
        spec::ParameterKind::Text => "text".into(),
        spec::ParameterKind::File => "file".into(),
        spec::ParameterKind::Formula => "formula of x".into(),
        spec::ParameterKind::Index => "index".into(),
        spec::ParameterKind::Table => "table".into(),
        spec::ParameterKind::Films => "films".into(),
        spec::ParameterKind::Member(_, base) => base.into(),
    }
}
