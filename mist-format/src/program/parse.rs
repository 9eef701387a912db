//! Text to tree, section by section, in the way NIST's program reads.
//!
//! What makes the rest unreadable ends the reading; everything else is collected.

mod entries;

use self::entries::{Assignment, Values, open_parentheses};
use super::check;
use super::lex::{Reader, Stop};
use super::{
    Basis, Color, ColorEntry, ColorKey, FilesEntry, FilesKey, FilesSection, ForLoop, Integral,
    IntegralParameter, ListLoop, Loop, Output, Program, Sections, Shape, Text, Variable,
    VariableKind,
};
use crate::diagnostic::Diagnostic;
use crate::dialect::{Dialect, Quirk};
use crate::number::{integer_prefix, is_blank};
use crate::span::Span;
use crate::suggestion::did_you_mean;
use std::collections::HashMap;

/// The longest text that is read as a program, in bytes.
pub const MAX_PROGRAM_BYTES: usize = 16 << 20;

/// The longest list of errors in one report; reading ends when it is full.
pub(super) const MAX_ERRORS: usize = 20;

/// The cues of the sections in their order.
const CUES: [&str; 6] = ["VARIABLES:", "VARY:", "INTEGRALS:", "OUTPUTS:", "FILES:", "COLOR:"];

/// Nothing more can be read; the reason is among the diagnostics.
struct Fatal;

type Read<T> = Result<T, Fatal>;

pub(super) fn parse(text: &str, dialect: Dialect) -> Result<Program, Vec<Diagnostic>> {
    if text.len() > MAX_PROGRAM_BYTES {
        let message = format!("the program is longer than {MAX_PROGRAM_BYTES} bytes");
        let found = Diagnostic::error("program/too-long", Span::empty(0), message);
        return Err(vec![
            found.help("keep long tables in files, and read them with LIST or @file"),
        ]);
    }
    let mut parser = Parser::new(text, dialect);
    let program = parser.program();
    let mut found = parser.found;
    if let Ok(program) = program {
        found.extend(check::check(&program));
        if found.is_empty() {
            return Ok(Program { comments: parser.reader.into_comments(), ..program });
        }
    }
    found.sort_by_key(|diagnostic| diagnostic.span);
    found.truncate(MAX_ERRORS);
    Err(found)
}

struct Parser<'t> {
    text: &'t str,
    dialect: Dialect,
    reader: Reader<'t>,
    found: Vec<Diagnostic>,
    /// A section cue read as something else, and the cue of the section it was read in: if
    /// reading fails later, an END is missing before it.
    swallowed_cue: Option<(Span, Span)>,
}

impl<'t> Parser<'t> {
    fn new(text: &'t str, dialect: Dialect) -> Self {
        let reader = Reader::new(text);
        Self { text, dialect, reader, found: Vec::new(), swallowed_cue: None }
    }

    fn program(&mut self) -> Read<Program> {
        let mut sections = Sections::default();
        let model = self.model(&mut sections)?;
        let variables = self.variables(&mut sections)?;
        let loops = self.vary(&mut sections)?;
        let integrals = self.integrals(&mut sections, &variables)?;
        let outputs = self.outputs(&mut sections)?;
        let files = self.files(&mut sections)?;
        let color = self.color(&mut sections)?;
        let trailing = Text::new(self.reader.rest().trim_end(), self.reader.at());
        let (comments, blank_lines) = (Vec::new(), blank_lines(self.text));
        Ok(Program {
            model,
            variables,
            loops,
            integrals,
            outputs,
            files,
            color,
            comments,
            blank_lines,
            trailing,
            sections,
        })
    }

    fn model(&mut self, sections: &mut Sections) -> Read<Text> {
        let start = self.reader.at();
        let name = match self.reader.name() {
            Ok(name) => name.text,
            Err(Stop::End) => {
                let empty =
                    Diagnostic::error("program/empty", Span::empty(0), "the program is empty");
                return self.fatal(empty.help("begin with `MODEL = ` and the name of a model"));
            }
            Err(stop) => return self.stopped(stop, Span::empty(start)),
        };
        if !name.as_str().eq_ignore_ascii_case("model") {
            return self.fatal(missing_model(&name));
        }
        let value = self.value(&name, Values::Texts)?;
        sections.model = name.span().to(value.span());
        Ok(value)
    }

    fn variables(&mut self, sections: &mut Sections) -> Read<Vec<Variable>> {
        let cue = self.cue(0)?;
        let mut variables = Vec::new();
        loop {
            match self.assignment(cue, |name| match VariableKind::of(name) {
                VariableKind::Literal => Values::Texts,
                _ => Values::Expressions,
            })? {
                Assignment::Entry(name, value) => {
                    let kind = VariableKind::of(name.as_str());
                    variables.push(Variable { name, kind, value });
                }
                Assignment::End(end) => {
                    sections.variables = cue.to(end);
                    return Ok(variables);
                }
            }
        }
    }

    fn vary(&mut self, sections: &mut Sections) -> Read<Vec<Loop>> {
        let cue = self.cue(1)?;
        let mut loops = Vec::new();
        loop {
            let word = self.section_token(cue)?;
            let start = word.span();
            if is(&word, "END") {
                sections.vary = cue.to(start);
                return Ok(loops);
            } else if is(&word, "FOR") {
                loops.push(self.for_loop(cue, start)?);
            } else if is(&word, "LIST") {
                let file = self.section_token(cue)?;
                let span = start.to(file.span());
                loops.push(Loop::List(ListLoop { file, span }));
            } else {
                return self.fatal(missing_loop(&word, cue));
            }
        }
    }

    fn for_loop(&mut self, cue: Span, start: Span) -> Read<Loop> {
        let variable = self.section_token(cue)?;
        let from = self.bound("FROM", cue, start.to(variable.span()))?;
        let to = self.bound("TO", cue, start.to(from.span()))?;
        let by = self.bound("BY", cue, start.to(to.span()))?;
        let span = start.to(by.span());
        Ok(Loop::For(Box::new(ForLoop { variable, from, to, by, span })))
    }

    /// A keyword and the expression behind it; `before` is the statement up to there.
    fn bound(&mut self, keyword: &str, cue: Span, before: Span) -> Read<Text> {
        let word = self.section_token(cue)?;
        if !is(&word, keyword) {
            let message = format!("missing {keyword} in FOR statement, found `{word}`");
            let between = Span::new(before.end, word.span().start).of(self.text);
            let place = if between.contains('\n') { before } else { word.span() };
            let missing = Diagnostic::error("program/vary-keyword", place, message);
            return self.fatal(missing.help(
                "write FOR variable FROM start TO end BY step; quote expressions with blanks",
            ));
        }
        let value = self.section_token(cue)?;
        self.check_blank_in_value(&value);
        Ok(value)
    }

    fn integrals(&mut self, sections: &mut Sections, known: &[Variable]) -> Read<Vec<Integral>> {
        let cue = self.cue(2)?;
        let folded = |variable: &Variable| variable.name.as_str().to_ascii_lowercase();
        let known: HashMap<String, Span> =
            known.iter().map(|variable| (folded(variable), variable.name.span())).collect();
        let mut integrals = Vec::new();
        loop {
            match self.assignment(cue, |_| Values::Texts)? {
                Assignment::Entry(name, word) => {
                    self.check_integral_name(&name, &known);
                    let shape = self.shape(&word);
                    integrals.extend(self.integral(name, word, shape)?);
                }
                Assignment::End(end) => {
                    sections.integrals = cue.to(end);
                    return Ok(integrals);
                }
            }
        }
    }

    fn shape(&mut self, word: &Text) -> Option<Shape> {
        let shape = Shape::find(word.as_str());
        if shape.is_none() {
            let names = Shape::ALL.iter().map(|shape| shape.name());
            let all: Vec<_> = names.clone().collect();
            let message = format!("invalid integral shape `{word}`");
            self.found.push(
                Diagnostic::error("program/shape", word.span(), message)
                    .help(format!("the shapes are {}", all.join(", ")))
                    .help_if(did_you_mean(word.as_str(), names)),
            );
        }
        shape
    }

    /// `known` are the places of the variables by their names in lower case.
    fn check_integral_name(&mut self, name: &Text, known: &HashMap<String, Span>) {
        if let Some(variable) = known.get(&name.as_str().to_ascii_lowercase()) {
            let message = format!("variable `{name}` already defined");
            self.found.push(
                Diagnostic::error("program/integral-name", name.span(), message)
                    .help("choose another name for the integral; case does not count here")
                    .note_at(*variable, "the variable is defined here"),
            );
        }
    }

    /// The parameters of an integral up to its END; nothing if its shape is unknown.
    fn integral(&mut self, name: Text, word: Text, shape: Option<Shape>) -> Read<Option<Integral>> {
        let mut parameters = Vec::new();
        loop {
            match self.assignment(word.span(), |_| Values::Expressions)? {
                Assignment::Entry(name, value) => {
                    if let Some(shape) = shape {
                        self.check_integral_parameter(shape, &name, &value);
                    }
                    parameters.push(IntegralParameter { name, value });
                }
                Assignment::End(end) => {
                    let span = name.span().to(end);
                    return Ok(shape.map(|shape| Integral {
                        name,
                        shape,
                        shape_text: word,
                        parameters,
                        span,
                    }));
                }
            }
        }
    }

    fn check_integral_parameter(&mut self, shape: Shape, name: &Text, value: &Text) {
        let known = shape.parameters();
        if known.iter().any(|known| known.eq_ignore_ascii_case(name.as_str())) {
            return;
        }
        let message = format!("unknown variable `{name}` in {}", shape.name());
        let found = Diagnostic::error("program/integral-parameter", name.span(), message);
        self.found.push(if Shape::find(value.as_str()).is_some() {
            found.help(format!("write END before `{name}`, so that the integral before it ends"))
        } else {
            found
                .help(format!("{} takes {}", shape.name(), known.join(", ")))
                .help_if(did_you_mean(name.as_str(), known.iter().copied()))
        });
    }

    fn outputs(&mut self, sections: &mut Sections) -> Read<Vec<Output>> {
        let cue = self.cue(3)?;
        let mut outputs = Vec::new();
        loop {
            let number = self.section_token(cue)?;
            if is(&number, "END") {
                sections.outputs = cue.to(number.span());
                return Ok(outputs);
            }
            let expected = outputs.len() + 1;
            self.check_output_number(&number, expected)?;
            let token = self.section_token(cue)?;
            if is(&token, "END") && !token.is_quoted() {
                self.refuse(Quirk::EmptyValue, token.span());
            }
            let output = split_output(number, token);
            self.check_output(&output);
            outputs.push(output);
        }
    }

    fn check_output_number(&mut self, number: &Text, expected: usize) -> Read<()> {
        let read = integer_prefix(number.as_str());
        if read.value != i64::try_from(expected).ok() {
            let message = format!(
                "missing or incorrect OUTPUTS section number: `{number}` is not {expected}"
            );
            let found = Diagnostic::error("program/output-number", number.span(), message);
            return self.fatal(found.help(
                "number the outputs 1, 2, 3 …; quote expressions with blanks; close with END",
            ));
        }
        let rest = &number.as_str()[read.taken..];
        if rest.bytes().any(|byte| !byte.is_ascii_punctuation() && !is_blank(byte)) {
            self.refuse(Quirk::NumberPrefix, number.span());
        }
        Ok(())
    }

    fn check_output(&mut self, output: &Output) {
        if output.has_label && open_parentheses(output.label.as_str()) > 0 {
            let span = output.label.span().to(output.expression.span());
            self.found.push(
                Diagnostic::error(
                    "program/output-label",
                    span,
                    "the first `=` ends the label, and this one stands in parentheses",
                )
                .help("give the output a label, such as `t=(a=b)`, or write eq(a,b)"),
            );
        } else {
            self.check_blank_in_value(&output.expression);
        }
    }

    fn files(&mut self, sections: &mut Sections) -> Read<FilesSection> {
        let cue = self.cue(4)?;
        let mut entries = Vec::new();
        loop {
            match self.assignment(cue, |_| Values::Texts)? {
                Assignment::Entry(name, value) => {
                    let key = self.files_key(&name);
                    if key == Some(FilesKey::Basis) {
                        self.check_basis(&value);
                    }
                    entries.extend(key.map(|key| FilesEntry { key, name, value }));
                }
                Assignment::End(end) => {
                    sections.files = cue.to(end);
                    return Ok(FilesSection { entries });
                }
            }
        }
    }

    fn files_key(&mut self, name: &Text) -> Option<FilesKey> {
        let key = FilesKey::find(name.as_str());
        if key.is_none() {
            let names = FilesKey::ALL.iter().map(|key| key.name());
            let all: Vec<_> = names.clone().collect();
            let message = format!("invalid output statement `{name}`");
            self.found.push(
                Diagnostic::error("program/files-key", name.span(), message)
                    .help(format!("FILES knows {}", all.join(", ")))
                    .help_if(did_you_mean(name.as_str(), names)),
            );
        }
        key
    }

    fn check_basis(&mut self, value: &Text) {
        if Basis::ALL.iter().all(|basis| basis.name() != value.as_str()) {
            let message = format!("invalid polarization basis `{value}`");
            self.found.push(
                Diagnostic::error("program/basis", value.span(), message)
                    .help("write psps, xyxy or plane, in lower case"),
            );
        }
    }

    /// COLOR, if it is the next thing behind FILES; otherwise nothing more is read.
    fn color(&mut self, sections: &mut Sections) -> Read<Option<Color>> {
        let before = self.reader.at();
        let cue = match self.reader.token() {
            Ok(token) if is(&token.text, "COLOR:") => token.text.span(),
            _ => {
                self.reader.go_to(before);
                return Ok(None);
            }
        };
        let mut entries = Vec::new();
        loop {
            match self.assignment(cue, |_| Values::Texts)? {
                Assignment::Entry(name, value) => {
                    let key = self.color_key(&name);
                    let words = key.is_some_and(ColorKey::takes_words);
                    let value = if words { self.with_words(value) } else { value };
                    entries.extend(key.map(|key| ColorEntry { key, name, value }));
                }
                Assignment::End(end) => {
                    sections.color = cue.to(end);
                    return Ok(Some(Color { entries, span: cue.to(end) }));
                }
            }
        }
    }

    fn color_key(&mut self, name: &Text) -> Option<ColorKey> {
        let key = ColorKey::find(name.as_str());
        if key.is_none() {
            let names = ColorKey::ALL.iter().map(|key| key.name());
            let all: Vec<_> = names.clone().collect();
            let message = format!("COLOR knows no `{name}`");
            self.found.push(
                Diagnostic::error("program/color-key", name.span(), message)
                    .help(format!("COLOR knows {}", all.join(", ")))
                    .help_if(did_you_mean(name.as_str(), names)),
            );
        }
        key
    }

    /// Reads the cue of a section and gives its place.
    fn cue(&mut self, section: usize) -> Read<Span> {
        let wanted = CUES[section];
        let token = match self.reader.token() {
            Ok(token) => token.text,
            Err(stop) => return self.stopped_before(stop, wanted),
        };
        if is(&token, wanted) {
            return Ok(token.span());
        }
        let message = format!("missing {wanted} section cue, found `{token}`");
        let found = Diagnostic::error("program/section-cue", token.span(), message);
        let with_colon = format!("{}:", token.as_str());
        self.fatal(if with_colon.eq_ignore_ascii_case(wanted) {
            found.help(format!("write {wanted} as one word with its colon"))
        } else {
            found.help(
                "the sections MODEL, VARIABLES:, VARY:, INTEGRALS:, OUTPUTS:, FILES: stand in this \
                 order, each closed by END; they may be empty",
            )
        })
    }
}

fn is(text: &Text, word: &str) -> bool {
    text.as_str().eq_ignore_ascii_case(word)
}

/// Where the blank lines of a text begin.
fn blank_lines(text: &str) -> Vec<usize> {
    let mut start = 0;
    let mut found = Vec::new();
    for line in text.split_inclusive('\n') {
        if line.trim().is_empty() {
            found.push(start);
        }
        start += line.len();
    }
    found
}

/// Label and expression of an output, parted at the first `=`.
fn split_output(number: Text, token: Text) -> Output {
    match token.as_str().find('=') {
        Some(at) => {
            let (label, expression) = (token.part(0..at), token.part(at + 1..token.as_str().len()));
            Output { number, label, has_label: true, expression }
        }
        None => Output { number, label: token.clone(), has_label: false, expression: token },
    }
}

fn missing_model(name: &Text) -> Diagnostic {
    let message = format!("missing MODEL statement, found `{name}` instead");
    let found = Diagnostic::error("program/model", name.span(), message);
    if name.as_str().starts_with('\u{feff}') {
        return found.help("save the file without the byte-order mark in front of the first word");
    }
    let help = "begin with `MODEL = ` and the name of a model";
    found.help(help).help_if(did_you_mean(name.as_str(), ["MODEL"]))
}

fn missing_loop(word: &Text, cue: Span) -> Diagnostic {
    let message = format!("missing FOR or LIST statement in VARY section, found `{word}`");
    Diagnostic::error("program/vary-keyword", word.span(), message)
        .help("write FOR variable FROM start TO end BY step, LIST file, or END")
        .help_if(did_you_mean(word.as_str(), ["FOR", "LIST", "END"]))
        .note_at(cue, "the section begins here")
}
