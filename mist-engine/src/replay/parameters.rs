//! Sending of the entries' values to the model: only values that the entry has not sent before.

use mist_format::expr::Value;
use scattering::Mode;

use super::{
    Override, Replay,
    memo::{SentNumber, SentState},
};
use crate::{
    fault::Fault,
    parameters::ParameterInput,
    step::{Listing, ListingLine, SentInput},
    sweep::EntryContent,
};

impl Replay<'_> {
    /// Sends the text of an entry to the model.
    pub(super) fn send_text(&mut self, at: usize, listing: &mut Listing) -> Result<(), Fault> {
        let text = match &self.overrides[at] {
            Some(Override { content: EntryContent::Text(text), .. }) => text.clone(),
            Some(Override { content: EntryContent::Value(value), .. }) => value.to_text().into(),
            None => self.text(&self.job.plan.entries[at]).as_str().into(),
        };
        self.send(at, SentInput::Text(text), listing)
    }

    /// Sends the value of an entry to the model: its numbers, under compat their text.
    pub(super) fn send_value(
        &mut self,
        at: usize,
        value: Value,
        listing: &mut Listing,
    ) -> Result<(), Fault> {
        let number = value.single().filter(|_| self.is_memoized(at));
        let sent = number.map(|x| SentNumber {
            entry: at,
            bits: x.to_bits(),
            before: self.parameters.hash_code(),
        });
        let Some(sent) = sent else { return self.send(at, self.input(value), listing) };
        if let Some(known) = self.memo.get(&sent, &self.parameters) {
            if self.is_new(at, &known.line.input) {
                self.parameters = known.after;
                self.note_sent(known.line, listing);
            }
            return Ok(());
        }
        let (before, text) = (self.parameters.clone(), value.to_text().into());
        let input = self.input(value);
        self.send(at, input.clone(), listing)?;
        let line = ListingLine { entry: at, input, text: Some(text) };
        self.memo.insert(sent, SentState { before, line, after: self.parameters.clone() });
        Ok(())
    }

    /// The input that a value is to the model.
    fn input(&self, value: Value) -> SentInput {
        match self.job.options.mode {
            Mode::Sound => SentInput::Value(value),
            Mode::Compat => SentInput::Text(value.to_text().into()),
        }
    }

    /// True if the parameters after a number depend on nothing but the number and the parameters
    /// before: NIST's optical constants also remember the last evaluation.
    fn is_memoized(&self, at: usize) -> bool {
        let path = self.job.plan.entries[at].parameter.as_ref();
        self.job.graph.inside(at).is_empty()
            && (self.job.options.mode == Mode::Sound
                || path.is_some_and(|path| self.parameters.belongs_to_object(path)))
    }

    fn is_new(&self, at: usize, input: &SentInput) -> bool {
        self.sent[at].as_ref().is_none_or(|last| last.input != *input)
    }

    fn send(&mut self, at: usize, input: SentInput, listing: &mut Listing) -> Result<(), Fault> {
        if !self.is_new(at, &input) {
            return Ok(());
        }
        let job = self.job;
        let entry = &job.plan.entries[at];
        let path = entry.parameter.as_ref().expect("only parameters are sent");
        let new = match &input {
            SentInput::Text(text) => ParameterInput::Text(text),
            SentInput::Value(value) => ParameterInput::Numbers(value.as_slice()),
        };
        let (mode, previous) = (job.options.mode, self.previous.as_ref());
        self.parameters
            .set(path, new, &job.library, mode, previous)
            .map_err(|error| job.set_fault(at, &error))?;
        for inside in job.graph.inside(at) {
            self.sent[*inside] = None;
            self.values.mark(*inside);
        }
        self.note_sent(ListingLine { entry: at, input, text: None }, listing);
        Ok(())
    }

    fn note_sent(&mut self, line: ListingLine, listing: &mut Listing) {
        let at = line.entry;
        listing.push(line.clone());
        self.sent[at] = Some(line);
    }
}
