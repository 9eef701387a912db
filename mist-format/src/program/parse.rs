//! Text to tree, section by section, in the way NIST's program reads.
//!
//! What makes the rest unreadable ends the reading; everything else is collected.

use super::check;
use super::lex::{Reader, Stop, Token};
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

/// One assignment, or the END of a section.
enum Assignment {
    Entry(Text, Text),
    End(Span),
}

/// What a section's values are.
#[derive(Clone, Copy, PartialEq)]
enum Values {
    Expressions,
    Texts,
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

    /// Enough is enough.
    fn check_patience(&self) -> Read<()> {
        if self.found.len() < MAX_ERRORS { Ok(()) } else { Err(Fatal) }
    }

    /// A token inside a section.
    fn section_token(&mut self, cue: Span) -> Read<Text> {
        self.check_patience()?;
        match self.reader.token() {
            Ok(token) => {
                self.note_swallowed_cue(&token.text, cue)?;
                Ok(self.plain(token))
            }
            Err(stop) => self.stopped(stop, cue),
        }
    }

    /// An assignment inside a section.
    fn assignment(&mut self, cue: Span, values: impl Fn(&str) -> Values) -> Read<Assignment> {
        self.check_patience()?;
        let name = match self.reader.name() {
            Ok(name) => name,
            Err(stop) => return self.stopped(stop, cue),
        };
        if is(&name.text, "END") {
            return Ok(Assignment::End(name.text.span()));
        }
        self.note_swallowed_cue(&name.text, cue)?;
        if let Some(equals) = name.equals {
            self.refuse(Quirk::EqualsBeforeName, equals);
        }
        let value = self.value(&name.text, values(name.text.as_str()))?;
        Ok(Assignment::Entry(name.text, value))
    }

    /// The equal sign behind a name, and the value.
    fn value(&mut self, name: &Text, values: Values) -> Read<Text> {
        match self.reader.equals() {
            Ok(None) => {}
            Ok(Some(junk)) => self.refuse_junk(name, junk),
            Err(Stop::End) => {
                let message =
                    format!("expecting assignment, i.e., variable = value, behind `{name}`");
                let found = Diagnostic::error("program/assignment", name.span(), message);
                return self.fatal(found.help("write `=` and a value, then END"));
            }
            Err(stop) => return self.stopped(stop, name.span()),
        }
        let token = match self.reader.token() {
            Ok(token) => token,
            Err(stop) => return self.stopped(stop, name.span()),
        };
        let value = self.plain(token);
        if value.is_quoted() {
            return Ok(value);
        }
        if value.as_str().starts_with('=') {
            self.refuse(Quirk::EqualsBeginsValue, value.span());
            if value.as_str() == "=" && Quirk::EqualsBeginsValue.refused_in(self.dialect) {
                return self.section_token(name.span());
            }
        } else if values == Values::Expressions && open_parentheses(value.as_str()) > 0 {
            self.check_blank_in_value(&value);
        } else if is(&value, "END") || self.an_equal_sign_follows() {
            self.refuse(Quirk::EmptyValue, name.span().to(value.span()));
            if Quirk::EmptyValue.refused_in(self.dialect) {
                // What was no value is read again as what it is.
                self.reader.go_to(value.span().start);
            }
        }
        Ok(value)
    }

    /// `(1, 2)` without quotes: the blank ends the value. NIST's program says `Mismatched
    /// parentheses` when it evaluates it. Reading goes on in the next line.
    fn check_blank_in_value(&mut self, value: &Text) {
        if value.is_quoted() || open_parentheses(value.as_str()) <= 0 {
            return;
        }
        let rest = self.reader.rest();
        let line = &rest[..rest.find(['\n', ';']).unwrap_or(rest.len())];
        self.found.push(if line.contains(')') {
            let message = "a blank ends this value inside a parenthesis";
            let found = Diagnostic::error("program/blank-in-value", value.span(), message);
            let whole = format!("{value}{}", line.trim_end());
            self.reader.go_to(self.reader.at() + line.len());
            found.help(format!("write it in quotes, `\"{whole}\"`, or without blanks"))
        } else {
            let message = "mismatched parentheses";
            Diagnostic::error("program/parentheses", value.span(), message)
                .help("close the parenthesis; a value with blanks needs quotes")
        });
    }

    /// Whether the value just read is the name of the next assignment.
    fn an_equal_sign_follows(&self) -> bool {
        self.reader.rest().trim_start_matches([' ', '\t']).starts_with('=')
    }

    /// The text of a token; a comment inside its quotes is refused where the dialect wants it.
    fn plain(&mut self, token: Token) -> Text {
        if let Some(comment) = token.comments.first() {
            self.refuse(Quirk::CommentInQuotes, *comment);
        }
        token.text
    }

    /// Notes a section cue where there should be none: an END is missing before it.
    fn note_swallowed_cue(&mut self, text: &Text, cue: Span) -> Read<()> {
        if text.is_quoted() || !CUES.iter().any(|known| is(text, known)) {
            return Ok(());
        }
        self.swallowed_cue.get_or_insert((text.span(), cue));
        if self.dialect.is_compat() { Ok(()) } else { self.fatal_missing_end() }
    }

    fn fatal_missing_end<T>(&mut self) -> Read<T> {
        if let Some((swallowed, cue)) = self.swallowed_cue {
            let message = format!("END is missing before `{}`", swallowed.of(self.text));
            self.found.push(
                Diagnostic::error("program/missing-end", swallowed, message)
                    .help("close the section before it with END")
                    .note_at(cue, "it begins here"),
            );
        }
        Err(Fatal)
    }

    fn refuse_junk(&mut self, name: &Text, junk: Span) {
        if !Quirk::JunkBeforeEquals.refused_in(self.dialect) {
            return;
        }
        let between = Span::new(name.span().end, junk.start).of(self.text);
        let on_one_line = !between.contains('\n');
        let message = if on_one_line {
            format!("`{name}` is followed by something else than `=`")
        } else {
            format!("`{name}` has no value")
        };
        let span = if on_one_line { junk } else { name.span() };
        self.found.push(
            Diagnostic::error("program/junk-before-equals", span, message)
                .help("write `name = value`; a value with blanks needs quotes")
                .note(format!(
                    "NIST's program ignores everything up to the next `=`, and gives `{name}` the \
                     value behind that"
                )),
        );
    }

    /// Refuses a quirk, if the dialect does.
    fn refuse(&mut self, quirk: Quirk, span: Span) {
        if !quirk.refused_in(self.dialect) {
            return;
        }
        let (code, message, help, note) = match quirk {
            Quirk::EqualsBeforeName => (
                "program/equals-before-name",
                "an equal sign without a name before it",
                "write `name = value`; a value with `=` or blanks needs quotes",
                "NIST's program skips equal signs before a name",
            ),
            Quirk::EqualsBeginsValue => (
                "program/double-equals",
                "the value begins with an equal sign",
                "write one `=`",
                "NIST's program takes the second `=` into the value",
            ),
            Quirk::EmptyValue => (
                "program/empty-value",
                "the value is missing",
                "write a value, or \"\" for an empty one",
                "NIST's program takes the next word as the value, whatever it is",
            ),
            Quirk::CommentInQuotes => (
                "program/comment-in-quotes",
                "a semicolon inside quotes begins a comment",
                "leave out the semicolon, or close the quotes before it",
                "NIST's program drops the rest of the line and goes on with the string in the next",
            ),
            _ => (
                "program/number",
                "this is no number",
                "write the number alone",
                "NIST's program reads the digits and drops the rest",
            ),
        };
        self.found.push(Diagnostic::error(code, span, message).help(help).note(note));
    }

    /// Reading ended inside a section or value that begins at `cue`.
    fn stopped<T>(&mut self, stop: Stop, cue: Span) -> Read<T> {
        if self.swallowed_cue.is_some() {
            return self.fatal_missing_end();
        }
        let waits = "NIST's program waits here forever";
        let found = match stop {
            Stop::End => {
                let message = format!("no END closes `{}`", cue.of(self.text));
                Diagnostic::error("program/missing-end", cue, message)
                    .help("write END behind the last entry")
                    .note_at(Span::empty(self.text.trim_end().len()), "the text ends here")
            }
            Stop::OpenQuote(quote) => {
                Diagnostic::error("program/open-quote", quote, "these quotes are never closed")
                    .help("write the closing quotes")
            }
            Stop::OpenComment(comment) => {
                let message = "a comment in the last line, which has no line end";
                Diagnostic::error("program/open-comment", comment, message)
                    .help("end the section with END before it, and the file with a line end")
            }
        };
        self.fatal(found.note(waits))
    }

    /// Reading ended where a section should begin.
    fn stopped_before<T>(&mut self, stop: Stop, wanted: &str) -> Read<T> {
        if stop != Stop::End {
            return self.stopped(stop, Span::empty(self.text.len()));
        }
        let message = format!("missing {wanted} section cue, the text ends");
        let end = Span::empty(self.text.trim_end().len());
        let found = Diagnostic::error("program/section-cue", end, message);
        self.fatal(found.help(format!("write {wanted} and END; a section may be empty")))
    }

    fn fatal<T>(&mut self, found: Diagnostic) -> Read<T> {
        if self.swallowed_cue.is_some() {
            return self.fatal_missing_end();
        }
        self.found.push(found);
        Err(Fatal)
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

/// Opening parentheses without their partner.
fn open_parentheses(text: &str) -> isize {
    text.bytes().fold(0, |open, byte| match byte {
        b'(' => open + 1,
        b')' => open - 1,
        _ => open,
    })
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
