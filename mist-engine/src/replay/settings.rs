//! What setting a number made of the parameters: loops come back to the same numbers again and
//! again, and the parameters are made once for each.

use std::sync::Arc;

use crate::{
    parameters::{Fingerprint, ModelParameters},
    share::FastMap,
};

/// Settings kept at the same time.
const KEPT: usize = 1 << 12;

/// An entry and the bits of its number, set in these parameters, behind a step that had those.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Setting {
    pub(super) entry: usize,
    pub(super) bits: u64,
    pub(super) before: Fingerprint,
    pub(super) previous: Option<Fingerprint>,
}

/// What came out.
#[derive(Clone)]
pub(super) struct Outcome {
    /// The number as it was sent.
    pub(super) text: Arc<str>,
    /// What the listing says of it.
    pub(super) line: Arc<str>,
    pub(super) after: ModelParameters,
}

/// The settings of a replay.
#[derive(Default)]
pub(super) struct Settings(FastMap<Setting, Outcome>);

impl Settings {
    pub(super) fn get(&self, setting: &Setting) -> Option<&Outcome> {
        self.0.get(setting)
    }

    pub(super) fn insert(&mut self, setting: Setting, outcome: Outcome) {
        if self.0.len() == KEPT {
            self.0.clear();
        }
        self.0.insert(setting, outcome);
    }
}
