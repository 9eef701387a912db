//! The sections INTEGRALS and OUTPUTS.

use super::super::integral::{ApertureShape, Integral, IntegralParameter};
use super::super::text::SourceText;
use super::super::tree::{Output, ProgramVariable, Sections};
use super::entries::{Assignment, ValueKind, open_parentheses};
use super::parser::{ParseResult, Parser, is};
use crate::diagnostic::Diagnostic;
use crate::dialect::TextDeviation;
use crate::number::{integer_prefix, is_blank};
use crate::span::Span;
use crate::suggestion::did_you_mean;
use std::collections::HashMap;

impl Parser<'_> {
    pub(super) fn integrals(
        &mut self,
        sections: &mut Sections,
        known: &[ProgramVariable],
    ) -> ParseResult<Vec<Integral>> {
        let Some(cue) = self.cue(2)? else { return Ok(Vec::new()) };
        let folded = |variable: &ProgramVariable| variable.name.as_str().to_ascii_lowercase();
        let known: HashMap<String, Span> =
            known.iter().map(|variable| (folded(variable), variable.name.span())).collect();
        let mut integrals = Vec::new();
        loop {
            match self.assignment(cue, |_| ValueKind::Texts)? {
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

    fn shape(&mut self, word: &SourceText) -> Option<ApertureShape> {
        let shape = ApertureShape::find(word.as_str());
        if shape.is_none() {
            let names = ApertureShape::ALL.iter().map(|shape| shape.name());
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

    /// `known` are the spans of the variables by their names in lower case.
    fn check_integral_name(&mut self, name: &SourceText, known: &HashMap<String, Span>) {
        if let Some(variable) = known.get(&name.as_str().to_ascii_lowercase()) {
            let message = format!("variable `{name}` already defined");
            self.found.push(
                Diagnostic::error("program/integral-name", name.span(), message)
                    .help("choose another name for the integral; case does not count here")
                    .note_at(*variable, "the variable is defined here"),
            );
        }
    }

    /// The parameters of an integral up to its END; none if its shape is unknown.
    fn integral(
        &mut self,
        name: SourceText,
        word: SourceText,
        shape: Option<ApertureShape>,
    ) -> ParseResult<Option<Integral>> {
        let mut parameters = Vec::new();
        loop {
            match self.assignment(word.span(), |_| ValueKind::Expressions)? {
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

    fn check_integral_parameter(
        &mut self,
        shape: ApertureShape,
        name: &SourceText,
        value: &SourceText,
    ) {
        let known = shape.parameters();
        if known.iter().any(|known| known.eq_ignore_ascii_case(name.as_str())) {
            return;
        }
        let message = format!("unknown variable `{name}` in {}", shape.name());
        let found = Diagnostic::error("program/integral-parameter", name.span(), message);
        self.found.push(if ApertureShape::find(value.as_str()).is_some() {
            found.help(format!("write END before `{name}`, so that the integral before it ends"))
        } else {
            found
                .help(format!("{} takes {}", shape.name(), known.join(", ")))
                .help_if(did_you_mean(name.as_str(), known.iter().copied()))
        });
    }

    pub(super) fn outputs(&mut self, sections: &mut Sections) -> ParseResult<Vec<Output>> {
        let Some(cue) = self.cue(3)? else { return Ok(Vec::new()) };
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
                self.refuse(TextDeviation::EmptyValue, token.span());
            }
            let output = self.output(cue, number, token)?;
            self.check_output(&output);
            outputs.push(output);
        }
    }

    /// The output with a number, whose first word is `token`. Blanks may surround the equal sign
    /// behind the label.
    fn output(&mut self, cue: Span, number: SourceText, token: SourceText) -> ParseResult<Output> {
        if token.is_quoted() || self.dialect.is_compat() {
            return Ok(split_output(number, token));
        }
        let word = token.as_str();
        let (label, expression) = match word.find('=') {
            Some(at) if at > 0 && at + 1 == word.len() => {
                (token.part(0..at), self.section_token(cue)?)
            }
            None if self.an_equal_sign_follows() => match self.section_token(cue)? {
                alone if alone.as_str() == "=" => (token, self.section_token(cue)?),
                joined => (token, joined.part(1..joined.as_str().len())),
            },
            _ => return Ok(split_output(number, token)),
        };
        if is(&expression, "END") {
            self.refuse(TextDeviation::EmptyValue, expression.span());
        }
        Ok(Output { number, label, has_label: true, expression })
    }

    fn check_output_number(&mut self, number: &SourceText, expected: usize) -> ParseResult<()> {
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
            self.refuse(TextDeviation::NumberPrefix, number.span());
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
}

/// Label and expression of an output, separated at the first `=`.
fn split_output(number: SourceText, token: SourceText) -> Output {
    match token.as_str().find('=') {
        Some(at) => {
            let (label, expression) = (token.part(0..at), token.part(at + 1..token.as_str().len()));
            Output { number, label, has_label: true, expression }
        }
        None => Output { number, label: token.clone(), has_label: false, expression: token },
    }
}
