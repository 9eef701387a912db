//! Pictures of colour tables and of spectra as SVG without scripts.

mod axes;
mod curves;
mod display;
mod graph;
mod page;
mod pair;
mod swatch;
mod table;

pub use curves::{Graph, Mark, Series};
pub use pair::plot_comparisons;
pub use table::{plot, plot_graphs};
