//! The two dialects of MIST texts, and the list of their differences.
//!
//! NIST's program reads some texts differently from what is written. [`Dialect::Compat`] reads
//! them in the same way; [`Dialect::Sound`] refuses them (or, for whole files, reads what is
//! written). Each difference is a [`TextDeviation`].

use serde::{Deserialize, Serialize};

/// The dialect of a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Dialect {
    /// Texts that NIST's program misreads are refused with an explanation.
    #[default]
    Sound,
    /// Exactly what NIST's MIST 4.22a reads.
    Compat,
}

impl Dialect {
    /// True for [`Dialect::Compat`].
    pub fn is_compat(self) -> bool {
        self == Self::Compat
    }
}

/// The sound dialect's reading of a text with a deviation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SoundReading {
    /// The same as NIST: the deviation is part of the language.
    Same,
    /// The text is refused.
    Refused,
    /// The text is read as written.
    Plain,
}

/// Declares the deviations; the documentation of an entry is its row in the manual.
macro_rules! text_deviations {
    ($($(#[doc = $doc:literal])+ $name:ident,)*) => {
        /// A deviation of NIST's reading from the written text.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum TextDeviation {
            $($(#[doc = $doc])+ $name,)*
        }

        impl TextDeviation {
            /// All deviations, in the order of the manual.
            pub const ALL: &'static [Self] = &[$(Self::$name),*];

            /// Reading of NIST's program, as the manual states it.
            pub fn deviation(self) -> &'static str {
                match self {
                    $(Self::$name => concat!($($doc),+).trim_ascii(),)*
                }
            }
        }
    };
}

text_deviations! {
    /// `a junk = 5` sets a: everything between a name and the next `=` is ignored, also a name
    /// on a line of its own.
    JunkBeforeEquals,
    /// `= = a = 5` sets a: equal signs before a name are skipped.
    EqualsBeforeName,
    /// `a == 5` gives a the text `=`.
    EqualsBeginsValue,
    /// `$p =` without a value takes the next word, which may be the next name or END;
    /// `""` is an empty value.
    EmptyValue,
    /// A semicolon inside quotes starts a comment; the string goes on in the next line.
    CommentInQuotes,
    /// `8abc` is the output number 8: digits are read up to the first other character.
    NumberPrefix,
    /// Three blanks before an operator (four after a bare name) make it vanish.
    OperatorLostToBlanks,
    /// Of two operands without an operator the last one counts: `2 3` = 3, `2a` = a.
    AdjacentOperands,
    /// A sign is lost before a name: `--x` = −x, `+-x` = x, `␣␣-x` = x.
    SignLost,
    /// `␣␣-2^2` = +4 though `-2^2` = −4: behind blanks the minus belongs to the number.
    SignBindsToNumber,
    /// `1e+x` = x: an incomplete number is dropped.
    NumberJunk,
    /// Arithmetic works on the first element only, the others are appended:
    /// `2*(1,2,3)` = (2,2,3).
    VectorArithmetic,
    /// `(1,2),(3,4)` = (1,2,4,3): lists inside lists come out in another order.
    NestedLists,
    /// `-x^2` = −(x²) at the start of an expression, but `2*-x^2` = 2·(−x)².
    LeadingMinus,
    /// `2^3^2` = 64.
    PowerFromLeft,
    /// `1|0&0` = 0: `&` and `|` have one rank.
    AndOrOneRank,
    /// The last line of a LIST file or table is dropped when it has no line end.
    DroppedLastLine,
    /// `1.5abc` is the index 1.5, and `./gold.txt` names the file `/gold.txt`.
    IndexPrefix,
    /// A thickness may be negative in a text, but not in a file, of a film stack.
    NegativeThickness,
}

impl TextDeviation {
    /// The reading of the sound dialect.
    pub fn sound_reading(self) -> SoundReading {
        match self {
            Self::LeadingMinus | Self::PowerFromLeft | Self::AndOrOneRank => SoundReading::Same,
            Self::DroppedLastLine | Self::IndexPrefix => SoundReading::Plain,
            _ => SoundReading::Refused,
        }
    }

    /// True if `dialect` reads the text as NIST's program does.
    pub fn applies_in(self, dialect: Dialect) -> bool {
        dialect.is_compat() || self.sound_reading() == SoundReading::Same
    }

    /// True if `dialect` refuses texts with the deviation.
    pub fn refused_in(self, dialect: Dialect) -> bool {
        !dialect.is_compat() && self.sound_reading() == SoundReading::Refused
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviations_act_in_compat_and_are_same_refused_or_plain_in_sound() {
        for deviation in TextDeviation::ALL {
            assert!(
                deviation.applies_in(Dialect::Compat) && !deviation.refused_in(Dialect::Compat)
            );
            let sound = deviation.sound_reading();
            assert_eq!(deviation.applies_in(Dialect::Sound), sound == SoundReading::Same);
            assert_eq!(deviation.refused_in(Dialect::Sound), sound == SoundReading::Refused);
        }
    }
}
