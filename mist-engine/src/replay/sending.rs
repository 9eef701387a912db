//! What entries send to the model: the texts of its parameters, and only those that are new.

use std::sync::Arc;

use mist_format::expr::Value;

use super::{
    Overwritten, Replay,
    settings::{Outcome, Setting},
};
use crate::{
    fault::Fault,
    parameters::{ModelParameters, is_below},
    quirk::Quirk,
    step::Listing,
    sweep::EntryContent,
};

/// What an entry sent to the model last.
pub(super) struct Sent {
    text: Arc<str>,
    /// The bits of the number, if it was one.
    bits: Option<u64>,
}

impl Replay<'_> {
    /// Sends the text of an entry to the model, unless the entry sent the same before.
    pub(super) fn send_text(&mut self, at: usize, listing: &mut Listing) -> Result<(), Fault> {
        let number;
        let text = match &self.overwritten[at] {
            Some(Overwritten { content: EntryContent::Text(text), .. }) => text,
            Some(Overwritten { content: EntryContent::Number(x), .. }) => {
                number = Value::from(*x).to_text();
                &*number
            }
            None => self.text(&self.job.entries[at]).as_str(),
        };
        if self.last_sent[at].as_ref().is_some_and(|last| *last.text == *text) {
            return Ok(());
        }
        let text = text.into();
        self.send(at, Sent { text, bits: None }, listing)
    }

    /// Sends the value of an entry to the model, unless the entry sent the same before.
    pub(super) fn send_number(
        &mut self,
        at: usize,
        value: &Value,
        listing: &mut Listing,
    ) -> Result<(), Fault> {
        let bits = match value.as_slice() {
            [one] => Some(one.to_bits()),
            _ => None,
        };
        if bits.is_some() && self.last_sent[at].as_ref().is_some_and(|last| last.bits == bits) {
            return Ok(());
        }
        let setting = bits.map(|bits| Setting {
            entry: at,
            bits,
            before: self.parameters.fingerprint(),
            previous: self.previous.as_ref().map(ModelParameters::fingerprint),
        });
        let known = setting.and_then(|setting| self.known_settings.get(&setting).cloned());
        let text: Arc<str> =
            known.as_ref().map_or_else(|| value.to_text().into(), |known| known.text.clone());
        if self.last_sent[at].as_ref().is_some_and(|last| last.text == text) {
            return Ok(());
        }
        if let Some(known) = known {
            self.parameters = known.after;
            listing.push(known.line);
            self.sent(at, Sent { text, bits });
            return Ok(());
        }
        self.send(at, Sent { text: text.clone(), bits }, listing)?;
        if let (Some(setting), Some(line)) = (setting, listing.last()) {
            let (line, after) = (line.clone(), self.parameters.clone());
            self.known_settings.insert(setting, Outcome { text, line, after });
        }
        Ok(())
    }

    /// Sends a parameter to the model.
    fn send(&mut self, at: usize, sent: Sent, listing: &mut Listing) -> Result<(), Fault> {
        let entry = &self.job.entries[at];
        let name = entry.parameter.as_deref().expect("only parameters are sent");
        let (mode, previous) = (self.job.options.mode, self.previous.as_ref());
        let set = self.parameters.set(name, &sent.text, &self.job.library, mode, previous);
        set.map_err(|error| {
            let variable = &self.job.program.variables[entry.variable];
            let place = if error.is_about_the_name() { &variable.name } else { &variable.value };
            Box::new(error.diagnostic(place.span()))
        })?;
        listing.push(format!("Setting parameter {name} to {}\n", sent.text).into());
        self.sent(at, sent);
        Ok(())
    }

    /// Notes that a parameter is set.
    fn sent(&mut self, at: usize, sent: Sent) {
        let name = self.job.entries[at].parameter.as_deref().expect("only parameters are sent");
        if !Quirk::NoResend.applies_in(self.job.options.mode) {
            self.forget_below(at, name);
        }
        self.last_sent[at] = Some(sent);
    }

    /// Entries that set a parameter below `name` are sent again: it is a new object now.
    fn forget_below(&mut self, at: usize, name: &str) {
        for (other, entry) in self.job.entries.iter().enumerate() {
            let is_below = entry.parameter.as_deref().is_some_and(|lower| is_below(lower, name));
            if other != at && is_below {
                self.last_sent[other] = None;
                self.due.add(other);
            }
        }
    }
}
