//! The text of a film stack: `material thickness material thickness …`.

use super::error::OpticsError;
use super::index::IndexText;
use crate::dialect::{Dialect, TextDeviation};
use crate::number::{number_prefix, whole_number};
use crate::table;

/// A film stack as text.
#[derive(Clone, Debug, PartialEq)]
pub enum StackText {
    /// Films, the one next to the substrate first; there may be none.
    Films(Vec<FilmText>),
    /// The name of a file with such films.
    File(String),
}

/// One film.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmText {
    /// Its material.
    pub material: IndexText,
    /// Its thickness in µm.
    pub thickness: f64,
}

impl StackText {
    /// Reads the text of a stack parameter: empty, one word that names a file, or films.
    ///
    /// # Errors
    /// A material without a thickness, a thickness that is not a number; sound: one that only
    /// begins with a number or is negative.
    pub fn parse(text: &str, dialect: Dialect) -> Result<Self, OpticsError> {
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        match words[..] {
            [file] => Ok(Self::File(file.into())),
            _ => films(&words, dialect).map(Self::Films),
        }
    }

    /// Reads the films of a stack file; `;` starts a comment.
    ///
    /// # Errors
    /// As for [`StackText::parse`], and negative thicknesses.
    pub fn parse_file(text: &str, dialect: Dialect) -> Result<Vec<FilmText>, OpticsError> {
        if let Some(line) = table::open_comment(text) {
            return Err(OpticsError::OpenComment { line });
        }
        let words = table::lines(text).flat_map(|line| line.text.split_ascii_whitespace());
        let films = films(&words.collect::<Vec<_>>(), dialect)?;
        match films.iter().find(|film| film.thickness < 0.0) {
            Some(film) => Err(OpticsError::Thickness { text: film.thickness.to_string() }),
            None => Ok(films),
        }
    }
}

fn films(words: &[&str], dialect: Dialect) -> Result<Vec<FilmText>, OpticsError> {
    let film = |pair: &[&str]| {
        let material = IndexText::parse(pair[0], dialect)?;
        let thickness = thickness(pair.get(1).copied().unwrap_or(""), dialect)?;
        Ok(FilmText { material, thickness })
    };
    words.chunks(2).map(film).collect()
}

fn thickness(text: &str, dialect: Dialect) -> Result<f64, OpticsError> {
    let invalid = || OpticsError::Thickness { text: text.into() };
    let read = number_prefix(text.as_bytes()).value.ok_or_else(invalid)?;
    let refused = |deviation| {
        let reading = read.to_string();
        Err(OpticsError::Refused { text: text.into(), reading, deviation })
    };
    if whole_number(text).is_none() && TextDeviation::NumberPrefix.refused_in(dialect) {
        return refused(TextDeviation::NumberPrefix);
    }
    if read < 0.0 && TextDeviation::NegativeThickness.refused_in(dialect) {
        return refused(TextDeviation::NegativeThickness);
    }
    Ok(read)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stack_is_nothing_a_file_or_films() {
        let parse = |text| StackText::parse(text, Dialect::Sound).unwrap();
        assert_eq!(parse(""), StackText::Films(vec![]));
        assert_eq!(parse("hl.stk"), StackText::File("hl.stk".into()));
        let StackText::Films(films) = parse("silica.nk 0.1 (1.7,0.01) 0.087") else { panic!() };
        assert_eq!(films.len(), 2);
        assert_eq!(films[1].material, IndexText::Constant { n: 1.7, k: 0.01 });
        assert_eq!(films[1].thickness, 0.087);
    }

    #[test]
    fn a_file_holds_the_same_pairs_and_comments() {
        let text = "; quarter waves\n(1.38,0) 0.097 ; low\n2.3\n0.058";
        assert_eq!(StackText::parse_file(text, Dialect::Compat).unwrap().len(), 2);
        assert!(StackText::parse_file("1.5 -1", Dialect::Compat).is_err());
        assert!(StackText::parse_file("1.5 1 ; never ends", Dialect::Compat).is_err());
    }

    #[test]
    fn a_thickness_is_needed_and_is_a_number() {
        for text in ["1.5 0.1 1.6", "1.5 thick", "(1.5, 0.1) x"] {
            for dialect in [Dialect::Compat, Dialect::Sound] {
                assert!(StackText::parse(text, dialect).is_err(), "{text}");
            }
        }
        for text in ["1.5 0.1um", "1.5 -0.1"] {
            assert!(StackText::parse(text, Dialect::Compat).is_ok(), "{text}");
            assert!(StackText::parse(text, Dialect::Sound).is_err(), "{text}");
        }
    }
}
