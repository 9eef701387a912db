//! The T-matrix of a spheroid about its centre, by the extended boundary condition with twice the
//! digits of `f64`.
//!
//! The matrices **Q** and **Q**⁰ are those of [`ebcm`](super::ebcm). The leading terms of the integrals of
//! outgoing waves of a high l with waves inside of a low one cancel on a spheroid, to 10⁻²⁰ of
//! themselves and less for long, flat or large ones: with `f64` the rest is noise, and the inverse
//! of **Q** spreads it. Here nodes, functions, sums and elimination have 31 digits. Only half the
//! meridian is integrated: the mirror symmetry makes J_MM and J_NN vanish for even l + l', J_MN and J_NM for
//! odd, and parts every system in two.
//!
//! P. C. Waterman, Phys. Rev. D 3, 825 (1971); W. R. C. Somerville, B. Auguié and E. C. Le Ru, J. Quant.
//! Spectrosc. Radiat. Transf. 113, 524 (2012), on the cancellation.

use num_complex::Complex64;

use self::waves::{Angular, Radial};
use super::{ComplexMatrix, TMatrix, is_finite};
use crate::{
    shape::Spheroid,
    special::{
        extended::{Extended, ExtendedComplex, ExtendedRow, solve},
        harmonics::Harmonics,
    },
};

mod waves;

/// Size of a block, relative to the largest one, below which it and those of higher orders are 0.
const NOTHING: f64 = 1e-30;

impl TMatrix {
    /// The matrix of a spheroid of this relative index, `k` 1/µm around it, by `nodes` nodes from its pole to its
    /// equator; nothing if the multipoles overflow.
    pub fn of_spheroid(
        spheroid: Spheroid,
        index: Complex64,
        k: f64,
        (l_max, m_max): (usize, usize),
        nodes: usize,
    ) -> Option<Self> {
        let surface = SpheroidSurface::new(spheroid, index, k, l_max, nodes);
        let mut blocks: Vec<ComplexMatrix> = Vec::new();
        let mut largest = 0.0f64;
        for m in 0..=m_max {
            let block = surface.block(m)?;
            let size = block.squared_norm_l2();
            largest = largest.max(size);
            blocks.push(block);
            if m > 1 && size < NOTHING * NOTHING * largest {
                break;
            }
        }
        Some(Self { l_max, blocks })
    }
}

/// The waves of one order m at the nodes, each a product of its radial and its angular function.
struct Waves {
    /// z μ, z τ, (kr z)' μ/kr and (kr z)' τ/kr + r'/r l(l+1) z P̃/kr inside, with the element of area.
    inside: [Vec<InsideRow>; 4],
    /// z τ, z μ, (kr z)' μ/kr and (kr z)' τ/kr + r'/r l(l+1) z P̃/kr outside, regular and irregular.
    outside: [[Vec<ExtendedRow>; 4]; 2],
}

/// A function inside at all nodes: its real part, and its imaginary one unless the index is real.
struct InsideRow(ExtendedRow, Option<ExtendedRow>);

/// The surface with everything that does not depend on the order.
struct SpheroidSurface {
    index: ExtendedComplex,
    l_max: usize,
    radial: Radial,
    angular: Angular,
    /// One over the size of the radial functions inside and outgoing, by l.
    scales: Vec<(f64, f64)>,
}

impl SpheroidSurface {
    fn new(spheroid: Spheroid, index: Complex64, k: f64, l_max: usize, nodes: usize) -> Self {
        let points = waves::points(spheroid, k, nodes);
        let radial = Radial::new(&points, index.into(), l_max);
        let angular = Angular::new(points);
        let scales = (0..=l_max).map(|l| radial.scales(l)).collect();
        Self { index: index.into(), l_max, radial, angular, scales }
    }

    /// T_m.
    fn block(&self, m: usize) -> Option<ComplexMatrix> {
        let l_min = Harmonics::l_min(m);
        let size = self.l_max + 1 - l_min;
        let waves = self.waves(m);
        let mut t = ComplexMatrix::zeros(2 * size, 2 * size);
        for parity in 0..2 {
            // (kind, l) with kind 0 for M and 1 for N.
            let kept: Vec<(usize, usize)> = (0..2 * size)
                .map(|at| (at / size, l_min + at % size))
                .filter(|(kind, l)| (l - l_min + kind) % 2 == parity)
                .collect();
            let mut q = vec![vec![ExtendedComplex::ZERO; kept.len()]; kept.len()];
            let mut q0 = q.clone();
            for (row, &outer) in kept.iter().enumerate() {
                crate::interrupt::check();
                for (column, &inner) in kept.iter().enumerate() {
                    // X Q = Q⁰, transposed.
                    (q[column][row], q0[column][row]) = self.element(&waves, l_min, outer, inner);
                }
            }
            let x = solve(q, q0)?;
            for (row, &(to_kind, to)) in kept.iter().enumerate() {
                for (column, &(from_kind, from)) in kept.iter().enumerate() {
                    // From (M, N) to (e, h) = (kN, ikM), and from normalized waves to ours.
                    let turn = match (to_kind, from_kind) {
                        (1, 0) => Complex64::I,
                        (0, 1) => -Complex64::I,
                        _ => Complex64::ONE,
                    };
                    let norm = ((from * (from + 1)) as f64 / (to * (to + 1)) as f64).sqrt();
                    let at = |kind: usize, l: usize| (1 - kind) * size + l - l_min;
                    t[(at(to_kind, to), at(from_kind, from))] =
                        -turn * x[column][row].to_c64() * (norm * self.scales[from].1);
                }
            }
        }
        is_finite(&t).then_some(t)
    }

    /// The elements of Q and Q⁰ between the wave `outer` outside and `inner` inside, scaled.
    fn element(
        &self,
        waves: &Waves,
        l_min: usize,
        (outer_kind, l): (usize, usize),
        (inner_kind, inner): (usize, usize),
    ) -> (ExtendedComplex, ExtendedComplex) {
        let (of_inside, of_outside) = (self.scales[inner].0, self.scales[l].1);
        let normal = Extended::from((l * (l + 1)) as f64 * (inner * (inner + 1)) as f64).sqrt();
        let normal = Extended::from(of_inside) / normal;
        let [regular, irregular] = [0, 1].map(|which| {
            let at = (l - l_min, inner - l_min);
            let sum = |pairs| waves.integral(which, at, pairs);
            let magnetic = outer_kind == 0;
            let value = if outer_kind == inner_kind {
                // J_MN = a·sm + b·g, J_NM = −(c·zm + f·zt).
                let (mn, nm) = (sum([(0, 2), (1, 3)]), -sum([(2, 1), (3, 0)]));
                if magnetic { self.index * nm + mn } else { self.index * mn + nm }
            } else {
                // J_MM = −i(a·zt + b·zm), J_NN = −i(c·g + f·sm).
                let (mm, nn) = (sum([(0, 0), (1, 1)]), sum([(2, 3), (3, 2)]));
                -if magnetic { self.index * mm + nn } else { self.index * nn + mm }.turned()
            };
            value.times(normal)
        });
        // ζ = ψ − iχ.
        let outgoing = regular - irregular.turned();
        (outgoing.times(of_outside.into()), regular)
    }

    fn waves(&self, m: usize) -> Waves {
        let angular = self.angular.order(m, self.l_max);
        let radial = &self.radial;
        let nodes = || 0..radial.points();
        let is_real = self.index.im == Extended::ZERO;
        let by_l = |of: &dyn Fn(usize, usize) -> ExtendedComplex| -> Vec<InsideRow> {
            let row = |row: usize| {
                let values: Vec<ExtendedComplex> = nodes().map(|node| of(row, node)).collect();
                let imaginary = (!is_real).then(|| values.iter().map(|z| z.im).collect());
                InsideRow(values.iter().map(|z| z.re).collect(), imaginary)
            };
            (0..angular.len()).map(row).collect()
        };
        let real_by_l = |of: &dyn Fn(usize, usize) -> Extended| -> Vec<ExtendedRow> {
            let row = |row: usize| nodes().map(|node| of(row, node)).collect();
            (0..angular.len()).map(row).collect()
        };
        let l_min = Harmonics::l_min(m);
        let along = |l: usize| Extended::from((l * (l + 1)) as f64);
        let inside = |row: usize, node: usize| radial.inside(l_min + row, node);
        let at = |row: usize, node: usize| &angular[row][node];
        let f = |row, node| {
            let (z, a) = (inside(row, node), at(row, node));
            z.slope.times(a.tau) + z.over.times(a.leaning * along(l_min + row))
        };
        let inside = [
            by_l(&|row, node| inside(row, node).z.times(at(row, node).mu)),
            by_l(&|row, node| inside(row, node).z.times(at(row, node).tau)),
            by_l(&|row, node| inside(row, node).slope.times(at(row, node).mu)),
            by_l(&f),
        ];
        let outside = [0, 1].map(|which| {
            let outside = |row: usize, node: usize| radial.outside(which, l_min + row, node);
            let g = |row, node| {
                let (z, a) = (outside(row, node), at(row, node));
                z.slope * a.tau + z.over * (a.leaning * along(l_min + row))
            };
            [
                real_by_l(&|row, node| outside(row, node).z * at(row, node).tau),
                real_by_l(&|row, node| outside(row, node).z * at(row, node).mu),
                real_by_l(&|row, node| outside(row, node).slope * at(row, node).mu),
                real_by_l(&g),
            ]
        });
        Waves { inside, outside }
    }
}

impl Waves {
    /// Σ over the nodes of the products of these pairs of functions inside and outside.
    fn integral(
        &self,
        which: usize,
        (row, column): (usize, usize),
        pairs: [(usize, usize); 2],
    ) -> ExtendedComplex {
        let mut total = ExtendedComplex::ZERO;
        for (of_inside, of_outside) in pairs {
            let InsideRow(re, im) = &self.inside[of_inside][column];
            let outside = &self.outside[which][of_outside][row];
            let im = im.as_ref().map_or(Extended::ZERO, |im| im.dot(outside));
            total = total + ExtendedComplex::new(re.dot(outside), im);
        }
        total
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{scatterer::layered, shape::ellipsoid, tmatrix::converged::distance};

    fn spheroid(vertical: f64, horizontal: f64) -> Spheroid {
        Spheroid { vertical, horizontal }
    }

    fn difference(a: &TMatrix, b: &TMatrix) -> f64 {
        distance(a.blocks.iter().enumerate(), b.blocks.iter().enumerate())
    }

    #[test]
    fn a_round_one_has_the_coefficients_of_mie() {
        for (index, x) in [((1.6, 0.1), 2.0), ((1.001, 0.0), 20.0), ((0.2, 3.5), 9.0)] {
            let index = Complex64::new(index.0, index.1);
            let t = TMatrix::of_spheroid(spheroid(x, x), index, 1.0, (30, 30), 60).unwrap();
            let mie = TMatrix::sphere(&layered::coefficients(&[(index, x)], 30));
            let difference = difference(&t, &mie);
            assert!(difference < 1e-12, "{index} {x}: {difference:e}");
        }
    }

    #[test]
    fn moderate_ones_have_the_matrix_of_the_general_body() {
        let index = Complex64::new(1.5, 0.02);
        for (v, h) in [(1.5, 1.0), (1.0, 1.6)] {
            let body = ellipsoid::sampled(200, v, h, 0.0);
            let expected = TMatrix::of_revolution(&body, index, 1.0, 8, 8).unwrap();
            let got = TMatrix::of_spheroid(spheroid(v, h), index, 1.0, (8, 8), 60).unwrap();
            let difference = difference(&got, &expected);
            assert!(difference < 1e-11, "{v} {h}: {difference:e}");
        }
    }

    #[test]
    fn long_and_flat_ones_take_from_the_beam_what_they_scatter() {
        for (v, h) in [(10.0, 1.0), (1.0, 8.0), (12.0, 3.0), (4.0, 4.4)] {
            let index = Complex64::new(1.59, 0.0);
            let t = TMatrix::of_spheroid(spheroid(v, h), index, 1.0, (28, 28), 120).unwrap();
            let (mut extinction, mut scattering) = (0.0, 0.0);
            for (m, block) in t.blocks.iter().enumerate() {
                let (degeneracy, size) = (if m == 0 { 1.0 } else { 2.0 }, block.nrows() / 2);
                let l = |at: usize| Harmonics::l_min(m) + at % size;
                let strength = |at: usize| (l(at) * (l(at) + 1)) as f64;
                for column in 0..2 * size {
                    extinction -= degeneracy * block[(column, column)].re;
                    for row in 0..2 * size {
                        let weight = degeneracy * strength(row) / strength(column);
                        scattering += weight * block[(row, column)].norm_sqr();
                    }
                }
            }
            let relative = extinction / scattering - 1.0;
            assert!(relative.abs() < 1e-6, "{v} {h}: {relative:e}");
        }
    }
}
