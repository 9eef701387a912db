//! Laws of all texts of tables and spectra, for the tests and for `fuzz/`.
//!
//! The checksum and the numbers of rows are put right first, so that a changed text is read
//! beyond them.

#![allow(unreachable_pub, reason = "the fuzz targets see it from another crate")]

use mist_engine::colour::ColourRow;
use rise_bridge::read::{self, ReadError};
use rise_bridge::write::{self, Style};

/// Every digit of an f64.
const EXACT: Style = Style { digits: 17, xyz: false };

/// A table read from `.mtab` is written and read again without loss.
pub fn mtab(text: &str) {
    let Some(table) = mended(text, read::mtab) else { return };
    let written = write::mtab(&table, EXACT).expect("what was read can be written");
    let again = read::mtab(&written).expect("what was written can be read");
    // X and Z are kept by tables that have columns for them, and this one is written without.
    let plain = |row: &ColourRow| {
        let mut row = row.clone();
        [row.xyz[0][0], row.xyz[0][2]] = [0.0; 2];
        row
    };
    let rows: Vec<_> = table.rows.iter().map(plain).collect();
    assert_eq!(again.rows, rows, "of\n{text}");
    // Tabs in a text of the header become blanks.
    let once = write::mtab(&again, EXACT).expect("it was written a moment ago");
    let twice = write::mtab(&read::mtab(&once).expect("it can be read"), EXACT);
    assert_eq!(twice.as_deref(), Ok(once.as_str()), "of\n{text}");
    write::json(&again, true).expect("it can be written as JSON");
    assert!(!write::plot(&again).contains("NaN"), "of\n{text}");
}

/// Spectra read from `.mspd` have one finite value per wavelength in each row.
pub fn mspd(text: &str) {
    let Some(spectra) = mended(text, read::mspd) else { return };
    for row in &spectra.rows {
        assert_eq!(row.values.len(), spectra.table.wavelengths.len(), "of\n{text}");
        assert!(row.values.iter().all(|value| value.is_finite()), "of\n{text}");
    }
}

/// The result of `read` for `text` with corrected number of rows and checksum.
fn mended<T>(text: &str, read: impl Fn(&str) -> Result<T, ReadError>) -> Option<T> {
    let mut text = text.to_owned();
    for _ in 0..3 {
        match read(&text) {
            Ok(found) => return Some(found),
            Err(ReadError::Checksum { found, stated }) => {
                let at = text.rfind(&stated)?;
                text.replace_range(at..at + stated.len(), &found);
            }
            Err(ReadError::RowCount { found, stated, by }) => {
                let key = by.trim_matches('"');
                let line = text.rfind(key)?;
                let at = line + text[line..].find(&stated.to_string())?;
                text.replace_range(at..at + stated.to_string().len(), &found.to_string());
            }
            Err(error) => {
                assert!(!error.to_string().is_empty());
                return None;
            }
        }
    }
    None
}
