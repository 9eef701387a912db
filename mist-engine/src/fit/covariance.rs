//! From the derivatives at the minimum to covariances, and what cannot be determined.
//!
//! The columns of J are scaled to length 1, so that G = JᵀJ has ones on its diagonal; its Cholesky
//! pivot k is the part of column k that the columns before it do not explain.

/// A pivot below this is rounding: differences are right to about 10⁻⁸, squared.
const UNEXPLAINED: f64 = 1e-12;

/// The part a column must have in another to be named with it.
const NAMED: f64 = 1e-3;

/// A column that the columns before it explain: its number and theirs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Degenerate {
    pub(super) column: usize,
    pub(super) explained_by: Vec<usize>,
}

/// (JᵀJ)⁻¹ for derivatives given column by column.
pub(super) fn inverse(columns: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, Degenerate> {
    let n = columns.len();
    let lengths: Vec<f64> = columns.iter().map(|column| dot(column, column).sqrt()).collect();
    if let Some(column) = lengths.iter().position(|length| !(*length > 0.0)) {
        return Err(Degenerate { column, explained_by: Vec::new() });
    }
    let mut lower = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let product = dot(&columns[i], &columns[j]) / (lengths[i] * lengths[j]);
            let rest = product - dot(&lower[i][..j], &lower[j][..j]);
            if i > j {
                lower[i][j] = rest / lower[j][j];
            } else if rest > UNEXPLAINED {
                lower[i][i] = rest.sqrt();
            } else {
                return Err(Degenerate { column: i, explained_by: explain(&lower, i) });
            }
        }
    }
    let mut inverse = vec![vec![0.0; n]; n];
    for k in 0..n {
        let mut unit = vec![0.0; n];
        unit[k] = 1.0;
        let solved = back(&lower, &forward(&lower, unit));
        for i in 0..n {
            inverse[i][k] = solved[i] / (lengths[i] * lengths[k]);
        }
    }
    Ok(inverse)
}

/// Which columns before `column` make it up.
fn explain(lower: &[Vec<f64>], column: usize) -> Vec<usize> {
    let before: Vec<Vec<f64>> = lower[..column].iter().map(|row| row[..column].to_vec()).collect();
    let parts = back(&before, &lower[column][..column]);
    (0..column).filter(|i| parts[*i].abs() > NAMED).collect()
}

/// Solves L x = b.
fn forward(lower: &[Vec<f64>], mut b: Vec<f64>) -> Vec<f64> {
    for i in 0..b.len() {
        b[i] = (b[i] - dot(&lower[i][..i], &b[..i])) / lower[i][i];
    }
    b
}

/// Solves Lᵀ x = b.
fn back(lower: &[Vec<f64>], b: &[f64]) -> Vec<f64> {
    let mut x = b.to_vec();
    for i in (0..x.len()).rev() {
        let sum: f64 = (i + 1..x.len()).map(|j| lower[j][i] * x[j]).sum();
        x[i] = (x[i] - sum) / lower[i][i];
    }
    x
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_of_a_known_matrix() {
        // J = [[1,0],[0,2],[1,1]] has JᵀJ = [[2,1],[1,5]].
        let inverse = inverse(&[vec![1.0, 0.0, 1.0], vec![0.0, 2.0, 1.0]]).unwrap();
        let expected = [[5.0 / 9.0, -1.0 / 9.0], [-1.0 / 9.0, 2.0 / 9.0]];
        for (row, expected) in inverse.iter().zip(expected) {
            for (a, b) in row.iter().zip(expected) {
                assert!((a - b).abs() < 1e-15, "{a} {b}");
            }
        }
    }

    #[test]
    fn a_column_that_others_make_up_is_told_with_them() {
        let columns =
            [vec![1.0, 2.0, 3.0, 1.0], vec![0.0, 1.0, 5.0, 2.0], vec![2.0, 4.0, 6.0, 2.0]];
        let found = inverse(&columns).unwrap_err();
        assert_eq!(found, Degenerate { column: 2, explained_by: vec![0] });
        let found = inverse(&[vec![1.0, 1.0], vec![0.0, 0.0]]).unwrap_err();
        assert_eq!(found, Degenerate { column: 1, explained_by: vec![] });
    }
}
