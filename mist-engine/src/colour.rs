//! From spectra to colour: the table that a renderer reads.
//!
//! [`table`] holds the finished table; whoever writes it to a file needs nothing else.

pub mod table;

pub use table::{Albedo, Axis, ColourRow, ColourTable, Layout, Patch, Symmetry};
