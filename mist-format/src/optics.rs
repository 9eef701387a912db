//! The texts of optical constants, tables and film stacks in the parameters of a model.
//!
//! A text becomes a typed description; the caller opens files.

mod error;
mod index;
mod stack;
mod table_text;

pub use error::OpticsError;
pub use index::IndexText;
pub use stack::{FilmText, StackText};
pub use table_text::TableText;
