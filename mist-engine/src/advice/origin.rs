//! Origin of a number: through plain variables and loops back to the literal.

use std::collections::BTreeSet;

use mist_format::{Span, program::SourceText};

use super::words::{Kind, Word, words};
use crate::{Job, plan::LoopPlan};

/// Longer chains of variables are not followed.
const LONGEST_CHAIN: usize = 32;

/// Which element of a vector is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Element {
    /// The one at this place, from 0.
    At(usize),
    /// The last number, where one number is required.
    Last,
}

/// Literal of a number.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Origin {
    /// Place.
    pub(super) span: Span,
    /// The text there.
    pub(super) text: String,
    /// True if it is a number and nothing else.
    pub(super) is_literal: bool,
}

/// Literal of the variable `name`, whose value is `value`.
pub(super) fn of_variable(job: &Job, name: &str, value: f64) -> Option<Origin> {
    Some(match source(job, name, value)? {
        ValueOrigin::Text(text) => origin(job, &text, Element::Last, value),
        ValueOrigin::File(file) => whole(&file),
    })
}

/// Follows `element` of `text`, whose value is `value`, to what was written for it.
pub(super) fn origin(job: &Job, text: &SourceText, element: Element, value: f64) -> Origin {
    let mut text = text.clone();
    let mut element = Some(element);
    for _ in 0..LONGEST_CHAIN {
        if let Some(part) = element.and_then(|element| part(&text, element)) {
            text = part;
        }
        let all = words(text.as_str());
        match &all[..] {
            [Word { kind: Kind::Name, text: name, .. }] => match source(job, name, value) {
                Some(ValueOrigin::Text(next)) => {
                    // A loop gives plain numbers; a variable may be a vector itself.
                    element = element.or(Some(Element::Last));
                    text = next;
                }
                Some(ValueOrigin::File(file)) => return whole(&file),
                None => return whole(&text),
            },
            [minus @ .., number] if minus.iter().all(|word| word.is("-") || word.is("+")) => {
                let is_literal = matches!(number.kind, Kind::Number(_));
                return Origin { is_literal, ..whole(&text) };
            }
            _ => return largest(&text, &all),
        }
    }
    whole(&text)
}

/// The largest number in an expression, or the whole of it.
fn largest(text: &SourceText, all: &[Word<'_>]) -> Origin {
    let number = |word: &Word<'_>| match word.kind {
        Kind::Number(x) => Some((x, word.range.clone())),
        _ => None,
    };
    let found = all.iter().filter_map(number).max_by(|a, b| a.0.total_cmp(&b.0));
    // A factor or an offset as small as an angle in radians is not to blame.
    match found.filter(|(x, _)| *x > std::f64::consts::TAU) {
        Some((_, range)) => Origin { is_literal: true, ..whole(&text.part(range)) },
        None => whole(text),
    }
}

fn whole(text: &SourceText) -> Origin {
    Origin { span: text.span(), text: text.as_str().trim().to_owned(), is_literal: false }
}

/// One element of a list that is written as a list.
fn part(text: &SourceText, element: Element) -> Option<SourceText> {
    let all = words(text.as_str());
    let inner = match &all[..] {
        [open, inner @ .., close] if open.is("(") && close.is(")") && balanced(inner) => inner,
        inner => inner,
    };
    let mut parts = vec![Vec::new()];
    let mut depth = 0;
    for word in inner {
        depth += i32::from(word.is("(")) - i32::from(word.is(")"));
        match (word.is(","), depth) {
            (true, 0) => parts.push(Vec::new()),
            _ => parts.last_mut()?.push(word),
        }
    }
    let wanted = match element {
        Element::At(place) => parts.get(place)?,
        Element::Last => parts.last()?,
    };
    Some(text.part(wanted.first()?.range.start..wanted.last()?.range.end))
}

fn balanced(words: &[Word<'_>]) -> bool {
    let mut depth = 0;
    words.iter().all(|word| {
        depth += i32::from(word.is("(")) - i32::from(word.is(")"));
        depth >= 0
    }) && depth == 0
}

enum ValueOrigin {
    Text(SourceText),
    File(SourceText),
}

/// Source of the value of the variable `name`: a loop, or its entry.
fn source(job: &Job, name: &str, value: f64) -> Option<ValueOrigin> {
    let slot = job.plan.names.find(name)?;
    let at = job.plan.entries.iter().rposition(|entry| entry.slot == Some(slot))?;
    let writer = job.plan.loops.iter().rev().find(|each| each.entries().contains(&at));
    Some(match writer {
        Some(LoopPlan::For(plan)) => {
            let statement = &plan.statement;
            let near = |text: &SourceText| {
                let number = mist_format::number::whole_number(text.as_str().trim());
                (number.unwrap_or(f64::INFINITY) - value).abs()
            };
            let from = near(&statement.from) < near(&statement.to);
            ValueOrigin::Text(if from { statement.from.clone() } else { statement.to.clone() })
        }
        Some(LoopPlan::List(plan)) => ValueOrigin::File(plan.statement.file.clone()),
        None => ValueOrigin::Text(
            job.plan.program.variables[job.plan.entries[at].variable].value.clone(),
        ),
    })
}

/// True if an element is made of an angle in degrees, or of π: through all variables it reads.
pub(super) fn is_converted(job: &Job, text: &SourceText, element: Element) -> bool {
    let part = part(text, element).unwrap_or_else(|| text.clone());
    are_converted(job, vec![part.as_str().to_owned()])
}

/// The same of a variable.
pub(super) fn is_variable_converted(job: &Job, name: &str) -> bool {
    are_converted(job, texts_of(job, name))
}

fn are_converted(job: &Job, mut open: Vec<String>) -> bool {
    let mut seen = BTreeSet::new();
    while let Some(text) = open.pop() {
        for word in words(&text) {
            match word.kind {
                Kind::Number(x) if is_a_conversion(x) => return true,
                Kind::Name if converts(word.text) => return true,
                Kind::Name if seen.insert(word.text.to_owned()) => {
                    open.extend(texts_of(job, word.text));
                }
                _ => {}
            }
        }
    }
    false
}

/// π/180, 180/π, π and its simplest parts as people write them.
fn is_a_conversion(x: f64) -> bool {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};
    [PI / 180.0, 180.0 / PI, PI, FRAC_PI_2, FRAC_PI_4, TAU]
        .iter()
        .any(|known| (x / known - 1.0).abs() < 1e-3)
}

fn converts(name: &str) -> bool {
    matches!(name, "pi" | "deg" | "asin" | "acos" | "atan" | "atan2")
}

/// Everything that is written for the variable `name`: its entries, or the bounds of the loop
/// that writes them.
fn texts_of(job: &Job, name: &str) -> Vec<String> {
    let Some(slot) = job.plan.names.find(name) else { return Vec::new() };
    let mut found = Vec::new();
    for (at, entry) in job.plan.entries.iter().enumerate().filter(|(_, e)| e.slot == Some(slot)) {
        let writers = job.plan.loops.iter().filter(|each| each.entries().contains(&at));
        let bounds: Vec<&SourceText> = writers
            .flat_map(|each| match each {
                LoopPlan::For(plan) => vec![&plan.statement.from, &plan.statement.to],
                LoopPlan::List(plan) => vec![&plan.statement.file],
            })
            .collect();
        match bounds[..] {
            [] => found.push(&job.plan.program.variables[entry.variable].value),
            _ => found.extend(bounds),
        }
    }
    let outputs = job.plan.outputs.iter().filter(|output| output.slot == slot);
    found.extend(outputs.map(|output| &output.text));
    found.into_iter().map(|text| text.as_str().to_owned()).collect()
}
