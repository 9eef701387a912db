//! The text of optical constants: a number, `(n,k)`, a file or a formula.

use super::error::OpticsError;
use super::table_text::{TableText, constant};
use crate::dialect::{Dialect, TextDeviation};
use crate::expr::Expr;
use crate::number::{self, is_blank, number_prefix, whole_number};

/// A dielectric function as text. The index is n + ik with k ≥ 0 absorbing.
#[derive(Clone, Debug, PartialEq)]
pub enum IndexText {
    /// A number, or (n,k).
    Constant {
        /// Real part.
        n: f64,
        /// Imaginary part.
        k: f64,
    },
    /// Two neighbouring columns of a file over the wavelength in µm.
    File {
        /// The file.
        name: String,
        /// The column of n, from 1; k is in the next column.
        column: usize,
    },
    /// Expressions of the wavelength in µm: the first is n, the second k.
    Formula {
        /// The variable.
        variable: String,
        /// n and k.
        columns: Expr,
    },
}

impl IndexText {
    /// Reads the text of optical constants.
    ///
    /// Compat: as the stream of NIST's program does: `1.5abc` is 1.5, `./gold.txt` is the file
    /// `/gold.txt`. Sound: a text is a number only as a whole, and arithmetic that NIST's
    /// program would cut after its first number is refused.
    ///
    /// # Errors
    /// See [`OpticsError`].
    pub fn parse(text: &str, dialect: Dialect) -> Result<Self, OpticsError> {
        if TextDeviation::IndexPrefix.applies_in(dialect) {
            return match stream(text) {
                StreamReading::Constant(n, k) => Ok(Self::Constant { n, k }),
                StreamReading::Rest(rest) => Self::table(rest, dialect),
            };
        }
        let whole = text.trim();
        if let Some((n, k)) = whole_number(whole).map(|n| (n, 0.0)).or_else(|| pair(whole)) {
            return Ok(Self::Constant { n, k });
        }
        if let (StreamReading::Constant(n, k), Some(_)) = (stream(whole), constant(whole)) {
            let reading = number::list(&[n, k], number::TEXT_DIGITS);
            let (text, deviation) = (text.to_owned(), TextDeviation::IndexPrefix);
            return Err(OpticsError::Refused { text, reading, deviation });
        }
        match Self::table(whole, dialect)? {
            Self::File { name, .. } if name.starts_with('(') => {
                Err(OpticsError::Pair { text: whole.to_owned() })
            }
            read => Ok(read),
        }
    }

    fn table(text: &str, dialect: Dialect) -> Result<Self, OpticsError> {
        Ok(match TableText::parse(text, dialect)? {
            TableText::Constant(value) => {
                let k = value.as_slice().get(1).copied().unwrap_or(0.0);
                Self::Constant { n: value.first(), k }
            }
            TableText::Formula { variable, columns } => Self::Formula { variable, columns },
            TableText::File { name, column } => Self::File { name, column: column.unwrap_or(2) },
        })
    }
}

/// The reading of a text by NIST's streams: a constant, or the rest of the text.
enum StreamReading<'t> {
    Constant(f64, f64),
    Rest(&'t str),
}

/// Reads a number, or else a complex number; each attempt consumes the characters it reads.
fn stream(text: &str) -> StreamReading<'_> {
    let bytes = text.as_bytes();
    let first = number_prefix(bytes);
    if let Some(n) = first.value {
        return StreamReading::Constant(n, 0.0);
    }
    let mut at = first.taken;
    skip_blanks(bytes, &mut at);
    if bytes.get(at) != Some(&b'(') {
        let second = number_prefix(&bytes[at..]);
        return match second.value {
            Some(n) => StreamReading::Constant(n, 0.0),
            None => StreamReading::Rest(&text[at + second.taken..]),
        };
    }
    at += 1;
    match complex(bytes, &mut at) {
        Some((n, k)) => StreamReading::Constant(n, k),
        None => StreamReading::Rest(&text[at..]),
    }
}

/// `n)` or `n,k)`; `at` moves past the consumed characters.
fn complex(bytes: &[u8], at: &mut usize) -> Option<(f64, f64)> {
    let n = part(bytes, at)?;
    match bytes.get(*at) {
        Some(b')') => {
            *at += 1;
            Some((n, 0.0))
        }
        Some(b',') => {
            *at += 1;
            let k = part(bytes, at)?;
            let closed = bytes.get(*at) == Some(&b')');
            *at += usize::from(closed);
            closed.then_some((n, k))
        }
        _ => None,
    }
}

/// A number and the blanks after it.
fn part(bytes: &[u8], at: &mut usize) -> Option<f64> {
    let read = number_prefix(&bytes[*at..]);
    *at += read.taken;
    read.value?;
    skip_blanks(bytes, at);
    read.value
}

fn skip_blanks(bytes: &[u8], at: &mut usize) {
    *at += bytes[*at..].iter().take_while(|byte| is_blank(**byte)).count();
}

/// `(n,k)` or `(n)` as a whole.
fn pair(text: &str) -> Option<(f64, f64)> {
    let mut at = 1;
    let inside = text.starts_with('(').then_some(text.as_bytes())?;
    complex(inside, &mut at).filter(|_| at == text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compat(text: &str) -> IndexText {
        IndexText::parse(text, Dialect::Compat).unwrap()
    }

    fn sound(text: &str) -> IndexText {
        IndexText::parse(text, Dialect::Sound).unwrap()
    }

    fn constant(n: f64, k: f64) -> IndexText {
        IndexText::Constant { n, k }
    }

    fn file(name: &str, column: usize) -> IndexText {
        IndexText::File { name: name.into(), column }
    }

    #[test]
    fn plain_texts_are_read_alike() {
        for read in [compat, sound] {
            assert_eq!(read("1.5"), constant(1.5, 0.0));
            assert_eq!(read("(4.05,0.05)"), constant(4.05, 0.05));
            assert_eq!(read("(1.5)"), constant(1.5, 0.0));
            assert_eq!(read(" (1.5 , 0.2)"), constant(1.5, 0.2));
            assert_eq!(read("metal.nk"), file("metal.nk", 2));
            assert_eq!(read("gold.txt!4"), file("gold.txt", 4));
            assert!(matches!(read("@x:1.5+0.01/x^2,0.1*x"), IndexText::Formula { .. }));
        }
    }

    #[test]
    fn nist_reads_prefixes_and_consumes_incomplete_numbers() {
        assert_eq!(compat("1.5+0.3"), constant(1.5, 0.0));
        assert_eq!(compat("1.5abc"), constant(1.5, 0.0));
        assert_eq!(compat("2gold.txt"), constant(2.0, 0.0));
        assert_eq!(compat("(1.6,0.2)xyz"), constant(1.6, 0.2));
        assert_eq!(compat("(1.5,0.1,7)"), file(",7)", 2));
        assert_eq!(compat("./nk.txt"), file("/nk.txt", 2));
        assert_eq!(compat("../a/b"), file("/a/b", 2));
        assert_eq!(compat("-x"), file("x", 2));
    }

    #[test]
    fn the_sound_dialect_reads_what_is_written_or_refuses() {
        assert_eq!(sound("./nk.txt"), file("./nk.txt", 2));
        assert_eq!(sound("../a/b"), file("../a/b", 2));
        assert_eq!(sound("2gold.txt"), file("2gold.txt", 2));
        assert_eq!(sound("my gold.txt"), file("my gold.txt", 2));
        for text in ["1.5+0.3", "1.5,0.2", "1.5 b"] {
            let error = IndexText::parse(text, Dialect::Sound).unwrap_err();
            assert!(matches!(error, OpticsError::Refused { .. }), "{text}");
        }
        for text in ["(1.446,0", "(n,k)"] {
            let error = IndexText::parse(text, Dialect::Sound).unwrap_err();
            assert!(matches!(error, OpticsError::Pair { .. }), "{text}: {error:?}");
        }
        assert!(IndexText::parse("", Dialect::Sound).is_err());
        assert!(IndexText::parse("", Dialect::Compat).is_err());
    }
}
