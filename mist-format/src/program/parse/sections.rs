//! The sections MODEL, VARIABLES, VARY, FILES and COLOR.

use super::super::colour::{ColourEntry, ColourKey, ColourStatements};
use super::super::files::{BasisName, FilesEntry, FilesKey, FilesSection};
use super::super::lex::UnexpectedEnd;
use super::super::text::SourceText;
use super::super::tree::{
    ForLoop, ListLoop, Loop, Program, ProgramVariable, Sections, VariableKind,
};
use super::entries::{Assignment, ValueKind};
use super::parser::{CUES, Fatal, ParseResult, Parser, is};
use crate::diagnostic::Diagnostic;
use crate::span::Span;
use crate::suggestion::did_you_mean;

impl Parser<'_> {
    pub(super) fn program(&mut self) -> ParseResult<Program> {
        let mut sections = Sections::default();
        let all = &mut sections;
        let model = self.section(|parser| parser.model(all));
        let variables = self.section(|parser| parser.variables(all));
        let loops = self.section(|parser| parser.vary(all));
        let integrals = self.section(|parser| parser.integrals(all, &variables));
        let outputs = self.section(|parser| parser.outputs(all));
        let files = self.section(|parser| parser.files(all));
        let colour = self.section(|parser| parser.colour(all));
        if self.has_failed {
            return Err(Fatal);
        }
        let trailing = SourceText::new(self.reader.rest().trim_end(), self.reader.at());
        let (comments, blank_lines) = (Vec::new(), blank_lines(self.text));
        Ok(Program {
            model,
            variables,
            loops,
            integrals,
            outputs,
            files,
            colour,
            comments,
            blank_lines,
            trailing,
            sections,
        })
    }

    fn model(&mut self, sections: &mut Sections) -> ParseResult<SourceText> {
        let start = self.reader.at();
        let name = match self.reader.name() {
            Ok(name) => name.text,
            Err(UnexpectedEnd::End) => {
                let empty =
                    Diagnostic::error("program/empty", Span::empty(0), "the program is empty");
                return self.fatal(empty.help("begin with `MODEL = ` and the name of a model"));
            }
            Err(stop) => return self.stopped(stop, Span::empty(start)),
        };
        if !name.as_str().eq_ignore_ascii_case("model") {
            return self.fatal(missing_model(&name));
        }
        let value = self.value(&name, ValueKind::Texts)?;
        sections.model = name.span().to(value.span());
        Ok(value)
    }

    fn variables(&mut self, sections: &mut Sections) -> ParseResult<Vec<ProgramVariable>> {
        let Some(cue) = self.cue(0)? else { return Ok(Vec::new()) };
        let mut variables = Vec::new();
        loop {
            match self.assignment(cue, |name| match VariableKind::of(name) {
                VariableKind::Literal => ValueKind::Texts,
                _ => ValueKind::Expressions,
            })? {
                Assignment::Entry(name, value) => {
                    let kind = VariableKind::of(name.as_str());
                    variables.push(ProgramVariable { name, kind, value });
                }
                Assignment::End(end) => {
                    sections.variables = cue.to(end);
                    return Ok(variables);
                }
            }
        }
    }

    fn vary(&mut self, sections: &mut Sections) -> ParseResult<Vec<Loop>> {
        let Some(cue) = self.cue(1)? else { return Ok(Vec::new()) };
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

    fn for_loop(&mut self, cue: Span, start: Span) -> ParseResult<Loop> {
        let variable = self.section_token(cue)?;
        let from = self.bound("FROM", cue, start.to(variable.span()))?;
        let to = self.bound("TO", cue, start.to(from.span()))?;
        let by = self.bound("BY", cue, start.to(to.span()))?;
        let span = start.to(by.span());
        Ok(Loop::For(Box::new(ForLoop { variable, from, to, by, span })))
    }

    /// A keyword and its expression; `before` is the statement before them.
    fn bound(&mut self, keyword: &str, cue: Span, before: Span) -> ParseResult<SourceText> {
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

    fn files(&mut self, sections: &mut Sections) -> ParseResult<FilesSection> {
        let Some(cue) = self.cue(4)? else { return Ok(FilesSection::default()) };
        let mut entries = Vec::new();
        loop {
            match self.assignment(cue, |_| ValueKind::Texts)? {
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

    fn files_key(&mut self, name: &SourceText) -> Option<FilesKey> {
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

    fn check_basis(&mut self, value: &SourceText) {
        if BasisName::ALL.iter().all(|basis| basis.name() != value.as_str()) {
            let message = format!("invalid polarization basis `{value}`");
            self.found.push(
                Diagnostic::error("program/basis", value.span(), message)
                    .help("write psps, xyxy or plane, in lower case"),
            );
        }
    }

    /// The section COLOR, if it follows FILES; otherwise nothing is read.
    fn colour(&mut self, sections: &mut Sections) -> ParseResult<Option<ColourStatements>> {
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
            match self.assignment(cue, |_| ValueKind::Texts)? {
                Assignment::Entry(name, value) => {
                    let key = self.colour_key(&name);
                    let words = key.is_some_and(ColourKey::takes_words);
                    let value = if words { self.with_words(value) } else { value };
                    entries.extend(key.map(|key| ColourEntry { key, name, value }));
                }
                Assignment::End(end) => {
                    sections.colour = cue.to(end);
                    return Ok(Some(ColourStatements { entries, span: cue.to(end) }));
                }
            }
        }
    }

    fn colour_key(&mut self, name: &SourceText) -> Option<ColourKey> {
        let key = ColourKey::find(name.as_str());
        if key.is_none() {
            let names = ColourKey::ALL.iter().map(|key| key.name());
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

    /// Reads the cue of a section and gives its span; none if the section is left out.
    pub(super) fn cue(&mut self, section: usize) -> ParseResult<Option<Span>> {
        let wanted = CUES[section];
        let may_leave_out = self.has_failed || (section > 0 && self.may_leave_out);
        let token = match self.reader.token() {
            Ok(token) => token.text,
            Err(stop) => return self.stopped_before(stop, wanted),
        };
        if is(&token, wanted) {
            return Ok(Some(token.span()));
        }
        if may_leave_out && CUES[section + 1..].iter().any(|later| is(&token, later)) {
            self.reader.go_to(token.span().start);
            return Ok(None);
        }
        let message = format!("missing {wanted} section cue, found `{token}`");
        let found = Diagnostic::error("program/section-cue", token.span(), message);
        let with_colon = format!("{}:", token.as_str());
        if with_colon.eq_ignore_ascii_case(wanted) {
            return self.fatal(found.help(format!("write {wanted} as one word with its colon")));
        }
        let found = found.help(
            "the sections MODEL, VARIABLES:, VARY:, INTEGRALS:, OUTPUTS:, FILES: stand in this \
             order, each closed by END; they may be empty",
        );
        let Some(meant) = did_you_mean(&token.as_str().to_ascii_uppercase(), [wanted]) else {
            return self.fatal(found);
        };
        if self.dialect.is_compat() {
            return self.fatal(found.help(meant));
        }
        // The section is read as the one that was meant.
        self.found.push(found.help(meant));
        Ok(Some(token.span()))
    }
}

/// The offsets of the blank lines of a text.
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

fn missing_model(name: &SourceText) -> Diagnostic {
    let message = format!("missing MODEL statement, found `{name}` instead");
    let found = Diagnostic::error("program/model", name.span(), message);
    if name.as_str().starts_with('\u{feff}') {
        return found.help("save the file without the byte-order mark in front of the first word");
    }
    let help = "begin with `MODEL = ` and the name of a model";
    found.help(help).help_if(did_you_mean(name.as_str(), ["MODEL"]))
}

fn missing_loop(word: &SourceText, cue: Span) -> Diagnostic {
    let message = format!("missing FOR or LIST statement in VARY section, found `{word}`");
    Diagnostic::error("program/vary-keyword", word.span(), message)
        .help("write FOR variable FROM start TO end BY step, LIST file, or END")
        .help_if(did_you_mean(word.as_str(), ["FOR", "LIST", "END"]))
        .note_at(cue, "the section begins here")
}
