//! The models of a table, and their matrices at its nodes.

use mist_engine::material::PreparedMaterial;
use scattering::{Basis, Mueller};

use super::super::{
    axes::node_directions,
    frame::{HalfAngles, with_opposite_handedness},
};
use crate::export::{Bands, ExportError};

/// The number of wavelengths that Mitsuba's own reader assumes, whatever the file states.
pub const STOCK_WAVELENGTHS: usize = 5;
/// The models of a table for `wavelengths` (nm); with `stock`, for Mitsuba's own reader.
///
/// # Errors
///
/// As [`Bands::new`]; if the material is anisotropic, if a wavelength is not a whole number up to
/// 65535, and with `stock` if there are not five.
pub fn bands(
    material: &PreparedMaterial,
    wavelengths: &[f64],
    stock: bool,
) -> Result<Bands, ExportError> {
    let count = wavelengths.len();
    if stock && count != STOCK_WAVELENGTHS {
        let problem = format!(
            "there are {count}: Mitsuba's reader takes exactly {STOCK_WAVELENGTHS} and renders \
             wrongly with more; give five, or write the table for our plugin, which takes any \
             number"
        );
        return Err(ExportError::refused("wavelengths", problem));
    }
    let whole = |nm: &f64| nm.fract() == 0.0 && (1.0..=65535.0).contains(nm);
    if let Some(odd) = wavelengths.iter().find(|nm| !whole(nm)) {
        let problem = format!("{odd} nm: the format has whole nanometres only");
        return Err(ExportError::refused("wavelengths", problem));
    }
    Bands::new(material, wavelengths)?.isotropic("a .pbsdf")
}

/// The matrices of a table at one node, per wavelength.
pub(super) fn matrices<'b>(
    bands: &'b Bands,
    at: &HalfAngles,
) -> impl Iterator<Item = Mueller> + use<'b> {
    let (l, v) = node_directions(at);
    bands.matrices(l, v, Basis::Plane).map(with_opposite_handedness)
}
