//! From the integrals of a step to a line of the results, and where lines go.

mod form;
mod not_finite;
mod units;

use std::{io, ops::Range, sync::Arc};

use form::TableForm;
pub(crate) use not_finite::NotFinite;

use mist_format::{
    expr::{Expr, OperandStack, Value},
    number::{push_list, whole_number},
    program::SourceText,
};

use crate::{
    Job,
    fault::{Fault, placed},
    plan::{ErrorColumn, ErrorColumns},
    slots::SlotValues,
    step::{COLUMN_DIGITS, Evaluated, LoopCell, Step},
    values::NodeValues,
};

/// One of the three texts that a run writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputStream {
    /// The table: a line of names, then one line per step.
    Results,
    /// Record of the run and its parameters.
    Listing,
    /// Every evaluated direction.
    Samples,
}

/// Takes the texts of a run as they are made.
pub trait Sink: Send {
    /// Appends `text` to `stream`.
    ///
    /// # Errors
    ///
    /// If the text cannot be kept; the run ends.
    fn write(&mut self, stream: OutputStream, text: &str) -> io::Result<()>;

    /// True if the texts of `stream` are needed; if not, a run does not make them.
    fn wants(&self, _stream: OutputStream) -> bool {
        true
    }

    /// True if the columns of the loops are needed by [`Sink::row`]; if not, and the texts of the
    /// results are not needed either, they are empty.
    fn wants_loops(&self) -> bool {
        true
    }

    /// Takes a line of the results in its parts, after its text was written.
    ///
    /// # Errors
    ///
    /// If it cannot be kept; the run ends.
    fn row(&mut self, _line: &TableLine) -> io::Result<()> {
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
    fn write(&mut self, stream: OutputStream, text: &str) -> io::Result<()> {
        let kept = match stream {
            OutputStream::Results => &mut self.results,
            OutputStream::Listing => &mut self.listing,
            OutputStream::Samples => &mut self.samples,
        };
        kept.push_str(text);
        Ok(())
    }
}

/// The header lines and the line of names.
pub(crate) fn head(job: &Job) -> String {
    let form = TableForm::of(job);
    let mut text = String::new();
    for header in job.plan.program.files.headers() {
        text.push_str(form.comment());
        text.push_str(header.as_str());
        text.push('\n');
    }
    let titles = titles(job);
    for title in titles.iter().map(|title| form.title(title, &job.plan)) {
        text.push_str(&title);
        text.push(form.character());
    }
    form.end_line(&mut text);
    text
}

impl Job {
    /// The unit of the column `title`, if the program tells it.
    pub fn unit(&self, title: &str) -> Option<&'static str> {
        units::unit(title, &self.plan)
    }
}

/// The titles of all columns.
fn titles(job: &Job) -> Vec<&str> {
    let [loops, _] = job.columns();
    let mut titles = loops;
    for (at, output) in job.plan.outputs.iter().enumerate() {
        titles.push(&output.label);
        let errors = job.plan.errors.iter().flat_map(|errors| errors.after(at));
        titles.extend(errors.map(|column| column.title.as_str()));
    }
    let errors = job.plan.errors.iter().flat_map(ErrorColumns::last);
    titles.extend(errors.map(|column| column.title.as_str()));
    titles
}

/// A line of the results.
#[derive(Debug, Default)]
pub struct TableLine {
    pub(crate) text: String,
    /// Positions of the columns of the loops in the text.
    cells: Vec<Range<usize>>,
    coordinates: Vec<f64>,
    outputs: Vec<f64>,
    errors: Vec<f64>,
}

impl TableLine {
    /// Contents of the columns of the loops.
    pub fn loops(&self) -> impl Iterator<Item = &str> {
        self.cells.iter().map(|cell| &self.text[cell.clone()])
    }

    /// The values of the loops with all their bits, in the order of their columns; NaN for a text
    /// that is not a number.
    pub fn coordinates(&self) -> &[f64] {
        &self.coordinates
    }

    /// The outputs as they are before they are rounded.
    pub fn outputs(&self) -> &[f64] {
        &self.outputs
    }

    /// The estimated errors in the order of [`Job::error_columns`], before they are rounded.
    pub fn errors(&self) -> &[f64] {
        &self.errors
    }
}

/// The values that outputs see: a step's variables and integrals, labels of earlier steps.
pub(crate) struct Outputs<'j> {
    job: &'j Job,
    pub(crate) scope: SlotValues,
    stack: OperandStack,
    /// The variables that the scope holds.
    values: Option<Arc<[Option<Value>]>>,
    /// True if an integral or an output has the name of a variable, and hides it until the end
    /// of the line.
    hides: bool,
    /// True if the numbers are formatted, and not only computed.
    formats: bool,
    form: TableForm,
    pub(crate) not_finite: NotFinite,
}

impl<'j> Outputs<'j> {
    /// For the lines of `job`; with `formats` their texts are made, not only their numbers.
    pub(crate) fn new(job: &'j Job, formats: bool) -> Self {
        let scope = SlotValues::new(job.plan.names.len(), job.library.clone());
        let required = &job.plan.required;
        let predefined = [required.pi, required.deg];
        let mut results = job.plan.results();
        let hides =
            results.any(|slot| job.plan.reads.contains(&slot) || predefined.contains(&slot));
        let (stack, not_finite) = (OperandStack::default(), NotFinite::new(job.plan.outputs.len()));
        let form = TableForm::of(job);
        Self { job, scope, stack, values: None, hides, formats, form, not_finite }
    }

    /// Puts the line of `step`, whose integrals came out as `integrals`, into `line`.
    pub(crate) fn fill(
        &mut self,
        line: &mut TableLine,
        step: &Step,
        integrals: &[Evaluated],
    ) -> Result<(), Fault> {
        let job = self.job;
        self.take_values(step);
        for (plan, evaluated) in job.plan.integrals.iter().zip(integrals) {
            self.scope.set_number(plan.slot, evaluated.value);
        }
        let error = |column: &ErrorColumn| integrals[column.integral].error;
        for column in job.plan.errors.iter().flat_map(ErrorColumns::all) {
            self.scope.set_number(column.slot, error(column));
        }
        let TableLine { text, cells, coordinates, outputs, errors } = line;
        text.clear();
        cells.clear();
        coordinates.clear();
        outputs.clear();
        errors.clear();
        for cell in &step.columns {
            let start = text.len();
            coordinates.push(self.push_cell(text, cell)?);
            cells.push(start..text.len());
            text.push(self.form.character());
        }
        for (at, output) in job.plan.outputs.iter().enumerate() {
            let value = self.number_at(&output.expr, &output.text)?;
            self.scope.set_number(output.slot, value);
            outputs.push(value);
            if !value.is_finite() {
                self.not_finite.add(at, step.index);
            }
        }
        errors.extend(job.plan.error_columns().map(error));
        if !self.formats {
            return Ok(());
        }
        for (at, value) in outputs.iter().enumerate() {
            self.form.push(text, &job.plan.format, *value);
            for column in job.plan.errors.iter().flat_map(|errors| errors.after(at)) {
                self.form.push(text, &job.plan.format, error(column));
            }
        }
        for column in job.plan.errors.iter().flat_map(ErrorColumns::last) {
            self.form.push(text, &job.plan.format, error(column));
        }
        self.form.end_line(text);
        Ok(())
    }

    /// The predefined variables and those of the step.
    fn take_values(&mut self, step: &Step) {
        let are_there =
            self.values.as_ref().is_some_and(|values| Arc::ptr_eq(values, &step.values));
        if are_there && !self.hides {
            return;
        }
        for (slot, x) in self.job.plan.required.constants() {
            self.scope.set_number(slot, x);
        }
        for (slot, value) in self.job.plan.reads.iter().zip(&*step.values) {
            if value.is_some() {
                self.scope.put(*slot, value.as_ref());
            }
        }
        self.values = Some(step.values.clone());
    }

    /// Appends the cell of a loop; gives its value.
    fn push_cell(&mut self, text: &mut String, cell: &LoopCell) -> Result<f64, Fault> {
        match cell {
            LoopCell::Text(cell) => {
                text.push_str(cell);
                Ok(whole_number(cell).unwrap_or(f64::NAN))
            }
            LoopCell::Number(x, cell) => {
                text.push_str(cell);
                Ok(*x)
            }
            LoopCell::Expression(expr) => {
                let value: Value = self
                    .scope
                    .value(expr, &mut self.stack)
                    .map_err(|error| Box::new(error.diagnostic(std::iter::empty())))?;
                push_list(text, value.as_slice(), COLUMN_DIGITS);
                Ok(value.as_slice().first().copied().unwrap_or(f64::NAN))
            }
        }
    }

    /// The number that `expr`, written at `place`, gives now.
    pub(crate) fn number_at(&mut self, expr: &Expr, place: &SourceText) -> Result<f64, Fault> {
        self.scope.number(expr, &mut self.stack).map_err(|error| {
            let known: Vec<&str> =
                self.scope.defined().map(|s| self.job.plan.names.name(s)).collect();
            placed(place, error.diagnostic(known))
        })
    }

    /// Gives integrals and labels to the scope of the next step.
    pub(crate) fn feed_back(&self, values: &mut NodeValues<'_>) {
        for slot in self.job.plan.results() {
            values.put(slot, self.scope.get(slot), None);
        }
    }
}
