//! Slope distributions: the density of facet slopes.

use crate::spec::{Member, Spec};

pub mod anisotropic_exponential;
pub mod anisotropic_gaussian;
pub mod ellipsoid;
pub mod exponential;
pub mod exponential_angle;
mod family;
pub mod gaussian;
pub mod gaussian_angle;
pub mod mixture;
pub mod table;
pub mod table_angle;
pub mod unit;

use family::{ClosedForm, DensityKernel, ExponentialConstants, by_angle, width};
pub use family::{FAMILY, SlopeDistribution};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn SlopeDistribution>] = &[
    &unit::SPEC,
    &exponential::SPEC,
    &gaussian::SPEC,
    &table::SPEC,
    &anisotropic_exponential::SPEC,
    &anisotropic_gaussian::SPEC,
    &ellipsoid::SPEC,
    &mixture::SPEC,
    &gaussian_angle::SPEC,
    &exponential_angle::SPEC,
    &table_angle::SPEC,
];

impl Member for dyn SlopeDistribution {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_1_PI;

    use super::*;
    use crate::{Mode, ParameterNode, ParameterValue, spec};

    fn built(name: &str, params: &[(&str, f64)], mode: Mode) -> Box<dyn SlopeDistribution> {
        let class = crate::registry::find_class(name).unwrap();
        let node =
            params.iter().fold(ParameterNode::with_defaults(class, mode), |node, (name, x)| {
                node.with(name, ParameterValue::Number(*x)).unwrap()
            });
        spec::build::<dyn SlopeDistribution>(&node).unwrap()
    }

    /// (∫∫S, ⟨ζ_x²⟩, ⟨ζ_y²⟩) by the trapezoidal rule in ln ζ and azimuth, which converges faster
    /// than any power for densities that are smooth in both.
    fn moments(s: &dyn SlopeDistribution) -> [f64; 3] {
        let (radial, azimuths) = (2000, 64);
        let mut sum = [0.0; 3];
        for i in 0..radial {
            let slope = (-25.0 + 32.0 * i as f64 / radial as f64).exp();
            for j in 0..azimuths {
                let phi = std::f64::consts::TAU * j as f64 / azimuths as f64;
                let (x, y) = (slope * phi.cos(), slope * phi.sin());
                let weight = s.density(x, y)
                    * slope
                    * slope
                    * (32.0 / radial as f64)
                    * (std::f64::consts::TAU / azimuths as f64);
                for (total, power) in sum.iter_mut().zip([1.0, x * x, y * y]) {
                    *total += weight * power;
                }
            }
        }
        sum
    }

    #[test]
    fn densities_integrate_to_one_and_have_the_stated_deviations() {
        for (name, params) in [
            ("Exponential_Slope_Distribution_Function", &[("s", 0.3)][..]),
            ("Gaussian_Slope_Distribution_Function", &[("s", 0.3)]),
            ("Anisotropic_Exponential_Slope_Distribution_Function", &[("sx", 0.4), ("sy", 0.25)]),
            (
                "Anisotropic_Gaussian_Slope_Distribution_Function",
                &[("sigmax", 0.4), ("sigmay", 0.25)],
            ),
        ] {
            let s = built(name, params, Mode::Sound);
            let (x, y) = s.deviations().unwrap();
            for (got, want) in moments(&*s).into_iter().zip([1.0, x * x, y * y]) {
                // The azimuthal sum of the exponential with axes 0.4 : 0.25 is good to 10⁻⁹.
                assert!((got - want).abs() < 1e-8 * want, "{name}: {got} is not {want}");
            }
        }
    }

    #[test]
    fn ellipsoids_cover_their_share_of_the_area() {
        let s = built("Ellipsoid_Slope_Distribution_Function", &[("ry", 7.0)], Mode::Sound);
        let covered = std::f64::consts::PI * 10.0 * 7.0 * 1e-4;
        // Slopes beyond e⁷ are cut: they hold e⁻¹⁴/49 of the whole.
        assert!((moments(&*s)[0] - covered).abs() < 1e-6 * covered);
    }

    #[test]
    fn equal_deviations_give_the_isotropic_gaussian() {
        let a = built(
            "Anisotropic_Gaussian_Slope_Distribution_Function",
            &[("sigmax", 0.2), ("sigmay", 0.2)],
            Mode::Sound,
        );
        let b =
            built("Gaussian_Slope_Distribution_Function", &[("s", 0.2 * 2f64.sqrt())], Mode::Sound);
        for (x, y) in [(0.0, 0.0), (0.1, -0.3), (0.5, 0.2)] {
            assert!((a.density(x, y) / b.density(x, y) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn twelve_digit_constants_are_kept_for_compat_only() {
        let name = "Exponential_Slope_Distribution_Function";
        let at = |mode| built(name, &[("s", 1.0)], mode).density(0.0, 0.0);
        assert_eq!(at(Mode::Compat), 0.954929658551);
        assert_eq!(at(Mode::Sound), 3.0 * FRAC_1_PI);
    }

    #[test]
    fn widths_that_are_not_positive_are_refused() {
        let class = crate::registry::find_class("Gaussian_Slope_Distribution_Function").unwrap();
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let node = ParameterNode::with_defaults(class, Mode::Sound)
                .with("s", ParameterValue::Number(bad));
            let error = spec::build::<dyn SlopeDistribution>(&node.unwrap()).err().unwrap();
            assert_eq!(error.parameter, "s");
        }
    }
}
