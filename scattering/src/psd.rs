//! Power spectral densities of surface height.
//!
//! The convention is two-sided and two-dimensional: the mean square height is the integral of
//! the density over all f_x, f_y, and FT h = ∬ h exp(−2πi f·r) dx dy. Densities of surfaces
//! covered with independent features at random places (mesas, pyramids, dimples) are the areal
//! density of the features times |FT|² of one of them.

use crate::spec::{Member, Spec};

pub mod abc;
pub mod double;
pub mod elliptic;
pub mod elliptical_mesa;
mod family;
pub mod fractal;
pub mod gaussian;
pub mod parabolic_dimple;
pub mod rectangular_mesa;
pub mod rectangular_pyramid;
pub mod table;
mod triangle;
pub mod triangular_mesa;
pub mod triangular_pyramid;
pub mod unit;

pub use family::{FAMILY, Psd};
use family::{sinc, strength};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Psd>] = &[
    &abc::SPEC,
    &gaussian::SPEC,
    &fractal::SPEC,
    &table::SPEC,
    &elliptical_mesa::SPEC,
    &rectangular_mesa::SPEC,
    &triangular_mesa::SPEC,
    &rectangular_pyramid::SPEC,
    &triangular_pyramid::SPEC,
    &parabolic_dimple::SPEC,
    &double::SPEC,
    &unit::SPEC,
];

impl Member for dyn Psd {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}

#[cfg(test)]
mod tests {
    use crate::{
        Mode, ParameterNode,
        psd::{ALL, Psd},
        spec::{self, ParameterValue},
    };

    /// A class at its defaults but for these numbers.
    pub(super) fn build(name: &str, mode: Mode, numbers: &[(&str, f64)]) -> Box<dyn Psd> {
        let class = crate::registry::find_class(name).unwrap();
        let node =
            numbers.iter().fold(ParameterNode::with_defaults(class, mode), |node, (name, x)| {
                node.with(name, ParameterValue::Number(*x)).unwrap()
            });
        spec::build::<dyn Psd>(&node).unwrap()
    }

    #[test]
    fn densities_are_real_surfaces_even_in_the_frequency() {
        for spec in ALL {
            let psd = build(spec.class.name, Mode::Sound, &[]);
            for (fx, fy) in [(0.3, 0.2), (-1.1, 0.7), (0.0, 2.0), (3.0, 0.0)] {
                let (here, there) = (psd.density(fx, fy), psd.density(-fx, -fy));
                assert!(here >= 0.0, "{}", spec.class.name);
                // The features without a centre are rounded differently at f and −f.
                assert!(
                    (here - there).abs() <= 1e-12 * psd.density(0.1, 0.1),
                    "{}",
                    spec.class.name
                );
            }
        }
    }

    #[test]
    fn negative_strengths_are_refused() {
        for (name, parameter) in [
            ("ABC_PSD_Function", "A"),
            ("Fractal_PSD_Function", "A"),
            ("Rectangular_Mesa_PSD_Function", "density"),
            ("Triangular_Pyramid_PSD_Function", "density"),
        ] {
            let class = crate::registry::find_class(name).unwrap();
            let node = ParameterNode::with_defaults(class, Mode::Sound)
                .with(parameter, ParameterValue::Number(-1.0))
                .unwrap();
            let error = spec::build::<dyn Psd>(&node).err().unwrap();
            assert_eq!(error.parameter, parameter);
        }
    }
}
