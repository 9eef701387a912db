//! Directional albedo of a rough surface, for every direction of incidence and polarization.
//!
//! $$ \mathbf e(\theta, r) = \int \mathbf F_{0\cdot}\cos\theta_s\,d\Omega_s
//!    = \int \mathbf F_{0\cdot}\cos\theta_s\,4 c\,n_z^3\,d^2\zeta \qquad (1) $$
//!
//! e is the first row of a Mueller matrix: e · (I, Q, U, V) is the returned power for incident light
//! with these Stokes parameters. c = −k_i·n̂ is the cosine of incidence on the facet, r the rotation of
//! the sample.
//!
//! The integral runs over the slopes ζ of the facets, because in slopes the lobe has the same width
//! at all angles of incidence. A facet sends light upwards only within the disc
//!
//! $$ |\zeta|^2 + 2\tan\theta\,\zeta_i < 1 \qquad (2) $$
//!
//! (ζ_i is the component in the plane of incidence), so on each ray from ζ = 0 the integrand is smooth up
//! to one end.
//!
//! The table holds the difference from the row of a smooth surface, which is small and varies
//! slowly. Its nodes are dense towards grazing incidence. In r it is a Fourier series of even orders,
//! because slopes (±ζ_x, ±ζ_y) are equally frequent.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::{Direction, Incidence, slope::SlopeDistribution, special::gauss};

/// Intervals of the table in angle.
const ANGLES: usize = 64;
/// Nodes of the integral along each ray of slopes.
const RADII: usize = 18;
/// Numbers of rays at normal and at grazing incidence; at grazing incidence their ends differ most.
const AZIMUTHS: (usize, usize) = (40, 160);
/// Rotations of an anisotropic surface over half a turn; even.
const ROTATIONS: usize = 16;
/// The integral ends where the density has fallen to this part of its peak, at most at
/// [`FARTHEST`] standard deviations.
const NEGLIGIBLE: f64 = 1e-11;
const FARTHEST: f64 = 12.0;
/// Steps in which a ray is searched for the edge.
const EDGE_STEPS: usize = 12;
/// Relative amount by which the table is made too large: more than its error, so that no energy is
/// gained.
const MARGIN: f64 = 2e-4;
/// Largest angle of incidence of the table; 90° itself is a limit.
const GRAZING: f64 = FRAC_PI_2 - 1e-4;

/// The rows of one surface.
#[derive(Clone, Debug)]
pub(super) struct DirectionalAlbedo {
    /// For every node the coefficients of 1, cos 2r, sin 2r, cos 4r, …
    nodes: Vec<Vec<[f64; 4]>>,
}

impl DirectionalAlbedo {
    /// Tabulates the integrals of `rows` (first rows of BRDFs of facets with these slopes) minus
    /// `smooth`, the row of a smooth surface as a function of the sine of incidence.
    ///
    /// `edge` is the sine of the exit angle where `rows` have a kink, such as the critical angle.
    ///
    /// Each intensity is made too large ([`ErrorSign::Large`]) or too small by more than the error of
    /// the table.
    pub(super) fn tabulate<const N: usize>(
        slopes: &dyn SlopeDistribution,
        rows: &FacetRows<'_, N>,
        smooth: &dyn Fn(f64) -> [[f64; 4]; N],
        (edge, safe): (Option<f64>, [ErrorSign; N]),
    ) -> [Self; N] {
        let rule = SlopeQuadrature::new(slopes, edge);
        let isotropic = rule.is_isotropic(rows);
        let rotations = if isotropic { 1 } else { ROTATIONS };
        let node = |j: usize| -> [Vec<[f64; 4]>; N] {
            let theta = GRAZING * angle(j as f64 / ANGLES as f64);
            let row = |k: usize| -> [[f64; 4]; N] {
                let at = Incidence::new(theta, PI * k as f64 / rotations as f64);
                let (whole, flat) = (rule.integrate(&at, rows, isotropic), smooth(at.sin));
                std::array::from_fn(|n| {
                    let factor = |i| if i == 0 { safe[n].factor() } else { 1.0 };
                    std::array::from_fn(|i| factor(i) * whole[n][i] - flat[n][i])
                })
            };
            let quarter: Vec<_> = (0..=rotations / 2).map(row).collect();
            // The mirror image has the opposite U and V.
            let mirrored = |n: usize, k: usize| match quarter.get(k) {
                Some(rows) => rows[n],
                None => {
                    let [i, q, u, v] = quarter[rotations - k][n];
                    [i, q, -u, -v]
                }
            };
            std::array::from_fn(|n| {
                let rows: Vec<_> = (0..rotations).map(|k| mirrored(n, k)).collect();
                series(&rows)
            })
        };
        let nodes: Vec<_> = (0..=ANGLES).map(node).collect();
        std::array::from_fn(|n| Self { nodes: nodes.iter().map(|node| node[n].clone()).collect() })
    }

    /// The difference to the smooth row at the angle of incidence `theta` and the rotation whose
    /// doubled angle has this cosine and sine.
    pub(super) fn at(&self, theta: f64, cos_2r: f64, sin_2r: f64) -> [f64; 4] {
        self.sum(theta, self.nodes[0].len(), cos_2r, sin_2r)
    }

    /// The mean over all rotations.
    pub(super) fn mean(&self, theta: f64) -> [f64; 4] {
        self.sum(theta, 1, 1.0, 0.0)
    }

    /// The first `orders` terms of the series.
    fn sum(&self, theta: f64, orders: usize, cos_2r: f64, sin_2r: f64) -> [f64; 4] {
        let x = ANGLES as f64 * (1.0 - (1.0 - theta.abs() / GRAZING).max(0.0).sqrt());
        let first = (x as usize).saturating_sub(1).min(ANGLES - 3);
        let weights = lagrange(x - first as f64);
        let mut row = [0.0; 4];
        let (mut cos, mut sin) = (1.0, 0.0);
        for order in 0..orders {
            // 0: 1; 1: cos 2r, 2: sin 2r, …
            if order % 2 == 1 {
                (cos, sin) = (cos * cos_2r - sin * sin_2r, sin * cos_2r + cos * sin_2r);
            }
            let basis = if order % 2 == 1 || order == 0 { cos } else { sin };
            for (k, weight) in weights.iter().enumerate() {
                let coefficients = self.nodes[first + k][order];
                for (x, c) in row.iter_mut().zip(coefficients) {
                    *x += basis * weight * c;
                }
            }
        }
        row
    }
}

/// First rows of BRDFs of facets.
pub(super) type FacetRows<'a, const N: usize> =
    dyn Fn(&Incidence, &Direction) -> [[f64; 4]; N] + 'a;

/// Sign of the error of a table that conserves energy.
#[derive(Clone, Copy, Debug)]
pub(super) enum ErrorSign {
    /// Too large: the remainder is transmitted.
    Large,
    /// Too small: the value is added to other light.
    Small,
}

impl ErrorSign {
    fn factor(self) -> f64 {
        match self {
            Self::Large => 1.0 + MARGIN,
            Self::Small => 1.0 - MARGIN,
        }
    }
}

/// Angle of incidence at the coordinate u of the table, both as fractions of their range.
fn angle(u: f64) -> f64 {
    1.0 - (1.0 - u) * (1.0 - u)
}

/// Weights of the cubic through the nodes 0 to 3 at x.
fn lagrange(x: f64) -> [f64; 4] {
    let (a, b, c) = (x - 1.0, x - 2.0, x - 3.0);
    [-a * b * c / 6.0, 0.5 * x * b * c, -0.5 * x * a * c, x * a * b / 6.0]
}

/// Fourier coefficients of rows at equidistant rotations over half a turn.
fn series(rows: &[[f64; 4]]) -> Vec<[f64; 4]> {
    let count = rows.len();
    let project = |norm: f64, basis: &dyn Fn(f64) -> f64| {
        let mut sum = [0.0; 4];
        for (k, row) in rows.iter().enumerate() {
            let weight = norm / count as f64 * basis(TAU * k as f64 / count as f64);
            for (s, x) in sum.iter_mut().zip(row) {
                *s += weight * x;
            }
        }
        sum
    };
    let mut coefficients = vec![project(1.0, &|_| 1.0)];
    for order in 1..count.div_ceil(2) {
        let m = order as f64;
        coefficients.push(project(2.0, &|r| (m * r).cos()));
        coefficients.push(project(2.0, &|r| (m * r).sin()));
    }
    coefficients
}

/// Standard deviations, or a wide range where none are known.
fn deviations(slopes: &dyn SlopeDistribution) -> (f64, f64) {
    slopes.deviations().unwrap_or((0.3, 0.3))
}

/// Nodes of the integral over slopes.
struct SlopeQuadrature {
    deviations: (f64, f64),
    /// End of the integral in standard deviations.
    reach: f64,
    radii: Vec<(f64, f64)>,
    /// Cosine of the exit angle at which the integrand has a kink.
    edge: Option<f64>,
}

impl SlopeQuadrature {
    fn new(slopes: &dyn SlopeDistribution, edge: Option<f64>) -> Self {
        let deviations = deviations(slopes);
        let negligible = NEGLIGIBLE * slopes.density(0.0, 0.0);
        let mut reach = 1.0;
        while reach < FARTHEST && slopes.density(reach * deviations.0, 0.0) > negligible {
            reach += 0.25;
        }
        let edge = edge.filter(|sin| *sin < 1.0).map(|sin| (1.0 - sin * sin).sqrt());
        Self { deviations, reach, radii: gauss::legendre(RADII, 0.0, 1.0), edge }
    }

    /// True if the rows do not depend on the rotation of the sample.
    fn is_isotropic<const N: usize>(&self, rows: &FacetRows<'_, N>) -> bool {
        let s = self.deviations.0.min(self.deviations.1);
        // Rows may vanish at the greater angle, where no light leaves.
        [(0.3, 0.5, 0.2), (0.9, -0.7, 1.1)].into_iter().all(|(theta, x, y)| {
            let turned = |rotation: f64| {
                let at = Incidence::new(theta, rotation);
                reflected(&at, x * s, y * s).map(|(direction, _)| rows(&at, &direction))
            };
            let first = turned(0.0);
            [0.4, 0.9, FRAC_PI_2].into_iter().all(|rotation| match (&first, turned(rotation)) {
                (Some(first), Some(other)) => same(first.as_flattened(), other.as_flattened()),
                _ => true,
            })
        })
    }

    /// The integrals at one incidence; `mirrored` where both halves of the azimuths are images of
    /// each other.
    fn integrate<const N: usize>(
        &self,
        at: &Incidence,
        rows: &FacetRows<'_, N>,
        mirrored: bool,
    ) -> [[f64; 4]; N] {
        let mut sum = [[0.0; 4]; N];
        let (least, most) = AZIMUTHS;
        let (x, y) = self.deviations;
        let elongation = (x / y).max(y / x).min(2.0);
        let wanted = least as f64 * elongation * (1.0 + 0.5 * at.sin / at.cos);
        let azimuths = 2 * (wanted as usize).min(most).div_ceil(2);
        let (taken, share) = if mirrored { (azimuths / 2, 2.0) } else { (azimuths, 1.0) };
        for j in 0..taken {
            // Not in the plane of incidence, where a shadow function may jump.
            let psi = TAU * (j as f64 + 0.5) / azimuths as f64;
            let (x, y) = (self.deviations.0 * psi.cos(), self.deviations.1 * psi.sin());
            let (c, s) = (at.cos_rotation, at.sin_rotation);
            // The ray ζ = u(x, y) of the sample in the laboratory.
            let ray = (x * c - y * s, y * c + x * s);
            let top = last_upward(ray, at).min(self.reach);
            let area = share * self.deviations.0 * self.deviations.1 * TAU / azimuths as f64;
            for (from, to) in self.pieces(at, ray, top) {
                for &(u, weight) in &self.radii {
                    let radius = from + (to - from) * u;
                    let Some((direction, measure)) = reflected(at, radius * ray.0, radius * ray.1)
                    else {
                        continue;
                    };
                    let factor = weight * (to - from) * radius * area * measure;
                    let values = rows(at, &direction);
                    for (x, value) in sum.as_flattened_mut().iter_mut().zip(values.as_flattened()) {
                        *x += factor * value;
                    }
                }
            }
        }
        if mirrored {
            sum.iter_mut().for_each(|row| row[2..].fill(0.0));
        }
        sum
    }
}

impl SlopeQuadrature {
    /// The parts of a ray of slopes up to `top` between which the exit crosses the edge.
    fn pieces(&self, at: &Incidence, ray: (f64, f64), top: f64) -> Vec<(f64, f64)> {
        let Some(edge) = self.edge else { return vec![(0.0, top)] };
        let above = |radius: f64| {
            let exit = reflected(at, radius * ray.0, radius * ray.1);
            exit.is_some_and(|(direction, _)| direction.cos > edge)
        };
        let mut pieces = Vec::new();
        let mut from = 0.0;
        let (mut before, mut was) = (0.0, above(0.0));
        for step in 1..=EDGE_STEPS {
            let here = top * step as f64 / EDGE_STEPS as f64;
            let is = above(here);
            if is != was {
                let (mut low, mut high) = (before, here);
                for _ in 0..30 {
                    let middle = 0.5 * (low + high);
                    if above(middle) == was { low = middle } else { high = middle }
                }
                pieces.push((from, low));
                from = low;
            }
            (before, was) = (here, is);
        }
        pieces.push((from, top));
        pieces
    }
}

/// True if both are equal up to rounding.
fn same(a: &[f64], b: &[f64]) -> bool {
    let largest = a.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-9 * largest)
}

/// The largest u for which facets of slope u·`ray` send the light upwards.
fn last_upward(ray: (f64, f64), at: &Incidence) -> f64 {
    // a u² + 2 b u − 1 = 0.
    let a = ray.0 * ray.0 + ray.1 * ray.1;
    let b = ray.0 * at.sin / at.cos;
    let root = (b * b + a).sqrt();
    if b > 0.0 { 1.0 / (b + root) } else { (root - b) / a }
}

/// The direction into which a facet of slope (x, y) reflects, and cos θ_s dΩ_s/d²ζ.
fn reflected(at: &Incidence, x: f64, y: f64) -> Option<(Direction, f64)> {
    let nz = 1.0 / (1.0 + x * x + y * y).sqrt();
    // The facet normal is (x, y, 1) n_z, as the BRDF has it.
    let c = (at.cos - at.sin * x) * nz;
    let (kx, ky) = (at.sin + 2.0 * c * x * nz, 2.0 * c * y * nz);
    let kz = 2.0 * c * nz - at.cos;
    if kz <= 0.0 || c <= 0.0 {
        return None;
    }
    let sin = kx.hypot(ky);
    let (cos_phi, sin_phi) = if sin > 0.0 { (kx / sin, ky / sin) } else { (1.0, 0.0) };
    let direction = Direction::from_sin_cos((sin, kz), (sin_phi, cos_phi));
    Some((direction, kz * 4.0 * c * nz * nz * nz))
}
