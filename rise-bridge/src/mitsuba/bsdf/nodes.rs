//! The nodes of a table around a pair of directions.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

/// The nodes of a table: viewers, and pixels per side of an image.
pub(super) struct BsdfGrid<'a> {
    pub(super) theta_i: &'a [f64],
    pub(super) phi_i: &'a [f64],
    pub(super) side: usize,
}

impl BsdfGrid<'_> {
    /// The coordinate of the half vector's polar angle, and the nodes (φ_i, θ_i, y, x) around a pair
    /// of directions with their weights; none below the horizon.
    pub(super) fn around(
        &self,
        to_light: DVec3,
        to_viewer: DVec3,
    ) -> Option<(f64, impl Iterator<Item = ([usize; 4], f64)> + use<>)> {
        let m = (to_light + to_viewer).try_normalize()?;
        if to_light.z <= 0.0 || to_viewer.z <= 0.0 {
            return None;
        }
        let polar = |w: DVec3| w.x.hypot(w.y).atan2(w.z);
        let (phi_i, phi_m) = (to_viewer.y.atan2(to_viewer.x), m.y.atan2(m.x));
        let azimuth = if self.phi_i.len() == 1 { phi_m - phi_i } else { phi_m };
        let u = (polar(m) / FRAC_PI_2).sqrt();
        let w = ((azimuth + PI) / TAU).rem_euclid(1.0);
        let last = (self.side - 1) as f64;
        let pixel = |x: f64| {
            let at = (x * last).clamp(0.0, last);
            let low = (at as usize).min(self.side - 2);
            (low, low + 1, at - low as f64)
        };
        let axes = [
            interval(self.phi_i, phi_i),
            interval(self.theta_i, polar(to_viewer)),
            pixel(w),
            pixel(u),
        ];
        let node = move |bits: usize| {
            let picked: [(usize, f64); 4] = std::array::from_fn(|k| {
                let (low, high, part) = axes[k];
                if bits >> k & 1 == 1 { (high, part) } else { (low, 1.0 - part) }
            });
            (picked.map(|side| side.0), picked.iter().map(|side| side.1).product::<f64>())
        };
        Some((u, (0..16).map(node).filter(|(_, weight)| *weight > 0.0)))
    }
}

/// The nodes below and above `x`, and its fraction between them; clamped at the ends.
fn interval(nodes: &[f64], x: f64) -> (usize, usize, f64) {
    if nodes.len() < 2 {
        return (0, 0, 0.0);
    }
    let high = nodes.partition_point(|node| *node < x).clamp(1, nodes.len() - 1);
    let part = (x - nodes[high - 1]) / (nodes[high] - nodes[high - 1]);
    (high - 1, high, part.clamp(0.0, 1.0))
}

/// The value of evenly spaced `nodes` at `x` in 0 … 1.
pub(super) fn linear(nodes: &[f32], x: f64) -> f32 {
    let at = x.clamp(0.0, 1.0) * (nodes.len() - 1) as f64;
    let low = (at as usize).min(nodes.len().saturating_sub(2));
    let part = (at - low as f64) as f32;
    let high = (low + 1).min(nodes.len() - 1);
    nodes[low] * (1.0 - part) + nodes[high] * part
}
