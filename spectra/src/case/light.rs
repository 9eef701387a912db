//! The light of a case: by name, by temperature, or by samples.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{error::CaseError, fields::CaseFields};
use crate::{Extrapolation, Illuminant, Interpolation, wavelength::Grid};

/// The illuminants that come with a request, by name.
pub(super) fn read_illuminants(
    request: CaseFields<'_>,
) -> Result<BTreeMap<String, Illuminant>, CaseError> {
    let Some(value) = request.get("illuminants") else { return Ok(BTreeMap::new()) };
    let Some(table) = value.as_object() else {
        return Err(request.error("illuminants", "expected an object of illuminants by name"));
    };
    table
        .iter()
        .map(|(name, value)| {
            let path = format!("illuminants.{name}");
            let fields = CaseFields::new(request.case(), &path, value)?;
            Ok((name.clone(), read_light(name, fields)?))
        })
        .collect()
}

/// A light from {wavelengths, values, interpolation, extrapolation} or {start_nm, end_nm, step_nm,
/// values}.
fn read_light(name: &str, fields: CaseFields<'_>) -> Result<Illuminant, CaseError> {
    let values = fields.required_numbers("values")?;
    let grid = if fields.has("wavelengths") {
        let wavelengths = fields.required_numbers("wavelengths")?;
        Grid::new(&wavelengths).map_err(|e| fields.error("wavelengths", e))?
    } else {
        let start = fields.required_number("start_nm")?;
        let step = fields.required_number("step_nm")?;
        let nm: Vec<f64> = (0..values.len()).map(|i| start + step * i as f64).collect();
        let grid = Grid::new(&nm).map_err(|e| fields.error("start_nm", e))?;
        let end = fields.number("end_nm")?.unwrap_or(nm[nm.len() - 1]);
        if (end - nm[nm.len() - 1]).abs() > 1e-6 * step.abs() {
            let found =
                format!("{} values from {start} nm by {step} nm do not end at end_nm", nm.len());
            return Err(fields.error("end_nm", found));
        }
        grid
    };
    let interpolation = match fields.text("interpolation")? {
        Some(text) => Interpolation::parse(text).map_err(|e| fields.error("interpolation", e))?,
        None => Interpolation::Linear,
    };
    let outside = match fields.text("extrapolation")? {
        Some(text) => Extrapolation::parse(text).map_err(|e| fields.error("extrapolation", e))?,
        None => Extrapolation::Zero,
    };
    Illuminant::interpolated(name, &grid, &values, interpolation, outside)
        .map_err(|e| fields.error("values", e))
}

/// The illuminant of a case; `None` for emission.
pub(super) fn read_illuminant(
    fields: CaseFields<'_>,
    illuminants: &BTreeMap<String, Illuminant>,
) -> Result<Option<Illuminant>, CaseError> {
    let custom = || -> Result<_, CaseError> {
        let path = fields.path_to("custom_illuminant");
        let light = CaseFields::new(fields.case(), &path, fields.required("custom_illuminant")?)?;
        read_light("custom", light)
    };
    match fields.get("illuminant") {
        None if fields.get("custom_illuminant").is_some() => custom().map(Some),
        None if fields.has("illuminant") => Ok(None),
        None => Err(fields.error("illuminant", "missing (null for emission)")),
        Some(Value::Number(kelvin)) => Illuminant::planck(kelvin.as_f64().unwrap_or(f64::NAN))
            .map(Some)
            .map_err(|e| fields.error("illuminant", e)),
        Some(_) => match fields.text("illuminant")?.unwrap_or_default() {
            "custom" => custom().map(Some),
            name => match illuminants.get(name) {
                Some(light) => Ok(Some(light.clone())),
                None => {
                    Illuminant::parse(name).map(Some).map_err(|e| fields.error("illuminant", e))
                }
            },
        },
    }
}
