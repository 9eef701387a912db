//! Light returned by a slab of scatterers on a diffuse backing, by adding and doubling.
//!
//! Radiance is kept at Gauss–Legendre nodes μ_j of its cosine. A thin slab of optical depth d has,
//! with α = (1 − ½a h⁺W) d/2μ and β = ½a h⁻W d/2μ (a the albedo, h^± the phase function of
//! Henyey and Greenstein averaged over azimuth, forwards and backwards, W the weights),
//!
//! $$ \Gamma = (1 + \alpha)^{-1}\beta, \qquad K = 1 + \alpha - \beta\Gamma, \qquad
//!    T = 2K^{-1} - 1, \qquad R = 2\Gamma K^{-1} $$
//!
//! and twice the depth has R + T R (1 − R²)⁻¹ T and T (1 − R²)⁻¹ T. The forward peak is taken
//! out first: a fraction g^M of the scattered light counts as unscattered (δ–M).
//!
//! H. C. van de Hulst, *Multiple Light Scattering* (Academic Press, 1980); W. J. Wiscombe, J.
//! Quant. Spectrosc. Radiat. Transfer 16, 637 (1976), for the thin slab, and J. Atmos. Sci. 34,
//! 1408 (1977), for δ–M.

use faer::{Mat, linalg::solvers::Solve};

use crate::special::gauss;

/// Nodes; M of δ–M is twice as many.
const NODES: usize = 16;
/// Optical depth of the thin slab over the smallest μ: its error is of third order.
const THIN: f64 = 1e-2;
/// Optical depth that transmits nothing at any albedo.
const OPAQUE: f64 = 1e7;

/// Reflectance of a body for diffuse light and for beams.
#[derive(Clone, Debug)]
pub(super) struct DiffuseSlab {
    /// Reflectance for diffuse light.
    pub(super) reflectance: f64,
    /// (μ, reflectance for a beam at μ over that for diffuse light, weight of the interpolation);
    /// empty if the reflectance does not depend on μ.
    beams: Vec<(f64, f64, f64)>,
}

impl DiffuseSlab {
    /// A body with the same reflectance for all beams.
    pub(super) fn uniform(reflectance: f64) -> Self {
        Self { reflectance, beams: Vec::new() }
    }

    /// The reflectance for a beam with the cosine `mu` over that for diffuse light.
    pub(super) fn shape(&self, mu: f64) -> f64 {
        if self.beams.is_empty() {
            return 1.0;
        }
        // Barycentric interpolation between the nodes (J.-P. Berrut and L. N. Trefethen, SIAM
        // Rev. 46, 501 (2004)).
        let (mut above, mut below) = (0.0, 0.0);
        for &(node, value, weight) in &self.beams {
            if mu == node {
                return value;
            }
            let part = weight / (mu - node);
            above += part * value;
            below += part;
        }
        above / below
    }
}

/// A slab with optical depth `depth`, albedo `albedo` and asymmetry `g`, on a backing of diffuse
/// reflectance `backing`.
pub(super) fn slab(depth: f64, albedo: f64, g: f64, backing: f64) -> DiffuseSlab {
    let peak = g.abs().powi(2 * NODES as i32);
    let depth = (depth * (1.0 - albedo * peak)).min(OPAQUE);
    let albedo = albedo * (1.0 - peak) / (1.0 - albedo * peak);
    if !(depth > 0.0) {
        return DiffuseSlab::uniform(backing);
    }
    let nodes = gauss::legendre(NODES, 0.0, 1.0);
    let doublings = (depth / (THIN * nodes[0].0)).log2().ceil().max(0.0) as i32;
    let (mut r, mut t) = thin(depth / 2f64.powi(doublings), albedo, g, &nodes);
    for _ in 0..doublings {
        (r, t) = doubled(&r, &t);
    }
    let ground = Mat::from_fn(NODES, NODES, |_, j| 2.0 * backing * nodes[j].0 * nodes[j].1);
    let whole = &r + &t * &ground * (unit() - &r * &ground).partial_piv_lu().solve(&t);
    // Radiance upwards under uniform illumination: by reciprocity the reflectance of a beam.
    let sum = |i: usize| (0..NODES).map(|j| whole[(i, j)]).sum::<f64>();
    let reflectance = nodes.iter().enumerate().map(|(i, (mu, w))| 2.0 * mu * w * sum(i)).sum();
    if !(reflectance > 0.0) {
        return DiffuseSlab::uniform(0.0);
    }
    let weight = |i: usize| -> f64 {
        let apart = |j: usize| if j == i { 1.0 } else { 4.0 * (nodes[i].0 - nodes[j].0) };
        1.0 / (0..NODES).map(apart).product::<f64>()
    };
    let beam = |i: usize| (nodes[i].0, sum(i) / reflectance, weight(i));
    DiffuseSlab { reflectance, beams: (0..NODES).map(beam).collect() }
}

fn unit() -> Mat<f64> {
    Mat::identity(NODES, NODES)
}

/// (R, T) of a thin slab.
fn thin(depth: f64, albedo: f64, g: f64, nodes: &[(f64, f64)]) -> (Mat<f64>, Mat<f64>) {
    // g^l (less the peak) for l < 2 NODES; the sum over j of ½ h W is 1 with them.
    let cut = g.abs().powi(2 * NODES as i32);
    let moment = |l: usize| (g.powi(l as i32) - cut) / (1.0 - cut);
    let legendre: Vec<Vec<f64>> = nodes.iter().map(|(mu, _)| polynomials(*mu)).collect();
    let phase = |i: usize, j: usize, sign: f64| -> f64 {
        let term = |l: usize| {
            let parity = if l % 2 == 1 { sign } else { 1.0 };
            (2 * l + 1) as f64 * moment(l) * parity * legendre[i][l] * legendre[j][l]
        };
        (0..2 * NODES).map(term).sum()
    };
    let scattered = |sign: f64| {
        Mat::from_fn(NODES, NODES, |i, j| {
            0.25 * albedo * depth / nodes[i].0 * phase(i, j, sign) * nodes[j].1
        })
    };
    let lost =
        Mat::from_fn(NODES, NODES, |i, j| if i == j { 0.5 * depth / nodes[i].0 } else { 0.0 });
    let inside = unit() + &lost - scattered(1.0);
    let beta = scattered(-1.0);
    let gamma = inside.partial_piv_lu().solve(&beta);
    let k = (&inside - &beta * &gamma).partial_piv_lu().solve(unit());
    (&gamma * &k + &gamma * &k, &k + &k - unit())
}

fn doubled(r: &Mat<f64>, t: &Mat<f64>) -> (Mat<f64>, Mat<f64>) {
    let between = (unit() - r * r).partial_piv_lu().solve(t);
    (r + t * (r * &between), t * &between)
}

/// P_0 … P_{2 NODES − 1} at μ.
fn polynomials(mu: f64) -> Vec<f64> {
    let mut p = vec![1.0, mu];
    for l in 2..2 * NODES {
        let k = l as f64;
        p.push(((2.0 * k - 1.0) * mu * p[l - 1] - (k - 1.0) * p[l - 2]) / k);
    }
    p
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reflectance(depth: f64, albedo: f64, g: f64, backing: f64) -> f64 {
        slab(depth, albedo, g, backing).reflectance
    }

    #[test]
    fn a_thick_body_returns_of_a_beam_what_chandrasekhar_s_function_says() {
        // 1 − √(1 − a) H(μ), H by its integral equation.
        let h = |mu: f64| {
            let mut values = vec![1.0; 64];
            let nodes = gauss::legendre(64, 0.0, 1.0);
            for _ in 0..200 {
                let next = |mu: f64| {
                    let sum: f64 =
                        nodes.iter().zip(&values).map(|((m, w), h)| w * m * h / (mu + m)).sum();
                    1.0 / (0.1f64.sqrt() + 0.45 * sum)
                };
                values = nodes.iter().map(|(m, _)| next(*m)).collect();
            }
            let sum: f64 = nodes.iter().zip(&values).map(|((m, w), h)| w * m * h / (mu + m)).sum();
            1.0 / (0.1f64.sqrt() + 0.45 * sum)
        };
        let body = slab(1e3, 0.9, 0.0, 0.0);
        for mu in [0.1, 0.5, 0.77, 1.0] {
            let expected = 1.0 - 0.1f64.sqrt() * h(mu);
            let got = body.reflectance * body.shape(mu);
            assert!((got - expected).abs() < 2e-3, "{mu}: {got} {expected}");
        }
    }

    #[test]
    fn nothing_is_lost_without_absorption_on_white() {
        for (depth, g) in [(1e-3, 0.0), (1.0, 0.8), (50.0, -0.3), (1e4, 0.95)] {
            let r = reflectance(depth, 1.0, g, 1.0);
            // Rounding of the doublings grows with the depth: at 10⁴ it is 8·10⁻⁸.
            assert!((r - 1.0).abs() < 1e-11 * (1.0 + depth), "{depth} {g}: {r}");
        }
    }

    #[test]
    fn without_scattering_the_backing_is_seen_through_diffuse_transmission_twice() {
        // 2 E₃(2d): diffuse light through the depth 2d, on each single path; E₃(1) = 0.1096919670.
        let r = reflectance(0.5, 0.0, 0.0, 0.3);
        // Between the two passes the backing makes the light diffuse again: R = R_g (2 E₃(d))².
        let e3 = 0.221_604_374_3;
        assert!((r - 0.3 * 4.0 * e3 * e3).abs() < 1e-5, "{r}");
    }

    #[test]
    fn a_thick_isotropic_body_has_the_reflectance_of_chandrasekhar() {
        // Spherical albedo of a half space with a = 0.9: 1 − 2 √(1 − a) α₁, α₁ the first moment of
        // the H function (van de Hulst, table 12): 0.478.
        let r = reflectance(1e3, 0.9, 0.0, 0.0);
        assert!((r - 0.478).abs() < 2e-3, "{r}");
    }

    /// Numbers from 0 to 1 (a linear congruential generator of Knuth's).
    struct KnuthGenerator(u64);

    impl KnuthGenerator {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((self.0 >> 11) as f64 + 0.5) / (1u64 << 53) as f64
        }
    }

    /// The part of `photons` walks of diffuse light that leave a slab on a black backing upwards.
    fn walked(depth: f64, albedo: f64, g: f64, photons: u32) -> f64 {
        let mut random = KnuthGenerator(11);
        let mut returned = 0;
        for _ in 0..photons {
            let (mut z, mut mu) = (0.0, random.next().sqrt());
            loop {
                z -= random.next().ln() * mu;
                if z < 0.0 {
                    returned += 1;
                    break;
                }
                if z > depth || random.next() > albedo {
                    break;
                }
                let part = (1.0 - g * g) / (1.0 - g + 2.0 * g * random.next());
                let cos = (1.0 + g * g - part * part) / (2.0 * g);
                let turn = (std::f64::consts::TAU * random.next()).cos();
                let sines = (1.0 - mu * mu) * (1.0 - cos * cos);
                mu = mu * cos + sines.max(0.0).sqrt() * turn;
            }
        }
        f64::from(returned) / f64::from(photons)
    }

    #[test]
    fn random_walks_return_as_much() {
        let photons = 100_000;
        for (depth, albedo, g) in [(1.0, 0.9, 0.8), (5.0, 0.99, 0.5), (0.3, 1.0, -0.4)] {
            let (walked, r) =
                (walked(depth, albedo, g, photons), reflectance(depth, albedo, g, 0.0));
            let deviation = (r * (1.0 - r) / f64::from(photons)).sqrt();
            assert!((walked - r).abs() < 4.0 * deviation, "{depth} {albedo} {g}: {walked} {r}");
        }
    }

    #[test]
    fn the_depth_of_the_thin_slab_does_not_matter() {
        let nodes = gauss::legendre(NODES, 0.0, 1.0);
        let once = doubled_to(0.3, 8, &nodes);
        let finer = doubled_to(0.3, 14, &nodes);
        assert!((once - finer).abs() < 1e-4, "{once} {finer}");
    }

    fn doubled_to(depth: f64, doublings: i32, nodes: &[(f64, f64)]) -> f64 {
        let (mut r, mut t) = thin(depth / 2f64.powi(doublings), 0.8, 0.5, nodes);
        for _ in 0..doublings {
            (r, t) = doubled(&r, &t);
        }
        let row = |i: usize| (0..NODES).map(|j| r[(i, j)]).sum::<f64>();
        nodes.iter().enumerate().map(|(i, (mu, w))| 2.0 * mu * w * row(i)).sum()
    }
}
