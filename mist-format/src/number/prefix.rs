//! Reads a number from the beginning of a text as a C++ stream does.
//!
//! The stream takes the longest run of characters that resembles a number and converts it; a run
//! that does not convert (`3e`, `.`, `1e400`) is consumed too.

/// The result of `>> double` of a C++ stream.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NumberPrefix {
    /// The number, if the run converts to a finite one.
    pub value: Option<f64>,
    /// Bytes taken: white space, sign and all characters of the run.
    pub taken: usize,
    /// Start of the run, after the white space.
    pub start: usize,
    /// The sign, if one was taken.
    pub sign: Option<u8>,
}

impl NumberPrefix {
    /// True if more than white space and a sign was taken.
    pub fn has_body(&self) -> bool {
        self.taken > self.start + usize::from(self.sign.is_some())
    }
}

/// Reads a floating-point number from the beginning of `text`.
pub fn number_prefix(text: &[u8]) -> NumberPrefix {
    let start = text.iter().position(|b| !is_blank(*b)).unwrap_or(text.len());
    let mut at = start;
    let sign = text.get(at).copied().filter(|b| matches!(b, b'+' | b'-'));
    at += usize::from(sign.is_some());
    let (mut digits, mut point, mut exponent) = (false, false, false);
    while let Some(&byte) = text.get(at) {
        match byte {
            b'0'..=b'9' => digits = true,
            b'.' if !point && !exponent => point = true,
            b'e' | b'E' if digits && !exponent => {
                exponent = true;
                if matches!(text.get(at + 1), Some(b'+' | b'-')) {
                    at += 1;
                }
            }
            _ => break,
        }
        at += 1;
    }
    let run = text.get(start..at).and_then(|run| std::str::from_utf8(run).ok());
    let value = run.and_then(|run| run.parse().ok()).filter(|value: &f64| value.is_finite());
    NumberPrefix { value, taken: at, start, sign }
}

/// The result of `>> int` of a C++ stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IntegerPrefix {
    /// The number, if there are digits and they fit.
    pub value: Option<i64>,
    /// Bytes taken.
    pub taken: usize,
}

/// Reads an integer from the beginning of `text`.
pub fn integer_prefix(text: &str) -> IntegerPrefix {
    let bytes = text.as_bytes();
    let start = bytes.iter().position(|b| !is_blank(*b)).unwrap_or(bytes.len());
    let signed = matches!(bytes.get(start), Some(b'+' | b'-'));
    let digits = start + usize::from(signed);
    let end = digits + bytes[digits..].iter().take_while(|b| b.is_ascii_digit()).count();
    let value = text[start..end].parse().ok().filter(|v| i32::try_from(*v).is_ok());
    IntegerPrefix { value, taken: end }
}

/// The number that the whole of `text` is, blanks around it allowed.
pub fn whole_number(text: &str) -> Option<f64> {
    let trimmed = text.trim_end_matches(|c: char| c.is_ascii() && is_blank(c as u8));
    let read = number_prefix(trimmed.as_bytes());
    read.value.filter(|_| read.taken == trimmed.len())
}

/// White space as C's `isspace` has it.
pub(crate) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t'..=b'\r')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Option<f64>, usize) {
        let prefix = number_prefix(text.as_bytes());
        (prefix.value, prefix.taken)
    }

    #[test]
    fn the_longest_run_that_looks_like_a_number_is_taken() {
        assert_eq!(read("5.x"), (Some(5.0), 2));
        assert_eq!(read(".5"), (Some(0.5), 2));
        assert_eq!(read("  -1e-2+3"), (Some(-0.01), 7));
        assert_eq!(read("1.2.3"), (Some(1.2), 3));
        assert_eq!(read("1e5.3"), (Some(1e5), 3));
        assert_eq!(read("1e-320"), (Some(1e-320), 6));
    }

    #[test]
    fn a_run_that_does_not_convert_is_taken_too() {
        assert_eq!(read("3exp"), (None, 2));
        assert_eq!(read("1e+x"), (None, 3));
        assert_eq!(read("1e400"), (None, 5));
        assert_eq!(read("-x"), (None, 1));
        assert_eq!(read("."), (None, 1));
        assert_eq!(read("inf"), (None, 0));
        assert_eq!(read(""), (None, 0));
    }

    #[test]
    fn integers_end_at_the_first_other_character() {
        assert_eq!(integer_prefix("007"), IntegerPrefix { value: Some(7), taken: 3 });
        assert_eq!(integer_prefix("8abc"), IntegerPrefix { value: Some(8), taken: 1 });
        assert_eq!(integer_prefix("x").value, None);
        assert_eq!(integer_prefix("99999999999").value, None);
    }

    #[test]
    fn a_whole_number_leaves_nothing_over() {
        assert_eq!(whole_number(" 1.5 "), Some(1.5));
        assert_eq!(whole_number("1.5um"), None);
        assert_eq!(whole_number(""), None);
    }
}
