//! New values of parameters, and the context in which they are set.

use std::borrow::Cow;

use mist_format::number;
use scattering::Mode;

use crate::DataFiles;

/// A new value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterInput<'a> {
    /// A text, as a program or a material writes it.
    Text(&'a str),
    /// One number, or the elements of a vector such as (n,k); at least one.
    Numbers(&'a [f64]),
}

impl<'a> ParameterInput<'a> {
    /// The text that a program sends: numbers with sixteen digits.
    pub(crate) fn to_text(self) -> Cow<'a, str> {
        match self {
            Self::Text(text) => Cow::Borrowed(text),
            Self::Numbers(values) => Cow::Owned(number::list(values, number::TEXT_DIGITS)),
        }
    }
}

/// The context in which a parameter is set.
pub(crate) struct ParameterContext<'a> {
    pub(crate) library: &'a DataFiles,
    pub(crate) mode: Mode,
    /// The wavelength for which the objects around were evaluated last, if any.
    pub(crate) evaluated_at: Option<f64>,
    /// True if the parameter belongs to an object inside of the model.
    pub(crate) is_nested: bool,
}

impl ParameterContext<'_> {
    /// True if numbers are stored as they are, not as their texts are read.
    pub(super) fn keeps_bits(&self, values: &[f64]) -> bool {
        self.mode == Mode::Sound && values.iter().all(|x| x.is_finite())
    }
}
