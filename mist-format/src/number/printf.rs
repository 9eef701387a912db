//! The number format of FILES: a C printf format for one double.

use std::fmt::Write as _;

use super::digits::Digits;
use super::general::{odd, push_finite, push_pointed, push_scientific};

/// NIST prints into a buffer of 256 characters; longer texts are cut.
const LONGEST: usize = 255;

/// Widths and precisions above this are refused: they only fill the line with blanks.
const WIDEST: usize = 4096;

/// Error of a number format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FormatError {
    /// The conversion is not for a double; the result would be arbitrary.
    #[error("`{conversion}` does not print a number; use one of %g %e %f %a")]
    Unsupported {
        /// The conversion as written.
        conversion: String,
    },
    /// A second conversion would print an arbitrary number.
    #[error("`{conversion}` is a second conversion; each output is one number")]
    Second {
        /// The conversion as written.
        conversion: String,
    },
    /// A `%` without an end.
    #[error("`{conversion}` is not a whole conversion; write %% for a percent sign")]
    Incomplete {
        /// The incomplete conversion.
        conversion: String,
    },
    /// Width or precision exceeds the limit.
    #[error("`{conversion}` is wider than {WIDEST} characters")]
    TooWide {
        /// The conversion as written.
        conversion: String,
    },
}

/// A parsed format: text, one conversion or none, text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PrintfFormat {
    before: String,
    conversion: Option<Conversion>,
    after: String,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Conversion {
    left: bool,
    plus: bool,
    blank: bool,
    alternate: bool,
    zero: bool,
    width: usize,
    precision: Option<usize>,
    letter: u8,
}

impl Default for PrintfFormat {
    /// `%10g\t`.
    fn default() -> Self {
        let conversion = Conversion { width: 10, letter: b'g', ..Conversion::default() };
        Self { before: String::new(), conversion: Some(conversion), after: "\t".into() }
    }
}

impl PrintfFormat {
    /// Reads a format; the two characters `\t` are a tab, there are no other escapes.
    ///
    /// # Errors
    /// Conversions that do not print a double (`%d`, `%s`, `%Lg`), more than one conversion,
    /// and a lone `%` are refused in every dialect: C leaves their result undefined.
    pub fn parse(text: &str) -> Result<Self, FormatError> {
        let text = text.replace("\\t", "\t");
        let mut format = Self { before: String::new(), conversion: None, after: String::new() };
        let mut rest = text.as_str();
        while let Some(at) = rest.find('%') {
            format.tail().push_str(&rest[..at]);
            rest = &rest[at..];
            if let Some(more) = rest.strip_prefix("%%") {
                format.tail().push('%');
                rest = more;
                continue;
            }
            let (conversion, len) = Conversion::parse(rest)?;
            if format.conversion.replace(conversion).is_some() {
                return Err(FormatError::Second { conversion: rest[..len].into() });
            }
            rest = &rest[len..];
        }
        format.tail().push_str(rest);
        Ok(format)
    }

    /// True if two numbers in this format can be told apart: there is text before or behind them
    /// that is not part of a number, or their width has room for a blank.
    pub fn separates(&self) -> bool {
        let is_separator = |c: char| !(c.is_alphanumeric() || "+-.".contains(c));
        // Sign, point and an exponent of five characters.
        let has_room = |c: &Conversion| {
            c.width > c.precision.unwrap_or(6) + 8 && !matches!(c.letter, b'f' | b'F')
        };
        self.before.contains(is_separator)
            || self.after.contains(is_separator)
            || self.conversion.as_ref().is_none_or(has_room)
    }

    fn tail(&mut self) -> &mut String {
        if self.conversion.is_some() { &mut self.after } else { &mut self.before }
    }

    /// The number as text, cut after 255 bytes.
    pub fn format(&self, x: f64) -> String {
        let mut text = String::new();
        self.push(&mut text, x);
        text
    }

    /// Appends [`PrintfFormat::format`] to `text`.
    pub fn push(&self, text: &mut String, x: f64) {
        let start = text.len();
        text.push_str(&self.before);
        if let Some(conversion) = &self.conversion {
            conversion.push(text, x);
        }
        text.push_str(&self.after);
        if text.len() - start > LONGEST {
            let cut = (start..=start + LONGEST).rev().find(|at| text.is_char_boundary(*at));
            text.truncate(cut.unwrap_or(start));
        }
    }
}

impl Conversion {
    /// Reads a conversion from its `%` on; gives its length too.
    fn parse(text: &str) -> Result<(Self, usize), FormatError> {
        let bytes = text.as_bytes();
        let mut at = 1;
        let mut conversion = Self::default();
        while let Some(flag) = bytes.get(at) {
            match flag {
                b'-' => conversion.left = true,
                b'+' => conversion.plus = true,
                b' ' => conversion.blank = true,
                b'#' => conversion.alternate = true,
                b'0' => conversion.zero = true,
                _ => break,
            }
            at += 1;
        }
        let number = |at: &mut usize| {
            let start = *at;
            *at += bytes[start..].iter().take_while(|b| b.is_ascii_digit()).count();
            if *at == start { Some(0) } else { text[start..*at].parse().ok() }
        };
        let width: Option<usize> = number(&mut at);
        let mut precision = Some(None);
        if bytes.get(at) == Some(&b'.') {
            at += 1;
            precision = number(&mut at).map(Some);
        }
        // `l` before a floating-point conversion changes nothing in C.
        if bytes.get(at) == Some(&b'l') {
            at += 1;
        }
        let letter = bytes.get(at).copied();
        let len = text[at.min(text.len())..].chars().next().map_or(at, |c| at + c.len_utf8());
        let written = || text[..len].to_owned();
        match letter {
            Some(b'g' | b'G' | b'e' | b'E' | b'f' | b'F' | b'a' | b'A') => {}
            None => return Err(FormatError::Incomplete { conversion: written() }),
            Some(_) => return Err(FormatError::Unsupported { conversion: written() }),
        }
        let too_wide = || FormatError::TooWide { conversion: written() };
        conversion.width = width.filter(|w| *w <= WIDEST).ok_or_else(too_wide)?;
        conversion.precision =
            precision.filter(|p| p.is_none_or(|p| p <= WIDEST)).ok_or_else(too_wide)?;
        conversion.letter = letter.unwrap_or(b'g');
        Ok((conversion, len))
    }

    fn push(&self, text: &mut String, x: f64) {
        let start = text.len();
        match (x.is_sign_negative(), self.plus, self.blank) {
            (true, _, _) => text.push('-'),
            (false, true, _) => text.push('+'),
            (false, false, true) => text.push(' '),
            (false, false, false) => {}
        }
        if self.letter.eq_ignore_ascii_case(&b'a') && x.is_finite() {
            text.push_str("0x");
        }
        let body = text.len();
        self.push_body(text, x);
        // Every text here is ASCII: bytes are columns.
        let fill = self.width.saturating_sub(text.len() - start);
        if fill > 0 {
            let (place, with) = match (self.left, self.zero && x.is_finite()) {
                (true, _) => (text.len(), " "),
                (false, true) => (body, "0"),
                (false, false) => (start, " "),
            };
            text.insert_str(place, &with.repeat(fill));
        }
        if self.letter.is_ascii_uppercase() {
            text[start..].make_ascii_uppercase();
        }
    }

    /// Appends |x| without its prefix.
    fn push_body(&self, text: &mut String, x: f64) {
        let magnitude = x.abs();
        let digits = self.precision.unwrap_or(6);
        match self.letter.to_ascii_lowercase() {
            _ if !x.is_finite() => text.push_str(odd(x)),
            b'e' => push_scientific(text, magnitude, digits + 1, self.alternate),
            b'f' => self.push_fixed(text, magnitude, digits),
            b'a' => text.push_str(&hexadecimal(magnitude, self.precision, self.alternate)),
            _ => push_finite(text, magnitude, digits.max(1), self.alternate),
        }
    }

    /// Appends `%f` of a finite x ≥ 0.
    fn push_fixed(&self, text: &mut String, x: f64, places: usize) {
        if let Some(digits) = Digits::down_to(x, places) {
            let whole = digits.exponent as usize + 1;
            return push_pointed(text, digits.as_str(), whole, self.alternate);
        }
        // Writing to a string cannot fail.
        let _ = write!(text, "{x:.places$}");
        if self.alternate && places == 0 {
            text.push('.');
        }
    }
}

/// `%a` of a finite x ≥ 0 without `0x`, as glibc writes it: one digit before the point.
fn hexadecimal(x: f64, precision: Option<usize>, alternate: bool) -> String {
    const FRACTION_DIGITS: usize = 13;
    let bits = x.to_bits();
    let fraction = bits & ((1 << 52) - 1);
    let biased = (bits >> 52) as i32;
    let (lead, exponent) = match (biased, fraction) {
        (0, 0) => (0, 0),
        (0, _) => (0, -1022),
        _ => (1, biased - 1023),
    };
    let whole = (lead << 52) | fraction;
    let kept = precision.unwrap_or(FRACTION_DIGITS);
    let rounded =
        if kept < FRACTION_DIGITS { round_half_even(whole, 52 - 4 * kept) } else { whole };
    let digits = format!("{:013x}", rounded & ((1 << 52) - 1));
    let shown = match precision {
        Some(p) if p <= FRACTION_DIGITS => digits[..p].to_owned(),
        Some(p) => format!("{digits}{}", "0".repeat(p - FRACTION_DIGITS)),
        None => digits.trim_end_matches('0').to_owned(),
    };
    let point = if shown.is_empty() && !alternate { "" } else { "." };
    format!("{}{point}{shown}p{exponent:+}", rounded >> 52)
}

fn round_half_even(value: u64, bits: usize) -> u64 {
    let unit = 1u64 << bits;
    let rest = value & (unit - 1);
    let floor = value - rest;
    let up = rest > unit / 2 || (rest == unit / 2 && floor & unit != 0);
    if up { floor + unit } else { floor }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn print(format: &str, x: f64) -> String {
        PrintfFormat::parse(format).unwrap().format(x)
    }

    // Expected texts come from the printf of glibc.
    #[test]
    fn conversions_print_as_in_c() {
        let cases = [
            ("%10g\\t", 0.142857142857, "  0.142857\t"),
            ("%.15le|", 0.12, "1.200000000000000e-01|"),
            ("%12.5f|", 3.62e-7, "     0.00000|"),
            ("%-8g|", 1.5, "1.5     |"),
            ("%+08.2f", 2.5, "+0002.50"),
            ("% g", 2.0, " 2"),
            ("%#g", 2.0, "2.00000"),
            ("%.0f", 0.5, "0"),
            ("%.0f", 1.5, "2"),
            ("%#.0f", 3.0, "3."),
            ("%E", 12345.678, "1.234568E+04"),
            ("%G", 1e-10, "1E-10"),
            ("%a", 1.0, "0x1p+0"),
            ("%a", 0.1, "0x1.999999999999ap-4"),
            ("%.2a", 0.1, "0x1.9ap-4"),
            ("%.0a", 1.5, "0x2p+0"),
            ("%012a", 1.0, "0x0000001p+0"),
            ("%a", 0.0, "0x0p+0"),
            ("100%% %g", 1.0, "100% 1"),
            ("%08g", f64::INFINITY, "     inf"),
            ("%g", -0.0, "-0"),
            ("%.17g", 0.1, "0.10000000000000001"),
        ];
        for (format, x, text) in cases {
            assert_eq!(print(format, x), text, "{format}");
        }
    }

    #[test]
    fn a_format_without_a_conversion_prints_its_text() {
        assert_eq!(print("abc", 1.0), "abc");
        assert_eq!(print("", 1.0), "");
    }

    #[test]
    fn more_than_255_characters_are_cut() {
        assert_eq!(print("%12.5f|", 1e300).len(), 255);
    }

    #[test]
    fn conversions_that_are_not_for_a_double_are_refused() {
        for format in ["%d", "%s", "%Lg", "%", "%5", "%g%g", "%n", "%*g", "%999999g", "%lµ"] {
            assert!(PrintfFormat::parse(format).is_err(), "{format}");
        }
    }
}
