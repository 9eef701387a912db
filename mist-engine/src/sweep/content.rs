//! The contents that loops write into entries, and the context in which they do it.

use std::sync::Arc;

use mist_format::expr::Value;
use scattering::Mode;

use crate::{plan::Plan, values::NodeValues};

/// New content of an entry of VARIABLES.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LoopWrite {
    /// The entry.
    pub(crate) entry: usize,
    pub(crate) content: EntryContent,
}

/// The content of an entry of VARIABLES, in place of the program's.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum EntryContent {
    /// A value.
    Value(Value),
    /// An expression, or a text for the model.
    Text(Arc<str>),
}

/// The context in which loops evaluate their expressions.
pub(crate) struct LoopContext<'a, 'j> {
    pub(crate) plan: &'j Plan,
    pub(crate) values: &'a mut NodeValues<'j>,
    pub(crate) mode: Mode,
    /// True if the columns of the loops are needed.
    pub(crate) shows: bool,
    /// True if FOR loops go from their first value to their last one at once.
    pub(crate) ends_only: bool,
}
