//! All bounces of light at a rough interface: transport in the height of the surface.
//!
//! On Smith's surface the cumulative distribution C ∈ (0, 1) of heights is uniform. Light above the
//! surface meets facets like one-sided plates in the optical depth −ln C, light below it in
//! −ln(1 − C); reflection and refraction couple both at the same C. With x = ln(C/(1 − C)) and ψ of both media together
//!
//! $$ \frac{d\psi}{d(-x)} = [(1-C)\,G_a + C\,G_b]\,\psi $$
//!
//! G_a acts on light above, G_b on light below. Extinction over μ: above 1 + Λ down and Λ up, below
//! Λ down and 1 + Λ up. Scattering: 2πZ q_i q_j, Z = M S/(4n_z⁴) of a reflection and
//! Z = (n_i/n_t) M S |c_i c_t| m²/(n_z⁴|k_i − m k_t|²) of a refraction; shadowing is the transport.
//! The range from x = 14 to −14 is cut into slices; each is an exponential of the fourth-order Magnus
//! expansion, doubled and added. Kernels are scaled so that no reflection or refraction loses
//! light, and the energy balance of the result is exact ([`energy_balance`]).
//!
//! E. Heitz et al., ACM Trans. Graph. 35, 58 (2016), for the transport; S. Blanes et al., Phys. Rep.
//! 470, 151 (2009), for the Magnus expansion.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::{
    azimuth,
    block::{RealMatrix, Stokes4, TransferBlock, joined, quarters, solved},
    energy_balance,
    facet::{PolarizedRay, mueller},
    facet_media::FacetMedia,
    operator::LayerOperator,
    scaling, slab,
};

/// Largest |x|: the fraction e^{−14} of the surface lies beyond.
const REACH: f64 = 14.0;
/// Slices.
const SLICES: usize = 24;
/// Azimuths of the kernels.
const AZIMUTHS: usize = 96;

/// Directions of both media: down above, down below, up above, up below.
struct HeightTransport<'a> {
    media: &'a FacetMedia<'a>,
    /// Nodes above, and nodes of both media together.
    above: usize,
    both: usize,
    /// Scattering of one event in every mode, ψ form.
    events: Vec<RealMatrix>,
    /// Extinction over μ, elements 00, 01, 10 of every direction.
    extinction: Vec<[f64; 3]>,
}

/// Operators of the face with all bounces, in the modes 0 … `last`.
pub(super) fn operators(media: &FacetMedia<'_>, last: usize) -> Vec<LayerOperator> {
    let transport = HeightTransport::new(media, last);
    let mut blocks: Vec<TransferBlock> = TransferBlock::all(last);
    blocks.sort_by_key(|block| block.mode());
    let solve = |block: &TransferBlock| (*block, transport.solve(*block));
    let found: Vec<(TransferBlock, LayerOperator)> = blocks.par_iter().map(solve).collect();
    let empty =
        || LayerOperator::opaque(4 * transport.above, 4 * (transport.both - transport.above));
    let mut modes: Vec<LayerOperator> = (0..=last).map(|_| empty()).collect();
    for (block, operator) in found {
        operator.into_whole(block, &mut modes[block.mode()]);
    }
    modes
}

impl<'a> HeightTransport<'a> {
    fn new(media: &'a FacetMedia<'a>, last: usize) -> Self {
        let [above, below] = media.sides.map(super::nodes::MediumDirections::len);
        let both = above + below;
        let mut transport = Self { media, above, both, events: Vec::new(), extinction: Vec::new() };
        let all = 2 * both;
        let events = azimuth::modes((all, all), last, AZIMUTHS, |i, j, turn| {
            let (into, out) = (transport.ray(j, (1.0, 0.0)), transport.ray(i, turn));
            transport.event(i, j, &into, &out)
        });
        transport.events = events;
        transport.close_events();
        transport
    }

    /// (side, node, goes up) of a direction.
    fn place(&self, k: usize) -> (usize, usize, bool) {
        let (up, k) = (k >= self.both, k % self.both);
        if k < self.above { (0, k, up) } else { (1, k - self.above, up) }
    }

    /// The reversed direction.
    fn reversed(&self, k: usize) -> usize {
        (k + self.both) % (2 * self.both)
    }

    fn ray(&self, k: usize, turn: (f64, f64)) -> PolarizedRay {
        let (side, node, up) = self.place(k);
        let mu = self.media.sides[side].mu[node];
        PolarizedRay::new(if up { mu } else { -mu }, turn)
    }

    /// 2πZ q_i q_j of one event.
    fn event(&self, i: usize, j: usize, into: &PolarizedRay, out: &PolarizedRay) -> Stokes4 {
        let ((side, node, _), (side_out, node_out, _)) = (self.place(j), self.place(i));
        let media = self.media;
        let q = TAU * media.sides[side].q(node) * media.sides[side_out].q(node_out);
        let (m, factor) = if side == side_out {
            let half = out.k - into.k;
            let size = half.length();
            // Light hits the facet from above or from below.
            let faces = if side == 0 { half.z > 0.0 } else { half.z < 0.0 };
            if !faces || size < 1e-12 {
                return [[0.0; 4]; 4];
            }
            let normal = half / size * half.z.signum();
            let density = media.slopes.density(normal);
            if !(density > 0.0) {
                return [[0.0; 4]; 4];
            }
            let [r, _] = media.coefficients(side, into.k.dot(normal).abs());
            (mueller(into, out, normal, r), 0.25 * density)
        } else {
            let Some((normal, cos, factor)) = media.refracting(side, into, out) else {
                return [[0.0; 4]; 4];
            };
            let [_, t] = media.coefficients(side, cos);
            let ratio = media.sides[side].n / media.sides[side_out].n;
            (mueller(into, out, normal, t), ratio * factor)
        };
        m.map(|row| row.map(|x| x * factor * q))
    }

    /// Flux of a unit of ψ.
    fn flux(&self, k: usize) -> f64 {
        let (side, node, _) = self.place(k);
        self.media.sides[side].n * self.media.sides[side].root_flux(node)
    }

    /// Scales the events to the extinction.
    fn close_events(&mut self) {
        let all = 2 * self.both;
        let flux: Vec<f64> = (0..all).map(|k| self.flux(k)).collect();
        let extinction: Vec<f64> = (0..all)
            .map(|k| {
                let (side, node, up) = self.place(k);
                let lambda = self.media.slopes.lambda(self.media.sides[side].mu[node]);
                if up == (side == 0) { lambda } else { 1.0 + lambda }
            })
            .collect();
        let target: Vec<f64> = extinction.iter().zip(&flux).map(|(k, e)| k * e).collect();
        let events = &self.events[0];
        // The scale of an outgoing direction is that of its reversed one.
        let s = scaling::factors(&flux, &target, |i, j| events[(4 * self.reversed(i), 4 * j)]);
        let both = self.both;
        for m in &mut self.events {
            for j in 0..4 * all {
                for i in 0..4 * all {
                    m[(i, j)] *= s[(i / 4 + both) % all] * s[j / 4];
                }
            }
        }
        let made: Vec<f64> = (0..all)
            .map(|j| {
                let part = |i: usize| flux[i] * self.events[0][(4 * i, 4 * j + 1)];
                (0..all).map(part).sum::<f64>() / flux[j]
            })
            .collect();
        self.extinction =
            (0..all).map(|k| [extinction[k], made[k], made[self.reversed(k)]]).collect();
    }

    /// (G_a, G_b) of a block.
    fn generators(&self, block: TransferBlock) -> [RealMatrix; 2] {
        let events = block.of_whole(&self.events[block.mode()]);
        let (s, n) = (block.size(), events.nrows());
        let rows = s * self.both;
        let mut g = events;
        for k in 0..2 * self.both {
            let [k00, k01, k10] = self.extinction[k];
            for c in 0..s {
                g[(s * k + c, s * k + c)] -= k00;
            }
            if block.first() == 0 {
                g[(s * k, s * k + 1)] -= k01;
                g[(s * k + 1, s * k)] -= k10;
            }
        }
        let is_above = |column: usize| column / s % self.both < self.above;
        [true, false].map(|side| {
            RealMatrix::from_fn(n, n, |i, j| {
                let sign = if i < rows { 1.0 } else { -1.0 };
                if is_above(j) == side { sign * g[(i, j)] } else { 0.0 }
            })
        })
    }

    /// The operators of the face in a block.
    fn solve(&self, block: TransferBlock) -> LayerOperator {
        let [a, b] = self.generators(block);
        let step = 2.0 * REACH / SLICES as f64;
        let offset = step * 3f64.sqrt() / 6.0;
        // The commutator of two generators (1 − C)G_a + C G_b is C₁ − C₂ times that of G_a and G_b.
        let commutator = &a * &b - &b * &a;
        let heights = |x: f64| 1.0 / (1.0 + (-x).exp());
        let mut whole: Option<LayerOperator> = None;
        for k in 0..SLICES {
            let middle = REACH - step * (k as f64 + 0.5);
            let (c1, c2) = (heights(middle + offset), heights(middle - offset));
            let mean = 0.5 * (c1 + c2);
            let omega = &a * faer::Scale(step * (1.0 - mean))
                + &b * faer::Scale(step * mean)
                + &commutator * faer::Scale(3f64.sqrt() / 12.0 * step * step * (c1 - c2));
            let slice = slice(&omega);
            whole = Some(whole.map_or_else(|| slice.clone(), |whole| whole.over(&slice)));
        }
        let whole = whole.unwrap_or_else(|| LayerOperator::nothing(a.nrows() / 2));
        self.closed(block, &whole)
    }

    /// The part between the outer sides of both media, reciprocal and with exact balance.
    fn closed(&self, block: TransferBlock, whole: &LayerOperator) -> LayerOperator {
        let (s, above) = (block.size(), block.size() * self.above);
        let [[r_down, _], _] = quarters(&whole.r_down, above, above);
        let [_, [t_down, _]] = quarters(&whole.t_down, above, above);
        let [_, [_, r_up]] = quarters(&whole.r_up, above, above);
        let [[_, t_up], _] = quarters(&whole.t_up, above, above);
        let mut x = joined([[&r_down, &t_up], [&t_down, &r_up]]);
        x = (&x + block.reversed(&x)) * faer::Scale(0.5);
        if block == TransferBlock::Intensity {
            let flux = |row: usize| if row.is_multiple_of(s) { self.flux(row / s) } else { 0.0 };
            let flux: Vec<f64> = (0..x.nrows()).map(flux).collect();
            energy_balance::restore(&mut x, &flux, &flux);
        }
        let [[r_down, t_up], [t_down, r_up]] = quarters(&x, above, above);
        LayerOperator { r_down, t_down, r_up, t_up }
    }
}

/// The operators of e^Ω.
fn slice(omega: &RealMatrix) -> LayerOperator {
    let doublings = (super::block::norm(omega) / 0.5).log2().ceil().max(0.0) as i32;
    let e = slab::exponential(&(omega * faer::Scale(0.5f64.powi(doublings))));
    let n = omega.nrows() / 2;
    let [[a, b], [c, d]] = quarters(&e, n, n);
    let t_up = solved(&d, &super::block::identity(n));
    let r_down = &t_up * &c * faer::Scale(-1.0);
    let t_down = a + &b * &r_down;
    let r_up = b * &t_up;
    let mut operator = LayerOperator { r_down, t_down, r_up, t_up };
    for _ in 0..doublings {
        operator = operator.over(&operator);
    }
    operator
}
