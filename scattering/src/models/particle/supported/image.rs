//! Response of a particle together with its image in the face of the substrate.
//!
//! The face reflects outgoing multipoles w as regular ones **A** w,
//!
//! $$ A^{e'e} = K \int_0^\infty e^{-x} (r_p \tau \tau' + r_s \mu\mu') dx, \qquad
//!    A^{h'e} = -iK \int_0^\infty e^{-x} (r_p \tau\mu' + r_s \mu\tau') dx $$
//!
//! with K = i^{l'−l} e^{2iq}/(2iq l'(l'+1)); A^{h'h} and A^{e'h} follow with τ and μ exchanged
//! and the sign of the second one changed. Here q is k times the height of the origin, τ and μ
//! of l stand at cos α = 1 + ix/(2q), those of l' at π − α. What the particle scatters from
//! regular waves v is then
//!
//! $$ \mathbf{w} = (\mathbf{T}^{-1} - \mathbf{A})^{-1} \mathbf{v}
//!    = (1 - \mathbf{T}\mathbf{A})^{-1} \mathbf{T} \mathbf{v} $$
//!
//! NIST's library takes a Gauss–Laguerre sum of min(100, 10(⌊L/10⌋+1)) nodes, 10⁻⁵ off
//! ([`Defect::ImageNodes`](crate::Defect::ImageNodes)). The sound integral goes by panels that are as
//! narrow as the distance 2q of the branch points of r from the path, up to where the weight is nothing.
//!
//! P. A. Bobbert and J. Vlieger, Physica A 137, 209 (1986), section 8.

use num_complex::Complex64;

use crate::{
    optics::film::{Films, SpAmplitudes},
    special::{
        gauss,
        harmonics::{Harmonics, Scalar},
        laguerre,
    },
    tmatrix::{ComplexMatrix, TMatrix, apply, is_finite, solve, waves::Multipole},
};

const I: Complex64 = Complex64::I;

/// The answers w = R v of all orders m.
pub(super) struct MultipoleResponse(Vec<OrderBlock>);

struct OrderBlock {
    /// Rows that are kept, electric ones first.
    matrix: ComplexMatrix,
    rows: usize,
}

/// The nodes of the integral.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ImageNodes {
    /// As many as NIST's library takes.
    Library,
    /// Panels with so many nodes each.
    Panels(usize),
}

impl ImageNodes {
    /// Nodes x and weights, e^{−x} included, for orders up to `l_max` at the height `q`.
    fn rule(self, l_max: usize, q: f64) -> Vec<(f64, f64)> {
        let count = match self {
            Self::Library => return laguerre::rule((10 * (l_max / 10 + 1)).min(100)),
            Self::Panels(count) => count,
        };
        // e^{−x} x^{2L} peaks at 2L, is √(2L) wide, and nothing ten widths beyond.
        let degree = 2.0 * l_max as f64;
        let (end, widest) = (degree + 10.0 * degree.sqrt() + 40.0, 4.0 + 0.5 * degree.sqrt());
        let (mut from, mut width) = (0.0, (0.5 * q).clamp(1e-6, widest));
        let mut rule = Vec::new();
        while from < end {
            let to = from + width;
            rule.extend(
                gauss::legendre(count, from, to).into_iter().map(|(x, w)| (x, w * (-x).exp())),
            );
            (from, width) = (to, (0.5 * (to + q)).clamp(width, widest));
        }
        rule
    }
}

/// The equation from which w follows, the parameter `order`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ImageMethod {
    /// Exactly.
    Exact,
    /// Without the image.
    Alone,
    /// By so many terms of the series about the diagonal of T⁻¹ − A.
    Series(usize),
}

impl MultipoleResponse {
    /// The answer of `particle` at the height q over the face of `films`, for l up to `l_out`;
    /// nothing if it is not finite.
    pub(super) fn new(
        particle: &TMatrix,
        films: &Films,
        q: f64,
        (normal_only, nodes): (bool, ImageNodes),
        method: ImageMethod,
        l_out: usize,
    ) -> Option<Self> {
        let image = ImageOperator::new(films, q, (normal_only, nodes), particle);
        let block = |(m, t): (usize, &ComplexMatrix)| {
            let matrix = answer(t, &image.block(m), method)?;
            let rows = (l_out + 1).saturating_sub(Harmonics::l_min(m));
            Some(OrderBlock { matrix, rows })
        };
        particle.blocks.iter().enumerate().map(block).collect::<Option<_>>().map(Self)
    }

    /// The matrices R by m.
    pub(super) fn matrices(&self) -> impl Iterator<Item = (usize, &ComplexMatrix)> {
        self.0.iter().map(|block| &block.matrix).enumerate()
    }

    /// (m, l, w) for regular waves in the order of [`Harmonics::visit`].
    pub(super) fn apply(&self, regular: &[Multipole]) -> Vec<(usize, usize, Multipole)> {
        let mut out = Vec::new();
        let mut start = 0;
        for (m, OrderBlock { matrix, rows }) in self.0.iter().enumerate() {
            let size = matrix.nrows() / 2;
            let v = &regular[start..start + size];
            start += size;
            apply(matrix, v, *rows, |row, w| out.push((m, Harmonics::l_min(m) + row, w)));
        }
        out
    }
}

/// R with w = R v.
fn answer(t: &ComplexMatrix, image: &ComplexMatrix, method: ImageMethod) -> Option<ComplexMatrix> {
    let one = ComplexMatrix::identity(t.nrows(), t.ncols());
    let checked = |matrix: ComplexMatrix| is_finite(&matrix).then_some(matrix);
    match method {
        ImageMethod::Alone => checked(t.clone()),
        ImageMethod::Exact => checked(solve(&checked(one - t * image)?, t)),
        ImageMethod::Series(terms) => {
            let whole = checked(solve(t, &one))? - image;
            let inverse = |row: usize| whole[(row, row)].inv();
            let (rows, columns) = (whole.nrows(), whole.ncols());
            let first = ComplexMatrix::from_fn(rows, columns, |row, column| {
                if row == column { inverse(row) } else { Complex64::ZERO }
            });
            let step = ComplexMatrix::from_fn(rows, columns, |row, column| {
                if row == column { Complex64::ZERO } else { -inverse(row) * whole[(row, column)] }
            });
            let sum = (1..terms).fold(first.clone(), |sum, _| &first + &step * sum);
            checked(sum)
        }
    }
}

/// The reflection of all multipoles at the nodes of the integral.
struct ImageOperator {
    l_max: usize,
    nodes: Vec<ImageNode>,
}

struct ImageNode {
    /// Weight times e^{2iq}/(2iq) and the reflection.
    r: SpAmplitudes,
    /// (τ, μ) by order, l within it.
    angular: Vec<Vec<(Complex64, Complex64)>>,
}

impl ImageOperator {
    fn new(
        films: &Films,
        q: f64,
        (normal_only, nodes): (bool, ImageNodes),
        particle: &TMatrix,
    ) -> Self {
        let l_max = particle.l_max;
        let harmonics = Harmonics::new(l_max, particle.m_max());
        let common = (2.0 * q * I).exp() / (2.0 * q * I);
        let node = |(x, weight): (f64, f64)| {
            let cos = Complex64::new(1.0, 0.5 * x / q);
            let sin = (1.0 - cos * cos).sqrt();
            let r = films.r12(if normal_only { Complex64::ZERO } else { sin });
            let scale = common * weight;
            let mut angular = vec![Vec::new(); particle.blocks.len()];
            harmonics.visit(cos, sin, |m, _, tau, mu| angular[m].push((tau, mu)));
            ImageNode { r: SpAmplitudes { s: scale * r.s, p: scale * r.p }, angular }
        };
        Self { l_max, nodes: nodes.rule(l_max, q).into_iter().map(node).collect() }
    }

    /// A of the order `m`.
    fn block(&self, m: usize) -> ComplexMatrix {
        let l_min = Harmonics::l_min(m);
        let size = self.l_max + 1 - l_min;
        let mut a = ComplexMatrix::zeros(2 * size, 2 * size);
        for column in 0..size {
            for row in 0..size {
                let (l, to) = (l_min + column, l_min + row);
                let [ee, he, eh, hh] = self.elements(m, row, column);
                // i^{l'−l} σ'/(l'(l'+1)) with σ' = (−1)^{l'−m}.
                let sign = if (to - m).is_multiple_of(2) { 1.0 } else { -1.0 };
                let turn = [Complex64::ONE, I, -Complex64::ONE, -I][(to + 3 * l) % 4];
                let factor = turn * (sign / (to * (to + 1)) as f64);
                a[(row, column)] = factor * ee;
                a[(size + row, column)] = -I * factor * he;
                a[(row, size + column)] = I * factor * eh;
                a[(size + row, size + column)] = factor * hh;
            }
        }
        a
    }

    /// The integrals of ee, he, eh and hh without their common factors; τ and μ at π − α are
    /// −σ'τ and σ'μ.
    fn elements(&self, m: usize, row: usize, column: usize) -> [Complex64; 4] {
        let mut sums = [Complex64::ZERO; 4];
        for ImageNode { r, angular } in &self.nodes {
            let (tau, mu) = angular[m][column];
            let (tau_to, mu_to) = angular[m][row];
            let (p_tau, s_tau) = (r.p * tau, r.s * tau);
            let (p_mu, s_mu) = (r.p * mu, r.s * mu);
            sums[0] += s_mu.of(mu_to) - p_tau.of(tau_to);
            sums[1] += p_tau.of(mu_to) - s_mu.of(tau_to);
            sums[2] += s_tau.of(mu_to) - p_mu.of(tau_to);
            sums[3] += p_mu.of(mu_to) - s_tau.of(tau_to);
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scatterer::layered;

    fn sphere() -> TMatrix {
        TMatrix::sphere(&layered::coefficients(&[(Complex64::new(1.6, 0.1), 1.0)], 5))
    }

    fn films(n: f64) -> Films {
        Films::new(&[], Complex64::ONE, n.into(), 0.6)
    }

    fn distance(a: &MultipoleResponse, b: &MultipoleResponse) -> f64 {
        let each = |(a, b): (&OrderBlock, &OrderBlock)| (&a.matrix - &b.matrix).norm_max();
        a.0.iter().zip(&b.0).map(each).fold(0.0, f64::max)
    }

    fn response(n: f64, q: f64, method: ImageMethod) -> MultipoleResponse {
        MultipoleResponse::new(&sphere(), &films(n), q, (false, ImageNodes::Library), method, 5)
            .unwrap()
    }

    #[test]
    fn over_no_substrate_the_particle_answers_alone() {
        let alone = response(1.0, 1.0, ImageMethod::Alone);
        assert!(distance(&response(1.0, 1.0, ImageMethod::Exact), &alone) < 1e-15);
        assert!(distance(&response(1.5, 1.0, ImageMethod::Exact), &alone) > 1e-3);
    }

    #[test]
    fn the_series_converges_to_the_exact_answer() {
        let exact = response(1.5, 1.5, ImageMethod::Exact);
        let [few, many] =
            [2, 60].map(|n| distance(&response(1.5, 1.5, ImageMethod::Series(n)), &exact));
        assert!(many < 1e-12 && few > 1e-9, "{few} {many}");
    }

    #[test]
    fn the_image_of_a_dipole_far_from_the_face_is_its_reflected_wave() {
        // For q → ∞ only normal incidence counts: A_ee of l = m = 1 is r_s (3/2)/(2iq) e^{2iq}…
        let q = 1e4;
        let image = ImageOperator::new(&films(1.5), q, (true, ImageNodes::Library), &sphere());
        let got = image.block(1)[(0, 0)];
        // τ = μ = √(3/2) at α = 0, so that A = K [−r_p + r_s]·3/2 with r_p = −r_s = 0.2.
        let expected = (2.0 * q * I).exp() / (2.0 * q * I) / 2.0 * 1.5 * (-0.4);
        assert!((got / expected - 1.0).norm() < 1e-3, "{got} {expected}");
    }

    #[test]
    fn panels_converge_and_the_librarys_nodes_come_near() {
        // κ = 3.5 of a metal, a small and a large height.
        let films = Films::new(&[], Complex64::ONE, Complex64::new(0.2, 3.5), 0.6);
        for q in [0.05, 1.0, 12.0] {
            let at = |nodes| ImageOperator::new(&films, q, (false, nodes), &sphere()).block(1);
            let (fine, coarse) = (at(ImageNodes::Panels(24)), at(ImageNodes::Panels(14)));
            let difference = (&fine - &coarse).norm_max() / fine.norm_max();
            assert!(difference < 1e-10, "{q}: {difference:e}");
            let library = at(ImageNodes::Library);
            let difference = (&fine - &library).norm_max() / fine.norm_max();
            assert!(difference < 1e-2, "{q}: {difference:e}");
        }
    }
}
