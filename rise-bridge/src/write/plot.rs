//! Pictures of colour tables and of spectra as SVG, without scripts and fonts.

mod display;
mod graph;
mod page;
mod pair;
mod swatch;
mod table;

pub use pair::plot_comparisons;
pub use table::plot;
