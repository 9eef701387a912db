//! The coefficient file of a Zernike expansion.

/// One line: `i j n m k l p c`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CoefficientLine {
    /// Row of the Mueller matrix, 1 to 4.
    pub i: usize,
    /// Column, from i to 4.
    pub j: usize,
    /// Radial order that goes with k.
    pub n: u32,
    /// Radial order that goes with l.
    pub m: u32,
    /// Azimuthal order that goes with n.
    pub k: i32,
    /// Azimuthal order that goes with m.
    pub l: i32,
    /// Power of the wavelength in µm.
    pub p: i32,
    /// Coefficient.
    pub c: f64,
}

/// The radial order above which the powers of a polynomial lose all digits.
const HIGHEST_ORDER: u32 = 40;

/// Reads the lines of `text`; blank ones are passed over.
pub(super) fn read(text: &str) -> Result<Vec<CoefficientLine>, String> {
    let mut lines = Vec::new();
    for (number, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        lines.push(read_line(line).map_err(|problem| format!("line {}: {problem}", number + 1))?);
    }
    if lines.is_empty() {
        return Err("no coefficients".to_owned());
    }
    Ok(lines)
}

fn read_line(line: &str) -> Result<CoefficientLine, String> {
    let words: Vec<&str> =
        line.split([',', ' ', '\t', '\r']).filter(|word| !word.is_empty()).collect();
    let [i, j, n, m, k, l, p, c] = words[..] else {
        return Err(format!("{} columns where `i j n m k l p c` are eight", words.len()));
    };
    let line = CoefficientLine {
        i: parse("i", i)?,
        j: parse("j", j)?,
        n: parse("n", n)?,
        m: parse("m", m)?,
        k: parse("k", k)?,
        l: parse("l", l)?,
        p: parse("p", p)?,
        c: parse("c", c)?,
    };
    if !(1 <= line.i && line.i <= line.j && line.j <= 4) {
        return Err(format!("element {i} {j} is not in the upper half of a Mueller matrix"));
    }
    if line.n.max(line.m) > HIGHEST_ORDER {
        return Err(format!("order {} is above {HIGHEST_ORDER}", line.n.max(line.m)));
    }
    Ok(line)
}

fn parse<T: std::str::FromStr>(column: &str, word: &str) -> Result<T, String> {
    word.parse().map_err(|_| format!("{column} cannot be {word:?}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_and_blanks_separate_alike() {
        assert_eq!(read("1 2 3 1 1 -1 0 0.5\r\n"), read("\n1, 2,3,1,1,-1,\t0,0.5"));
    }

    #[test]
    fn a_wrong_line_is_named_by_its_number() {
        assert!(read("1 1 0 0 0 0 0 1\n\n1 1 0 0 0 0 0\n").unwrap_err().starts_with("line 3"));
    }
}
