//! The tree of a program.

use super::colour::ColourStatements;
use super::files::FilesSection;
use super::integral::Integral;
use super::text::SourceText;
use crate::span::Span;

/// A whole program.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Class name after `MODEL =`.
    pub model: SourceText,
    /// VARIABLES in the order written; names may repeat.
    pub variables: Vec<ProgramVariable>,
    /// VARY in the order declared: the last one runs fastest.
    pub loops: Vec<Loop>,
    /// INTEGRALS in the order written; names may repeat.
    pub integrals: Vec<Integral>,
    /// OUTPUTS in the order written.
    pub outputs: Vec<Output>,
    /// FILES.
    pub files: FilesSection,
    /// COLOR, our own section after FILES, which NIST's program never reads.
    pub colour: Option<ColourStatements>,
    /// Comments in the order of the text, without the text behind the last section.
    pub comments: Vec<Comment>,
    /// Offsets of blank lines; printing keeps one where there are some.
    pub blank_lines: Vec<usize>,
    /// The text after the last END, without white space at its end; it has no meaning.
    pub trailing: SourceText,
    /// The spans of the sections.
    pub sections: Sections,
}

/// The span of each section: from its cue to its END.
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
    pub colour: Span,
}

/// The kind of a variable, given by the first character of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VariableKind {
    /// `name`: an expression, seen by other expressions.
    Local,
    /// `#name`: an expression that is also sent to the model's parameter `name`.
    Parameter,
    /// `$name`: a text that is sent to the model's parameter `name`.
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
pub struct ProgramVariable {
    /// The name with its `#` or `$`.
    pub name: SourceText,
    /// The kind, given by the name.
    pub kind: VariableKind,
    /// An expression, or a text for [`VariableKind::Literal`].
    pub value: SourceText,
}

impl ProgramVariable {
    /// The model parameter that is set: the name without `#` or `$`; none for locals.
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
    pub variable: SourceText,
    /// First value.
    pub from: SourceText,
    /// Last value.
    pub to: SourceText,
    /// Step.
    pub by: SourceText,
    /// The whole statement.
    pub span: Span,
}

/// `LIST file`.
#[derive(Clone, Debug, PartialEq)]
pub struct ListLoop {
    /// Name of the file with the rows.
    pub file: SourceText,
    /// The whole statement.
    pub span: Span,
}

/// One output column.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// The number as written.
    pub number: SourceText,
    /// The value is stored and the column named by this: the text before the first `=`, or the
    /// expression.
    pub label: SourceText,
    /// True if the label was written.
    pub has_label: bool,
    /// An expression.
    pub expression: SourceText,
}

/// A comment, from its `;` up to the end of the line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comment {
    /// The text after the semicolon, without the line end.
    pub text: String,
    /// From the semicolon to the end of the line.
    pub span: Span,
    /// True if it is alone in its line.
    pub own_line: bool,
}
