//! The material over one cell of a slice as operators on two-dimensional harmonics.
//!
//! Three matrices describe a constant c: E, the plain series; A, the series along axis 2 of the
//! inverse of the series along axis 1 of 1/c; and B, the same with the axes exchanged. Between
//! D and the Cartesian field they give, with s = sin ζ and c = cos ζ,
//!
//! $$ \epsilon_{xx} = c^2 A + s^2 E, \quad \epsilon_{xy} = sc\,(E - A), \quad
//! \epsilon_{yy} = B + s^2 (A - E) $$
//!
//! For ζ = 0 these are Li's rules. For ζ ≠ 0 they are exact for lines along either axis, where
//! E equals A or B, and for a cell with edges along both axes they replace the coupling of the
//! oblique components by A + B − E.
//!
//! NIST's library takes R, the inverse of the series of 1/c along both axes, for the components
//! that mix both axes, and for lines along axis 2 (axis 1) A (E) and E (B) in its place for the
//! two mixed components ([`ObliqueRule::Library`]). With P and Q for both,
//!
//! $$ \epsilon_{xx} = A + s^2 (B - Q), \quad \epsilon_{xy} = sc\,(B - Q), \quad
//! \epsilon_{yx} = \tfrac{s}{c} (c^2 B + s^2 Q - P), \quad \epsilon_{yy} = c^2 B + s^2 Q $$
//!
//! L. Li, J. Opt. Soc. Am. A 14, 2758 (1997).

use std::f64::consts::TAU;

use faer::Scale;
use num_complex::Complex64;

use super::grid::PixelGrid;
use crate::{
    grating::{GratingMaterial, LinePattern},
    rcw::{
        ComplexMatrix,
        layer::{LayerOperators, MaterialTensor},
        toeplitz::{FourierSeries, inverse},
    },
};

/// A slice in which the material does not depend on z.
#[derive(Clone, Debug)]
pub struct CrossSlice {
    /// Thickness, µm.
    pub thickness: f64,
    /// The material along both axes.
    pub pattern: CrossPattern,
    /// Shift along both axes, as fractions of the periods.
    pub shift: (f64, f64),
    /// True for the distance between two gratings.
    pub is_gap: bool,
}

impl CrossSlice {
    /// A slice that is not shifted.
    pub fn new(thickness: f64, pattern: CrossPattern) -> Self {
        Self { thickness, pattern, shift: (0.0, 0.0), is_gap: false }
    }

    /// A homogeneous slice between two gratings.
    pub fn gap(thickness: f64, pattern: CrossPattern) -> Self {
        Self { is_gap: true, ..Self::new(thickness, pattern) }
    }
}

/// Rule for the components of a permittivity that mix the axes of an oblique lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObliqueRule {
    /// That of the turned Cartesian tensor.
    Invariant,
    /// That of NIST's library ([`Defect::CrossedOblique`](crate::Defect::CrossedOblique)).
    Library,
}

/// The material over one cell.
#[derive(Clone, Debug)]
pub enum CrossPattern {
    /// Varies along axis 1 alone.
    Along1(LinePattern),
    /// Varies along axis 2 alone.
    Along2(LinePattern),
    /// Pixels.
    Grid(PixelGrid),
}

/// Which harmonics are kept: −`order1`…`order1` by −`order2`…`order2`, axis 2 running fastest.
#[derive(Clone, Copy, Debug)]
pub struct HarmonicTruncation {
    /// Highest harmonic along axis 1.
    pub order1: usize,
    /// Highest harmonic along axis 2.
    pub order2: usize,
}

impl HarmonicTruncation {
    /// Number of harmonics along each axis.
    fn sizes(&self) -> [usize; 2] {
        [2 * self.order1 + 1, 2 * self.order2 + 1]
    }

    /// The orders (i, j) of all harmonics.
    pub fn harmonics(&self) -> Vec<(isize, isize)> {
        let (last1, last2) = (self.order1 as isize, self.order2 as isize);
        (-last1..=last1).flat_map(|i| (-last2..=last2).map(move |j| (i, j))).collect()
    }
}

/// A constant as three matrices, and the inverse of its normal part.
struct TensorFactors {
    a: ComplexMatrix,
    b: ComplexMatrix,
    plain: ComplexMatrix,
    normal_inverse: ComplexMatrix,
    /// P and Q.
    library: Option<[ComplexMatrix; 2]>,
}

impl CrossPattern {
    /// True if it is a line profile that differs from its mirror image.
    pub fn is_unsymmetric_line(&self) -> bool {
        match self {
            Self::Along1(line) | Self::Along2(line) => !line.is_symmetric(),
            Self::Grid(_) => false,
        }
    }

    /// The same with line profiles mirrored ([`Defect::CrossedMirror`](crate::Defect::CrossedMirror)).
    #[must_use]
    pub fn with_mirrored_lines(&self) -> Self {
        match self {
            Self::Along1(line) => Self::Along1(line.mirrored()),
            Self::Along2(line) => Self::Along2(line.mirrored()),
            Self::Grid(_) => self.clone(),
        }
    }
}

impl CrossSlice {
    /// Effect of the slice of `depth` (in 1/k₀) on the harmonics, axis 2 tilted by `zeta`.
    pub fn operators(
        &self,
        kept: HarmonicTruncation,
        (zeta, rule): (f64, ObliqueRule),
        depth: f64,
    ) -> LayerOperators {
        let by_library = zeta != 0.0 && rule == ObliqueRule::Library;
        let (epsilon, mu) = match &self.pattern {
            CrossPattern::Along1(pattern) => {
                let line = pattern.operators(kept.order1, depth);
                let spread = |m: &ComplexMatrix| spread_1(m, kept.sizes()[1]);
                (along(&line.epsilon, spread, false), along(&line.mu, spread, false))
            }
            CrossPattern::Along2(pattern) => {
                let line = pattern.operators(kept.order2, depth);
                let spread = |m: &ComplexMatrix| spread_2(m, kept.sizes()[0]);
                (along(&line.epsilon, spread, true), along(&line.mu, spread, true))
            }
            CrossPattern::Grid(grid) => {
                let factors =
                    |of: fn(&GratingMaterial) -> [Complex64; 3]| grid.factors(kept, by_library, of);
                (factors(|m| m.epsilon), factors(|m| m.mu))
            }
        };
        let tensor = |factors: TensorFactors| match factors.library {
            Some(mixed) if by_library => {
                library_tensor(factors.a, factors.b, mixed, factors.normal_inverse, zeta)
            }
            library => TensorFactors { library, ..factors }.tensor(zeta),
        };
        let mut operators =
            LayerOperators { depth, epsilon: tensor(epsilon), mu: tensor(mu), waves: None };
        if self.shift != (0.0, 0.0) {
            self.shift(&mut operators.epsilon, kept);
            self.shift(&mut operators.mu, kept);
        }
        operators
    }

    /// Moves a tensor sideways: c_{h−h'} gets the phase of the shift.
    fn shift(&self, tensor: &mut MaterialTensor, kept: HarmonicTruncation) {
        let phases: Vec<Complex64> = kept
            .harmonics()
            .iter()
            .map(|&(i, j)| {
                Complex64::cis(-TAU * (i as f64 * self.shift.0 + j as f64 * self.shift.1))
            })
            .collect();
        let turn = |m: &ComplexMatrix| {
            ComplexMatrix::from_fn(m.nrows(), m.ncols(), |a, b| {
                phases[a] * m[(a, b)] * phases[b].conj()
            })
        };
        tensor.xx = turn(&tensor.xx);
        tensor.xy = tensor.xy.as_ref().map(|xy| xy.each_ref().map(turn));
        tensor.yy = turn(&tensor.yy);
        tensor.zz_inverse = turn(&tensor.zz_inverse);
    }
}

/// A line pattern's tensor in two dimensions; `second` if it varies along axis 2.
fn along(
    tensor: &MaterialTensor,
    spread: impl Fn(&ComplexMatrix) -> ComplexMatrix,
    second: bool,
) -> TensorFactors {
    let (across, lengthwise) = (spread(&tensor.xx), spread(&tensor.yy));
    let plain = lengthwise.clone();
    let (a, b) = if second { (lengthwise, across) } else { (across, lengthwise) };
    let library = Some([a.clone(), b.clone()]);
    TensorFactors { a, b, plain, normal_inverse: spread(&tensor.zz_inverse), library }
}

/// m ⊗ 1: harmonics of axis 2 keep to themselves.
fn spread_1(m: &ComplexMatrix, n2: usize) -> ComplexMatrix {
    let n = m.nrows() * n2;
    ComplexMatrix::from_fn(n, n, |a, b| {
        if a % n2 == b % n2 { m[(a / n2, b / n2)] } else { Complex64::ZERO }
    })
}

/// 1 ⊗ m: harmonics of axis 1 keep to themselves.
fn spread_2(m: &ComplexMatrix, n1: usize) -> ComplexMatrix {
    let n2 = m.nrows();
    ComplexMatrix::from_fn(n1 * n2, n1 * n2, |a, b| {
        if a / n2 == b / n2 { m[(a % n2, b % n2)] } else { Complex64::ZERO }
    })
}

impl TensorFactors {
    fn tensor(self, zeta: f64) -> MaterialTensor {
        let Self { a, b, plain, normal_inverse, .. } = self;
        if zeta == 0.0 {
            return MaterialTensor { xx: a, xy: None, yy: b, zz_inverse: normal_inverse };
        }
        let (s, c) = zeta.sin_cos();
        let scaled = |m: &ComplexMatrix, x: f64| m * Scale(Complex64::from(x));
        let difference = &plain - &a;
        MaterialTensor {
            xx: scaled(&a, c * c) + scaled(&plain, s * s),
            xy: Some([scaled(&difference, s * c), scaled(&difference, s * c)]),
            yy: b - scaled(&difference, s * s),
            zz_inverse: normal_inverse,
        }
    }
}

/// The tensor of NIST's library from A, B, (P, Q) and the normal part.
fn library_tensor(
    a: ComplexMatrix,
    b: ComplexMatrix,
    [p, q]: [ComplexMatrix; 2],
    normal_inverse: ComplexMatrix,
    zeta: f64,
) -> MaterialTensor {
    let (s, c) = zeta.sin_cos();
    let scaled = |m: &ComplexMatrix, x: f64| m * Scale(Complex64::from(x));
    let difference = &b - &q;
    let yy = scaled(&b, c * c) + scaled(&q, s * s);
    MaterialTensor {
        xx: a + scaled(&difference, s * s),
        xy: Some([scaled(&difference, s * c), scaled(&(&yy - &p), s / c)]),
        yy,
        zz_inverse: normal_inverse,
    }
}

impl PixelGrid {
    fn factors(
        &self,
        kept: HarmonicTruncation,
        by_library: bool,
        of: impl Fn(&GratingMaterial) -> [Complex64; 3],
    ) -> TensorFactors {
        let [n1, n2] = kept.sizes();
        let values: Vec<[Complex64; 3]> = self.materials.iter().map(&of).collect();
        if values.iter().all(|v| *v == [Complex64::ONE; 3]) {
            let one = ComplexMatrix::identity(n1 * n2, n1 * n2);
            return TensorFactors {
                a: one.clone(),
                b: one.clone(),
                plain: one.clone(),
                normal_inverse: one,
                library: None,
            };
        }
        let axis = |k: usize| -> Vec<Complex64> { values.iter().map(|v| v[k]).collect() };
        let inverses = |k: usize| -> Vec<Complex64> { values.iter().map(|v| v[k].inv()).collect() };

        let rows = self.lines(0, 2 * kept.order2);
        let columns = self.lines(1, 2 * kept.order1);
        let inverted = |series: Vec<FourierSeries>, n: usize| -> Vec<ComplexMatrix> {
            series.iter().map(|s| inverse(&s.matrix(n))).collect()
        };
        let along_rows = inverted(rows.series(&inverses(0), 2 * kept.order1), n1);
        let along_columns = inverted(columns.series(&inverses(1), 2 * kept.order2), n2);
        let a = assemble(n1, n2, &rows.where_, |look, i, i2| along_rows[look][(i, i2)]);
        let b = exchanged(
            &assemble(n2, n1, &columns.where_, |look, j, j2| along_columns[look][(j, j2)]),
            n1,
            n2,
        );
        let toeplitz = |values: &[Complex64]| -> ComplexMatrix {
            let series = rows.series(values, 2 * kept.order1);
            assemble(n1, n2, &rows.where_, |look, i, i2| series[look].at(i as isize - i2 as isize))
        };
        let normal = toeplitz(&axis(2));
        let plain = if axis(0) == axis(2) { normal.clone() } else { toeplitz(&axis(0)) };
        let library = by_library.then(|| [0, 1].map(|k| inverse(&toeplitz(&inverses(k)))));
        TensorFactors { a, b, plain, normal_inverse: inverse(&normal), library }
    }
}

/// Σ over looks of `inner`(look) ⊗ Toeplitz of where the look stands; the inner index is the
/// slow one.
fn assemble(
    inner: usize,
    outer: usize,
    where_: &[FourierSeries],
    of: impl Fn(usize, usize, usize) -> Complex64,
) -> ComplexMatrix {
    let mut m = ComplexMatrix::zeros(inner * outer, inner * outer);
    let last = outer as isize - 1;
    let mut by_difference = vec![Complex64::ZERO; 2 * outer - 1];
    for i in 0..inner {
        for i2 in 0..inner {
            by_difference.fill(Complex64::ZERO);
            for (look, series) in where_.iter().enumerate() {
                let value = of(look, i, i2);
                for (k, sum) in by_difference.iter_mut().enumerate() {
                    *sum += value * series.at(k as isize - last);
                }
            }
            for j in 0..outer {
                for j2 in 0..outer {
                    m[(i * outer + j, i2 * outer + j2)] = by_difference[outer - 1 + j - j2];
                }
            }
        }
    }
    m
}

/// The matrix with the slow index j made the fast one.
fn exchanged(m: &ComplexMatrix, n1: usize, n2: usize) -> ComplexMatrix {
    let at = |h: usize| (h % n2) * n1 + h / n2;
    ComplexMatrix::from_fn(n1 * n2, n1 * n2, |a, b| m[(at(a), at(b))])
}
