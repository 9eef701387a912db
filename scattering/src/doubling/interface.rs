//! A smooth interface with coherent films between two media.
//!
//! It is diagonal in the nodes and the same for all modes: R = M(diag(r_s, r_p)) and
//! T = M(diag(t_s, t_p)) with t = 2√(Y₀Y_t)/(X + Z), so that |t|² is a transmittance. With the
//! admittances Y = q (s), q/n² (p), q = √(n² − κ²), and δ = 2πtq/λ a film carries (1, Y_t) by
//!
//! $$ F e^{i\delta} = \frac12\begin{pmatrix} 1+e^{2i\delta} & (1-e^{2i\delta})/Y \\
//!    (1-e^{2i\delta})\,Y & 1+e^{2i\delta} \end{pmatrix}, \qquad r = \frac{X-Z}{X+Z} $$
//!
//! (X, Z) = (v₁Y₀, v₂) of the product v. Beyond the critical angle |r| = 1 and the phase of
//! r_p r_s* turns U into V. M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999), 1.5, 1.6.

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::{
    block::{Stokes4, TransferBlock},
    nodes::RayNodes,
    operator::LayerOperator,
};
use crate::{Jones, optics::film::decaying_root};

const I: Complex64 = Complex64::I;
const ONE: Complex64 = Complex64::ONE;
/// Smaller normal indices of a film count as this one.
const LEAST: f64 = 1e-9;

/// Films between two media; the first one lies on the lower medium.
#[derive(Clone, Debug, Default)]
pub struct SmoothFace {
    /// (index, thickness over wavelength) of each film.
    pub films: Vec<(Complex64, f64)>,
}

/// Normal index q and square of the index of a medium.
#[derive(Clone, Copy)]
struct FaceSide {
    q: Complex64,
    epsilon: Complex64,
}

impl SmoothFace {
    /// The interface from a medium of index `above` to one of index `below`.
    pub fn operator(
        &self,
        block: TransferBlock,
        nodes: &RayNodes,
        above: f64,
        below: f64,
    ) -> LayerOperator {
        let (up, down) = (nodes.inside(above).len(), nodes.inside(below).len());
        let both = up.min(down);
        let side = |i: usize, n: f64| {
            let (q, imaginary) = nodes.normal_index(i, n);
            FaceSide { q: if imaginary { I * q } else { q.into() }, epsilon: (n * n).into() }
        };
        let meets = |i: usize, from_above: bool| {
            let (a, b) = (side(i, above), side(i, below));
            let kappa2 = nodes.kappa(i).powi(2).into();
            if from_above {
                self.amplitudes(kappa2, a, b, self.films.iter())
            } else {
                self.amplitudes(kappa2, b, a, self.films.iter().rev())
            }
        };
        let part = |i: usize, from_above: bool, which: usize| -> Stokes4 {
            let [s, p] = meets(i, from_above)[which];
            Jones::diagonal(s, p).mueller().0
        };
        LayerOperator {
            r_down: block.diagonal((up, up, up), |i| part(i, true, 0)),
            t_down: block.diagonal((down, up, both), |i| part(i, true, 1)),
            r_up: block.diagonal((down, down, down), |i| part(i, false, 0)),
            t_up: block.diagonal((up, down, both), |i| part(i, false, 1)),
        }
    }

    /// Reflection at a substrate of any index below a medium of index `above`, at node `i`.
    pub fn mirror(&self, nodes: &RayNodes, i: usize, above: f64, substrate: Complex64) -> Stokes4 {
        let (q, _) = nodes.normal_index(i, above);
        let kappa2 = Complex64::from(nodes.kappa(i).powi(2));
        let epsilon = substrate * substrate;
        let exit = FaceSide { q: decaying_root(epsilon - kappa2), epsilon };
        let entry = FaceSide { q: q.into(), epsilon: (above * above).into() };
        let [[s, p], _] = self.amplitudes(kappa2, entry, exit, self.films.iter());
        Jones::diagonal(s, p).mueller().0
    }

    /// [[r_s, r_p], [t_s, t_p]] of a facet met at the cosine `cos` from a medium of index `above`.
    pub fn facet(&self, cos: f64, above: f64, below: Complex64) -> [[Complex64; 2]; 2] {
        let kappa2 = Complex64::from(above * above * (1.0 - cos * cos));
        let epsilon = below * below;
        let exit = FaceSide { q: decaying_root(epsilon - kappa2), epsilon };
        let entry = FaceSide { q: (above * cos).into(), epsilon: (above * above).into() };
        self.amplitudes(kappa2, entry, exit, self.films.iter())
    }

    /// The same for light from below, at the cosine `cos` there.
    pub fn facet_from_below(&self, cos: f64, above: f64, below: f64) -> [[Complex64; 2]; 2] {
        let kappa2 = Complex64::from(below * below * (1.0 - cos * cos));
        let epsilon = Complex64::from(above * above);
        let exit = FaceSide { q: decaying_root(epsilon - kappa2), epsilon };
        let entry = FaceSide { q: (below * cos).into(), epsilon: (below * below).into() };
        self.amplitudes(kappa2, entry, exit, self.films.iter().rev())
    }

    /// [[r_s, r_p], [t_s, t_p]]; `films` from the exit to the entry.
    fn amplitudes<'a>(
        &self,
        kappa2: Complex64,
        entry: FaceSide,
        exit: FaceSide,
        films: impl Iterator<Item = &'a (Complex64, f64)> + Clone,
    ) -> [[Complex64; 2]; 2] {
        let mut found = [[ONE; 2]; 2];
        for p in 0..2 {
            let admittance = |side: FaceSide| if p == 1 { side.q / side.epsilon } else { side.q };
            let (y0, yt) = (admittance(entry), admittance(exit));
            let (mut v, mut phase) = ([ONE, yt], ONE);
            for (index, thickness) in films.clone() {
                let epsilon = index * index;
                let q = decaying_root(epsilon - kappa2);
                let q = if q.norm() < LEAST { LEAST.into() } else { q };
                let y = admittance(FaceSide { q, epsilon });
                let factor = (I * q * (TAU * thickness)).exp();
                let double = factor * factor;
                let (sum, difference) = (0.5 * (ONE + double), 0.5 * (ONE - double));
                v = [v[0] * sum + v[1] * difference / y, v[0] * difference * y + v[1] * sum];
                phase *= factor;
            }
            let (x, z) = (v[0] * y0, v[1]);
            found[0][p] = (x - z) / (x + z);
            let flux = (y0.re * yt.re).max(0.0).sqrt();
            found[1][p] = phase * (2.0 * flux) / (x + z);
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(operator: &LayerOperator, from_above: bool, j: usize) -> f64 {
        let (r, t) = if from_above {
            (&operator.r_down, &operator.t_down)
        } else {
            (&operator.r_up, &operator.t_up)
        };
        let sum = |m: &super::super::block::RealMatrix| {
            (0..m.nrows()).step_by(2).map(|i| m[(i, j)]).sum::<f64>()
        };
        sum(r) + sum(t)
    }

    #[test]
    fn films_without_loss_close_the_balance_from_both_sides() {
        let nodes = RayNodes::new(&[1.5], 10, 8, &[]);
        let coated = SmoothFace { films: vec![(1.38.into(), 0.18), (2.3.into(), 0.4)] };
        let operator = coated.operator(TransferBlock::Intensity, &nodes, 1.0, 1.5);
        for j in 0..operator.r_up.ncols() {
            let expected = if j % 2 == 0 { 1.0 } else { 0.0 };
            assert!((columns(&operator, false, j) - expected).abs() < 1e-14, "{j}");
            if j < operator.r_down.ncols() {
                assert!((columns(&operator, true, j) - expected).abs() < 1e-14, "{j}");
            }
        }
        let reversed = TransferBlock::Intensity.reversed(&operator.t_up);
        assert!(super::super::block::norm(&(reversed - operator.t_down)) < 1e-14);
    }

    #[test]
    fn an_interface_between_equal_media_is_not_there() {
        let nodes = RayNodes::new(&[1.5], 6, 5, &[]);
        let operator = SmoothFace::default().operator(TransferBlock::Mode(1), &nodes, 1.5, 1.5);
        let n = operator.r_up.nrows();
        let nothing = LayerOperator::nothing(n);
        assert!(super::super::block::norm(&(operator.t_down - nothing.t_down)) < 1e-15);
        assert!(super::super::block::norm(&operator.r_down) < 1e-15);
    }
}
