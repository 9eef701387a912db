//! From the integrals of a step to a line of the results, and where lines go.

use std::io;

use mist_format::{
    expr::{Expr, Stack, Value},
    number::{general, list},
    program::Text,
};

use crate::{
    Job,
    fault::{Fault, placed},
    scope::Scope,
    step::{Cell, Evaluated, Step},
    uncertainty::{ErrorColumn, ErrorColumns},
};

/// Digits of loop columns; the program's `format` does not concern them.
const LOOP_DIGITS: usize = 6;

/// One of the three texts that a run writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// The table: a line of names, then one line per step.
    Results,
    /// What was run with which parameters.
    Listing,
    /// Every evaluated direction.
    Samples,
}

/// Takes the texts of a run as they are made.
pub trait Sink {
    /// Appends `text` to `stream`.
    ///
    /// # Errors
    ///
    /// If the text cannot be kept; the run ends.
    fn write(&mut self, stream: Stream, text: &str) -> io::Result<()>;

    /// Takes a line of the results as it is before it is rounded: what the columns of the loops
    /// show, and the outputs. Nothing is done with it unless a sink wants it.
    ///
    /// # Errors
    ///
    /// If it cannot be kept; the run ends.
    fn row(&mut self, loops: &[String], outputs: &[f64]) -> io::Result<()> {
        let _ = (loops, outputs);
        Ok(())
    }

    /// Everything of the step number `step` is written.
    ///
    /// # Errors
    ///
    /// If it cannot be kept; the run ends.
    fn step_done(&mut self, _step: u64) -> io::Result<()> {
        Ok(())
    }

    /// A good moment to make sure that everything is kept.
    ///
    /// # Errors
    ///
    /// If it cannot be kept; the run ends.
    fn block_done(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Keeps the texts in memory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MemorySink {
    /// The table.
    pub results: String,
    /// The listing.
    pub listing: String,
    /// The samples.
    pub samples: String,
}

impl Sink for MemorySink {
    fn write(&mut self, stream: Stream, text: &str) -> io::Result<()> {
        let kept = match stream {
            Stream::Results => &mut self.results,
            Stream::Listing => &mut self.listing,
            Stream::Samples => &mut self.samples,
        };
        kept.push_str(text);
        Ok(())
    }
}

/// The header lines and the line of names.
pub(crate) fn head(job: &Job) -> String {
    let mut text = String::new();
    for header in job.program.files.headers() {
        text.push_str(header.as_str());
        text.push('\n');
    }
    let [loops, _] = job.columns();
    for title in loops {
        text.push_str(title);
        text.push('\t');
    }
    for (at, output) in job.outputs.iter().enumerate() {
        text.push_str(&output.label);
        text.push('\t');
        for column in job.errors.iter().flat_map(|errors| errors.after(at)) {
            text.push_str(&column.title);
            text.push('\t');
        }
    }
    for column in job.errors.iter().flat_map(ErrorColumns::last) {
        text.push_str(&column.title);
        text.push('\t');
    }
    text.push('\n');
    text
}

/// A line of the results.
pub(crate) struct Line {
    pub(crate) text: String,
    /// What the columns of the loops show.
    pub(crate) loops: Vec<String>,
    pub(crate) outputs: Vec<f64>,
}

/// The values that outputs see: a step's variables and integrals, labels of earlier steps.
pub(crate) struct Outputs<'j> {
    job: &'j Job,
    pub(crate) scope: Scope,
    stack: Stack,
}

impl<'j> Outputs<'j> {
    pub(crate) fn new(job: &'j Job) -> Self {
        let scope = Scope::new(job.names.len(), job.library.clone());
        Self { job, scope, stack: Stack::default() }
    }

    /// The line of `step`, whose integrals came out as `integrals`.
    pub(crate) fn line(&mut self, step: &Step, integrals: &[Evaluated]) -> Result<Line, Fault> {
        let job = self.job;
        let predefined =
            [(job.required.pi, 4.0 * 1f64.atan()), (job.required.deg, 4.0 * 1f64.atan() / 180.0)];
        for (slot, value) in predefined {
            self.scope.set(slot, value.into());
        }
        for (slot, value) in job.reads.iter().zip(&step.values) {
            if value.is_some() {
                self.scope.put(*slot, value.clone());
            }
        }
        for (plan, evaluated) in job.integrals.iter().zip(integrals) {
            self.scope.set(plan.slot, evaluated.value.into());
        }
        let error = |column: &ErrorColumn| integrals[column.integral].error;
        for column in job.errors.iter().flat_map(ErrorColumns::all) {
            self.scope.set(column.slot, error(column).into());
        }
        let mut text = String::new();
        let mut loops = Vec::with_capacity(step.columns.len());
        for cell in &step.columns {
            let cell = self.cell(cell)?;
            text.push_str(&cell);
            text.push('\t');
            loops.push(cell);
        }
        let mut outputs = Vec::with_capacity(job.outputs.len());
        for (at, output) in job.outputs.iter().enumerate() {
            let value = self.number_at(&output.expr, &output.text)?;
            self.scope.set(output.slot, value.into());
            text.push_str(&job.format.format(value));
            outputs.push(value);
            for column in job.errors.iter().flat_map(|errors| errors.after(at)) {
                text.push_str(&job.format.format(error(column)));
            }
        }
        for column in job.errors.iter().flat_map(ErrorColumns::last) {
            text.push_str(&job.format.format(error(column)));
        }
        text.push('\n');
        Ok(Line { text, loops, outputs })
    }

    fn cell(&mut self, cell: &Cell) -> Result<String, Fault> {
        match cell {
            Cell::Text(text) => Ok(text.clone()),
            Cell::Number(x) => Ok(general(*x, LOOP_DIGITS)),
            Cell::Expression(expr) => {
                let value: Value = self
                    .scope
                    .value(expr, &mut self.stack)
                    .map_err(|error| Box::new(error.diagnostic(std::iter::empty())))?;
                Ok(list(value.as_slice(), LOOP_DIGITS))
            }
        }
    }

    /// The number that `expr`, written at `place`, gives now.
    pub(crate) fn number_at(&mut self, expr: &Expr, place: &Text) -> Result<f64, Fault> {
        self.scope.number(expr, &mut self.stack).map_err(|error| {
            let known: Vec<&str> = self.scope.defined().map(|s| self.job.names.name(s)).collect();
            placed(place, error.diagnostic(known))
        })
    }

    /// Gives integrals and labels to the scope of the next step.
    pub(crate) fn feed_back(&self, scope: &mut Scope) {
        let integrals = self.job.integrals.iter().map(|plan| plan.slot);
        let errors = self.job.errors.iter().flat_map(ErrorColumns::slots);
        let outputs = self.job.outputs.iter().map(|output| output.slot);
        for slot in integrals.chain(errors).chain(outputs) {
            scope.put(slot, self.scope.get(slot).cloned());
        }
    }
}
