//! The text of a Table: a constant, a formula of one variable, or columns of a file.

use super::error::OpticsError;
use crate::dialect::{Dialect, TextDeviation};
use crate::expr::{Expr, NoNames, OperandStack, Value};
use crate::number::number_prefix;

/// A Table parameter as text.
#[derive(Clone, Debug, PartialEq)]
pub enum TableText {
    /// An expression without variables. Column c is its (c−1)st element, and a single number
    /// counts for the first of them only.
    Constant(Value),
    /// `@v:expr,…`: column c is the (c−1)st element.
    Formula {
        /// The variable.
        variable: String,
        /// The columns from the second on.
        columns: Expr,
    },
    /// `file` or `file!k`: the values stand in column k.
    File {
        /// The file.
        name: String,
        /// The column after the `!`, from 1.
        column: Option<usize>,
    },
}

impl TableText {
    /// Reads the text of a Table. Compat: its first word. Sound: the whole text, which may be the
    /// name of a file with blanks.
    ///
    /// # Errors
    /// No text, a formula that is not an expression; sound: several words that begin with a number
    /// or a formula.
    pub fn parse(text: &str, dialect: Dialect) -> Result<Self, OpticsError> {
        if let Some(value) = constant(text) {
            return Ok(Self::Constant(value));
        }
        let mut words = text.split_ascii_whitespace();
        let mut word = words.next().ok_or(OpticsError::Empty)?;
        if words.next().is_some() && TextDeviation::NumberPrefix.refused_in(dialect) {
            if !is_file_name(word) {
                let (text, reading) = (text.to_owned(), word.to_owned());
                return Err(OpticsError::Refused {
                    text,
                    reading,
                    deviation: TextDeviation::NumberPrefix,
                });
            }
            word = text.trim();
        }
        if let Some((variable, formula)) = word.strip_prefix('@').and_then(|w| w.split_once(':')) {
            let columns = Expr::compile_library(formula)
                .map_err(|error| OpticsError::Formula { text: formula.into(), error })?;
            return Ok(Self::Formula { variable: variable.into(), columns });
        }
        let parts = word.rsplit_once('!');
        // Four bytes, so that the next columns are in the range of usize.
        let number = |column: &str| column.parse::<u32>().ok().map(|column| column as usize);
        let numbered = parts.and_then(|(name, column)| Some((name, number(column)?)));
        Ok(match numbered {
            Some((name, column)) => Self::File { name: name.into(), column: Some(column) },
            None => Self::File { name: word.into(), column: None },
        })
    }
}

/// True if the first word of several is the beginning of a file name.
fn is_file_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic() || "_./\\~".contains(c))
        && number_prefix(word.as_bytes()).value.is_none()
}

/// The value of an expression that needs neither names nor files.
pub(super) fn constant(text: &str) -> Option<Value> {
    let expr = Expr::compile_library(text).ok()?;
    expr.eval(&mut NoNames, &mut OperandStack::default()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> TableText {
        TableText::parse(text, Dialect::Sound).unwrap()
    }

    #[test]
    fn the_forms_are_told_apart() {
        assert_eq!(parse("0.5*2"), TableText::Constant(Value::from(1.0)));
        assert_eq!(parse("(1.5,0.2)"), TableText::Constant(Value::new(1.5, &[0.2])));
        let file = |name: &str, column| TableText::File { name: name.into(), column };
        assert_eq!(parse("gold.txt"), file("gold.txt", None));
        assert_eq!(parse("gold.txt!4"), file("gold.txt", Some(4)));
        assert_eq!(parse("wow!.txt"), file("wow!.txt", None));
        assert_eq!(parse("my data/gold 2.txt!3"), file("my data/gold 2.txt", Some(3)));
        assert!(TableText::parse("1.5 gold.txt", Dialect::Sound).is_err());
        let huge = "gold.txt!18446744073709551615";
        assert_eq!(parse(huge), file(huge, None));
        match parse("@w:sqrt(w)+1,if(w>0.5,0.1,0)") {
            TableText::Formula { variable, columns } => {
                assert_eq!(variable, "w");
                assert_eq!(columns.names(), ["w"]);
            }
            other => panic!("{other:?}"),
        }
        assert!(TableText::parse("@x:1+", Dialect::Compat).is_err());
        assert_eq!(TableText::parse(" ", Dialect::Compat), Err(OpticsError::Empty));
    }
}
