//! Which entries have to be evaluated in a step: those that were written or give or read a slot
//! that has changed since. All others would give and send what they gave and sent before.

use mist_format::expr::Expr;

use crate::{Job, scope::SlotValues};

/// The entries that are due.
pub(super) struct Due {
    entries: Marks,
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
        let mut entries = Marks(vec![0; count.div_ceil(64)]);
        (0..count).for_each(|at| entries.mark(at));
        Self { entries, always: vec![false; count], concerned, seen: 0 }
    }

    /// The entry `at` has to be evaluated.
    pub(super) fn add(&mut self, at: usize) {
        self.entries.mark(at);
    }

    /// A loop has written the entry `at`: it has to be evaluated, and in every step if it is an
    /// expression now.
    pub(super) fn written(&mut self, at: usize, is_expression: bool) {
        self.entries.mark(at);
        self.always[at] = is_expression;
    }

    /// Adds the entries that are concerned by what has changed in `scope`.
    pub(super) fn look_at(&mut self, scope: &SlotValues) {
        if scope.now() > self.seen {
            scope.changed_since(self.seen, |slot| {
                self.concerned[slot as usize].iter().for_each(|at| self.entries.mark(*at));
            });
            self.seen = scope.now();
        }
    }

    /// [`Due::look_at`], where nothing but `slot` may have changed, by the entry `giver`; it stays as
    /// it is even if it reads the slot: an entry before it has given that, and is due.
    pub(super) fn given(&mut self, scope: &SlotValues, giver: usize, slot: u32) {
        if scope.now() > self.seen {
            for at in &self.concerned[slot as usize] {
                if *at != giver {
                    self.entries.mark(*at);
                }
            }
            self.seen = scope.now();
        }
    }

    /// The first entry from `next` on that is due.
    pub(super) fn take(&mut self, next: usize) -> Option<usize> {
        let at = self.entries.first(next)?;
        if !self.always[at] {
            self.entries.unmark(at);
        }
        Some(at)
    }
}

/// Marks on entries, 64 to a word.
struct Marks(Vec<u64>);

impl Marks {
    fn mark(&mut self, at: usize) {
        self.0[at / 64] |= 1 << (at % 64);
    }

    fn unmark(&mut self, at: usize) {
        self.0[at / 64] &= !(1 << (at % 64));
    }

    /// The first marked entry from `next` on.
    fn first(&self, next: usize) -> Option<usize> {
        let mut word = next / 64;
        let mut here = self.0.get(word)? & (u64::MAX << (next % 64));
        while here == 0 {
            word += 1;
            here = *self.0.get(word)?;
        }
        Some(word * 64 + here.trailing_zeros() as usize)
    }
}
