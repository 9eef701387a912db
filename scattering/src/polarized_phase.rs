//! Mueller-valued phase functions with coefficients of absorption and scattering.

use crate::spec::{Member, Spec};

pub mod code_whitney;
pub mod constrained;
pub mod distributed_mie;
mod family;
pub mod mixture;
pub mod none;
pub mod scaled;
pub mod series;
pub mod sphere;
pub mod unpolarized;

pub use family::{FAMILY, PolarizedPhase, SCALAR};
use family::{ScalarPhase, coefficient};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn PolarizedPhase>] = &[
    &unpolarized::SPEC,
    &code_whitney::SPEC,
    &constrained::SPEC,
    &sphere::SPEC,
    &distributed_mie::SPEC,
    &mixture::SPEC,
    &scaled::SPEC,
    &series::SPEC,
    &none::SPEC,
];

impl Member for dyn PolarizedPhase {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use crate::{Mode, ParameterNode, special::gauss};

    #[test]
    fn every_default_scatters_all_it_takes_from_the_beam() {
        for spec in ALL {
            let node = ParameterNode::with_defaults(&spec.class, Mode::Sound);
            // Spheres of up to 100 µm have lobes that few nodes do not see.
            // Without particles nothing is scattered.
            if ["Distributed_Mie_Phase_Function", "No_Polarized_Phase_Function"]
                .contains(&spec.class.name)
            {
                continue;
            }
            let phase = (spec.build)(&node).unwrap();
            let total = gauss::integrate(100, 0.0, PI, |t| {
                TAU * t.sin() * phase.at_cosine(t.cos())[(0, 0)]
            });
            assert!((total - 1.0).abs() < 1e-12, "{}: {total}", spec.class.name);
            assert!(phase.scattering() > 0.0 && phase.absorption() >= 0.0);
        }
    }
}
