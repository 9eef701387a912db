//! Change of the colours of a program with its variables, as required for colour tolerances
//! of thicknesses, sizes and densities.
//!
//! For each variable p and each row of the colour table, with a step h,
//!
//! $$ \frac{\Delta E}{\Delta p} = \frac{\Delta E_{00}[\mathrm{Lab}(p+h), \mathrm{Lab}(p-h)]}{2h} $$
//!
//! with CIEDE2000 between L\*a\*b\* relative to the white of the table; where the model refuses one
//! of the two, the value itself takes its place. CIEDE2000 is not a metric of large distances, so
//! this is the rate for small changes: a tolerance of one ΔE is 1/(ΔE/Δp) as long as the colour
//! moves evenly.
//!
//! ISO/CIE 11664-6:2014.

use std::f64::consts::PI;

use serde::Serialize;
use spectra::{Lab, Xyz, difference::delta_e_2000, lab};

use crate::{
    Control, Failure,
    colour::{ColourRow, ColourTable},
    function::ProgramFunction,
};

/// Change of the colour of one row.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ColourShift {
    /// Values of the columns before the angles.
    pub leading: Vec<f64>,
    /// Polar angle of incidence, degrees.
    pub thetai: f64,
    /// Polar angle of scattering, degrees.
    pub thetas: f64,
    /// Azimuth of scattering, degrees.
    pub phis: f64,
    /// CIEDE2000 per unit of the variable.
    pub delta_e: f64,
    /// Change of L\*, a\*, b\* per unit of the variable.
    pub lab: [f64; 3],
}

/// Effect of one variable on the colours.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ColourSensitivity {
    /// The variable.
    pub name: String,
    /// Its value in the program.
    pub value: f64,
    /// The two values between which the difference was taken.
    pub between: [f64; 2],
    /// Mean of ΔE per unit over the rows.
    pub mean: f64,
    /// Largest ΔE per unit.
    pub largest: f64,
    /// The change that moves the most sensitive row by one ΔE; none if no colour moves.
    pub for_one: Option<f64>,
    /// The rows.
    pub rows: Vec<ColourShift>,
}

/// Effects of the variables on the colours of a program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ColourTolerance {
    /// Step relative to the value.
    pub step: f64,
    /// Names of the columns before the angles.
    pub leading: Vec<String>,
    /// The variables, in the order they were named.
    pub parameters: Vec<ColourSensitivity>,
}

/// Error of a tolerance analysis.
#[derive(Debug, thiserror::Error)]
pub enum ToleranceError {
    /// The program makes no colours.
    #[error("the program has no section COLOR, so it has no colours that could move")]
    NoColour,
    /// The colours are absolute.
    #[error(
        "the colours are radiances, which have no white: write `quantity = factor`, `brdf` or \
         `reflectance` in COLOR"
    )]
    NoWhite,
    /// The step is out of range.
    #[error("the step must lie between 0 and 1, relative to the value; it is {0}")]
    Step(f64),
    /// The program does not run.
    #[error("with {name} = {value}: {failure}")]
    Run {
        /// The variable.
        name: String,
        /// Its value.
        value: f64,
        /// The reason.
        failure: Failure,
    },
}

/// Change of the colours of `program` per unit of each of its variables; `step` is relative to
/// the value, and absolute for a value of zero.
///
/// # Errors
///
/// See [`ToleranceError`].
pub fn tolerance(
    program: &ProgramFunction,
    step: f64,
    control: &Control,
) -> Result<ColourTolerance, ToleranceError> {
    if !(step > 0.0 && step < 1.0) {
        return Err(ToleranceError::Step(step));
    }
    let mut leading = Vec::new();
    let mut parameters = Vec::new();
    let count = program.names().len();
    for at in 0..count {
        let (parameter, table) = sensitivity(program, at, step, control)?;
        leading = table.leading;
        parameters.push(parameter);
        control.report((at + 1) as f64 / count as f64);
    }
    Ok(ColourTolerance { step, leading, parameters })
}

fn sensitivity(
    program: &ProgramFunction,
    at: usize,
    step: f64,
    control: &Control,
) -> Result<(ColourSensitivity, ColourTable), ToleranceError> {
    let value = program.start()[at];
    let size = if value == 0.0 { 1.0 } else { value.abs() };
    let colours = |moved: f64| -> Result<(f64, ColourTable), ToleranceError> {
        let mut values = program.start().to_vec();
        values[at] = moved;
        let ran = program.outputs(&values, control).map_err(|failure| {
            let name = program.names()[at].clone();
            ToleranceError::Run { name, value: moved, failure }
        })?;
        Ok((moved, ran.colour.ok_or(ToleranceError::NoColour)?))
    };
    let below = colours(value - step * size);
    let above = colours(value + step * size);
    // A cancelled run must not be tried again on the other side.
    let (below, above) = match (below, above) {
        (Ok(below), Ok(above)) => (below, above),
        (Ok(below), Err(error)) if error.is_of_the_value() => (below, colours(value)?),
        (Err(error), Ok(above)) if error.is_of_the_value() => (colours(value)?, above),
        (Err(error), _) | (_, Err(error)) => return Err(error),
    };
    let (between, (low, high)) = ([below.0, above.0], (below.1, above.1));
    let width = between[1] - between[0];
    let scale = scale(&low)?;
    let white = Xyz::new(low.white[0], low.white[1], low.white[2]);
    let lab = |row: &ColourRow| {
        let [x, y, z] = row.xyz[0].map(|v| v * scale);
        lab::from_xyz(Xyz::new(x, y, z), white)
    };
    let rows: Vec<ColourShift> = low
        .rows
        .iter()
        .zip(&high.rows)
        .map(|(from, to)| {
            let (a, b): (Lab, Lab) = (lab(from), lab(to));
            ColourShift {
                leading: from.leading.clone(),
                thetai: from.thetai,
                thetas: from.thetas,
                phis: from.phis,
                delta_e: delta_e_2000(a, b) / width,
                lab: [b.l - a.l, b.a - a.a, b.b - a.b].map(|change| change / width),
            }
        })
        .collect();
    let largest = rows.iter().map(|row| row.delta_e).fold(0.0, f64::max);
    let found = ColourSensitivity {
        name: program.names()[at].clone(),
        value,
        between,
        mean: rows.iter().map(|row| row.delta_e).sum::<f64>() / rows.len().max(1) as f64,
        largest,
        for_one: (largest > 0.0).then(|| 1.0 / largest),
        rows,
    };
    Ok((found, low))
}

impl ToleranceError {
    /// True if another value of the variable may be possible.
    fn is_of_the_value(&self) -> bool {
        matches!(self, Self::Run { failure, .. } if !matches!(failure, Failure::Cancelled))
    }
}

/// Factor from the quantity to a scale on which a perfect diffuser has the white's Y.
fn scale(table: &ColourTable) -> Result<f64, ToleranceError> {
    match table.quantity.split(' ').next() {
        Some("brdf") => Ok(PI),
        Some("factor" | "reflectance") => Ok(1.0),
        _ => Err(ToleranceError::NoWhite),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{MemoryFiles, Options};

    /// A grey diffuser of the radiance factor `rho`, seen at 45°.
    fn program(color: &str) -> String {
        format!(
            "MODEL = Lambertian_BRDF_Model
             VARIABLES:
               incidentangle = 0   incidentpol = (1,0,0,0)   rotation = 0
               differential = 0.001   minsamples = 5   wl = 550   idle = 0
               rho = 0.3   $reflectance = Table_Reflectance   #reflectance.table = rho
               omega = 4*atan(1)*sin(0.02)^2*cos(0.7)
             END
             VARY: FOR wl FROM 360 TO 830 BY 10 END
             INTEGRALS: I = CIRCLE CENTER = (0.7,0) ALPHA = 0.02 END END
             OUTPUTS: 1 f=I/omega END
             FILES: END
             {color}"
        )
    }

    const COLOR: &str = "COLOR: wavelength = wl/1000 spectrum = f quantity = brdf illuminant = D65
        observer = CIE1931_2 space = sRGB adaptation = Bradford END";

    fn varied(source: &str, names: &[&str]) -> ProgramFunction {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let files = Arc::new(MemoryFiles::default());
        ProgramFunction::new(source, files, Options::default(), &names).unwrap()
    }

    #[test]
    fn a_grey_diffuser_moves_along_its_lightness() {
        let varied = varied(&program(COLOR), &["rho", "idle"]);
        let found = tolerance(&varied, 1e-3, &Control::default()).unwrap();
        let rho = &found.parameters[0];
        // dL*/dY = 116/3 Y^(−2/3); CIEDE2000 divides it by S_L at the mean lightness.
        let slope = 116.0 / 3.0 * 0.3_f64.powf(-2.0 / 3.0);
        let lightness = 116.0 * 0.3_f64.cbrt() - 16.0;
        let d = (lightness - 50.0).powi(2);
        let s_l = 1.0 + 0.015 * d / (20.0 + d).sqrt();
        // The circle is sampled in a few directions, so that Y is right to 2 %, L* to a third.
        assert!((rho.rows[0].lab[0] / slope - 1.0).abs() < 0.01, "{rho:?} {slope}");
        assert!((rho.largest * s_l / slope - 1.0).abs() < 0.01, "{rho:?}");
        assert_eq!(rho.for_one, Some(1.0 / rho.largest));
        let idle = &found.parameters[1];
        assert_eq!((idle.largest, idle.for_one), (0.0, None));
    }

    #[test]
    fn without_colours_there_are_no_tolerances() {
        let varied = varied(&program(""), &["rho"]);
        let none = tolerance(&varied, 1e-3, &Control::default());
        assert!(matches!(none, Err(ToleranceError::NoColour)));
        assert!(matches!(
            tolerance(&varied, 2.0, &Control::default()),
            Err(ToleranceError::Step(_))
        ));
    }
}
