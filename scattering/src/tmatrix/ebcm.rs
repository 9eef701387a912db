//! The T-matrix of a homogeneous body of revolution by the extended boundary condition.
//!
//! The field inside, regular waves of the index m with coefficients c, is the field of currents
//! on the surface: outside they make the incident field, v = **Q** c, and the scattered one,
//! w = −**Q**⁰ c, so that
//!
//! $$ \mathbf{T} = -\mathbf{Q}^0 \mathbf{Q}^{-1}, \qquad
//!    \mathbf{Q} = m\begin{pmatrix} J_{NM} & J_{MM} \\ J_{NN} & J_{MN} \end{pmatrix}
//!      + \begin{pmatrix} J_{MN} & J_{NN} \\ J_{MM} & J_{NM} \end{pmatrix} $$
//!
//! J_AB is the integral over the surface of n̂·(A × B), A a regular wave inside, B = M or N an
//! outgoing wave outside (a regular one in Q⁰) with the opposite order; M = ∇×(**r**u),
//! N = ∇×M/k. Rows and columns are scaled by the size of their radial functions before the
//! system is solved. Very long, flat or large bodies need more digits than there are.
//!
//! P. C. Waterman, Phys. Rev. D 3, 825 (1971); M. I. Mishchenko, L. D. Travis and A. A. Lacis,
//! *Scattering, Absorption, and Emission of Light by Small Particles* (2002), section 5.8.

use num_complex::Complex64;

use super::{ComplexMatrix, TMatrix, is_finite, solve};
use crate::{
    shape::Shape,
    special::{
        harmonics::{Harmonics, zonal},
        riccati,
    },
};

const I: Complex64 = Complex64::I;

impl TMatrix {
    /// The matrix of a body of this shape and relative index, `k` 1/µm around it; nothing if the
    /// multipoles overflow.
    pub fn of_revolution(
        shape: &Shape,
        index: Complex64,
        k: f64,
        l_max: usize,
        m_max: usize,
    ) -> Option<Self> {
        let surface = ParticleSurface::new(shape, index, k, l_max, m_max);
        let blocks = (0..=m_max).map(|m| surface.block(m)).collect::<Option<_>>()?;
        Some(Self { l_max, blocks })
    }
}

/// z, (kr z)'/kr and z/kr of one l at one node.
#[derive(Clone, Copy, Default)]
struct RadialFunctions {
    z: Complex64,
    slope: Complex64,
    over: Complex64,
}

/// Everything that the integrals need at one node.
struct BoundaryNode {
    /// r² sin θ dθ times k².
    area: f64,
    /// r'/r.
    lean: f64,
    inside: Vec<RadialFunctions>,
    outgoing: Vec<RadialFunctions>,
    regular: Vec<RadialFunctions>,
    /// (τ, μ, P̃) by order, l within it.
    angular: Vec<Vec<(f64, f64, f64)>>,
}

struct ParticleSurface {
    index: Complex64,
    l_max: usize,
    nodes: Vec<BoundaryNode>,
    /// One over the size of the radial functions inside and outgoing, by l.
    scales: Vec<(f64, f64)>,
}

impl ParticleSurface {
    fn new(shape: &Shape, index: Complex64, k: f64, l_max: usize, m_max: usize) -> Self {
        let harmonics = Harmonics::new(l_max, m_max);
        let node = |point: &crate::shape::SurfaceNode| {
            crate::interrupt::check();
            let (sin, cos) = point.theta.sin_cos();
            let x = k * point.r;
            let (psi, chi) = riccati::real(l_max, x);
            let regular: Vec<Complex64> = psi.iter().map(|&z| z.into()).collect();
            let outgoing: Vec<_> =
                psi.iter().zip(&chi).map(|(&re, &im)| Complex64::new(re, -im)).collect();
            let inside = riccati::regular(l_max, index * x);
            let zonal = zonal(l_max, cos);
            let mut angular = vec![Vec::new(); m_max + 1];
            harmonics.visit(cos, sin, |m, l, tau, mu| {
                let p = if m == 0 { zonal[l] } else { mu * sin / m as f64 };
                angular[m].push((tau, mu, p));
            });
            BoundaryNode {
                area: x * x * sin * point.weight,
                lean: point.slope / point.r,
                inside: radial(&inside, index * x),
                outgoing: radial(&outgoing, x.into()),
                regular: radial(&regular, x.into()),
                angular,
            }
        };
        let nodes: Vec<BoundaryNode> = shape.nodes().iter().map(node).collect();
        let scale = |l: usize| {
            let largest = |of: fn(&BoundaryNode) -> &[RadialFunctions]| {
                let sizes = nodes.iter().map(|node| of(node)[l].z.norm());
                sizes.fold(0.0, f64::max).recip()
            };
            (largest(|node| &node.inside), largest(|node| &node.outgoing))
        };
        let scales = (0..=l_max).map(scale).collect();
        Self { index, l_max, nodes, scales }
    }

    /// T_m.
    fn block(&self, m: usize) -> Option<ComplexMatrix> {
        let size = self.l_max + 1 - Harmonics::l_min(m);
        let [q, q0] = self.systems(m);
        if !(is_finite(&q) && is_finite(&q0)) {
            return None;
        }
        // X Q = Q⁰, transposed.
        let x = solve(&q.transpose().to_owned(), &q0.transpose().to_owned());
        let l = |at: usize| Harmonics::l_min(m) + at % size;
        let t = ComplexMatrix::from_fn(2 * size, 2 * size, |row, column| {
            // From (M, N) to (e, h) = (kN, ikM), and from normalized waves to ours.
            let (to, from) = (l(row), l(column));
            let turn = match (row < size, column < size) {
                (true, false) => I,
                (false, true) => -I,
                _ => Complex64::ONE,
            };
            let norm = ((from * (from + 1)) as f64 / (to * (to + 1)) as f64).sqrt();
            let swapped = |at: usize| (at + size) % (2 * size);
            -turn * x[(swapped(column), swapped(row))] * (norm * self.scales[from].1)
        });
        is_finite(&t).then_some(t)
    }

    /// Q and Q⁰, M before N, columns scaled by the waves inside and rows of Q by those outside.
    fn systems(&self, m: usize) -> [ComplexMatrix; 2] {
        let l_min = Harmonics::l_min(m);
        let size = self.l_max + 1 - l_min;
        let mut systems = [(); 2].map(|()| ComplexMatrix::zeros(2 * size, 2 * size));
        for row in 0..size {
            crate::interrupt::check();
            for column in 0..size {
                let (l, inner) = (l_min + row, l_min + column);
                let (of_inside, of_outside) = (self.scales[inner].0, self.scales[l].1);
                let scales = [of_inside * of_outside, of_inside];
                for ((q, j), scale) in
                    systems.iter_mut().zip(self.integrals(m, l, inner)).zip(scales)
                {
                    let [mm, mn, nm, nn] = j;
                    let index = self.index;
                    let normal =
                        scale / ((l * (l + 1)) as f64 * (inner * (inner + 1)) as f64).sqrt();
                    q[(row, column)] = (index * nm + mn) * normal;
                    q[(row, size + column)] = (index * mm + nn) * normal;
                    q[(size + row, column)] = (index * nn + mm) * normal;
                    q[(size + row, size + column)] = (index * mn + nm) * normal;
                }
            }
        }
        systems
    }

    /// J_MM, J_MN, J_NM, J_NN (the wave inside first) with outgoing and with regular waves of l
    /// outside, without the factor 2π.
    fn integrals(&self, m: usize, l: usize, inner: usize) -> [[Complex64; 4]; 2] {
        let l_min = Harmonics::l_min(m);
        let mut sums = [[Complex64::ZERO; 4]; 2];
        for node in &self.nodes {
            let (tau, mu, p) = node.angular[m][l - l_min];
            let (tau_in, mu_in, p_in) = node.angular[m][inner - l_min];
            let crossed = mu_in * tau + tau_in * mu;
            let even = mu_in * mu + tau_in * tau;
            let inside = &node.inside[inner];
            let along_in = inside.over * ((inner * (inner + 1)) as f64);
            for (sum, outside) in sums.iter_mut().zip([&node.outgoing[l], &node.regular[l]]) {
                let along = outside.over * ((l * (l + 1)) as f64);
                let leaning =
                    inside.slope * along * (mu_in * p) + along_in * outside.slope * (p_in * mu);
                sum[0] -= I * node.area * inside.z * outside.z * crossed;
                sum[1] += node.area
                    * inside.z
                    * (outside.slope * even + along * (node.lean * tau_in * p));
                sum[2] -= node.area
                    * outside.z
                    * (inside.slope * even + along_in * (node.lean * p_in * tau));
                sum[3] -=
                    I * node.area * (inside.slope * outside.slope * crossed + leaning * node.lean);
            }
        }
        sums
    }
}

/// z = f/x, f'/x and f/x² of a Riccati–Bessel function f for l from 0; those of l = 0 are not used.
fn radial(f: &[Complex64], x: Complex64) -> Vec<RadialFunctions> {
    let each = |l: usize| {
        let slope = if l == 0 { Complex64::ZERO } else { f[l - 1] - f[l] * (l as f64) / x };
        RadialFunctions { z: f[l] / x, slope: slope / x, over: f[l] / (x * x) }
    };
    (0..f.len()).map(each).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scatterer::layered;

    const INDEX: Complex64 = Complex64::new(1.6, 0.1);

    fn ellipsoid(vertical: f64, horizontal: f64, offset: f64) -> Shape {
        crate::shape::ellipsoid::sampled(100, vertical, horizontal, offset)
    }

    #[test]
    fn a_round_body_has_the_coefficients_of_mie() {
        let t = TMatrix::of_revolution(&ellipsoid(2.0, 2.0, 0.0), INDEX, 1.0, 8, 8).unwrap();
        let mie = TMatrix::sphere(&layered::coefficients(&[(INDEX, 2.0)], 8));
        for (a, b) in t.blocks.iter().zip(&mie.blocks) {
            assert!((a - b).norm_max() < 1e-12, "{:e}", (a - b).norm_max());
        }
    }

    #[test]
    fn bodies_with_a_plane_of_symmetry_do_not_mix_parities() {
        let t = TMatrix::of_revolution(&ellipsoid(1.5, 1.0, 0.0), INDEX, 1.0, 6, 6).unwrap();
        // e of l and e of l + 1, e and h of the same l.
        let block = &t.blocks[1];
        assert!(block[(0, 1)].norm() < 1e-14 && block[(0, 6)].norm() < 1e-14);
        assert!(block[(0, 2)].norm() > 1e-6 && block[(0, 7)].norm() > 1e-6);
    }

    #[test]
    fn lossless_bodies_scatter_all_they_take_from_the_beam() {
        // With waves normalized to unit power, S = 1 + 2T is unitary: T + T* + 2T*T = 0.
        let l_max = 8;
        let shape = ellipsoid(1.5, 1.1, 0.3);
        let t = TMatrix::of_revolution(&shape, Complex64::new(1.5, 0.0), 1.0, l_max, 3).unwrap();
        for (m, block) in t.blocks.iter().enumerate() {
            let size = block.nrows() / 2;
            let norm = |at: usize| {
                let l = (Harmonics::l_min(m) + at % size) as f64;
                (l * (l + 1.0)).sqrt()
            };
            let t = ComplexMatrix::from_fn(2 * size, 2 * size, |i, j| {
                block[(i, j)] * norm(i) / norm(j)
            });
            let lost = &t + t.adjoint() + faer::Scale(Complex64::from(2.0)) * (t.adjoint() * &t);
            // The low multipoles; the last ones are cut off.
            for at in [0, 1, size, size + 1] {
                assert!(lost[(at, at)].norm() < 1e-9, "{m} {at} {}", lost[(at, at)]);
            }
        }
    }
}
