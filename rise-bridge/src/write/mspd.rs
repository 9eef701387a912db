//! The spectral power distributions behind a colour table, as text: `.mspd`.

use mist_engine::colour::ColourTable;

use super::{
    error::WriteError,
    header::{columns, header, node},
    rows::TextRows,
    style::Style,
};
use crate::column;

/// The spectra of the Stokes component `component` (0 … 3 for I, Q, U, V) as `.mspd`.
///
/// # Errors
///
/// If a row has no such spectrum or a number is not finite.
pub fn mspd(table: &ColourTable, component: usize, style: Style) -> Result<String, WriteError> {
    let letter = ['I', 'Q', 'U', 'V'][component];
    let mut names = column::patch_names(table);
    names.extend(table.wavelengths.iter().copied().map(node));
    let mut rows = TextRows::new(&names, style.digits);
    for (i, row) in table.rows.iter().enumerate() {
        let spectrum = &row.spectra[component];
        if spectrum.len() != table.wavelengths.len() {
            return Err(WriteError::NoSpectrum { row: i + 1, component: letter });
        }
        let mut values = column::patch_values(row);
        values.extend(spectrum);
        rows.push(&values, None)?;
    }
    let stokes = [("stokes", letter.to_string())];
    Ok(header(table, style.digits, &stokes) + &columns(&names) + &rows.finish())
}

/// Name of the file that holds a component: `paint.mspd` for I, `paint.Q.mspd` for Q.
pub fn component_name(name: &str, component: usize) -> String {
    match (component, name.rsplit_once('.')) {
        (0, _) => name.to_owned(),
        (_, Some((stem, extension))) if !extension.contains('/') => {
            format!("{stem}.{}.{extension}", column::STOKES[component])
        }
        _ => format!("{name}.{}", column::STOKES[component]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_have_files_of_their_own() {
        assert_eq!(component_name("a.mspd", 0), "a.mspd");
        assert_eq!(component_name("a.mspd", 1), "a.Q.mspd");
        assert_eq!(component_name("./a", 3), "./a.V");
    }
}
