//! The value of an expression: a vector of at least one number.

use crate::number;

/// A vector of at least one number; a single number needs no memory of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Value(Repr);

#[derive(Clone, Debug, PartialEq)]
enum Repr {
    Scalar([f64; 1]),
    Vector(Box<[f64]>),
}

impl Value {
    /// The vector of `first` and `rest`.
    pub fn new(first: f64, rest: &[f64]) -> Self {
        if rest.is_empty() {
            return Self(Repr::Scalar([first]));
        }
        Self(Repr::Vector(std::iter::once(first).chain(rest.iter().copied()).collect()))
    }

    /// All elements.
    pub fn as_slice(&self) -> &[f64] {
        match &self.0 {
            Repr::Scalar(one) => one,
            Repr::Vector(many) => many,
        }
    }

    /// The number, if it is a single one.
    #[inline]
    pub fn single(&self) -> Option<f64> {
        match self.0 {
            Repr::Scalar([one]) => Some(one),
            Repr::Vector(_) => None,
        }
    }

    /// The number, to be changed, if it is a single one.
    #[inline]
    pub fn single_mut(&mut self) -> Option<&mut f64> {
        match &mut self.0 {
            Repr::Scalar([one]) => Some(one),
            Repr::Vector(_) => None,
        }
    }

    /// The first element.
    pub fn first(&self) -> f64 {
        self.as_slice()[0]
    }

    /// The last element: what NIST's program takes where it needs one number.
    pub fn number(&self) -> f64 {
        let all = self.as_slice();
        all[all.len() - 1]
    }

    /// The text that is sent to a model: 16 significant digits, `(a,b,c)` for several.
    pub fn to_text(&self) -> String {
        number::list(self.as_slice(), number::TEXT_DIGITS)
    }
}

impl From<f64> for Value {
    fn from(x: f64) -> Self {
        Self::new(x, &[])
    }
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.to_text())
    }
}
