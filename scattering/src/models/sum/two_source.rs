//! Weighted sum of two models, coherent to a stated degree.
//!
//! $$ \mathbf F = (1-c)\,[\mathbf M(J_1) + \mathbf M(J_2)] + c\,\mathbf M(J_1 + J_2), \qquad
//!    J_j = \sqrt{factor_j}\,J_{source\,j} $$
//!
//! For c = 0 it is Σ factor_j F_j and the sources may depolarize; for c ≠ 0 both must have Jones
//! matrices.
//!
//! T. A. Germer and E. Marx, Appl. Opt. 43, 1266 (2004), for sums of sources.

use super::weighted::{WeightedSource, WeightedSum, source};
use crate::{
    Direction, Incidence, Mueller, ParameterError, ParameterNode,
    models::{Brdf, COMMON, CommonParameters, LobeSupport},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Two_Source_BRDF_Model",
        parent: "BRDF_Model",
        summary: "Weighted sum of two models",
        equation: "F = (1-c)(M(J1) + M(J2)) + c M(J1 + J2)",
        source: "germer-2004",
        params: &[
            COMMON,
            &source("factor1", "source1", "Weight of the first source", "First source"),
            &source("factor2", "source2", "Weight of the second source", "Second source"),
            &[Parameter::number("correlation", 0.0, "1", "Degree of coherence, from -1 to 1")],
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build,
};

fn build(node: &ParameterNode) -> Result<Box<dyn Brdf>, ParameterError> {
    let sum = WeightedSum::read(node, 2)?;
    let correlation = node.number("correlation");
    if !(-1.0..=1.0).contains(&correlation) {
        let problem = format!("{correlation} is not from -1 to 1");
        return Err(ParameterError::new("correlation", problem));
    }
    if correlation == 0.0 {
        return Ok(Box::new(sum));
    }
    if let Some(at) = sum.sources.iter().position(|source| !source.is_coherent()) {
        let problem = format!("source{} depolarizes: only 0 is possible", at + 1);
        return Err(ParameterError::new("correlation", problem));
    }
    Ok(Box::new(CoherentSum { sum, correlation }))
}

struct CoherentSum {
    sum: WeightedSum,
    correlation: f64,
}

impl Brdf for CoherentSum {
    fn common(&self) -> &CommonParameters {
        &self.sum.common
    }

    fn lobe_supports(&self, incidence: &Incidence) -> Vec<LobeSupport> {
        self.sum.lobe_supports(incidence)
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let jones = |source: &WeightedSource| {
            source.jones(incidence, direction).expect("a coherent model has a Jones matrix")
        };
        let (first, second) = (jones(&self.sum.sources[0]), jones(&self.sum.sources[1]));
        (first.mueller() + second.mueller()) * (1.0 - self.correlation)
            + (first + second).mueller() * self.correlation
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Basis, Geometry, Mode, ParameterValue, models, optics::RefractiveIndex};

    fn with(node: ParameterNode, name: &str, value: ParameterValue) -> ParameterNode {
        node.with(name, value).unwrap()
    }

    fn defaults(name: &str, mode: Mode) -> ParameterNode {
        ParameterNode::with_defaults(crate::registry::find_class(name).unwrap(), mode)
    }

    fn number(x: f64) -> ParameterValue {
        ParameterValue::Number(x)
    }

    #[test]
    fn fully_coherent_equal_sources_are_four_times_one() {
        let sum = with(defaults(SPEC.class.name, Mode::Sound), "correlation", number(1.0));
        let one = defaults("Microroughness_BRDF_Model", Mode::Sound);
        let at = Geometry { theta_i: 0.5, theta_s: 0.6, phi_s: 0.7, rotation: 0.1 };
        let m = |node| models::build(&node).unwrap().mueller(&at, Basis::Psps);
        let (sum, one) = (m(sum), m(one) * 4.0);
        assert!((sum - one).largest() < 1e-14 * one.largest());
    }

    #[test]
    fn a_depolarizing_source_cannot_be_coherent() {
        let body = defaults("Lambertian_BRDF_Model", Mode::Sound);
        let node = with(defaults(SPEC.class.name, Mode::Sound), "correlation", number(0.5));
        let node = with(node, "source2", ParameterValue::Member(body.into()));
        assert_eq!(models::build(&node).err().unwrap().parameter, "correlation");
    }

    #[test]
    fn sources_must_share_the_wavelength_of_the_sum() {
        let node = with(defaults(SPEC.class.name, Mode::Sound), "lambda", number(0.6));
        assert_eq!(models::build(&node).err().unwrap().parameter, "source1.lambda");
    }

    #[test]
    fn negative_factors_are_refused() {
        let node = with(defaults(SPEC.class.name, Mode::Sound), "factor2", number(-0.1));
        assert_eq!(models::build(&node).err().unwrap().parameter, "factor2");
    }

    #[test]
    fn an_absorbing_binder_is_refused_by_compat_only() {
        let build = |mode| {
            let glass = || ParameterValue::Index(RefractiveIndex::constant(1.5, 0.01));
            let binder =
                with(defaults("Diffuse_Subsurface_BRDF_Model", mode), "substrate", glass());
            let body = with(defaults("Lambertian_BRDF_Model", mode), "substrate", glass());
            let node = with(defaults(SPEC.class.name, mode), "substrate", glass());
            let node = with(node, "source1", ParameterValue::Member(binder.into()));
            models::build(&with(node, "source2", ParameterValue::Member(body.into()))).err()
        };
        assert_eq!(build(Mode::Sound), None);
        assert_eq!(build(Mode::Compat).unwrap().parameter, "source1.substrate");
    }
}
