//! Numbers as C++ output streams write them: `%g` with a number of digits.

use std::fmt::Write as _;

use super::digits::{Digits, MOST};

/// Width of a loop value that is written into a variable.
const LOOP_WIDTH: usize = 16;

/// Digits that NIST's program keeps where a value becomes text again.
pub const TEXT_DIGITS: usize = 16;

/// `x` with at most `digits` significant digits as `%.{digits}g` writes it: trailing zeros
/// dropped, an exponent of two digits or more outside of 1e-4 … 10^digits; `inf`, `nan`, `-nan`.
pub fn general(x: f64, digits: usize) -> String {
    let mut text = String::with_capacity(digits.min(MOST) + 7);
    push_general(&mut text, x, digits);
    text
}

/// Appends [`general`] to `text`.
pub fn push_general(text: &mut String, x: f64, digits: usize) {
    if x.is_sign_negative() {
        text.push('-');
    }
    if x.is_finite() {
        push_finite(text, x.abs(), digits.max(1), false);
    } else {
        text.push_str(odd(x));
    }
}

/// A value as text: one number, or several as `(a,b,c)` without blanks.
pub fn list(values: &[f64], digits: usize) -> String {
    let mut text = String::with_capacity(values.len() * (digits.min(MOST) + 8));
    push_list(&mut text, values, digits);
    text
}

/// Appends [`list`] to `text`.
pub fn push_list(text: &mut String, values: &[f64], digits: usize) {
    if let [one] = values {
        return push_general(text, *one, digits);
    }
    text.push('(');
    for (at, x) in values.iter().enumerate() {
        if at > 0 {
            text.push(',');
        }
        push_general(text, *x, digits);
    }
    text.push(')');
}

/// The text that a FOR loop writes into its variable: 16 digits, to the right of 16 columns.
pub fn loop_text(x: f64) -> String {
    format!("{:>LOOP_WIDTH$}", general(x, TEXT_DIGITS))
}

/// The number that [`loop_text`] of x is read as; none if x is not finite.
pub fn reread(x: f64) -> Option<f64> {
    // 16 digits hold every whole number up to 10^15.
    if x.trunc() == x && x.abs() < 1e15 {
        return Some(x);
    }
    general(x, TEXT_DIGITS).parse().ok().filter(|x: &f64| x.is_finite())
}

/// `inf` or `nan` without a sign.
pub(super) fn odd(x: f64) -> &'static str {
    if x.is_nan() { "nan" } else { "inf" }
}

/// Appends `%.{digits}g` of a finite x ≥ 0; `alternate` (`#`) keeps trailing zeros.
pub(super) fn push_finite(text: &mut String, x: f64, digits: usize, alternate: bool) {
    with_digits(x, digits, |all, exponent| {
        let kept = if alternate { all } else { all.trim_end_matches('0') };
        if exponent < -4 || exponent >= digits as i32 {
            push_pointed(text, kept, 1, alternate);
            push_exponent(text, exponent);
        } else if exponent < 0 {
            text.push_str("0.");
            text.extend(std::iter::repeat_n('0', (-exponent - 1) as usize));
            text.push_str(kept);
        } else {
            push_pointed(text, kept, exponent as usize + 1, alternate);
        }
    });
}

/// Hands the first `count` digits of a finite x ≥ 0 to `write`, and the power of ten of the first.
pub(super) fn with_digits(x: f64, count: usize, write: impl FnOnce(&str, i32)) {
    if let Some(digits) = Digits::of(x, count) {
        return write(digits.as_str(), digits.exponent);
    }
    let scientific = format!("{:.*e}", count - 1, x);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    write(&mantissa.replace('.', ""), exponent.parse().unwrap_or(0));
}

/// Appends a finite x ≥ 0 as d.ddde+05 with `count` digits; `point` writes a point even where
/// nothing follows.
pub(super) fn push_scientific(text: &mut String, x: f64, count: usize, point: bool) {
    match Digits::of(x, count).and_then(|digits| digits.scientific(point)) {
        Some(short) => text.push_str(short.as_str()),
        None => with_digits(x, count, |all, exponent| {
            push_pointed(text, all, 1, point);
            push_exponent(text, exponent);
        }),
    }
}

/// Appends `digits` with a point behind the first `whole` of them, filled up with zeros; `point`
/// writes it even where nothing follows.
pub(super) fn push_pointed(text: &mut String, digits: &str, whole: usize, point: bool) {
    let (before, behind) = digits.split_at(whole.min(digits.len()));
    text.push_str(before);
    text.extend(std::iter::repeat_n('0', whole - before.len()));
    if point || !behind.is_empty() {
        text.push('.');
    }
    text.push_str(behind);
}

/// Appends `e+05` and the like.
pub(super) fn push_exponent(text: &mut String, exponent: i32) {
    text.push_str(if exponent < 0 { "e-" } else { "e+" });
    let size = exponent.unsigned_abs();
    if size < 100 {
        text.push(char::from(b'0' + (size / 10) as u8));
        text.push(char::from(b'0' + (size % 10) as u8));
    } else {
        // Writing to a string cannot fail.
        let _ = write!(text, "{size}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::whole_number;

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
        for x in [0.1 + 0.2, 1e15, 3.0, -0.0, 1e-320, 0.55, f64::NAN, f64::INFINITY, f64::MAX] {
            let text = loop_text(x);
            assert_eq!(reread(x).map(f64::to_bits), whole_number(&text).map(f64::to_bits), "{x}");
        }
    }
}
