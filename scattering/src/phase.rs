//! Scalar phase functions: the density of directions after one scattering event.

use crate::spec::{Member, Spec};

mod family;
pub mod gaussian;
pub mod henyey_greenstein;
pub mod isotropic;
pub mod legendre;
pub mod rayleigh;
pub mod reynolds_mccormick;
pub mod table;

pub use family::{FAMILY, Phase};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Phase>] = &[
    &isotropic::SPEC,
    &henyey_greenstein::SPEC,
    &henyey_greenstein::DOUBLE,
    &reynolds_mccormick::SPEC,
    &reynolds_mccormick::DOUBLE,
    &rayleigh::SPEC,
    &legendre::SPEC,
    &gaussian::SPEC,
    &table::SPEC,
];

impl Member for dyn Phase {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use crate::{Mode, ParameterNode, ParameterValue, spec, special::gauss};

    /// ∫ p dΩ of the class `name`.
    fn integral(name: &str, mode: Mode, values: &[(&str, f64)]) -> f64 {
        let mut node =
            ParameterNode::with_defaults(crate::registry::find_class(name).unwrap(), mode);
        for (parameter, value) in values {
            node = node.with(parameter, ParameterValue::Number(*value)).unwrap();
        }
        let phase = spec::build::<dyn super::Phase>(&node).unwrap();
        // In the angle, because a Gaussian of θ is not smooth in cos θ at θ = π.
        gauss::integrate(200, 0.0, PI, |t| TAU * t.sin() * phase.at_cosine(t.cos()))
    }

    #[test]
    fn the_integral_over_all_directions_is_one() {
        for (name, values) in [
            ("Isotropic_Phase_Function", vec![]),
            ("Henyey_Greenstein_Phase_Function", vec![("g", -0.7)]),
            ("Double_Henyey_Greenstein_Phase_Function", vec![("g1", 0.8), ("g2", -0.3)]),
            ("Reynolds_McCormick_Phase_Function", vec![("g", 0.5), ("alpha", 0.8)]),
            ("Reynolds_McCormick_Phase_Function", vec![("g", -0.5), ("alpha", 0.0)]),
            ("Reynolds_McCormick_Phase_Function", vec![("g", 0.0), ("alpha", 2.0)]),
            ("Double_Reynolds_McCormick_Phase_Function", vec![("g", 0.6), ("alpha", 1.1)]),
            ("Rayleigh_Phase_Function", vec![]),
            ("Legendre_Phase_Function", vec![]),
            ("Gaussian_Phase_Function", vec![("width", 20.0)]),
            ("Gaussian_Phase_Function", vec![("width", 300.0)]),
        ] {
            let got = integral(name, Mode::Sound, &values);
            assert!((got - 1.0).abs() < 1e-12, "{name} {values:?}: {got}");
        }
    }

    #[test]
    fn compat_norms_are_those_of_the_defects() {
        let four_pi = 2.0 * TAU;
        for name in ["Rayleigh_Phase_Function", "Legendre_Phase_Function"] {
            let got = integral(name, Mode::Compat, &[]);
            assert!((got - four_pi).abs() < 1e-12 * four_pi, "{name}: {got}");
        }
        let rm = integral(
            "Reynolds_McCormick_Phase_Function",
            Mode::Compat,
            &[("g", 0.5), ("alpha", 0.8)],
        );
        assert!((rm - 1.98).abs() < 0.005, "{rm}");
        // The series of the norm leaves out the eighth power of a width of 0.9 rad.
        let gaussian = integral("Gaussian_Phase_Function", Mode::Compat, &[("width", 50.0)]);
        assert!((gaussian - 1.0).abs() > 1e-4 && (gaussian - 1.0).abs() < 0.1, "{gaussian}");
    }

    #[test]
    fn parameters_that_give_no_density_are_refused() {
        for (name, parameter, value) in [
            ("Henyey_Greenstein_Phase_Function", "g", 1.0),
            ("Henyey_Greenstein_Phase_Function", "g", f64::NAN),
            ("Double_Henyey_Greenstein_Phase_Function", "g2", -1.5),
            ("Reynolds_McCormick_Phase_Function", "g", 1.0),
            ("Reynolds_McCormick_Phase_Function", "alpha", f64::INFINITY),
            ("Gaussian_Phase_Function", "width", 0.0),
        ] {
            let node = ParameterNode::with_defaults(
                crate::registry::find_class(name).unwrap(),
                Mode::Sound,
            )
            .with(parameter, ParameterValue::Number(value))
            .unwrap();
            let error = spec::build::<dyn super::Phase>(&node).err().expect(name);
            assert_eq!(error.parameter, parameter);
        }
    }
}
