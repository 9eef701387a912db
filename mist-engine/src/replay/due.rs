//! Which entries have to be evaluated in a step: those that were written or give or read a slot
//! that has changed since. All others would give and send what they gave and sent before.

use mist_format::expr::Expr;

use crate::{Job, scope::Scope};

/// The entries that are due.
pub(super) struct Due {
    entries: Vec<bool>,
    /// Entries whose text a loop has replaced: what they read is not known.
    always: Vec<bool>,
    /// For each slot the entries that give or read it.
    concerned: Vec<Vec<usize>>,
    /// Changes of the scope up to this one are taken into account.
    seen: u64,
}

impl Due {
    /// All entries of `job`.
    pub(super) fn new(job: &Job) -> Self {
        let mut concerned = vec![Vec::new(); job.names.len()];
        for (at, entry) in job.entries.iter().enumerate() {
            let read = entry.expr.iter().flat_map(Expr::slots).copied();
            for slot in read.chain(entry.slot) {
                if let Some(concerned) = concerned.get_mut(slot as usize) {
                    concerned.push(at);
                }
            }
        }
        let count = job.entries.len();
        Self { entries: vec![true; count], always: vec![false; count], concerned, seen: 0 }
    }

    /// The entry `at` has to be evaluated.
    pub(super) fn add(&mut self, at: usize) {
        self.entries[at] = true;
    }

    /// A loop has written the entry `at`: it has to be evaluated, and in every step if it is an
    /// expression now.
    pub(super) fn written(&mut self, at: usize, is_expression: bool) {
        self.entries[at] = true;
        self.always[at] = is_expression;
    }

    /// Adds the entries that are concerned by what has changed in `scope`.
    pub(super) fn look_at(&mut self, scope: &Scope) {
        for slot in scope.changed_since(self.seen) {
            self.concerned[slot].iter().for_each(|at| self.entries[*at] = true);
        }
        self.seen = scope.now();
    }

    /// [`Due::look_at`], where nothing but `slot` may have changed.
    pub(super) fn look_at_slot(&mut self, scope: &Scope, slot: u32) {
        if scope.now() > self.seen {
            self.concerned[slot as usize].iter().for_each(|at| self.entries[*at] = true);
            self.seen = scope.now();
        }
    }

    /// The first entry from `next` on that is due.
    pub(super) fn take(&mut self, next: usize) -> Option<usize> {
        let at = next + self.entries[next..].iter().position(|is_due| *is_due)?;
        self.entries[at] = self.always[at];
        Some(at)
    }
}
