//! Numbers as C++ output streams write them: `%g` with a number of digits.

use std::fmt::Write as _;

/// Width of a loop value that is written into a variable.
const LOOP_WIDTH: usize = 16;

/// Digits that NIST's program keeps where a value becomes text again.
pub(crate) const TEXT_DIGITS: usize = 16;

/// `x` with at most `digits` significant digits as `%.{digits}g` writes it: trailing zeros
/// dropped, an exponent of two digits or more outside of 1e-4 … 10^digits; `inf`, `nan`, `-nan`.
pub fn general(x: f64, digits: usize) -> String {
    let body = if x.is_finite() { general_finite(x.abs(), digits.max(1), false) } else { odd(x) };
    if x.is_sign_negative() { format!("-{body}") } else { body }
}

/// A value as text: one number, or several as `(a,b,c)` without blanks.
pub fn list(values: &[f64], digits: usize) -> String {
    match values {
        [one] => general(*one, digits),
        many => {
            let texts: Vec<String> = many.iter().map(|x| general(*x, digits)).collect();
            format!("({})", texts.join(","))
        }
    }
}

/// The text that a FOR loop writes into its variable: 16 digits, to the right of 16 columns.
pub fn loop_text(x: f64) -> String {
    format!("{:>LOOP_WIDTH$}", general(x, TEXT_DIGITS))
}

/// `inf` or `nan` without a sign.
pub(super) fn odd(x: f64) -> String {
    if x.is_nan() { "nan".into() } else { "inf".into() }
}

/// `%.{digits}g` of a finite x ≥ 0; `alternate` (`#`) keeps trailing zeros.
pub(super) fn general_finite(x: f64, digits: usize, alternate: bool) -> String {
    let scientific = format!("{:.*e}", digits - 1, x);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if exponent < -4 || exponent >= digits as i32 {
        let mut text = strip(mantissa, alternate);
        write_exponent(&mut text, exponent);
        text
    } else {
        strip(&plain(mantissa, exponent), alternate)
    }
}

/// `d.ddd` times 10^exponent without an exponent; the digits stay as they are.
fn plain(mantissa: &str, exponent: i32) -> String {
    let mut text = String::with_capacity(mantissa.len() + 6);
    if exponent < 0 {
        text.push_str("0.");
        text.extend(std::iter::repeat_n('0', (-exponent - 1) as usize));
        text.extend(mantissa.chars().filter(|c| *c != '.'));
        return text;
    }
    let whole = exponent as usize + 1;
    for (place, digit) in mantissa.chars().filter(|c| *c != '.').enumerate() {
        if place == whole {
            text.push('.');
        }
        text.push(digit);
    }
    text
}

/// Appends `e+05` and the like.
pub(super) fn write_exponent(text: &mut String, exponent: i32) {
    let sign = if exponent < 0 { '-' } else { '+' };
    // Writing to a string cannot fail.
    let _ = write!(text, "e{sign}{:02}", exponent.abs());
}

fn strip(text: &str, alternate: bool) -> String {
    match (alternate, text.contains('.')) {
        (true, true) => text.to_owned(),
        (true, false) => format!("{text}."),
        (false, true) => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        (false, false) => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_streams_write_them() {
        let cases = [
            (0.0, "0"),
            (-0.0, "-0"),
            (0.0001, "0.0001"),
            (0.00001, "1e-05"),
            (123456.0, "123456"),
            (1234567.0, "1.23457e+06"),
            (999999.5, "1e+06"),
            (1e100, "1e+100"),
            (f64::INFINITY, "inf"),
            (f64::NEG_INFINITY, "-inf"),
        ];
        for (x, text) in cases {
            assert_eq!(general(x, 6), text);
        }
        assert_eq!(general(0.1 + 0.2, 16), "0.3");
        assert_eq!(general(0.1 + 0.2 / 3.0, 16), "0.1666666666666667");
    }

    #[test]
    fn not_a_number_keeps_its_sign() {
        assert_eq!(general(f64::NAN.copysign(1.0), 6), "nan");
        assert_eq!(general(f64::NAN.copysign(-1.0), 6), "-nan");
    }

    #[test]
    fn vectors_and_loop_values_have_their_own_forms() {
        assert_eq!(list(&[1.0, 0.5], 16), "(1,0.5)");
        assert_eq!(list(&[2.0], 16), "2");
        assert_eq!(loop_text(0.4), "             0.4");
    }
}
