//! Flakes in a slab: plates with Gaussian slopes that reflect from both faces.
//!
//! With a the area of all plates over that of the slab (coverage depth),
//!
//! $$ K(k) = a\int S(\zeta)\frac{|k\cdot\hat n|}{n_z}(1 - M_T)\,d\zeta, \qquad
//!    Z(k\to k') = \frac{a\,S}{4n_z^4}\,M_R, \quad \hat n\parallel k'-k $$
//!
//! M_R and M_T are the Mueller matrices of the plate. Light transmitted by a plate keeps its
//! direction and is part of the extinction matrix. Plates are independent of each other. The
//! scattering is scaled to the integral over slopes, and its energy balance is exact
//! ([`energy_balance`]).

use num_complex::Complex64;

use super::{
    azimuth,
    block::{RealMatrix, Stokes4, TransferBlock},
    energy_balance,
    facet::{PolarizedRay, mueller, scaled},
    interface::SmoothFace,
    nodes::MediumDirections,
    scaling,
    slopes::GaussianSlopes,
};

/// Points of the integrals over slopes, in slope and azimuth.
const SLOPES: (usize, usize) = (48, 48);
/// Azimuths of the scattering.
const AZIMUTHS: usize = 96;

/// Flakes of one kind.
#[derive(Clone, Debug)]
pub struct FlakeLayer {
    /// Coverage depth a.
    pub depth: f64,
    /// Their slopes.
    pub slopes: GaussianSlopes,
    /// Films on the core, or all films of a clear plate.
    pub films: SmoothFace,
    /// Index of an opaque core; `None` for a clear plate.
    pub core: Option<Complex64>,
}

/// Extinction and scattering of flakes at the nodes.
#[derive(Clone, Debug)]
pub struct FlakeKernel {
    /// K at every node, light that goes down.
    pub extinction: Vec<Stokes4>,
    /// 2π√(w_i w_j) Z of every mode, (down to down, down to up), rows 4·node + component.
    pub modes: Vec<(RealMatrix, RealMatrix)>,
}

impl FlakeLayer {
    /// Kernel at `directions` with the modes 0 … `last`.
    pub fn kernel(&self, directions: &MediumDirections, last: usize) -> FlakeKernel {
        let count = directions.len();
        let root: Vec<f64> = directions.w.iter().map(|w| w.sqrt()).collect();
        let scattered = |sign: f64| {
            azimuth::modes((count, count), last, AZIMUTHS, |i, j, turn| {
                let into = PolarizedRay::new(-directions.mu[j], (1.0, 0.0));
                let out = PolarizedRay::new(sign * directions.mu[i], turn);
                let factor = 2.0 * std::f64::consts::PI * root[i] * root[j];
                scaled(self.reflection(&into, &out, directions.n), factor)
            })
        };
        let (mut down, mut up) = (scattered(-1.0), scattered(1.0));
        let (extinction, rows): (Vec<Stokes4>, Vec<[f64; 2]>) =
            directions.mu.iter().map(|mu| self.loss(*mu, directions.n)).unzip();
        let target: Vec<f64> = rows.iter().zip(&root).map(|(row, root)| row[0] * root).collect();
        let s = scaling::factors(&root, &target, |i, j| {
            down[0][(4 * i, 4 * j)] + up[0][(4 * i, 4 * j)]
        });
        for m in down.iter_mut().chain(&mut up) {
            for j in 0..4 * count {
                for i in 0..4 * count {
                    m[(i, j)] *= s[i / 4] * s[j / 4];
                }
            }
        }
        close(&mut down[0], &mut up[0], &root, &rows);
        FlakeKernel { extinction, modes: down.into_iter().zip(up).collect() }
    }

    /// Z between two rays, 1/sr.
    fn reflection(&self, into: &PolarizedRay, out: &PolarizedRay, n: f64) -> Stokes4 {
        let half = out.k - into.k;
        let size = half.length();
        if size == 0.0 || half.z == 0.0 {
            return [[0.0; 4]; 4];
        }
        let normal = half / size;
        let density = self.slopes.density(normal);
        if density == 0.0 {
            return [[0.0; 4]; 4];
        }
        let [r, _] = self.coefficients(into.k.dot(normal).abs().min(1.0), n);
        scaled(mueller(into, out, normal, r), 0.25 * self.depth * density)
    }

    /// Reflection and transmission of a plate met at the cosine `cos`.
    fn coefficients(&self, cos: f64, n: f64) -> [[Complex64; 2]; 2] {
        match self.core {
            Some(core) => [self.films.facet(cos, n, core)[0], [Complex64::ZERO; 2]],
            None => self.films.facet(cos, n, n.into()),
        }
    }

    /// K of light that goes down at the cosine `mu`, and the row (I, Q) of the scattered power.
    fn loss(&self, mu: f64, n: f64) -> (Stokes4, [f64; 2]) {
        let ray = PolarizedRay::new(-mu, (1.0, 0.0));
        let (mut extinction, mut row) = ([[0.0; 4]; 4], [0.0; 2]);
        for (normal, weight) in self.slopes.quadrature(SLOPES.0, SLOPES.1) {
            let cos = ray.k.dot(normal).abs();
            let met = self.depth * weight * cos / normal.z;
            let [r, t] = self.coefficients(cos.min(1.0), n);
            let passed = mueller(&ray, &ray, normal, t);
            for a in 0..4 {
                for b in 0..4 {
                    // By mirror symmetry the other blocks vanish.
                    if a / 2 == b / 2 {
                        let one = f64::from(u8::from(a == b));
                        extinction[a][b] += met * (one - passed[a][b]);
                    }
                }
            }
            let out = ray.k - normal * (2.0 * ray.k.dot(normal));
            let reflected = mueller(&ray, &PolarizedRay::along(out), normal, r);
            row[0] += met * reflected[0][0];
            row[1] += met * reflected[0][1];
        }
        (extinction, row)
    }
}

/// Restores the energy balance of mode 0 for the rows (I, Q) of the scattered power.
fn close(down: &mut RealMatrix, up: &mut RealMatrix, root: &[f64], rows: &[[f64; 2]]) {
    let block = TransferBlock::Intensity;
    let [d, u] = [&*down, &*up].map(|m| block.of_whole(m));
    let n = d.nrows();
    let mut both = super::block::joined([[&d, &u], [&u, &d]]);
    let flux = |row: usize| if row.is_multiple_of(2) { root[row % n / 2] } else { 0.0 };
    let target = |row: usize| rows[row % n / 2][row % 2] * root[row % n / 2];
    let flux: Vec<f64> = (0..2 * n).map(flux).collect();
    let target: Vec<f64> = (0..2 * n).map(target).collect();
    energy_balance::restore(&mut both, &flux, &target);
    for j in 0..n {
        for i in 0..n {
            let at = (4 * (i / 2) + i % 2, 4 * (j / 2) + j % 2);
            down[at] = both[(i, j)];
            up[at] = both[(i + n, j)];
        }
    }
}
