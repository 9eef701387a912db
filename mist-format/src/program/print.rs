//! Prints a program in the layout of `mist fmt`.
//!
//! One entry per line, four blanks per level, one blank line between sections. Texts are
//! printed unchanged, comments at their positions. Reading the printed text gives the same
//! program, and printing that gives the same text.

use super::colour::ColourStatements;
use super::integral::Integral;
use super::text::SourceText;
use super::tree::{Loop, Output, Program};
use crate::span::Span;
use std::fmt;

impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut printer = Printer { program: self, comment: 0, end: 0, f };
        let lines = lines(self);
        for (place, line) in lines.iter().enumerate() {
            let next = lines.get(place + 1).map(|next| next.span.start);
            printer.line(line, next.unwrap_or(usize::MAX))?;
        }
        writeln!(f, "{}", self.trailing)
    }
}

/// A line to print, with its span in the text that was read.
struct PrintedLine {
    text: String,
    level: usize,
    span: Span,
    role: LineRole,
}

#[derive(Clone, Copy, PartialEq)]
enum LineRole {
    /// `MODEL = …` or the cue of a section.
    Cue,
    Entry,
    End,
    /// The END of the last section: what follows is printed as it is.
    LastEnd,
}

fn lines(program: &Program) -> Vec<PrintedLine> {
    let sections = &program.sections;
    let model = format!("MODEL = {}", quote(&program.model));
    let mut lines =
        vec![PrintedLine { text: model, level: 0, span: sections.model, role: LineRole::Cue }];
    let variables = program.variables.iter().map(|v| assignment(1, &v.name, &v.value)).collect();
    section(&mut lines, "VARIABLES:", sections.variables, variables);
    section(&mut lines, "VARY:", sections.vary, program.loops.iter().map(loop_line).collect());
    let integrals = program.integrals.iter().flat_map(integral_lines).collect();
    section(&mut lines, "INTEGRALS:", sections.integrals, integrals);
    let outputs = program.outputs.iter().map(output_line).collect();
    section(&mut lines, "OUTPUTS:", sections.outputs, outputs);
    let files = &program.files.entries;
    let files = files.iter().map(|entry| assignment(1, &entry.name, &entry.value)).collect();
    section(&mut lines, "FILES:", sections.files, files);
    if let Some(colour) = &program.colour {
        section(&mut lines, "COLOR:", sections.colour, colour_lines(colour));
    }
    if let Some(last) = lines.last_mut() {
        last.role = LineRole::LastEnd;
    }
    lines
}

/// The cue of a section, its entries and its END; nothing if the section was left out.
fn section(lines: &mut Vec<PrintedLine>, cue: &str, span: Span, entries: Vec<PrintedLine>) {
    if span == Span::default() {
        return;
    }
    let start = Span::new(span.start, span.start + cue.len());
    lines.push(PrintedLine { text: cue.into(), level: 0, span: start, role: LineRole::Cue });
    lines.extend(entries);
    lines.push(end(0, span));
}

fn end(level: usize, span: Span) -> PrintedLine {
    let span = Span::new(span.end.saturating_sub("END".len()), span.end);
    PrintedLine { text: "END".into(), level, span, role: LineRole::End }
}

fn assignment(level: usize, name: &SourceText, value: &SourceText) -> PrintedLine {
    let text = format!("{name} = {}", quote(value));
    PrintedLine { text, level, span: name.span().to(value.span()), role: LineRole::Entry }
}

impl fmt::Display for Loop {
    /// The statement on one line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::For(each) => {
                let [variable, from, to, by] =
                    [&each.variable, &each.from, &each.to, &each.by].map(quote);
                write!(f, "FOR {variable} FROM {from} TO {to} BY {by}")
            }
            Self::List(list) => write!(f, "LIST {}", quote(&list.file)),
        }
    }
}

fn loop_line(each: &Loop) -> PrintedLine {
    let (text, span) = (each.to_string(), each.span());
    PrintedLine { text, level: 1, span, role: LineRole::Entry }
}

fn integral_lines(integral: &Integral) -> Vec<PrintedLine> {
    let mut lines = vec![assignment(1, &integral.name, &integral.shape_text)];
    lines.extend(integral.parameters.iter().map(|each| assignment(2, &each.name, &each.value)));
    lines.push(end(1, integral.span));
    lines
}

fn output_line(output: &Output) -> PrintedLine {
    let label = if output.has_label { format!("{}=", output.label) } else { String::new() };
    let mark = if output.expression.is_quoted() { "\"" } else { "" };
    let text = format!("{} {mark}{label}{}{mark}", quote(&output.number), output.expression);
    let span = output.number.span().to(output.expression.span());
    // The closing quotes are not part of the expression.
    let span = Span::new(span.start, span.end + mark.len());
    PrintedLine { text, level: 1, span, role: LineRole::Entry }
}

fn colour_lines(colour: &ColourStatements) -> Vec<PrintedLine> {
    colour.entries.iter().map(|entry| assignment(1, &entry.name, &entry.value)).collect()
}

/// The text in the syntax of a program.
fn quote(text: &SourceText) -> String {
    if text.is_quoted() { format!("\"{text}\"") } else { text.to_string() }
}

struct Printer<'p, 'f, 'w> {
    program: &'p Program,
    /// The next comment.
    comment: usize,
    /// The end of the last printed item in the text that was read.
    end: usize,
    f: &'f mut fmt::Formatter<'w>,
}

impl<'p> Printer<'p, '_, '_> {
    /// Prints a line with the comments before and after it; the next line begins at `next`.
    fn line(&mut self, line: &PrintedLine, next: usize) -> fmt::Result {
        let first = self.end == 0;
        let level = if matches!(line.role, LineRole::End | LineRole::LastEnd) {
            line.level + 1
        } else {
            line.level
        };
        let mut apart = line.role == LineRole::Cue && !first;
        while let Some(comment) = self.next_comment(line.span.end) {
            if apart || self.blank_line_before(comment.start) {
                writeln!(self.f)?;
            }
            apart = false;
            writeln!(self.f, "{:1$};{text}", "", 4 * level, text = comment.text)?;
            self.end = comment.end;
        }
        let gap = line.role == LineRole::Entry && self.blank_line_before(line.span.start);
        if apart || gap {
            writeln!(self.f)?;
        }
        write!(self.f, "{:1$}{text}", "", 4 * line.level, text = line.text)?;
        self.end = line.span.end.max(self.end);
        // A comment at the end of a line stays there.
        let behind = self.program.comments.get(self.comment);
        if let Some(comment) = behind.filter(|c| !c.own_line && c.span.start < next) {
            write!(self.f, " ;{}", comment.text)?;
            self.end = comment.span.end;
            self.comment += 1;
        }
        if line.role == LineRole::LastEnd { Ok(()) } else { writeln!(self.f) }
    }

    fn next_comment(&mut self, before: usize) -> Option<PendingComment<'p>> {
        let comment = self.program.comments.get(self.comment)?;
        if comment.span.start >= before {
            return None;
        }
        self.comment += 1;
        Some(PendingComment {
            text: &comment.text,
            start: comment.span.start,
            end: comment.span.end,
        })
    }

    fn blank_line_before(&self, start: usize) -> bool {
        let blank = &self.program.blank_lines;
        let place = blank.partition_point(|at| *at < self.end);
        self.end > 0 && blank.get(place).is_some_and(|at| *at < start)
    }
}

/// A comment before or inside a line.
struct PendingComment<'p> {
    text: &'p str,
    start: usize,
    end: usize,
}
