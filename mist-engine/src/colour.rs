//! From spectra to colour: the table that a renderer reads.
//!
//! [`section`] is the section COLOR of a program, compiled; [`fold`] gathers the steps of a run
//! into spectra; [`table`] holds the finished table. Whoever writes it needs nothing else.

mod angles;
pub(crate) mod fold;
pub mod section;
pub mod table;

pub use crate::plan::ColourSection;
pub use table::{Albedo, ColourRow, ColourTable, RowOrder, RowPatch, Symmetry, TableAxis};
