//! A number of the program that must be of a certain size, watched over the steps.

use std::f64::consts::PI;

use mist_format::{
    Diagnostic,
    expr::{Expr, OperandStack},
    program::SourceText,
};

use super::origin::{Element, Origin, is_converted, is_variable_converted, of_variable, origin};
use crate::{Job, slots::SlotValues};

/// Place of the number.
pub(super) enum ReadingSource<'j> {
    Slot(u32),
    Expr(&'j Expr),
    Number(f64),
}

/// Meaning of the number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    /// An angle in radians that may look like degrees.
    Radians,
    /// A wavelength in µm that may look like nm.
    Micrometres,
}

/// One number and the largest value it had.
pub(super) struct Reading<'j> {
    pub(super) what: String,
    pub(super) unit: Unit,
    pub(super) text: &'j SourceText,
    pub(super) source: ReadingSource<'j>,
    pub(super) element: Element,
    /// Larger values are not likely.
    pub(super) most: f64,
    pub(super) extreme: f64,
}

impl<'j> Reading<'j> {
    /// Looks at the value in this step.
    pub(super) fn see(&mut self, scope: &mut SlotValues) {
        let value = match &self.source {
            ReadingSource::Number(x) => Some((*x).into()),
            ReadingSource::Slot(slot) => scope.get(*slot).cloned(),
            ReadingSource::Expr(expr) => scope.value(expr, &mut OperandStack::default()).ok(),
        };
        let Some(value) = value else { return };
        let all = value.as_slice();
        let number = match self.element {
            Element::At(place) => all.get(place),
            Element::Last => all.last(),
        };
        if let Some(x) = number.filter(|x| x.is_finite() && x.abs() > self.extreme.abs()) {
            self.extreme = *x;
        }
    }

    /// The warning.
    pub(super) fn warning(&self, job: &Job) -> Option<Diagnostic> {
        if self.extreme.abs() <= self.most {
            return None;
        }
        let written = || origin(job, self.text, self.element, self.extreme);
        let (origin, converted) = match self.source {
            ReadingSource::Slot(slot) => {
                let name = job.plan.names.name(slot);
                let found = of_variable(job, name, self.extreme);
                (found.unwrap_or_else(written), is_variable_converted(job, name))
            }
            _ => (written(), is_converted(job, self.text, self.element)),
        };
        match self.unit {
            Unit::Radians if converted => None,
            Unit::Radians => Some(self.degrees(&origin)),
            Unit::Micrometres => Some(self.nanometres(&origin)),
        }
    }

    fn degrees(&self, origin: &Origin) -> Diagnostic {
        let (what, value) = (&self.what, self.extreme);
        let looks = if value.abs() > PI { "looks like degrees" } else { "is below the horizon" };
        let message = format!("{what} is read in radians, and {value} {looks}");
        let help = if origin.is_literal {
            format!("write {}*deg where it is used as an angle, with deg = atan(1)/45", origin.text)
        } else {
            format!("multiply by deg = atan(1)/45 where {what} is set")
        };
        self.at(origin, "angle/degrees", message, help)
    }

    fn nanometres(&self, origin: &Origin) -> Diagnostic {
        let (what, value) = (&self.what, self.extreme);
        let message = format!("{what} is read in um, and {value} looks like nm");
        let help = format!("write {}, or divide by 1000 where {what} is set", value / 1000.0);
        self.at(origin, "wavelength/nanometres", message, help)
    }

    /// A warning at the origin, with the place where the number is read.
    fn at(&self, origin: &Origin, code: &'static str, message: String, help: String) -> Diagnostic {
        let found = Diagnostic::warning(code, origin.span, message).help(help);
        let read = self.text.span();
        if read.start <= origin.span.start && origin.span.end <= read.end {
            return found;
        }
        found.note_at(read, format!("{} is read here", self.what))
    }
}
