//! Shadowing functions: the fraction of facets that is lit and seen.

use crate::spec::{Member, Spec};

mod family;
pub mod maxwell_beard;
pub mod sancer;
pub mod smith;
pub mod table;
pub mod torrance_sparrow;
pub mod unit;

pub use family::{FAMILY, Shadow};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Shadow>] = &[
    &unit::SPEC,
    &torrance_sparrow::SPEC,
    &smith::SPEC,
    &maxwell_beard::SPEC,
    &table::SPEC,
    &sancer::SPEC,
];

impl Member for dyn Shadow {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Direction, Incidence, Mode, ParameterNode, slope::SlopeDistribution, spec};

    #[test]
    fn every_fraction_is_the_same_for_the_reversed_path() {
        for class in FAMILY.classes() {
            let node = ParameterNode::with_defaults(class, Mode::Sound);
            let mut shadow = spec::build::<dyn Shadow>(&node).unwrap();
            let slopes =
                crate::registry::find_class("Anisotropic_Gaussian_Slope_Distribution_Function");
            let slopes = ParameterNode::with_defaults(slopes.unwrap(), Mode::Sound);
            shadow.adapt(&*spec::build::<dyn SlopeDistribution>(&slopes).unwrap()).unwrap();
            for (a, b, phi, r) in [(0.5, 1.2, 0.7, 0.3), (1.4, 0.1, -2.3, 1.1)] {
                let there = shadow.fraction(&Incidence::new(a, r), &Direction::new(b, phi));
                let turned = Incidence::new(b, r + std::f64::consts::PI - phi);
                let back = shadow.fraction(&turned, &Direction::new(a, -phi));
                assert!((there - back).abs() < 1e-14, "{}: {there} and {back}", class.name);
                let mut fractions = [0.0; 5];
                let directions = [Direction::new(b, phi); 5];
                shadow.fractions(&Incidence::new(a, r), &directions, &mut fractions);
                assert_eq!(fractions, [there; 5]);
                assert!((0.0..=1.0).contains(&there), "{}: {there}", class.name);
            }
        }
    }
}
