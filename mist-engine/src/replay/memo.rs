//! The memo of the model's parameters.

use rustc_hash::FxHashMap;

use crate::{parameters::ModelParameters, step::ListingLine};

/// The memo of the model's parameters: their states after the numbers that were sent. Loops send
/// the same numbers again and again, and equal states are then the same object with the same hash.
#[derive(Default)]
pub(super) struct ParameterMemo(FxHashMap<SentNumber, SentState>);

/// The largest number of states in a memo.
const STATES: usize = 1 << 12;

/// A number sent by an entry to parameters with a hash.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct SentNumber {
    pub(super) entry: usize,
    pub(super) bits: u64,
    pub(super) before: u64,
}

/// The parameters before and after a number was sent, and its line of the listing.
#[derive(Clone)]
pub(super) struct SentState {
    pub(super) before: ModelParameters,
    pub(super) line: ListingLine,
    pub(super) after: ModelParameters,
}

impl ParameterMemo {
    /// The state after `sent` to the parameters `before`.
    pub(super) fn get(&self, sent: &SentNumber, before: &ModelParameters) -> Option<SentState> {
        self.0.get(sent).filter(|state| state.before == *before).cloned()
    }

    pub(super) fn insert(&mut self, sent: SentNumber, state: SentState) {
        if self.0.len() >= STATES {
            self.0.clear();
        }
        self.0.insert(sent, state);
    }
}
