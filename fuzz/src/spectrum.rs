//! Files of two columns.

use spectra::{Extrapolation, Spectrum};

/// A spectrum has one value for each of its ascending wavelengths.
pub fn is_a_grid(text: &str) {
    let Ok((spectrum, _)) = Spectrum::parse(text) else { return };
    let grid = spectrum.grid().nm();
    assert_eq!(grid.len(), spectrum.values().len());
    assert!(grid.windows(2).all(|pair| pair[0] < pair[1]), "{grid:?}");
    let _ = spectrum.fine(Extrapolation::Hold);
}
