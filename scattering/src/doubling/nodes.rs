//! Directions that all media of a stack share: nodes in the tangential index κ = n sin θ.
//!
//! The range of κ is split at every index 1 < n_a < n_b < …. A medium of index n has all nodes with
//! κ < n, and a node is the same ray in every medium. Up to κ = 1 the nodes are Gauss–Legendre nodes in
//! the cosine outside; from a to b they are Gauss–Legendre nodes in t, κ² = a² + (b² − a²) sin²t. Fresnel
//! coefficients and cosines are analytic in these, so that integrals converge exponentially. In a
//! medium μ = √(n² − κ²)/n and w = κdκ/(n²μ), Σ 2μw = 1.

use std::f64::consts::FRAC_PI_2;

use crate::special::gauss;

/// Indices closer than this (relative) have no nodes between them.
const SAME: f64 = 1e-9;

/// The nodes of a stack.
#[derive(Clone, Debug)]
pub struct RayNodes {
    rays: Vec<RayNode>,
}

/// One node.
#[derive(Clone, Copy, Debug)]
struct RayNode {
    /// b², the square of the index at the upper end of its segment.
    end: f64,
    /// b² − κ².
    gap: f64,
    /// κdκ.
    weight: f64,
}

/// The nodes inside a medium.
#[derive(Clone, Debug)]
pub struct MediumDirections {
    /// Index of the medium.
    pub n: f64,
    /// Cosines inside, positive.
    pub mu: Vec<f64>,
    /// Weights in μ.
    pub w: Vec<f64>,
}

impl RayNodes {
    /// Nodes for media of the `indices` (each at least 1): `outside` up to κ = 1, `trapped` in
    /// each further segment; `extra` cosines outside get the weight 10⁻⁸.
    pub fn new(indices: &[f64], outside: usize, trapped: usize, extra: &[f64]) -> Self {
        let mut ends: Vec<f64> = indices.iter().copied().filter(|n| *n > 1.0 + SAME).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|b, a| *b - *a <= SAME * *a);
        let first = gauss::legendre(outside, 0.0, 1.0).into_iter().rev();
        let extra = extra.iter().map(|mu| (*mu, 1e-8));
        let ray = |(mu, w): (f64, f64)| RayNode { end: 1.0, gap: mu * mu, weight: mu * w };
        let mut rays: Vec<RayNode> = first.chain(extra).map(ray).collect();
        let mut a = 1.0;
        for b in ends {
            let span = b * b - a * a;
            let rule = gauss::legendre(trapped, 0.0, FRAC_PI_2);
            let sum: f64 = rule.iter().map(|(t, w)| w * t.sin() * t.cos()).sum();
            rays.extend(rule.into_iter().map(|(t, w)| RayNode {
                end: b * b,
                gap: span * t.cos().powi(2),
                weight: 0.5 * span * w * t.sin() * t.cos() / sum,
            }));
            a = b;
        }
        Self { rays }
    }

    /// The nodes inside a medium of index `n`, the first ones of all.
    pub fn inside(&self, n: f64) -> MediumDirections {
        let n2 = n * n;
        let own = |ray: &&RayNode| ray.end <= n2 * (1.0 + 3.0 * SAME);
        let squares: Vec<(f64, f64)> = self
            .rays
            .iter()
            .take_while(own)
            .map(|ray| ((n2 - ray.end).max(0.0) + ray.gap, ray.weight))
            .collect();
        let mu: Vec<f64> = squares.iter().map(|(q2, _)| q2.sqrt() / n).collect();
        let w = squares.iter().zip(&mu).map(|((_, weight), mu)| weight / (n2 * mu)).collect();
        MediumDirections { n, mu, w }
    }

    /// The node `i` alone.
    pub fn only(&self, i: usize) -> Self {
        Self { rays: vec![self.rays[i]] }
    }

    /// κ of node `i`.
    pub fn kappa(&self, i: usize) -> f64 {
        let ray = &self.rays[i];
        (ray.end - ray.gap).max(0.0).sqrt()
    }

    /// √(n² − κ²) of node `i`, and whether it is imaginary.
    pub fn normal_index(&self, i: usize, n: f64) -> (f64, bool) {
        let ray = &self.rays[i];
        let square = (n * n - ray.end) + ray.gap;
        (square.abs().sqrt(), square < 0.0)
    }

    /// The number of all nodes.
    pub fn len(&self) -> usize {
        self.rays.len()
    }

    /// True when there is no node.
    pub fn is_empty(&self) -> bool {
        self.rays.is_empty()
    }
}

impl MediumDirections {
    /// The number of nodes per hemisphere.
    pub fn len(&self) -> usize {
        self.mu.len()
    }

    /// True when no node propagates in the medium.
    pub fn is_empty(&self) -> bool {
        self.mu.is_empty()
    }

    /// √(w/μ) of node `i`.
    pub fn q(&self, i: usize) -> f64 {
        (self.w[i] / self.mu[i]).sqrt()
    }

    /// √(μw) of node `i`.
    pub fn root_flux(&self, i: usize) -> f64 {
        (self.w[i] * self.mu[i]).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_medium_has_a_whole_hemisphere() {
        let nodes = RayNodes::new(&[1.5, 1.33, 1.0, 1.5], 8, 6, &[]);
        assert_eq!(nodes.len(), 20);
        for (n, count) in [(1.0, 8), (1.33, 14), (1.5, 20)] {
            let inside = nodes.inside(n);
            assert_eq!(inside.len(), count);
            let flux: f64 = inside.mu.iter().zip(&inside.w).map(|(mu, w)| 2.0 * mu * w).sum();
            assert!((flux - 1.0).abs() < 1e-14, "{n}: {flux}");
        }
    }

    #[test]
    fn internal_reflectance_converges_exponentially() {
        // Internal diffuse reflectance of n = 1.5: 0.596345759…
        for (outside, trapped, tolerance) in [(8, 6, 1e-8), (14, 10, 2e-9)] {
            let inside = RayNodes::new(&[1.5], outside, trapped, &[]).inside(1.5);
            let passed: f64 = (0..outside)
                .map(|i| {
                    let (mu, w) = (inside.mu[i], inside.w[i]);
                    let outer = (1.0 - 2.25 * (1.0 - mu * mu)).sqrt();
                    let s = (1.5 * mu - outer) / (1.5 * mu + outer);
                    let p = (mu - 1.5 * outer) / (mu + 1.5 * outer);
                    2.0 * mu * w * (1.0 - 0.5 * (s * s + p * p))
                })
                .sum();
            assert!((1.0 - passed - 0.596_345_759_7).abs() < tolerance, "{}", 1.0 - passed);
        }
    }
}
