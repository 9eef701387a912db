//! Places on half a spheroid, and the radial and angular functions there.

use crate::{
    shape::Spheroid,
    special::{
        extended::{Extended, ExtendedComplex},
        gauss,
        harmonics::Harmonics,
    },
};

/// A node between the pole and the equator.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    sin: Extended,
    cos: Extended,
    /// k r.
    x: Extended,
    /// r'/r.
    lean: Extended,
    /// k² r² sin θ dθ.
    area: Extended,
}

/// `count` nodes of a Gauss–Legendre rule in θ from 0 to π/2, with the sizes times `k`.
pub(super) fn points(spheroid: Spheroid, k: f64, count: usize) -> Vec<Point> {
    let quarter = Extended::PI.times_power(0.25);
    let inverse_square = |axis: f64| {
        let x = Extended::from(axis) * Extended::from(k);
        Extended::ONE / (x * x)
    };
    let (v, h) = (inverse_square(spheroid.vertical), inverse_square(spheroid.horizontal));
    let point = |(x, weight): (Extended, Extended)| {
        let (sin, cos) = (quarter * (Extended::ONE + x)).sin_cos();
        // 1/r² = v cos² + h sin², r'/r = −r² (h − v) sin cos.
        let square = Extended::ONE / (v * cos * cos + h * sin * sin);
        let area = square * sin * weight * quarter;
        Point { sin, cos, x: square.sqrt(), lean: square * (v - h) * sin * cos, area }
    };
    legendre(count).into_iter().map(point).collect()
}

/// Nodes and weights of Gauss–Legendre on (−1, 1), by Newton's method from those of `f64`.
fn legendre(count: usize) -> Vec<(Extended, Extended)> {
    let number = |x: f64| Extended::from(x);
    let polynomial = |x: Extended| {
        let (mut before, mut p) = (Extended::ZERO, Extended::ONE);
        for k in 1..=count {
            let k = k as f64;
            let next = (x * p * number(2.0 * k - 1.0) - before * number(k - 1.0)) / number(k);
            (before, p) = (p, next);
        }
        let square = Extended::ONE - x * x;
        (p, number(count as f64) * (before - x * p) / square, square)
    };
    let refined = |(x, _): (f64, f64)| {
        let mut x = number(x);
        for _ in 0..2 {
            let (p, slope, _) = polynomial(x);
            x = x - p / slope;
        }
        let (_, slope, square) = polynomial(x);
        (x, number(2.0) / (square * slope * slope))
    };
    gauss::legendre(count, -1.0, 1.0).into_iter().map(refined).collect()
}

/// f/x, f'/x and f/x² of a Riccati–Bessel function f.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Wave<T> {
    pub(super) z: T,
    pub(super) slope: T,
    pub(super) over: T,
}

/// The radial functions at every node, those inside times the element of area.
pub(super) struct Radial {
    inside: Vec<Vec<Wave<ExtendedComplex>>>,
    /// ψ and χ.
    outside: [Vec<Vec<Wave<Extended>>>; 2],
    areas: Vec<Extended>,
}

impl Radial {
    pub(super) fn new(points: &[Point], index: ExtendedComplex, l_max: usize) -> Self {
        let inside = |point: &Point| {
            let z = index.times(point.x);
            let (over_z, area) = (z.inverse(), point.area);
            let psi = regular(l_max, z);
            let wave = |l: usize| {
                let value = psi[l] * over_z;
                let order = Extended::from(l as f64);
                let before = if l == 0 { ExtendedComplex::ZERO } else { psi[l - 1] };
                let slope = (before - value.times(order)) * over_z;
                let [z, slope, over] = [value, slope, value * over_z].map(|f| f.times(area));
                Wave { z, slope, over }
            };
            (0..=l_max).map(wave).collect()
        };
        let both: Vec<[Vec<Extended>; 2]> =
            points.iter().map(|point| real(l_max, point.x)).collect();
        let outside = [0, 1].map(|which| {
            let waves = |(point, both): (&Point, &[Vec<Extended>; 2])| {
                let f = &both[which];
                let wave = |l: usize| {
                    let z = f[l] / point.x;
                    let before = if l == 0 { Extended::ZERO } else { f[l - 1] };
                    let slope = (before - z * Extended::from(l as f64)) / point.x;
                    Wave { z, slope, over: z / point.x }
                };
                (0..=l_max).map(wave).collect()
            };
            points.iter().zip(&both).map(waves).collect()
        });
        let areas = points.iter().map(|point| point.area).collect();
        Self { inside: points.iter().map(inside).collect(), outside, areas }
    }

    /// The number of nodes.
    pub(super) fn points(&self) -> usize {
        self.areas.len()
    }

    pub(super) fn inside(&self, l: usize, node: usize) -> Wave<ExtendedComplex> {
        self.inside[node][l]
    }

    /// The regular wave, or the irregular one if `which` is 1.
    pub(super) fn outside(&self, which: usize, l: usize, node: usize) -> Wave<Extended> {
        self.outside[which][node][l]
    }

    /// One over the largest z inside and one over the largest outgoing z of this l.
    pub(super) fn scales(&self, l: usize) -> (f64, f64) {
        let inside = |node: usize| {
            let z = self.inside[node][l].z.to_c64().norm();
            z / self.areas[node].to_f64()
        };
        let outgoing = |node: usize| {
            let [psi, chi] = [0, 1].map(|which| self.outside[which][node][l].z.to_f64());
            psi.hypot(chi)
        };
        let largest =
            |of: &dyn Fn(usize) -> f64| (0..self.points()).map(of).fold(0.0, f64::max).recip();
        (largest(&inside), largest(&outgoing))
    }
}

/// An order from which the downward recurrence of ψ(z) is exact to 10⁻³⁴ at `n` and below.
fn start(n: usize, size: f64) -> usize {
    n.max((size + 14.0 * size.cbrt()) as usize) + 30
}

/// ψ_l(z) for l = 0 … `n`, as [`riccati::regular`](crate::special::riccati::regular).
fn regular(n: usize, z: ExtendedComplex) -> Vec<ExtendedComplex> {
    let mut ratio = vec![ExtendedComplex::ZERO; n + 2];
    let mut above = ExtendedComplex::ZERO;
    let inverse = z.inverse();
    for k in (1..=start(n, z.to_c64().norm())).rev() {
        above = (inverse.times(Extended::from((2 * k + 1) as f64)) - above).inverse();
        if k <= n + 1 {
            ratio[k] = above;
        }
    }
    let (sin, cos) = z.sin_cos();
    let from_cosine = sin.to_c64().norm() < cos.to_c64().norm() && z.to_c64().norm() > 1.0;
    let mut psi = vec![sin; n + 1];
    for l in 1..=n {
        let first = l == 1 && from_cosine;
        psi[l] = if first { sin * inverse - cos } else { psi[l - 1] * ratio[l] };
    }
    psi
}

/// ψ_l(x) and χ_l(x) with ζ = ψ − iχ for l = 0 … `n`.
fn real(n: usize, x: Extended) -> [Vec<Extended>; 2] {
    let psi = regular(n, x.into()).into_iter().map(|z| z.re).collect();
    let (sin, cos) = x.sin_cos();
    let mut chi = vec![cos; n + 1];
    for l in 1..=n {
        chi[l] = match l {
            1 => cos / x + sin,
            _ => chi[l - 1] * Extended::from((2 * l - 1) as f64) / x - chi[l - 2],
        };
    }
    [psi, chi]
}

/// The angular functions of one l at one node.
#[derive(Clone, Copy, Debug)]
pub(super) struct NodeHarmonics {
    pub(super) tau: Extended,
    pub(super) mu: Extended,
    /// r'/r times P̃.
    pub(super) leaning: Extended,
}

/// The nodes, for the angular functions of one order after another.
pub(super) struct Angular(Vec<Point>);

impl Angular {
    pub(super) fn new(points: Vec<Point>) -> Self {
        Self(points)
    }

    /// Rows by l from max(1, m), columns by node; the recurrences are those of [`Harmonics`].
    pub(super) fn order(&self, m: usize, l_max: usize) -> Vec<Vec<NodeHarmonics>> {
        let l_min = Harmonics::l_min(m);
        let mut rows = vec![Vec::with_capacity(self.0.len()); l_max + 1 - l_min];
        let number = |x: f64| Extended::from(x);
        let order = l_min as f64;
        // Every step takes the same numbers at all nodes.
        let steps: Vec<[Extended; 3]> = (l_min..=l_max)
            .map(|l| {
                let l = l as f64;
                let (d, e) = ((l - order) * (l + order), (l - 1.0 - order) * (l - 1.0 + order));
                let top = 2.0 * l + 1.0;
                if d == 0.0 {
                    return [Extended::ZERO; 3];
                }
                let root = |above: f64, below: f64| (number(above) / number(below)).sqrt();
                [
                    root(top * (2.0 * l - 1.0), d),
                    root(top * e.max(0.0), d * (2.0 * l - 3.0).max(1.0)),
                    root(top * d, 2.0 * l - 1.0),
                ]
            })
            .collect();
        let first = (1..=l_min).fold(Extended::ONE, |product, k| {
            product * (Extended::ONE + number(0.5) / number(k as f64)).sqrt()
        });
        for point in &self.0 {
            let power = (1..l_min).fold(first, |power, _| power * point.sin);
            let (mut before, mut q) = (Extended::ZERO, power);
            let (mut zonal_before, mut zonal) = (Extended::ONE, point.cos);
            for ((l, step), row) in (l_min..).zip(&steps).zip(&mut rows) {
                let [a, b, c] = *step;
                if l > l_min {
                    (before, q) = (q, point.cos * q * a - before * b);
                }
                let n = l as f64;
                let (tau, mu, p) = if m == 0 {
                    let p = number(2.0 * n + 1.0).sqrt() * zonal;
                    let next = (point.cos * zonal * number(2.0 * n + 1.0)
                        - zonal_before * number(n))
                        / number(n + 1.0);
                    (zonal_before, zonal) = (zonal, next);
                    (-(number(n * (n + 1.0)).sqrt() * point.sin * q), Extended::ZERO, p)
                } else {
                    let tau = point.cos * q * number(n) - before * c;
                    (tau, q * number(m as f64), q * point.sin)
                };
                row.push(NodeHarmonics { tau, mu, leaning: point.lean * p });
            }
        }
        rows
    }
}
