//! The one place that says what differs between the two ways of reading a MIST text.
//!
//! NIST's program reads a few things in ways nobody would guess. [`Dialect::Compat`] reads
//! them the same way; [`Dialect::Sound`] refuses them (or, for whole files, reads what is
//! written). Each such thing is a [`Quirk`].

use serde::{Deserialize, Serialize};

/// How texts are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Dialect {
    /// Surprising readings are refused with an explanation.
    #[default]
    Sound,
    /// Exactly what NIST's MIST 4.22a reads.
    Compat,
}

impl Dialect {
    /// Whether this is [`Dialect::Compat`].
    pub fn is_compat(self) -> bool {
        self == Self::Compat
    }
}

/// What the sound dialect does where the quirk would act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SoundReading {
    /// The same as NIST: the quirk is part of the language.
    Same,
    /// The text is refused.
    Refused,
    /// The text means what it says.
    Plain,
}

/// A surprising reading of NIST's program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quirk {
    /// `a junk = 5` sets a: everything between a name and the next `=` is ignored, also a name
    /// on a line of its own.
    JunkBeforeEquals,
    /// `= = a = 5` sets a: equal signs before a name are skipped.
    EqualsBeforeName,
    /// `a == 5` gives a the text `=`.
    EqualsBeginsValue,
    /// `$p =` without a value takes the next word, which may be the next name or END.
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
    /// `1e+x` = x: what only looks like the beginning of a number is dropped.
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

impl Quirk {
    /// Every quirk, in the order of this file.
    pub const ALL: &'static [Self] = &[
        Self::JunkBeforeEquals,
        Self::EqualsBeforeName,
        Self::EqualsBeginsValue,
        Self::EmptyValue,
        Self::CommentInQuotes,
        Self::NumberPrefix,
        Self::OperatorLostToBlanks,
        Self::AdjacentOperands,
        Self::SignLost,
        Self::SignBindsToNumber,
        Self::NumberJunk,
        Self::VectorArithmetic,
        Self::NestedLists,
        Self::LeadingMinus,
        Self::PowerFromLeft,
        Self::AndOrOneRank,
        Self::DroppedLastLine,
        Self::IndexPrefix,
        Self::NegativeThickness,
    ];

    /// What the sound dialect does instead.
    pub fn sound_reading(self) -> SoundReading {
        match self {
            Self::LeadingMinus | Self::PowerFromLeft | Self::AndOrOneRank => SoundReading::Same,
            Self::DroppedLastLine | Self::IndexPrefix => SoundReading::Plain,
            _ => SoundReading::Refused,
        }
    }

    /// Whether a text is read NIST's way in `dialect`.
    pub fn applies_in(self, dialect: Dialect) -> bool {
        dialect.is_compat() || self.sound_reading() == SoundReading::Same
    }

    /// Whether a text that shows the quirk is refused in `dialect`.
    pub fn refused_in(self, dialect: Dialect) -> bool {
        !dialect.is_compat() && self.sound_reading() == SoundReading::Refused
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_quirk_acts_in_compat_and_is_the_same_refused_or_plain_in_sound() {
        for quirk in Quirk::ALL {
            assert!(quirk.applies_in(Dialect::Compat) && !quirk.refused_in(Dialect::Compat));
            let sound = quirk.sound_reading();
            assert_eq!(quirk.applies_in(Dialect::Sound), sound == SoundReading::Same);
            assert_eq!(quirk.refused_in(Dialect::Sound), sound == SoundReading::Refused);
        }
    }
}
