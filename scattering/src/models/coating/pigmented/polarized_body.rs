//! The coating as an `Adding_Doubling_BRDF_Model`: `body = doubling`.
//!
//! One slab under the rough surface holds the particles and the flakes; the backing is a Lambertian
//! surface below it. All light is followed with its polarization, between flakes and particles too.
//!
//! J. F. de Haan, P. B. Bosma and J. W. Hovenier, Astron. Astrophys. 183, 371 (1987).

use std::sync::Arc;

use crate::{
    ParameterError, ParameterNode, ParameterValue,
    models::{
        brdf::Brdf,
        coating::{adding_doubling, paint, paint_face, paint_flakes},
        diffuse::lambertian,
    },
    polarized_phase::sphere,
    shadow::sancer,
    spec::Class,
};

/// Parameters that belong to the scalar body, with their only value beside doubling.
const SCALAR: [(&str, f64); 7] = [
    ("correlation", 1.0),
    ("printed", 0.0),
    ("flake_spread", 0.0),
    ("albedo", 0.0),
    ("exchange", 0.0),
    ("printed_surface", 0.0),
    ("printed_flakes", 0.0),
];

/// Parameters of the layered model and those of the coating that they come from.
const NAMES: [(&str, &str); 10] = [
    ("layer1.interface.material", "overcoat"),
    ("layer1.interface.stack", "overcoat_films"),
    ("layer1.interface.sdf", "surface_sdf"),
    ("layer1.thickness", "thickness"),
    ("layer1.particles.scatterer", "particle"),
    ("layer1.particles.volume_density", "particle_density"),
    ("layer1.flakes.density", "flake_density"),
    ("layer1.flakes.area", "flake_area"),
    ("layer1.flakes.", ""),
    ("model.reflectance", "backing"),
];

/// The coating of `node` with its body by adding and doubling.
pub(super) fn build(node: &ParameterNode) -> Result<Box<dyn Brdf>, ParameterError> {
    refuse_scalar(node)?;
    let model = layered(node)?;
    (adding_doubling::SPEC.build)(&model).map_err(named)
}

/// Refuses parameters that only the scalar body has.
fn refuse_scalar(node: &ParameterNode) -> Result<(), ParameterError> {
    for (name, only) in SCALAR {
        let value = match name {
            "correlation" | "flake_spread" => node.number(name),
            _ => f64::from(node.integer(name)),
        };
        if value != only {
            let problem = format!(
                "it belongs to the scalar body: leave it out, or set body = scalar ({value} is not {only})"
            );
            return Err(ParameterError::new(name, problem));
        }
    }
    for name in ["surface_shadow", "flake_shadow"] {
        let (class, usual) = (node.child(name).class.name, sancer::SPEC.class.name);
        if class != usual {
            let problem = format!("beside body = doubling it is {usual}, not {class}");
            return Err(ParameterError::new(name, problem));
        }
    }
    Ok(())
}

/// The parameters of the layered model.
fn layered(node: &ParameterNode) -> Result<ParameterNode, ParameterError> {
    let new = |class: &'static Class| {
        ParameterNode::with_defaults_noting(class, node.mode, node.notices.clone())
    };
    let number = |name: &str| ParameterValue::Number(node.number(name));
    let index = |name: &str| ParameterValue::Index(node.index(name).clone());
    let child = |name: &str| member(node.child(name).clone());
    let face = new(&paint_face::SPEC.class)
        .with("material", index("overcoat"))?
        .with("stack", child("overcoat_films"))?
        .with("sdf", child("surface_sdf"))?;
    let mut slab = new(&paint::SPEC.class)
        .with("interface", member(face))?
        .with("thickness", number("thickness"))?;
    if node.number("particle_density") != 0.0 {
        let particle = node.child("particle").clone().with("radius", number("particle_radius"))?;
        let particles = new(&sphere::SPEC.class)
            .with("scatterer", member(particle))?
            .with("volume_density", number("particle_density"))?;
        slab = slab.with("particles", member(particles))?;
    }
    if node.number("flake_density") != 0.0 && node.number("flake_area") != 0.0 {
        let flakes = new(&paint_flakes::SPEC.class)
            .with("density", number("flake_density"))?
            .with("area", number("flake_area"))?
            .with("substrate", index("substrate"))?
            .with("stack", child("stack"))?
            .with("sdf", child("sdf"))?;
        slab = slab.with("flakes", member(flakes))?;
    }
    let below = new(&lambertian::SPEC.class)
        .with("lambda", number("lambda"))?
        .with("reflectance", child("backing"))?;
    new(&adding_doubling::SPEC.class)
        .with("lambda", number("lambda"))?
        .with("type", ParameterValue::Integer(node.integer("type")))?
        .with("model", member(below))?
        .with("layer1", member(slab))
}

fn member(node: ParameterNode) -> ParameterValue {
    ParameterValue::Member(Arc::new(node))
}

/// The error with the name that the parameter has in the coating.
fn named(error: ParameterError) -> ParameterError {
    let ParameterError { parameter, problem } = error;
    let found = NAMES
        .iter()
        .find_map(|(inner, own)| parameter.strip_prefix(inner).map(|rest| format!("{own}{rest}")));
    ParameterError { parameter: found.unwrap_or(parameter), problem }
}
