//! The entries of INTEGRALS.

use super::text::SourceText;
use crate::span::Span;

/// A solid angle to integrate over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ApertureShape {
    /// One direction.
    Differential,
    /// A circular cone.
    Circle,
    /// The hemisphere.
    Hemi,
    /// A ring between two circular cones.
    Annulus,
    /// A polygon of directions.
    Polygon,
}

impl ApertureShape {
    /// Every shape.
    pub const ALL: &'static [Self] =
        &[Self::Differential, Self::Circle, Self::Hemi, Self::Annulus, Self::Polygon];

    /// The word in a program.
    pub fn name(self) -> &'static str {
        match self {
            Self::Differential => "DIFFERENTIAL",
            Self::Circle => "CIRCLE",
            Self::Hemi => "HEMI",
            Self::Annulus => "ANNULUS",
            Self::Polygon => "POLYGON",
        }
    }

    /// Finds a shape by its word in any case.
    pub fn find(word: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|shape| shape.name().eq_ignore_ascii_case(word))
    }

    /// The parameters it takes, in upper case.
    pub fn parameters(self) -> &'static [&'static str] {
        match self {
            Self::Differential => &["CENTER", "POL", "INPOL"],
            Self::Circle => &["CENTER", "ALPHA", "POL", "INPOL"],
            Self::Hemi => &["INPOL"],
            Self::Annulus => {
                &["OUTERCENTER", "INNERCENTER", "OUTERALPHA", "INNERALPHA", "POL", "INPOL"]
            }
            Self::Polygon => &["VERTEX", "POL", "POLCENTER", "INPOL"],
        }
    }
}

/// One integral.
#[derive(Clone, Debug, PartialEq)]
pub struct Integral {
    /// Its value is stored under this name.
    pub name: SourceText,
    /// The solid angle.
    pub shape: ApertureShape,
    /// The word of the shape as written.
    pub shape_text: SourceText,
    /// Parameters in the order written; a repeated one counts last, VERTEX accumulates.
    pub parameters: Vec<IntegralParameter>,
    /// From the name to END.
    pub span: Span,
}

/// One parameter of an integral.
#[derive(Clone, Debug, PartialEq)]
pub struct IntegralParameter {
    /// The name as written; [`IntegralParameter::key`] is its upper case.
    pub name: SourceText,
    /// An expression.
    pub value: SourceText,
}

impl IntegralParameter {
    /// The name in upper case, one of [`ApertureShape::parameters`].
    pub fn key(&self) -> String {
        self.name.as_str().to_ascii_uppercase()
    }
}
