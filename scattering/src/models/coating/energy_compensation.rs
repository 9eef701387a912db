//! Compensation of the light that is lost between rough interfaces of a coating.
//!
//! A rough interface sends light into all directions; the part that meets another interface is not
//! followed. Without absorption, all light that is neither sent out nor transmitted,
//!
//! $$ \mathbf m = (1, 0) - \mathbf p - \mathbf r - \sum_j \mathbf p_j \mathbf x_j, \qquad (1) $$
//! $$ \mathbf x_j = \int \mathbf p_j(\theta_s)\,\mathbf F_j\cos\theta_s\,d\Omega_s \qquad (2) $$
//!
//! is taken as diffuse light that reaches the body. Here p is the transmission of all layers, r the
//! reflection of smooth interfaces, p_j the transmission of the layers above the rough interface j,
//! and x_j the part of the light of that interface that leaves through them.
//!
//! By reciprocity the fraction 1 − ρ = ∫(p + m) sin 2θ dθ/n² of diffuse light from the body leaves
//! the coating; over a white body no light is lost. Absorption attenuates m like a ray on its way down.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::{
    coat::{Absorption, CoatLayer, LayersAbove},
    directional_albedo::{DirectionalAlbedo, ErrorSign},
    interface::{InterfaceRay, realizable},
};
use crate::{Direction, Incidence, special::gauss};

/// Nodes of the integral over diffuse light.
const NODES: usize = 96;
/// Azimuths of the integral over diffuse light: more than the orders of the tables.
const AZIMUTHS: usize = 24;

/// Fraction of the light of each rough interface that leaves the layers.
pub(super) struct EnergyCompensation {
    /// x_j of (2) for the rough interfaces below others.
    seen: Vec<Option<DirectionalAlbedo>>,
}

impl EnergyCompensation {
    /// `None` if all interfaces are smooth, or if films absorb part of the missing light.
    pub(super) fn new(coats: &[CoatLayer]) -> Option<Self> {
        let rough = coats.iter().any(|coat| coat.interface.is_rough());
        if !rough || coats.iter().any(|coat| coat.interface.absorbs()) {
            return None;
        }
        Some(Self { seen: (0..coats.len()).map(|j| seen(&coats[..j], &coats[j])).collect() })
    }

    /// ρ without absorption.
    pub(super) fn sent_back(&self, coats: &[CoatLayer]) -> f64 {
        let n = coats.last().map_or(1.0, |coat| coat.n);
        let out = gauss::integrate(NODES, 0.0, FRAC_PI_2, |t| {
            let whole = (0..AZIMUTHS).map(|k| {
                let (sin_2r, cos_2r) = (TAU * k as f64 / AZIMUTHS as f64).sin_cos();
                let ray = InterfaceRay { turn: (cos_2r, sin_2r), ..InterfaceRay::mean(t.sin()) };
                let (passes, missing, _) = self.follow(coats, ray);
                passes[0] + missing[0]
            });
            whole.sum::<f64>() / AZIMUTHS as f64 * (2.0 * t).sin()
        });
        (1.0 - out / (n * n)).max(0.0)
    }

    /// Adds m of (1) to `row`, the transmission of all layers for `ray`.
    pub(super) fn add(&self, row: &mut [f64; 4], coats: &[CoatLayer], ray: InterfaceRay) {
        let (_, missing, left) = self.follow(coats, ray);
        for (x, m) in row.iter_mut().zip(missing) {
            *x += left * m;
        }
    }

    /// (p, m, transmittance of m) of a ray; see (1).
    fn follow(&self, coats: &[CoatLayer], mut ray: InterfaceRay) -> ([f64; 4], [f64; 4], f64) {
        let mut above = LayersAbove::NOTHING;
        let mut missing = [1.0, 0.0, 0.0, 0.0];
        let mut left = 1.0;
        let mut lessen = |by: [f64; 4]| {
            for (m, x) in missing.iter_mut().zip(by) {
                *m -= x;
            }
        };
        for (coat, seen) in coats.iter().zip(&self.seen) {
            if coat.interface.is_rough() {
                let out = match seen {
                    None => coat.interface.returned(&ray),
                    Some(seen) => seen.at(ray.sin.min(1.0).asin(), ray.turn.0, ray.turn.1),
                };
                lessen(above.passes.before(out));
            }
            let below = ray.below(coat.interface.n);
            above = coat.add(above, &ray, below.cos, Absorption::Clear);
            left *= coat.left(below.cos, Absorption::Lossy);
            ray = below;
        }
        lessen(above.mirrored.row());
        let passes = above.passes.row();
        lessen(passes);
        (passes, realizable(missing), left)
    }
}

/// Fraction of the light of the rough interface of `coat` that leaves through the layers `above`.
fn seen(above: &[CoatLayer], coat: &CoatLayer) -> Option<DirectionalAlbedo> {
    let (facets, slopes) = (coat.interface.facets()?, coat.interface.slopes()?);
    let n = above.last()?.n;
    let rows = |at: &Incidence, to: &Direction| {
        let inside = InterfaceRay::reversed(at, to);
        let sin = inside.sin * n;
        if sin >= 1.0 {
            return [[0.0; 4]];
        }
        let mut ray = InterfaceRay { turn: inside.turn, ..InterfaceRay::mean(sin) };
        let mut passed = LayersAbove::NOTHING;
        for coat in above {
            let below = ray.below(coat.interface.n);
            passed = coat.add(passed, &ray, below.cos, Absorption::Clear);
            ray = below;
        }
        let (out, up) = (passed.passes.row(), facets.mueller(at, to).0);
        [std::array::from_fn(|j| out[0] * up[0][j] + out[1] * up[1][j])]
    };
    let edge = Some(1.0 / n);
    let [seen] =
        DirectionalAlbedo::tabulate(slopes, &rows, &|_| [[0.0; 4]], (edge, [ErrorSign::Large]));
    Some(seen)
}
