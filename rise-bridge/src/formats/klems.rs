//! Writer of Klems XML for Radiance and WINDOW.

use std::io::Write;

use mist_engine::{Control, material::PreparedMaterial};

use super::export::{ExportRequest, error_of_f};
use crate::{
    export::{Bands, ExportError},
    klems,
};

/// Writes the file; the line has the error inside of the patches.
pub(super) fn write(
    material: &PreparedMaterial,
    request: &ExportRequest,
    out: &mut dyn Write,
    control: &Control,
) -> Result<String, ExportError> {
    let bands = Bands::new(material, &request.wavelengths("360:10:830")?)?;
    klems::write(&bands, &request.name, out, control)?;
    let mut line = "145 x 145 patches, CIE X, Y and Z".to_owned();
    if request.estimate_error {
        let error = klems::interpolation_error(&bands)?;
        line += &format!("; inside the patches {}", error_of_f(error.median, error.quantile_95));
    }
    Ok(line)
}
