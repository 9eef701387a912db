//! A MIST program as a tree: sections in their order, every text with its place.
//!
//! [`parse()`] reads a program, [`Program`]'s `Display` prints it back with its comments.

mod check;
mod color;
mod compare;
mod lex;
mod parse;
mod print;
mod text;

pub use check::REQUIRED_VARIABLES;
pub use color::{Color, ColorEntry, ColorKey};
pub use lex::count_tokens;
pub use parse::MAX_PROGRAM_BYTES;
pub use text::Text;

use crate::diagnostic::Diagnostic;
use crate::dialect::Dialect;
use crate::span::Span;

/// A whole program.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Class name after `MODEL =`.
    pub model: Text,
    /// VARIABLES in the order written; names may repeat.
    pub variables: Vec<Variable>,
    /// VARY in the order declared: the last one runs fastest.
    pub loops: Vec<Loop>,
    /// INTEGRALS in the order written; names may repeat.
    pub integrals: Vec<Integral>,
    /// OUTPUTS in the order written.
    pub outputs: Vec<Output>,
    /// FILES.
    pub files: FilesSection,
    /// COLOR, our own section after FILES, which NIST's program never reads.
    pub color: Option<Color>,
    /// Comments in the order of the text, without the text behind the last section.
    pub comments: Vec<Comment>,
    /// Offsets of blank lines; printing keeps one where there are some.
    pub blank_lines: Vec<usize>,
    /// Whatever stands behind the last END, without white space at its end; never read by
    /// anyone.
    pub trailing: Text,
    /// Where the six sections begin and end.
    pub sections: Sections,
}

/// Where each section stands: from its cue to its END.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sections {
    /// `MODEL = name`.
    pub model: Span,
    /// `VARIABLES:` to END.
    pub variables: Span,
    /// `VARY:` to END.
    pub vary: Span,
    /// `INTEGRALS:` to END.
    pub integrals: Span,
    /// `OUTPUTS:` to END.
    pub outputs: Span,
    /// `FILES:` to END.
    pub files: Span,
    /// `COLOR:` to END.
    pub color: Span,
}

/// What a variable is, told by the first character of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VariableKind {
    /// `name`: an expression, seen by other expressions.
    Local,
    /// `#name`: an expression that is also sent to the model's parameter `name`.
    Parameter,
    /// `$name`: a text that is sent to the model's parameter `name` as it is.
    Literal,
}

impl VariableKind {
    /// The kind that a name with this first character has.
    pub fn of(name: &str) -> Self {
        match name.bytes().next() {
            Some(b'#') => Self::Parameter,
            Some(b'$') => Self::Literal,
            _ => Self::Local,
        }
    }
}

/// One assignment in VARIABLES.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// The name with its `#` or `$`.
    pub name: Text,
    /// Told by the name.
    pub kind: VariableKind,
    /// An expression, or a text for [`VariableKind::Literal`].
    pub value: Text,
}

impl Variable {
    /// The model parameter that is set: the name without `#` or `$`; nothing for locals.
    pub fn parameter(&self) -> Option<&str> {
        match self.kind {
            VariableKind::Local => None,
            VariableKind::Parameter | VariableKind::Literal => self.name.as_str().get(1..),
        }
    }
}

/// One statement in VARY.
#[derive(Clone, Debug, PartialEq)]
pub enum Loop {
    /// `FOR variable FROM from TO to BY by`.
    For(Box<ForLoop>),
    /// `LIST file`.
    List(ListLoop),
}

impl Loop {
    /// From FOR or LIST to the last word.
    pub fn span(&self) -> Span {
        match self {
            Self::For(each) => each.span,
            Self::List(list) => list.span,
        }
    }
}

/// `FOR variable FROM from TO to BY by`; the bounds are expressions.
#[derive(Clone, Debug, PartialEq)]
pub struct ForLoop {
    /// The variable, found without regard to case.
    pub variable: Text,
    /// First value.
    pub from: Text,
    /// Last value.
    pub to: Text,
    /// Step.
    pub by: Text,
    /// The whole statement.
    pub span: Span,
}

/// `LIST file`.
#[derive(Clone, Debug, PartialEq)]
pub struct ListLoop {
    /// Name of the file with the rows.
    pub file: Text,
    /// The whole statement.
    pub span: Span,
}

/// A solid angle to integrate over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
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

impl Shape {
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
    pub name: Text,
    /// The solid angle.
    pub shape: Shape,
    /// The word of the shape as written.
    pub shape_text: Text,
    /// Parameters in the order written; a repeated one counts last, VERTEX accumulates.
    pub parameters: Vec<IntegralParameter>,
    /// From the name to END.
    pub span: Span,
}

/// One parameter of an integral.
#[derive(Clone, Debug, PartialEq)]
pub struct IntegralParameter {
    /// The name as written; [`IntegralParameter::key`] is its upper case.
    pub name: Text,
    /// An expression.
    pub value: Text,
}

impl IntegralParameter {
    /// The name in upper case, one of [`Shape::parameters`].
    pub fn key(&self) -> String {
        self.name.as_str().to_ascii_uppercase()
    }
}

/// One output column.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// The number as written.
    pub number: Text,
    /// The value is stored and the column named by this: the text before the first `=`, or the
    /// expression.
    pub label: Text,
    /// Whether the label was written.
    pub has_label: bool,
    /// An expression.
    pub expression: Text,
}

/// A polarization basis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Basis {
    /// s and p of each beam.
    #[default]
    Psps,
    /// x and y turned with each beam.
    Xyxy,
    /// Perpendicular and parallel to the plane of both beams.
    Plane,
}

impl Basis {
    /// Every basis.
    pub const ALL: &'static [Self] = &[Self::Psps, Self::Xyxy, Self::Plane];

    /// The word in a program; its case counts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Psps => "psps",
            Self::Xyxy => "xyxy",
            Self::Plane => "plane",
        }
    }
}

/// FILES: what is written where.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilesSection {
    /// Every assignment in the order written.
    pub entries: Vec<FilesEntry>,
}

/// One assignment in FILES.
#[derive(Clone, Debug, PartialEq)]
pub struct FilesEntry {
    /// Told by the name.
    pub key: FilesKey,
    /// The name as written.
    pub name: Text,
    /// The value.
    pub value: Text,
}

/// The names that FILES knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FilesKey {
    /// The table of loop values and outputs; `JOB.dat` unless given.
    Results,
    /// The report; `JOB.lst` unless given.
    Listing,
    /// One row per evaluated direction; none unless given.
    Samples,
    /// A line at the head of the results; repeatable.
    Header,
    /// printf format of each output; `%10g\t` unless given.
    Format,
    /// Polarization basis; psps unless given.
    Basis,
}

impl FilesKey {
    /// Every key.
    pub const ALL: &'static [Self] =
        &[Self::Results, Self::Listing, Self::Samples, Self::Header, Self::Format, Self::Basis];

    /// The word in a program.
    pub fn name(self) -> &'static str {
        match self {
            Self::Results => "results",
            Self::Listing => "listing",
            Self::Samples => "samples",
            Self::Header => "header",
            Self::Format => "format",
            Self::Basis => "basis",
        }
    }

    /// Finds a key by its word in any case.
    pub fn find(word: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|key| key.name().eq_ignore_ascii_case(word))
    }
}

impl FilesSection {
    /// The last value given for `key`, unless it is empty.
    pub fn last(&self, key: FilesKey) -> Option<&Text> {
        let found = self.entries.iter().rev().find(|entry| entry.key == key);
        found.map(|entry| &entry.value).filter(|value| !value.as_str().is_empty())
    }

    /// Name of the results file, if given.
    pub fn results(&self) -> Option<&Text> {
        self.last(FilesKey::Results)
    }

    /// Name of the listing file, if given.
    pub fn listing(&self) -> Option<&Text> {
        self.last(FilesKey::Listing)
    }

    /// Name of the samples file, if given.
    pub fn samples(&self) -> Option<&Text> {
        self.last(FilesKey::Samples)
    }

    /// The header lines.
    pub fn headers(&self) -> impl Iterator<Item = &Text> {
        self.entries.iter().filter(|entry| entry.key == FilesKey::Header).map(|entry| &entry.value)
    }

    /// The number format as written, if given; an empty one counts.
    pub fn format(&self) -> Option<&Text> {
        let found = self.entries.iter().rev().find(|entry| entry.key == FilesKey::Format);
        found.map(|entry| &entry.value)
    }

    /// The polarization basis.
    pub fn basis(&self) -> Basis {
        let wanted = self.entries.iter().rev().find(|entry| entry.key == FilesKey::Basis);
        let word = wanted.map_or("", |entry| entry.value.as_str());
        Basis::ALL.iter().copied().find(|basis| basis.name() == word).unwrap_or_default()
    }
}

/// A comment, from its `;` up to the end of the line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comment {
    /// The text behind the semicolon, without the line end.
    pub text: String,
    /// From the semicolon to the end of the line.
    pub span: Span,
    /// Whether nothing stands before it in its line.
    pub own_line: bool,
}

/// Reads a program.
///
/// # Errors
/// Everything found wrong with it, in the order of the text: what NIST's program refuses or
/// never finishes reading, in both dialects; its misreadings, in the sound dialect.
pub fn parse(text: &str, dialect: Dialect) -> Result<Program, Vec<Diagnostic>> {
    parse::parse(text, dialect)
}
