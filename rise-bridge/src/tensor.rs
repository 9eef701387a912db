//! The container `tensor_file` of Mitsuba and the RGL: named arrays of numbers.
//!
//! Little endian, neither compressed nor protected by a checksum: `tensor_file\0`, version 1.0,
//! the number of fields; per field its name, shape, number type and offset; the data in C
//! order, each field at a multiple of eight bytes.
//!
//! [`TensorWriter`] takes the data in the order of the fields, in parts, so that a table need not fit in
//! memory; [`TensorReader`] reads parts.

mod error;
mod field;
mod format;
mod read;
mod write;

pub use error::TensorError;
pub use field::{NumberType, TensorField};
pub use read::TensorReader;
pub use write::TensorWriter;

#[cfg(test)]
mod tests;
