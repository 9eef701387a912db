//! Comparison of tables: texts are equal, numbers agree within a tolerance.

use mist_format::number::number_prefix;

/// Allowed differences of numbers.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Relative to the larger number.
    pub relative: f64,
    /// As a fraction of the largest output of the row.
    pub of_row: f64,
    /// Lines that are compared as text.
    pub header_lines: usize,
    /// Tab-separated columns at the beginning that are not outputs.
    pub loop_columns: usize,
}

/// Compares two tables.
///
/// # Errors
///
/// The first difference: line, both values and the relative difference.
pub fn tables(got: &str, want: &str, tolerance: Tolerance) -> Result<(), String> {
    let (got, want): (Vec<_>, Vec<_>) = (got.split('\n').collect(), want.split('\n').collect());
    if got.len() != want.len() {
        return Err(format!("{} lines, expected {}", got.len(), want.len()));
    }
    for (number, (got, want)) in got.iter().zip(&want).enumerate() {
        if got == want {
            continue;
        }
        if number < tolerance.header_lines {
            return Err(format!("line {}: {got:?}, expected {want:?}", number + 1));
        }
        line(got, want, tolerance).map_err(|why| format!("line {}: {why}", number + 1))?;
    }
    Ok(())
}

fn line(got: &str, want: &str, tolerance: Tolerance) -> Result<(), String> {
    let (got_cells, want_cells): (Vec<_>, Vec<_>) = (cells(got), cells(want));
    if got_cells.len() != want_cells.len() {
        return Err(format!("{got:?}, expected {want:?}"));
    }
    let outputs = want.split('\t').skip(tolerance.loop_columns).flat_map(cells);
    let largest = outputs
        .filter_map(|cell| cell.number())
        .filter(|x| x.is_finite())
        .fold(0.0, |m: f64, x| m.max(x.abs()));
    for (a, b) in got_cells.iter().zip(&want_cells) {
        match (a.number(), b.number()) {
            (Some(x), Some(y)) => close(x, y, tolerance, largest)?,
            _ if a == b => {}
            _ => return Err(format!("{a:?}, expected {b:?}")),
        }
    }
    Ok(())
}

fn close(x: f64, y: f64, tolerance: Tolerance, largest: f64) -> Result<(), String> {
    let equal = x == y || (x.is_nan() && y.is_nan());
    let allowed = (tolerance.relative * x.abs().max(y.abs())).max(tolerance.of_row * largest);
    if equal || (x - y).abs() <= allowed {
        return Ok(());
    }
    let relative = (x - y).abs() / x.abs().max(y.abs());
    Err(format!("{x:e}, expected {y:e} (relative difference {relative:.1e})"))
}

/// Part of a line: a number, or text between numbers.
#[derive(Clone, Debug, PartialEq)]
enum Cell<'a> {
    Number(f64),
    Text(&'a str),
}

impl Cell<'_> {
    fn number(&self) -> Option<f64> {
        match self {
            Self::Number(x) => Some(*x),
            Self::Text(_) => None,
        }
    }
}

/// Numbers and the words between them; any white space separates them.
fn cells(line: &str) -> Vec<Cell<'_>> {
    line.split(|c: char| c.is_whitespace() || matches!(c, '(' | ')' | ','))
        .filter(|word| !word.is_empty())
        .map(|word| match word {
            "nan" | "-nan" => Cell::Number(f64::NAN),
            "inf" => Cell::Number(f64::INFINITY),
            "-inf" => Cell::Number(f64::NEG_INFINITY),
            _ => {
                let read = number_prefix(word.as_bytes());
                match read.value {
                    Some(x) if read.taken == word.len() => Cell::Number(x),
                    _ => Cell::Text(word),
                }
            }
        })
        .collect()
}

/// A listing without the parts that differ between runs: banner and elapsed time.
pub fn masked_listing(text: &str) -> String {
    let text = text.replace("\r\n", "\n");
    let lines: Vec<&str> = text.split('\n').filter(|l| !l.starts_with("Elapsed time:")).collect();
    let start = lines.iter().position(|l| l.starts_with("Integrating model:")).unwrap_or(0);
    lines[start..].join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXACT: Tolerance =
        Tolerance { relative: 1e-12, of_row: 0.0, header_lines: 1, loop_columns: 0 };

    #[test]
    fn the_notation_of_a_number_does_not_matter() {
        assert_eq!(tables("a\n1.0\tx\n", "a\n1\tx\n", EXACT), Ok(()));
        assert_eq!(tables("a\nnan\n", "a\n-nan\n", EXACT), Ok(()));
    }

    #[test]
    fn a_difference_is_reported_with_its_line() {
        assert!(tables("a\n1\n2\n", "a\n1\n3\n", EXACT).unwrap_err().starts_with("line 3"));
        assert!(tables("b\n1\n", "a\n1\n", EXACT).is_err());
        assert!(tables("a\nx\n", "a\ny\n", EXACT).is_err());
    }

    #[test]
    fn a_tolerance_may_refer_to_the_largest_number_of_the_row() {
        let loose = Tolerance { of_row: 1e-3, ..EXACT };
        assert_eq!(tables("a\n1\t1e-9\n", "a\n1\t0\n", loose), Ok(()));
        assert!(tables("a\n1\t1e-9\n", "a\n1\t0\n", EXACT).is_err());
    }
}
