//! The angles of the rows of a colour table: those of the variables that COLOR names, or of the step.

use crate::{Warning, plan::PlacedExpression, region::Region, step::Step};

/// Relative difference of angles that are the same but for rounding.
const ROUNDING: f64 = 1e-6;

/// The angles of `step` in degrees: incidence, then the centre of the aperture of the spectrum,
/// which is the integral number `integral`.
pub(super) fn of_step(step: &Step, integral: Option<usize>) -> [Option<f64>; 4] {
    let region = integral.and_then(|number| step.integrals.get(number)).map(|i| &i.region);
    let center = match region {
        Some(Region::Differential { center } | Region::Circle { center, .. }) => Some(*center),
        Some(Region::Annulus { outer_center, .. }) => Some(*outer_center),
        Some(Region::Polygon { .. } | Region::Hemi) | None => None,
    };
    let thetas = center.map(|center| degrees(center.0));
    let phis = center.map(|center| degrees(center.1));
    [Some(degrees(step.theta_i)), thetas, phis, None]
}

/// Degrees without the last bits of the conversion.
fn degrees(radians: f64) -> f64 {
    (radians.to_degrees() * 1e10).round() / 1e10
}

/// Differences between the angles of a table and those of the steps, one for each column.
#[derive(Clone, Debug, Default)]
pub(super) struct TableAngles([Option<(f64, f64, bool)>; 4]);

const COLUMNS: [(&str, &str); 4] = [
    ("thetai", "incidentangle"),
    ("thetas", "the polar angle of the aperture's centre"),
    ("phis", "the azimuth of the aperture's centre"),
    ("omega", ""),
];

impl TableAngles {
    /// Compares the angle of a row with that of its step, degrees.
    ///
    /// An expression in COLOR may differ, but not be the same number in radians.
    pub(super) fn compare(
        &mut self,
        column: usize,
        placed: Option<&PlacedExpression>,
        row: f64,
        step: Option<f64>,
    ) {
        let (Some(placed), Some(step)) = (placed, step) else { return };
        let near = |a: f64, b: f64| (a - b).abs() <= ROUNDING * a.abs().max(b.abs()).max(1e-3);
        let differ = !near(row, step)
            && (column != 2 || !near(row.rem_euclid(360.0), step.rem_euclid(360.0)));
        let is_radians = differ && step != 0.0 && near(row, step.to_radians());
        let is_implied = placed.text.is_none();
        if self.0[column].is_none() && (is_radians || (differ && is_implied)) {
            self.0[column] = Some((row, step, is_radians));
        }
    }

    /// One warning for each column.
    pub(super) fn warnings(&self) -> Vec<Warning> {
        let all = self.0.iter().zip(COLUMNS);
        all.filter_map(|(found, (name, of_step))| {
            let (row, step, is_radians) = (*found)?;
            let help = format!("write `{name} = …` in COLOR with the angle in degrees");
            let message = if is_radians {
                format!("{name} of the table is in degrees, and {row} is {step} degrees in radians")
            } else {
                format!(
                    "{name} of the table is the variable {name} ({row}), and {of_step} is {step} \
                     degrees"
                )
            };
            Some(Warning::new("color/angle", message).help(help))
        })
        .collect()
    }
}
