//! A rough interface of Gaussian facets: one reflection or refraction, and a diffuse remainder.
//!
//! [`super::facet_media`] has the kernel of one bounce. It is scaled so that every column carries the
//! power of one bounce by a quadrature over slopes: this removes the error of the nodes for narrow
//! lobes. Light that meets further facets goes into all directions of both sides by the rank-two
//! form X → X + d dᵀ/(e·d), d the power that is missing in each column. Energy and reciprocity are
//! conserved.
//!
//! K. E. Torrance and E. M. Sparrow, J. Opt. Soc. Am. 57, 1105 (1967); B. Walter et al., Proc. EGSR
//! (2007); M. I. Sancer, IEEE Trans. Antennas Propag. AP-17, 577 (1969).

use std::sync::Arc;

use super::{
    block::{RealMatrix, joined, quarters},
    facet::{PolarizedRay, mueller},
    facet_media::FacetMedia,
    heights,
    interface::SmoothFace,
    kernel_cache::{ContentKey, KernelCache},
    nodes::{MediumDirections, RayNodes},
    operator::LayerOperator,
    scaling,
    slopes::{GaussianSlopes, beta},
};

/// Points of the integrals over slopes, in slope and azimuth.
const SLOPES: (usize, usize) = (60, 64);

/// Faces of all models. A binder without dispersion and without films has one face at all
/// wavelengths, whatever its slab and the bottom are.
static FACES: KernelCache<RoughKernel> = KernelCache::new(128 << 20);

/// A face of Gaussian facets.
#[derive(Clone, Debug)]
pub struct RoughFace {
    /// Films on every facet.
    pub films: SmoothFace,
    /// Slopes.
    pub slopes: GaussianSlopes,
    /// Bounces that are followed.
    pub bounces: FacetBounces,
}

/// Light that meets further facets of a rough face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FacetBounces {
    /// The light leaves diffusely; see this module.
    First,
    /// All bounces are computed; see [`super::heights`].
    All,
}

/// Operators of a rough face in every mode.
#[derive(Clone, Debug)]
pub struct RoughKernel {
    /// All light, with rows 4·node + component.
    pub modes: Vec<LayerOperator>,
    /// One reflection from above, before the correction of the energy balance.
    pub first: Vec<RealMatrix>,
}

impl RoughFace {
    /// The face from a medium of index `above` to `below` in the modes 0 … `last`, computed once for
    /// equal faces.
    pub fn kernel(
        &self,
        nodes: &RayNodes,
        above: f64,
        below: f64,
        last: usize,
    ) -> Arc<RoughKernel> {
        let (up, down) = (nodes.inside(above), nodes.inside(below));
        FACES.get_or_compute(self.key([&up, &down], last), || {
            let kernel = self.computed(&up, &down, last);
            let bytes = kernel.bytes();
            (kernel, bytes)
        })
    }

    /// All numbers that the operators depend on.
    fn key(&self, sides: [&MediumDirections; 2], last: usize) -> ContentKey {
        let all = if self.bounces == FacetBounces::All { 1.0 } else { 0.0 };
        let mut key = ContentKey::default();
        key.extend([last as f64, all, self.slopes.sigma].into_iter());
        for (index, thickness) in &self.films.films {
            key.extend([index.re, index.im, *thickness].into_iter());
        }
        for side in sides {
            key.extend(std::iter::once(side.n));
            key.extend(side.mu.iter().copied());
            key.extend(side.w.iter().copied());
        }
        key
    }

    fn computed(&self, up: &MediumDirections, down: &MediumDirections, last: usize) -> RoughKernel {
        let media = FacetMedia { films: &self.films, slopes: self.slopes, sides: [up, down] };
        let raw = media.one_bounce(last);
        let first = raw.iter().map(|operator| operator.r_down.clone()).collect();
        let modes = match self.bounces {
            FacetBounces::First => media.closed(raw),
            FacetBounces::All => heights::operators(&media, last),
        };
        RoughKernel { modes, first }
    }
}

impl RoughKernel {
    /// Memory that it takes, bytes.
    pub fn bytes(&self) -> usize {
        let size = |m: &RealMatrix| m.nrows() * m.ncols() * size_of::<f64>();
        let operator = |o: &LayerOperator| {
            [&o.r_down, &o.t_down, &o.r_up, &o.t_up].map(size).iter().sum::<usize>()
        };
        let modes: usize = self.modes.iter().map(operator).sum::<usize>();
        modes + self.first.iter().map(size).sum::<usize>()
    }
}

impl FacetMedia<'_> {
    /// Power of one bounce, reflected and transmitted, for a unit of I at node `j` of `side`, and the
    /// row (I, Q) of the power that visible facets absorb.
    fn budget(&self, side: usize, j: usize) -> (f64, [f64; 2]) {
        let into = self.ray(side, j, false, (1.0, 0.0));
        let mu = into.k.z.abs();
        let slopes = self.slopes;
        let (own, other) = (self.sides[side].n, self.sides[1 - side].n);
        let lambda_i = slopes.lambda(mu);
        let away = into.k.z.signum();
        let (mut returned, mut absorbed) = (0.0, [0.0; 2]);
        for (normal, weight) in slopes.quadrature(SLOPES.0, SLOPES.1) {
            let cos = into.k.dot(normal);
            if cos * away <= 0.0 {
                continue;
            }
            let met = weight * cos.abs() / (normal.z * mu);
            let [r, t] = self.coefficients(side, cos.abs());
            let out = into.k - normal * (2.0 * cos);
            let m_r = mueller(&into, &PolarizedRay::along(out), normal, r);
            if out.z * away < 0.0 {
                returned += met * m_r[0][0] / (1.0 + lambda_i + slopes.lambda(out.z.abs()));
            }
            let mut left = [1.0 - m_r[0][0], -m_r[0][1]];
            // Snell's law at the facet: k_t = (k_i + (…) n̂)/m.
            let m = other / own;
            let square = m * m - 1.0 + cos * cos;
            if square > 0.0 {
                let through = (into.k + normal * (cos.signum() * square.sqrt() - cos)) / m;
                let m_t = mueller(&into, &PolarizedRay::along(through), normal, t);
                if through.z * away > 0.0 {
                    let seen = beta(lambda_i, slopes.lambda(through.z.abs().min(1.0)));
                    returned += met * m_t[0][0] * seen;
                }
                left = [left[0] - m_t[0][0], left[1] - m_t[0][1]];
            }
            for (sum, x) in absorbed.iter_mut().zip(left) {
                *sum += met * x / (1.0 + lambda_i);
            }
        }
        (returned, absorbed)
    }

    /// The operators with the light of further bounces.
    fn closed(&self, mut modes: Vec<LayerOperator>) -> Vec<LayerOperator> {
        let [up, down] = self.sides.map(MediumDirections::len);
        let all = up + down;
        let place = |k: usize| if k < up { (0, k) } else { (1, k - up) };
        let flux: Vec<f64> = (0..all)
            .map(|k| {
                let (side, node) = place(k);
                self.sides[side].n * self.sides[side].root_flux(node)
            })
            .collect();
        let budgets: Vec<(f64, [f64; 2])> = (0..all)
            .map(|k| {
                let (side, node) = place(k);
                self.budget(side, node)
            })
            .collect();
        let whole = |o: &LayerOperator| joined([[&o.r_down, &o.t_up], [&o.t_down, &o.r_up]]);
        let mut x = whole(&modes[0]);
        let target: Vec<f64> = budgets.iter().zip(&flux).map(|((r, _), e)| r * e).collect();
        let s = scaling::factors(&flux, &target, |i, j| x[(4 * i, 4 * j)]);
        let scale = |m: &mut RealMatrix, rows: usize, columns: usize| {
            for j in 0..m.ncols() {
                for i in 0..m.nrows() {
                    m[(i, j)] *= s[rows + i / 4] * s[columns + j / 4];
                }
            }
        };
        for o in &mut modes {
            scale(&mut o.r_down, 0, 0);
            scale(&mut o.t_down, up, 0);
            scale(&mut o.r_up, up, up);
            scale(&mut o.t_up, 0, up);
        }
        x = whole(&modes[0]);
        // d of the components I and Q.
        let missing: Vec<f64> = (0..4 * all)
            .map(|column| {
                let (node, c) = (column / 4, column % 4);
                if c > 1 {
                    return 0.0;
                }
                let sum: f64 = (0..all).map(|i| flux[i] * x[(4 * i, column)]).sum();
                let whole = if c == 0 { flux[node] } else { 0.0 };
                whole - budgets[node].1[c] * flux[node] - sum
            })
            .collect();
        let total: f64 = (0..all).map(|i| flux[i] * missing[4 * i]).sum();
        if total > 0.0 {
            for j in 0..4 * all {
                for i in 0..4 * all {
                    x[(i, j)] += missing[i] * missing[j] / total;
                }
            }
            let [[r_down, t_up], [t_down, r_up]] = quarters(&x, 4 * up, 4 * up);
            modes[0] = LayerOperator { r_down, t_down, r_up, t_up };
        }
        modes
    }
}
