//! The steps of a job, made one after the other by a walk of its dependency graph.
//!
//! A replay owns the values of the graph's nodes, the loops and the model's parameters, and yields
//! one independent [`Step`] per combination of loop values. Each step evaluates the nodes whose
//! memos no longer hold ([`crate::graph`]). The model is never evaluated here.

mod aperture;
mod assemble;
mod memo;
mod parameters;

use std::sync::Arc;

use memo::ParameterMemo;
use mist_format::{
    Diagnostic,
    expr::{Expr, Value},
    program::SourceText,
};
use scattering::Mode;

use crate::{
    Job,
    deviation::dialect,
    fault::Fault,
    parameters::ModelParameters,
    plan::VariableEntry,
    slots::SlotNames,
    step::{Listing, ListingLine, Step, StepIntegral},
    sweep::{EntryContent, LoopContext, Sweep},
    values::NodeValues,
};

/// The content that a loop, or the caller of the job, has put into an entry.
struct Override {
    content: EntryContent,
    /// The text of the content compiled, once it was needed.
    expr: Option<Expr>,
}

impl Override {
    fn new(content: EntryContent) -> Self {
        Self { content, expr: None }
    }
}

/// A run of the expressions of a job.
pub struct Replay<'j> {
    job: &'j Job,
    values: NodeValues<'j>,
    sweep: Option<Sweep<'j>>,
    /// For each entry the content that replaces the program's.
    overrides: Vec<Option<Override>>,
    /// For each entry the input that it sent to the model last.
    sent: Vec<Option<ListingLine>>,
    parameters: ModelParameters,
    memo: ParameterMemo,
    /// The parameters of the step before, under compat: NIST's library remembers optical
    /// constants by them.
    previous: Option<ModelParameters>,
    /// The memo of the apertures.
    integrals: Arc<Vec<StepIntegral>>,
    /// The memo of the values that outputs read.
    output_values: Arc<[Option<Value>]>,
    index: u64,
    ended: bool,
    /// True if the columns of the loops are needed.
    shows: bool,
    /// True if FOR loops have two values.
    ends_only: bool,
}

impl<'j> Replay<'j> {
    /// At the beginning of `job`, before its first step.
    pub fn new(job: &'j Job) -> Self {
        let entries = job.plan.entries.len();
        let mut overrides: Vec<_> = (0..entries).map(|_| None).collect();
        for (entry, x) in &*job.given {
            overrides[*entry] = Some(Override::new(EntryContent::Value((*x).into())));
        }
        Self {
            job,
            values: NodeValues::new(job),
            sweep: None,
            overrides,
            sent: vec![None; entries],
            parameters: job.plan.defaults.clone(),
            memo: ParameterMemo::default(),
            previous: None,
            integrals: Arc::default(),
            output_values: Arc::new([]),
            index: 0,
            ended: false,
            shows: true,
            ends_only: false,
        }
    }

    /// The same replay; without `shows` the columns of FOR loops are empty.
    pub(crate) fn showing(mut self, shows: bool) -> Self {
        self.shows = shows;
        self
    }

    /// The same replay with the first and the last value of each FOR loop only.
    pub(crate) fn at_ends(self) -> Self {
        Self { ends_only: true, ..self }
    }

    /// True if the last step was made.
    pub(crate) fn has_ended(&self) -> bool {
        self.ended
    }

    /// The next step; none after the last one.
    ///
    /// # Errors
    ///
    /// The first thing that is wrong with the program in this step, and where.
    pub fn next_step(&mut self) -> Result<Option<Step>, Fault> {
        if self.ended || !self.move_loops()? {
            self.ended = true;
            return Ok(None);
        }
        self.write_loops()?;
        let listing = self.evaluate_entries()?;
        let step = self.assemble(listing)?;
        self.leave_step();
        Ok(Some(step))
    }

    /// Advances to step `to`; of the steps before it only the loops are moved. The steps of the
    /// job must be independent.
    pub(crate) fn skip_to(&mut self, to: u64) -> Result<(), Fault> {
        while self.index < to && !self.ended {
            if !self.move_loops()? {
                self.ended = true;
                return Ok(());
            }
            // The first step sets what does not change, the last one what has changed.
            if self.index == 0 || self.index + 1 == to {
                self.write_loops()?;
                self.evaluate_entries()?;
                self.leave_step();
            } else {
                self.index += 1;
            }
        }
        Ok(())
    }

    /// The parameters of the model after the last step.
    pub(crate) fn parameters(&self) -> &ModelParameters {
        &self.parameters
    }

    /// The values of the last step.
    pub(crate) fn values_mut(&mut self) -> &mut NodeValues<'j> {
        &mut self.values
    }

    /// Evaluates the entries whose values do not hold; returns their part of the listing.
    fn evaluate_entries(&mut self) -> Result<Listing, Fault> {
        let mut listing = Listing::new();
        self.values.set_predefined();
        let mut next = 0;
        while let Some(at) = self.values.next_entry(next) {
            self.evaluate_entry(at, &mut listing)?;
            next = at + 1;
        }
        if self.job.options.mode == Mode::Compat {
            self.parameters.forget_other_wavelengths();
        }
        Ok(listing)
    }

    fn leave_step(&mut self) {
        if self.job.options.mode == Mode::Compat {
            self.previous = Some(self.parameters.clone());
        }
        self.index += 1;
    }

    /// The number of advances of each loop since its reset: the position of the last step.
    pub fn counts(&self) -> Vec<u64> {
        self.sweep.as_ref().map(|sweep| sweep.counts().to_vec()).unwrap_or_default()
    }

    /// Goes to the next combination of loop values; false after the last one.
    fn move_loops(&mut self) -> Result<bool, Fault> {
        let mut context = context(self.job, &mut self.values, (self.shows, self.ends_only));
        match &mut self.sweep {
            Some(sweep) => sweep.advance(&mut context),
            None => {
                self.sweep = Some(Sweep::start(&self.job.plan.loops, &mut context)?);
                Ok(true)
            }
        }
    }

    /// Writes the values of the loops into their entries.
    fn write_loops(&mut self) -> Result<(), Fault> {
        let Some(sweep) = &mut self.sweep else { return Ok(()) };
        for written in
            sweep.write(&mut context(self.job, &mut self.values, (self.shows, self.ends_only)))?
        {
            self.values.mark(written.entry);
            self.overrides[written.entry] = Some(Override::new(written.content));
        }
        Ok(())
    }

    fn evaluate_entry(&mut self, at: usize, listing: &mut Listing) -> Result<(), Fault> {
        let job = self.job;
        let entry = &job.plan.entries[at];
        let Some(slot) = entry.slot else { return self.send_text(at, listing) };
        if let (None, None, Some(expr)) = (&entry.parameter, &self.overrides[at], &entry.expr)
            && let Some(x) = self.values.short_number(expr)
        {
            self.values.set_number(slot, x, Some(at));
            return Ok(());
        }
        let value = self.value_of(at, entry)?;
        self.values.put(slot, Some(&value), Some(at));
        match entry.parameter {
            Some(_) => self.send_value(at, value, listing),
            None => Ok(()),
        }
    }

    /// Evaluates an entry that is not a text.
    fn value_of(&mut self, at: usize, entry: &'j VariableEntry) -> Result<Value, Fault> {
        let text = self.text(entry);
        match &mut self.overrides[at] {
            None => {
                let expr = entry.expr.as_ref().expect("an entry with a slot has an expression");
                self.values.evaluate(expr, text)
            }
            Some(Override { content: EntryContent::Value(value), .. }) => Ok(value.clone()),
            Some(Override { content: EntryContent::Text(written), expr }) => {
                let expr = match expr {
                    Some(expr) => expr,
                    None => {
                        let names = &self.job.plan.names;
                        expr.insert(written_expr(written, text, names, self.job.options.mode)?)
                    }
                };
                // The graph does not know what it reads: it is evaluated in every step.
                self.values.mark(at);
                self.values.evaluate(expr, text)
            }
        }
    }

    /// The text of an entry in the program.
    fn text(&self, entry: &VariableEntry) -> &'j SourceText {
        &self.job.plan.program.variables[entry.variable].value
    }
}

/// The context in which the loops of `job` evaluate their expressions.
fn context<'a, 'j>(
    job: &'j Job,
    values: &'a mut NodeValues<'j>,
    (shows, ends_only): (bool, bool),
) -> LoopContext<'a, 'j> {
    LoopContext { plan: &job.plan, values, mode: job.options.mode, shows, ends_only }
}

/// The text that a loop wrote into an entry, compiled.
fn written_expr(
    written: &str,
    text: &SourceText,
    names: &SlotNames,
    mode: Mode,
) -> Result<Expr, Fault> {
    let mut expr = Expr::compile(written, dialect(mode)).map_err(|error| {
        let diagnostic = error.diagnostic();
        let message = format!("the loop value {written:?}: {}", diagnostic.message);
        Box::new(Diagnostic { span: text.span(), message, ..diagnostic })
    })?;
    expr.bind(|name| names.find(name).unwrap_or(u32::MAX));
    Ok(expr)
}
