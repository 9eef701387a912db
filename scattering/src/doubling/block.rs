//! Blocks of the radiative transfer operators: azimuthal modes and the Stokes components in them.
//!
//! A medium without direction and handedness has a kernel
//! M(φ) = Σ_m (2 − δ_m0)[C^m cos mφ + S^m sin mφ], C with the two diagonal 2×2 blocks only, S with
//! the other two. For light with (I, Q) ∝ cos mφ and (U, V) ∝ sin mφ the convolution in azimuth
//! is a product with
//!
//! $$ M_+^m = \begin{pmatrix} C_{11} & -S_{12} \\ S_{21} & C_{22} \end{pmatrix} $$
//!
//! For m = 0 the halves (I, Q) and (U, V) do not mix. Matrices have the row s·node + component, s
//! the number of Stokes components of the block.
//!
//! J. E. Hansen and L. D. Travis, Space Sci. Rev. 16, 527 (1974); J. W. Hovenier, C. van der Mee
//! and H. Domke, *Transfer of Polarized Light in Planetary Atmospheres* (Kluwer, 2004), 4.6.

use faer::{Mat, linalg::solvers::Solve};

/// A real matrix.
pub type RealMatrix = Mat<f64>;

/// A 4×4 matrix of Stokes components.
pub type Stokes4 = [[f64; 4]; 4];

/// One independent part of the transfer problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransferBlock {
    /// m = 0, components I and Q.
    Intensity,
    /// m = 0, components U and V.
    Circular,
    /// m ≥ 1, all four components.
    Mode(usize),
}

impl TransferBlock {
    /// The azimuthal mode.
    pub fn mode(self) -> usize {
        match self {
            Self::Intensity | Self::Circular => 0,
            Self::Mode(m) => m,
        }
    }

    /// Number of Stokes components.
    pub fn size(self) -> usize {
        if self.mode() == 0 { 2 } else { 4 }
    }

    /// The first Stokes component.
    pub fn first(self) -> usize {
        if self == Self::Circular { 2 } else { 0 }
    }

    /// The blocks of mode `m`.
    pub fn of_mode(m: usize) -> Vec<Self> {
        if m == 0 { vec![Self::Intensity, Self::Circular] } else { vec![Self::Mode(m)] }
    }

    /// The blocks of the modes 0 … `last`.
    pub fn all(last: usize) -> Vec<Self> {
        let modes = (1..=last).map(Self::Mode);
        [Self::Intensity, Self::Circular].into_iter().chain(modes).collect()
    }

    /// The Stokes component of a row or column.
    pub fn component(self, row: usize) -> usize {
        self.first() + row % self.size()
    }

    /// The matrix whose parts between nodes are `part(i, j)`.
    pub fn assembled(
        self,
        rows: usize,
        columns: usize,
        mut part: impl FnMut(usize, usize) -> Stokes4,
    ) -> RealMatrix {
        let (s, first) = (self.size(), self.first());
        let mut whole = RealMatrix::zeros(s * rows, s * columns);
        for j in 0..columns {
            for i in 0..rows {
                let m = part(i, j);
                for a in 0..s {
                    for b in 0..s {
                        whole[(s * i + a, s * j + b)] = m[first + a][first + b];
                    }
                }
            }
        }
        whole
    }

    /// The matrix that is `part(i)` for every node and 0 between nodes; it may have more rows or
    /// more columns than `parts` nodes.
    pub fn diagonal(
        self,
        (rows, columns, parts): (usize, usize, usize),
        part: impl Fn(usize) -> Stokes4,
    ) -> RealMatrix {
        let (s, first) = (self.size(), self.first());
        let mut whole = RealMatrix::zeros(s * rows, s * columns);
        for i in 0..parts {
            let m = part(i);
            for a in 0..s {
                for b in 0..s {
                    whole[(s * i + a, s * i + b)] = m[first + a][first + b];
                }
            }
        }
        whole
    }

    /// The part of this block in a matrix with all four components of its mode.
    pub fn of_whole(self, whole: &RealMatrix) -> RealMatrix {
        let (s, first) = (self.size(), self.first());
        let at = |row: usize| 4 * (row / s) + first + row % s;
        RealMatrix::from_fn(whole.nrows() / 4 * s, whole.ncols() / 4 * s, |i, j| {
            whole[(at(i), at(j))]
        })
    }

    /// Puts the part of this block into a matrix with all four components.
    pub fn put(self, part: &RealMatrix, whole: &mut RealMatrix) {
        let (s, first) = (self.size(), self.first());
        let at = |row: usize| 4 * (row / s) + first + row % s;
        for j in 0..part.ncols() {
            for i in 0..part.nrows() {
                whole[(at(i), at(j))] = part[(i, j)];
            }
        }
    }

    /// D M D, D = diag(1, 1, −1, −1): the same medium seen from below.
    pub fn mirrored(self, m: &RealMatrix) -> RealMatrix {
        if self.size() == 2 {
            return m.clone();
        }
        let sign = |row: usize| if row % 4 < 2 { 1.0 } else { -1.0 };
        RealMatrix::from_fn(m.nrows(), m.ncols(), |i, j| sign(i) * sign(j) * m[(i, j)])
    }

    /// P M P, P = diag(1, 1, −1, 1); with the transposed matrix that of the reversed paths.
    pub fn reversed(self, m: &RealMatrix) -> RealMatrix {
        let sign = |row: usize| if self.component(row) == 2 { -1.0 } else { 1.0 };
        RealMatrix::from_fn(m.ncols(), m.nrows(), |i, j| sign(i) * sign(j) * m[(j, i)])
    }
}

/// The identity.
pub fn identity(n: usize) -> RealMatrix {
    RealMatrix::identity(n, n)
}

/// (1 − a b)⁻¹ c.
pub fn between(a: &RealMatrix, b: &RealMatrix, c: &RealMatrix) -> RealMatrix {
    let mut left = a * b;
    let n = left.nrows();
    for j in 0..n {
        for i in 0..n {
            left[(i, j)] = f64::from(u8::from(i == j)) - left[(i, j)];
        }
    }
    solved(&left, c)
}

/// a⁻¹ c.
pub fn solved(a: &RealMatrix, c: &RealMatrix) -> RealMatrix {
    a.partial_piv_lu().solve(c)
}

/// The largest sum of absolute values of a column.
pub fn norm(m: &RealMatrix) -> f64 {
    let column = |j: usize| (0..m.nrows()).map(|i| m[(i, j)].abs()).sum::<f64>();
    (0..m.ncols()).map(column).fold(0.0, f64::max)
}

/// The parts of a matrix of 2×2 blocks, of which the first has `rows` × `columns`.
pub fn quarters(m: &RealMatrix, rows: usize, columns: usize) -> [[RealMatrix; 2]; 2] {
    let (more_rows, more_columns) = (m.nrows() - rows, m.ncols() - columns);
    let part = |i, j, rows, columns| RealMatrix::from_fn(rows, columns, |a, b| m[(i + a, j + b)]);
    [
        [part(0, 0, rows, columns), part(0, columns, rows, more_columns)],
        [part(rows, 0, more_rows, columns), part(rows, columns, more_rows, more_columns)],
    ]
}

/// The matrix of 2×2 blocks.
pub fn joined([[a, b], [c, d]]: [[&RealMatrix; 2]; 2]) -> RealMatrix {
    let (rows, columns) = (a.nrows(), a.ncols());
    RealMatrix::from_fn(rows + c.nrows(), columns + b.ncols(), |i, j| {
        match (i < rows, j < columns) {
            (true, true) => a[(i, j)],
            (true, false) => b[(i, j - columns)],
            (false, true) => c[(i - rows, j)],
            (false, false) => d[(i - rows, j - columns)],
        }
    })
}
