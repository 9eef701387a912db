//! Tree to text: the layout of `mist fmt`.
//!
//! One entry per line, four blanks per level, one blank line between sections. Texts are
//! printed as they are, comments where they stood. Reading the printed text gives the same
//! program, and printing that gives the same text.

use super::{Color, Integral, Loop, Output, Program, Text};
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

/// A line to print, and what it stands for in the text that was read.
struct Line {
    text: String,
    level: usize,
    span: Span,
    role: Role,
}

#[derive(Clone, Copy, PartialEq)]
enum Role {
    /// `MODEL = …` or the cue of a section.
    Cue,
    Entry,
    End,
    /// The END of the last section: what follows is printed as it is.
    LastEnd,
}

fn lines(program: &Program) -> Vec<Line> {
    let sections = &program.sections;
    let model = format!("MODEL = {}", quote(&program.model));
    let mut lines = vec![Line { text: model, level: 0, span: sections.model, role: Role::Cue }];
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
    if let Some(color) = &program.color {
        section(&mut lines, "COLOR:", sections.color, color_lines(color));
    }
    if let Some(last) = lines.last_mut() {
        last.role = Role::LastEnd;
    }
    lines
}

/// The cue of a section, its entries and its END.
fn section(lines: &mut Vec<Line>, cue: &str, span: Span, entries: Vec<Line>) {
    let start = Span::new(span.start, span.start + cue.len());
    lines.push(Line { text: cue.into(), level: 0, span: start, role: Role::Cue });
    lines.extend(entries);
    lines.push(end(0, span));
}

fn end(level: usize, span: Span) -> Line {
    let span = Span::new(span.end.saturating_sub("END".len()), span.end);
    Line { text: "END".into(), level, span, role: Role::End }
}

fn assignment(level: usize, name: &Text, value: &Text) -> Line {
    let text = format!("{name} = {}", quote(value));
    Line { text, level, span: name.span().to(value.span()), role: Role::Entry }
}

fn loop_line(each: &Loop) -> Line {
    let text = match each {
        Loop::For(each) => {
            let [variable, from, to, by] =
                [&each.variable, &each.from, &each.to, &each.by].map(quote);
            format!("FOR {variable} FROM {from} TO {to} BY {by}")
        }
        Loop::List(list) => format!("LIST {}", quote(&list.file)),
    };
    Line { text, level: 1, span: each.span(), role: Role::Entry }
}

fn integral_lines(integral: &Integral) -> Vec<Line> {
    let mut lines = vec![assignment(1, &integral.name, &integral.shape_text)];
    lines.extend(integral.parameters.iter().map(|each| assignment(2, &each.name, &each.value)));
    lines.push(end(1, integral.span));
    lines
}

fn output_line(output: &Output) -> Line {
    let label = if output.has_label { format!("{}=", output.label) } else { String::new() };
    let mark = if output.expression.is_quoted() { "\"" } else { "" };
    let text = format!("{} {mark}{label}{}{mark}", quote(&output.number), output.expression);
    let span = output.number.span().to(output.expression.span());
    // The closing quotes are not part of the expression.
    let span = Span::new(span.start, span.end + mark.len());
    Line { text, level: 1, span, role: Role::Entry }
}

fn color_lines(color: &Color) -> Vec<Line> {
    color.entries.iter().map(|entry| assignment(1, &entry.name, &entry.value)).collect()
}

/// The text as it is written in a program.
fn quote(text: &Text) -> String {
    if text.is_quoted() { format!("\"{text}\"") } else { text.to_string() }
}

struct Printer<'p, 'f, 'w> {
    program: &'p Program,
    /// The next comment.
    comment: usize,
    /// Where, in the text that was read, the last printed thing ends.
    end: usize,
    f: &'f mut fmt::Formatter<'w>,
}

impl<'p> Printer<'p, '_, '_> {
    /// Prints a line with the comments before it and behind it; the next line begins at `next`.
    fn line(&mut self, line: &Line, next: usize) -> fmt::Result {
        let first = self.end == 0;
        let level = if matches!(line.role, Role::End | Role::LastEnd) {
            line.level + 1
        } else {
            line.level
        };
        let mut apart = line.role == Role::Cue && !first;
        while let Some(comment) = self.next_comment(line.span.end) {
            if apart || self.blank_line_before(comment.start) {
                writeln!(self.f)?;
            }
            apart = false;
            writeln!(self.f, "{:1$};{text}", "", 4 * level, text = comment.text)?;
            self.end = comment.end;
        }
        let gap = line.role == Role::Entry && self.blank_line_before(line.span.start);
        if apart || gap {
            writeln!(self.f)?;
        }
        write!(self.f, "{:1$}{text}", "", 4 * line.level, text = line.text)?;
        self.end = line.span.end.max(self.end);
        // Behind its own line, a comment stays there.
        let behind = self.program.comments.get(self.comment);
        if let Some(comment) = behind.filter(|c| !c.own_line && c.span.start < next) {
            write!(self.f, " ;{}", comment.text)?;
            self.end = comment.span.end;
            self.comment += 1;
        }
        if line.role == Role::LastEnd { Ok(()) } else { writeln!(self.f) }
    }

    fn next_comment(&mut self, before: usize) -> Option<Before<'p>> {
        let comment = self.program.comments.get(self.comment)?;
        if comment.span.start >= before {
            return None;
        }
        self.comment += 1;
        Some(Before { text: &comment.text, start: comment.span.start, end: comment.span.end })
    }

    fn blank_line_before(&self, start: usize) -> bool {
        let blank = &self.program.blank_lines;
        let place = blank.partition_point(|at| *at < self.end);
        self.end > 0 && blank.get(place).is_some_and(|at| *at < start)
    }
}

/// A comment that stands before or inside a line.
struct Before<'p> {
    text: &'p str,
    start: usize,
    end: usize,
}
