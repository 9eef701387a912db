//! Three by three matrices, row by row.

/// A 3 × 3 matrix, row by row.
pub type Matrix3 = [[f64; 3]; 3];

/// The identity.
pub(crate) const IDENTITY: Matrix3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The product of a matrix and a column.
pub(crate) fn apply(m: &Matrix3, v: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// The product of two matrices.
pub(crate) fn multiply(a: &Matrix3, b: &Matrix3) -> Matrix3 {
    a.map(|row| [0, 1, 2].map(|j| row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]))
}

/// A matrix with its columns scaled.
pub(crate) fn scale_columns(m: &Matrix3, by: [f64; 3]) -> Matrix3 {
    m.map(|row| [row[0] * by[0], row[1] * by[1], row[2] * by[2]])
}

/// The inverse; `None` if the matrix is singular or not finite.
pub(crate) fn inverse(m: &Matrix3) -> Option<Matrix3> {
    let minor = |i: usize, j: usize| {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        let (c, d) = ((j + 1) % 3, (j + 2) % 3);
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let determinant: f64 = (0..3).map(|j| m[0][j] * minor(0, j)).sum();
    let inverse = [0, 1, 2].map(|i| [0, 1, 2].map(|j| minor(j, i) / determinant));
    inverse.iter().flatten().all(|element| element.is_finite()).then_some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_times_matrix_is_the_identity() {
        let m = [[0.9, 0.3, -0.2], [-0.7, 1.7, 0.1], [0.1, -0.1, 1.0]];
        let product = multiply(&inverse(&m).unwrap(), &m);
        for (row, unit) in product.iter().zip(IDENTITY) {
            for (element, expected) in row.iter().zip(unit) {
                // Rounding of products of order one.
                assert!((element - expected).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn a_singular_matrix_has_no_inverse() {
        assert_eq!(inverse(&[[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [0.0, 1.0, 1.0]]), None);
    }
}
