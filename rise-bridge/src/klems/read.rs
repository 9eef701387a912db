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
    let is = |tag: &str, expected: &str| inside(text, tag).is_some_and(|found| found == expected);
    if !is("AngleBasisName", BASIS) {
        let found = inside(text, "AngleBasisName").unwrap_or("none");
        return Err(refused(&format!("the basis is {found}; expected {BASIS}")));
    }
    if !is("IncidentDataStructure", "Columns") {
        let found = inside(text, "IncidentDataStructure").unwrap_or("missing");
        return Err(refused(&format!("IncidentDataStructure is {found}; expected Columns")));
    }
    let count: usize = RINGS.iter().map(|ring| ring.1).sum();
    let mut blocks = Vec::new();
    for piece in text.split("<WavelengthData>").skip(1) {
        let part =
            |tag: &str| inside(piece, tag).ok_or_else(|| refused(&format!("{tag} is missing")));
        let mut numbers = Vec::with_capacity(count * count);
        let words = part("ScatteringData")?.split(|c: char| c == ',' || c.is_whitespace());
        for word in words.filter(|word| !word.is_empty()) {
            let number: Result<f64, _> = word.parse();
            let wrong = |_| refused(&format!("ScatteringData: {word:?} is not a number"));
            numbers.push(number.map_err(wrong)?);
        }
        if numbers.len() != count * count {
            return Err(refused(&format!("{} numbers of {}", numbers.len(), count * count)));
        }
        let values = numbers.chunks(count).map(<[f64]>::to_vec).collect();
        let (band, side) = (part("Wavelength")?, part("WavelengthDataDirection")?);
        blocks.push(KlemsBlock { band: band.to_owned(), side: side.to_owned(), values });
    }
    Ok(blocks)
}

/// The content of the first element called `tag`, with or without attributes, without the white
/// space around it.
fn inside<'t>(text: &'t str, tag: &str) -> Option<&'t str> {
    let mut rest = text;
    loop {
        rest = rest.split_once(&format!("<{tag}"))?.1;
        // No other tag with the same beginning.
        if rest.starts_with(|c: char| c == '>' || c.is_whitespace()) {
            let content = rest.split_once('>')?.1;
            return Some(content.split_once(&format!("</{tag}"))?.0.trim());
        }
    }
}
