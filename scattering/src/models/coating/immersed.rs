//! Models below a coat: the same model for light that comes from inside a medium.
//!
//! Maxwell's equations contain indices only relative to the medium of the incident light, and lengths
//! only relative to the wavelength in it. A model in a medium of index n is therefore the same model
//! with every index divided by n, at the wavelength λ/n. Optical constants are evaluated at the
//! vacuum wavelength before λ is changed: a function of wavelength becomes a constant.
//!
//! `medium_i` of a grating is the medium of the incident light: if it is left at 1, it is the coat.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999), section 1.5.

use std::sync::Arc;

use num_complex::Complex64;

use crate::{
    ParameterError, ParameterNode,
    models::brdf,
    optics::{Film, RealFunction, RefractiveIndex},
    reflectance,
    spec::{Family, ParameterKind, ParameterValue},
};

/// Classes, with all classes derived from them, that have no meaning below a coat, and the reason.
const MEANINGLESS: &[(&str, &str)] = &[
    ("Instrument_BRDF_Model", "it describes an instrument in air"),
    ("ZernikeExpansion_BRDF_Model", "it is a fit to what was measured in air"),
    ("Transmit_BRDF_Model", "its light leaves through the back into air"),
    ("Generic_Grating", "its indices stand in a text"),
    ("Generic_CrossGrating", "its indices stand in a text"),
];

/// `node`, the value of the parameter `name`, for light from a medium of index `n` at the vacuum
/// wavelength `lambda` µm.
///
/// # Errors
///
/// For models of an instrument, of a fit or of a structure that is described by a text, and for
/// gratings with an incident medium of their own: these have no meaning inside a coat.
pub(super) fn immersed(
    name: &str,
    node: &ParameterNode,
    n: f64,
    lambda: f64,
) -> Result<ParameterNode, ParameterError> {
    ImmersionMedium { n, lambda }.immerse(name, node, &brdf::FAMILY)
}

/// The medium of the light.
struct ImmersionMedium {
    n: f64,
    /// Vacuum wavelength, µm.
    lambda: f64,
}

impl ImmersionMedium {
    fn immerse(
        &self,
        name: &str,
        node: &ParameterNode,
        family: &Family,
    ) -> Result<ParameterNode, ParameterError> {
        let class = node.class.name;
        if let Some((_, why)) = MEANINGLESS.iter().find(|(base, _)| family.is_below(class, base)) {
            let problem = format!("{class} has no meaning below a coat: {why}");
            return Err(ParameterError::new(name, problem));
        }
        let mut node = node.clone();
        for (value, param) in node.values.iter_mut().zip(node.class.parameters()) {
            *value = match (&*value, param.kind) {
                (ParameterValue::Member(child), ParameterKind::Member { family, .. }) => {
                    let inner = self.immerse(param.name, child, family);
                    ParameterValue::Member(Arc::new(inner.map_err(|error| error.inside(name))?))
                }
                (ParameterValue::Number(x), _) if param.name == "lambda" => {
                    ParameterValue::Number(x / self.n)
                }
                (ParameterValue::Index(index), _) if param.name == "medium_i" => {
                    let own = index.at(self.lambda);
                    if own != Complex64::ONE {
                        let problem =
                            format!("{own}: below a coat the incident medium is the coat; write 1");
                        return Err(ParameterError::new(param.name, problem).inside(name));
                    }
                    ParameterValue::Index(index.clone())
                }
                // These are functions of wavelength; tables of other families are functions of an angle.
                (ParameterValue::Table(table), _) if *family == reflectance::FAMILY => {
                    ParameterValue::Table(RealFunction::constant(table.at(self.lambda)))
                }
                (ParameterValue::Formula(formula), _) if *family == reflectance::FAMILY => {
                    let at_lambda = formula(self.lambda);
                    ParameterValue::Formula(Arc::new(move |_| at_lambda))
                }
                (other, _) => self.optical(other),
            };
        }
        Ok(node)
    }

    fn optical(&self, value: &ParameterValue) -> ParameterValue {
        match value {
            ParameterValue::Index(index) => ParameterValue::Index(self.relative(index)),
            ParameterValue::Films(films) => {
                let film = |film: &Film| Film {
                    index: self.relative(&film.index),
                    thickness: film.thickness,
                };
                ParameterValue::Films(films.iter().map(film).collect())
            }
            other => other.clone(),
        }
    }

    fn relative(&self, index: &RefractiveIndex) -> RefractiveIndex {
        let at = index.at(self.lambda) / self.n;
        RefractiveIndex::constant(at.re, at.im)
    }
}

#[cfg(test)]
mod tests {
    use crate::{Basis, Geometry, Mode, models};

    use super::*;

    fn defaults(name: &str) -> ParameterNode {
        ParameterNode::with_defaults(crate::registry::find_class(name).unwrap(), Mode::Sound)
    }

    #[test]
    fn immersion_in_vacuum_changes_nothing() {
        let at = Geometry { theta_i: 0.5, theta_s: 0.9, phi_s: 0.7, rotation: 0.1 };
        for name in [
            "Facet_BRDF_Model",
            "Microroughness_BRDF_Model",
            "Two_Source_BRDF_Model",
            "First_Diffuse_BRDF_Model",
            "Double_Interaction_BRDF_Model",
            "RCW_BRDF_Model",
        ] {
            let node = defaults(name);
            let inner = immersed("model", &node, 1.0, 0.532).unwrap();
            let [a, b] =
                [node, inner].map(|n| models::build(&n).unwrap().mueller(&at, Basis::Psps));
            assert_eq!(a, b, "{name}");
        }
    }

    #[test]
    fn a_model_in_a_medium_is_the_one_with_all_lengths_and_indices_in_units_of_the_medium() {
        // In water all lengths are n times as long in wavelengths: a thicker film in air is equal.
        let at = Geometry { theta_i: 0.5, theta_s: 0.9, phi_s: 0.7, rotation: 0.1 };
        let n = 1.33;
        let sphere = |node: ParameterNode, radius: f64, index: f64, density: f64| {
            let scatterer = node.child("scatterer").clone();
            let scatterer = scatterer
                .with("lambda", ParameterValue::Number(0.532))
                .and_then(|s| s.with("radius", ParameterValue::Number(radius)))
                .and_then(|s| {
                    s.with("sphere", ParameterValue::Index(RefractiveIndex::constant(index, 0.0)))
                })
                .unwrap();
            node.with("scatterer", ParameterValue::Member(scatterer.into()))
                .and_then(|n| n.with("distance", ParameterValue::Number(radius)))
                .and_then(|n| n.with("density", ParameterValue::Number(density)))
                .and_then(|n| {
                    n.with(
                        "substrate",
                        ParameterValue::Index(RefractiveIndex::constant(index, 0.0)),
                    )
                })
                .unwrap()
        };
        let name = "Double_Interaction_BRDF_Model";
        let below = immersed("model", &sphere(defaults(name), 0.1, 1.6, 1.0), n, 0.532).unwrap();
        let in_air = sphere(defaults(name), 0.1 * n, 1.6 / n, 1.0 / (n * n));
        let [a, b] = [below, in_air].map(|n| models::build(&n).unwrap().mueller(&at, Basis::Psps));
        assert!((a - b).largest() < 1e-12 * b.largest(), "{a:?} {b:?}");
    }

    #[test]
    fn what_has_no_meaning_below_a_coat_is_refused() {
        for name in
            ["ZernikeExpansion_BRDF_Model", "Rayleigh_Instrument_BRDF_Model", "Transmit_BRDF_Model"]
        {
            let error = immersed("model", &defaults(name), 1.5, 0.532).unwrap_err();
            assert!(error.problem.contains("no meaning"), "{error}");
        }
        let grating = defaults("Single_Line_Grating")
            .with("medium_i", ParameterValue::Index(RefractiveIndex::constant(1.5, 0.0)))
            .unwrap();
        let model = defaults("RCW_BRDF_Model")
            .with("grating", ParameterValue::Member(grating.into()))
            .unwrap();
        let error = immersed("model", &model, 1.5, 0.532).unwrap_err();
        assert_eq!(error.parameter, "model.grating.medium_i");
    }
}
