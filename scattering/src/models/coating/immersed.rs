//! Models below a coat: the same model for light that comes from inside a medium.
//!
//! Maxwell's equations know indices only relative to the medium of the incident light, and
//! lengths only relative to the wavelength there. In a medium of index n a model is therefore the
//! one with every index divided by n at the wavelength λ/n. Materials are taken at the vacuum
//! wavelength before it is changed: what was a function of wavelength becomes a constant.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999), section 1.5.

use std::sync::Arc;

use crate::{
    Node, ParamError,
    optics::{Index, Table},
    spec::{Family, Kind, Value, is_below},
    stack::Film,
};

/// The models that have a meaning below a coat; sums, layers and pigmented coatings among them
/// are immersed with all that they contain.
const MEANINGFUL: &[&str] = &[
    "Lambertian_BRDF_Model",
    "Diffuse_Subsurface_BRDF_Model",
    "Facet_BRDF_Model",
    "Shadowed_Facet_BRDF_Model",
    "Subsurface_Facet_BRDF_Model",
    "Shadowed_Subsurface_Facet_BRDF_Model",
    "Pigmented_Coating_BRDF_Model",
    "Layered_BRDF_Model",
    "Two_Source_BRDF_Model",
    "Three_Source_BRDF_Model",
    "Four_Source_BRDF_Model",
];

/// `node`, the value of the parameter `name`, for light from a medium of index `n` at the vacuum
/// wavelength `lambda` µm.
///
/// # Errors
///
/// For models that describe an instrument, a fit, a grating, a particle or a single scattering
/// with media of its own: they have no meaning inside a coat.
pub(super) fn immersed(name: &str, node: &Node, n: f64, lambda: f64) -> Result<Node, ParamError> {
    let class = node.class.name;
    if !MEANINGFUL.contains(&class) && !is_below(class, "Roughness_BRDF_Model") {
        return Err(ParamError::new(name, format!("{class} has no meaning below a coat")));
    }
    let mut node = node.clone();
    for (value, param) in node.values.iter_mut().zip(node.class.parameters()) {
        *value = match (&*value, param.kind) {
            (Value::Member(child), Kind::Member(Family::Brdf, _)) => {
                let inner = immersed(param.name, child, n, lambda);
                Value::Member(Arc::new(inner.map_err(|error| error.inside(name))?))
            }
            (Value::Member(child), Kind::Member(family, _)) => {
                Value::Member(Arc::new(member(child, family, n, lambda)))
            }
            (Value::Number(x), _) if param.name == "lambda" => Value::Number(x / n),
            (other, _) => optical(other, n, lambda),
        };
    }
    Ok(node)
}

/// The same for what a model contains: slopes, films, reflectances, particles, layers.
fn member(node: &Node, family: Family, n: f64, lambda: f64) -> Node {
    let mut node = node.clone();
    for (value, param) in node.values.iter_mut().zip(node.class.parameters()) {
        *value = match (&*value, param.kind) {
            (Value::Member(child), Kind::Member(family, _)) => {
                Value::Member(Arc::new(member(child, family, n, lambda)))
            }
            (Value::Number(x), _) if param.name == "lambda" => Value::Number(x / n),
            // Functions of wavelength; those of slopes and shadows are functions of an angle.
            (Value::Table(table), _) if family == Family::Reflectance => {
                Value::Table(Table::constant(table.at(lambda)))
            }
            (Value::Formula(formula), _) if family == Family::Reflectance => {
                let at_lambda = formula(lambda);
                Value::Formula(Arc::new(move |_| at_lambda))
            }
            (other, _) => optical(other, n, lambda),
        };
    }
    node
}

fn optical(value: &Value, n: f64, lambda: f64) -> Value {
    match value {
        Value::Index(index) => Value::Index(relative(index, n, lambda)),
        Value::Films(films) => {
            let film = |film: &Film| Film {
                index: relative(&film.index, n, lambda),
                thickness: film.thickness,
            };
            Value::Films(films.iter().map(film).collect())
        }
        other => other.clone(),
    }
}

fn relative(index: &Index, n: f64, lambda: f64) -> Index {
    let at = index.at(lambda) / n;
    Index::constant(at.re, at.im)
}

#[cfg(test)]
mod tests {
    use crate::{Basis, Geometry, Mode, models, spec};

    use super::*;

    #[test]
    fn immersion_in_vacuum_changes_nothing() {
        let at = Geometry { theta_i: 0.5, theta_s: 0.9, phi_s: 0.7, rotation: 0.1 };
        for name in ["Facet_BRDF_Model", "Microroughness_BRDF_Model", "Two_Source_BRDF_Model"] {
            let node = Node::with_defaults(spec::find_class(name).unwrap(), Mode::Sound);
            let inner = immersed("model", &node, 1.0, 0.532).unwrap();
            let [a, b] =
                [node, inner].map(|n| models::build(&n).unwrap().mueller(&at, Basis::Psps));
            assert_eq!(a, b, "{name}");
        }
    }

    #[test]
    fn models_without_meaning_below_a_coat_are_refused() {
        for name in ["ZernikeExpansion_BRDF_Model", "Rayleigh_Instrument_BRDF_Model"] {
            let node = Node::with_defaults(spec::find_class(name).unwrap(), Mode::Sound);
            let error = immersed("model", &node, 1.5, 0.532).unwrap_err();
            assert!(error.problem.contains("no meaning"), "{error}");
        }
    }
}
