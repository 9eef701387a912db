//! Densities of a particle diameter.

use crate::spec::{Member, Spec};

pub mod bimodal;
mod family;
pub mod log_normal;
pub mod modified_gamma;
pub mod normal;
pub mod weibull;

use family::positive;
pub use family::{Distribution, FAMILY};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Distribution>] =
    &[&log_normal::SPEC, &normal::SPEC, &weibull::SPEC, &modified_gamma::SPEC, &bimodal::SPEC];

impl Member for dyn Distribution {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Defect, Mode, ParameterNode, special::gauss};

    fn integral(spec: &Spec<dyn Distribution>, node: &ParameterNode) -> f64 {
        let distribution = (spec.build)(node).unwrap();
        // In u = ln d from 1 nm to 100 km: every default lies far inside.
        gauss::integrate(1000, 1e-3f64.ln(), 1e11f64.ln(), |u| {
            u.exp() * distribution.density(u.exp())
        })
    }

    #[test]
    fn the_integral_over_all_diameters_is_one() {
        for spec in ALL {
            let node = ParameterNode::with_defaults(&spec.class, Mode::Sound);
            // Part of the normal distribution lies at negative diameters: ½ erfc(√2) = 0.02275.
            let expected =
                if spec.class.name == "Normal_Distribution" { 0.977_249_87 } else { 1.0 };
            let got = integral(spec, &node);
            assert!((got - expected).abs() < 1e-4, "{}: {got}", spec.class.name);
        }
    }

    #[test]
    fn modified_gamma_integrates_to_two_in_compat_only() {
        let spec = &modified_gamma::SPEC;
        let compat = ParameterNode::with_defaults(&spec.class, Mode::Compat);
        assert!((integral(spec, &compat) - 2.0).abs() < 1e-9);
        let sound = ParameterNode::with_defaults(&spec.class, Mode::Sound);
        assert!((integral(spec, &sound) - 1.0).abs() < 1e-9);
        assert!(sound.notices.lock().unwrap().contains(&Defect::GammaNorm.into()));
    }
}
