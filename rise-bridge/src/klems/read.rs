//! Reads Klems XML.

use super::basis::{BASIS, RINGS};
use crate::export::ExportError;

/// The values of one band on one side.
#[derive(Clone, Debug, PartialEq)]
pub struct KlemsBlock {
    /// The band: `Visible`, `CIE-X`, `CIE-Z`, ….
    pub band: String,
    /// The side, such as `Reflection Back`.
    pub side: String,
    /// BRDF (1/sr) by `[outgoing][incident]`.
    pub values: Vec<Vec<f64>>,
}

/// Reads a file in the full Klems basis.
///
/// # Errors
///
/// If the basis or the order of rows differs, or numbers are missing.
pub fn read(text: &str) -> Result<Vec<KlemsBlock>, ExportError> {
    let refused = |problem: &str| ExportError::refused("Klems file", problem);
    if !text.contains(&format!("<AngleBasisName>{BASIS}</AngleBasisName>"))
        || !text.contains("<IncidentDataStructure>Columns</IncidentDataStructure>")
    {
        return Err(refused("expected the basis LBNL/Klems Full with columns"));
    }
    let count: usize = RINGS.iter().map(|ring| ring.1).sum();
    let mut blocks = Vec::new();
    for piece in text.split("<WavelengthData>").skip(1) {
        let inside = |tag: &str| {
            // The tag without or with attributes, but no other tag with the same beginning.
            let whole = piece.split_once(&format!("<{tag}>"));
            let rest = match whole {
                Some((_, rest)) => rest,
                None => piece.split_once(&format!("<{tag} "))?.1.split_once('>')?.1,
            };
            Some(rest.split_once(&format!("</{tag}>"))?.0)
        };
        let part = |tag: &str| inside(tag).ok_or_else(|| refused(&format!("{tag} is missing")));
        let numbers: Result<Vec<f64>, _> = part("ScatteringData")?
            .split([',', '\n', ' '])
            .filter(|word| !word.is_empty())
            .map(str::parse)
            .collect();
        let numbers =
            numbers.map_err(|_| refused("ScatteringData has a word that is not a number"))?;
        if numbers.len() != count * count {
            return Err(refused(&format!("{} numbers of {}", numbers.len(), count * count)));
        }
        let values = numbers.chunks(count).map(<[f64]>::to_vec).collect();
        let (band, side) = (part("Wavelength")?, part("WavelengthDataDirection")?);
        blocks.push(KlemsBlock { band: band.to_owned(), side: side.to_owned(), values });
    }
    Ok(blocks)
}
