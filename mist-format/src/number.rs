//! Numbers as text: C++ stream input, C printf output.

mod digits;
mod general;
mod prefix;
mod printf;
mod unit;

pub use general::{TEXT_DIGITS, general, list, loop_text, push_general, push_list, reread};
pub(crate) use prefix::is_blank;
pub use prefix::{IntegerPrefix, NumberPrefix, integer_prefix, number_prefix, whole_number};
pub use printf::{FormatError, PrintfFormat};
pub use unit::{unit_length, without_unit};
