//! The whole phase matrix as a table in the scattering angle.

use std::f64::consts::PI;

use super::expansion::PhaseElements;

/// Steps from 0 to π.
const STEPS: usize = 2048;

/// a₁, a₂, a₃, a₄, b₁, b₂ on an even grid in Θ, between which cubics are taken.
#[derive(Clone, Debug)]
pub struct PhaseTable {
    values: Vec<PhaseElements>,
}

impl PhaseTable {
    /// The table of `elements`, functions of cos Θ, divided by `whole`.
    pub fn new(elements: impl Fn(f64) -> PhaseElements, whole: f64) -> Self {
        let at = |k: usize| {
            let theta = PI * k as f64 / STEPS as f64;
            elements(theta.cos()).map(|x| x / whole)
        };
        Self { values: (0..=STEPS).map(at).collect() }
    }

    /// The elements at the scattering angle whose cosine and sine these are.
    pub fn at(&self, cos: f64, sin: f64) -> PhaseElements {
        let x = sin.atan2(cos) / PI * STEPS as f64;
        let first = (x.floor() as usize).saturating_sub(1).min(STEPS - 3);
        let t = x - first as f64;
        let (a, b, c, d) = (t, t - 1.0, t - 2.0, t - 3.0);
        let weights = [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0];
        let mut sum = [0.0; 6];
        for (values, weight) in self.values[first..first + 4].iter().zip(weights) {
            for (s, value) in sum.iter_mut().zip(values) {
                *s += weight * value;
            }
        }
        sum
    }
}
