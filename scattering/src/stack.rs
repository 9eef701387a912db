//! Film stacks: which films lie on an interface.

use crate::spec::{Member, Spec};

pub mod double;
mod family;
pub mod graded;
pub mod list;
pub mod none;
pub mod single;

pub use family::{FAMILY, Stack};

pub use crate::optics::Film;
use family::check_thickness;

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<Stack>] =
    &[&none::SPEC, &list::SPEC, &single::SPEC, &double::SPEC, &graded::SPEC];

impl Member for Stack {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}
