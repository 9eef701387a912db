//! The rules in which the evaluators differ.

use crate::dialect::{Dialect, TextDeviation};

/// The differences between the evaluators.
#[derive(Clone, Copy, Debug)]
pub(in crate::expr) struct Rules {
    pub(super) dialect: Dialect,
    pub(super) library: bool,
}

impl Rules {
    pub(in crate::expr) fn program(dialect: Dialect) -> Self {
        Self { dialect, library: false }
    }

    pub(in crate::expr) fn library() -> Self {
        Self { dialect: Dialect::Sound, library: true }
    }

    pub(super) fn refuses(self, deviation: TextDeviation) -> bool {
        deviation.refused_in(self.dialect)
    }
}
