//! Gathers the steps of a run into spectra and turns them into the rows of a colour table.

use std::collections::HashMap;

use mist_format::Diagnostic;
use spectra::{ColourPlan, Extrapolation, Grid, Interpolation, Xyz, wavelength::nm_from_um};

use super::{
    ColourRow, ColourSection, ColourTable, RowOrder, RowPatch,
    angles::{TableAngles, of_step},
};
use crate::{
    fault::Fault,
    output::Outputs,
    plan::{LoopRole, PlacedExpression},
    request::invisible_warning,
    step::Step,
};

/// A channel this far below zero still counts as inside the gamut: rounding.
const GAMUT_SLACK: f64 = 1e-9;

/// One row while its spectrum grows.
struct Gathered {
    leading: Vec<f64>,
    /// thetai, thetas, phis in degrees, omega in sr.
    direction: [f64; 4],
    /// (nm, I, Q, U, V).
    samples: Vec<(f64, [f64; 4])>,
}

/// The spectra of a run.
pub(crate) struct Fold<'a> {
    section: &'a ColourSection,
    /// The incident light of the table: I, Q, U, V.
    incident: [f64; 4],
    rows: Vec<Gathered>,
    /// The row of each combination of loops that are not folded.
    places: HashMap<Vec<u64>, usize>,
    angles: TableAngles,
}

impl<'a> Fold<'a> {
    pub(crate) fn new(section: &'a ColourSection, incident: [f64; 4]) -> Self {
        let (rows, places, angles) = (Vec::new(), HashMap::new(), TableAngles::default());
        Self { section, incident, rows, places, angles }
    }

    /// Adds a step whose outputs were just computed.
    pub(crate) fn add(&mut self, step: &Step, outputs: &mut Outputs<'_>) -> Result<(), Fault> {
        let place: Vec<u64> = self
            .section
            .roles
            .iter()
            .zip(&step.counts)
            .filter(|(role, _)| **role != LoopRole::Folded)
            .map(|(_, count)| *count)
            .collect();
        let nm = nm_from_um(self.number(&self.section.wavelength, outputs)?);
        let mut stokes = [0.0; 4];
        for (value, slot) in stokes.iter_mut().zip(&self.section.spectrum) {
            *value = outputs.scope.get(*slot).map_or(f64::NAN, mist_format::expr::Value::number);
        }
        let at = match self.places.get(&place) {
            Some(at) => *at,
            None => {
                let row = self.begin(step, outputs)?;
                self.rows.push(row);
                self.places.insert(place, self.rows.len() - 1);
                self.rows.len() - 1
            }
        };
        self.rows[at].samples.push((nm, stokes));
        Ok(())
    }

    fn begin(&mut self, step: &Step, outputs: &mut Outputs<'_>) -> Result<Gathered, Fault> {
        let of_step = of_step(step, self.section.integral);
        let mut direction = [0.0; 4];
        for (at, placed) in self.section.angles.iter().enumerate() {
            direction[at] = match placed {
                Some(placed) => self.number(placed, outputs)?,
                None => of_step[at].unwrap_or(0.0),
            };
            self.angles.compare(at, placed.as_ref(), direction[at], of_step[at]);
        }
        let mut leading = Vec::new();
        for role in &self.section.roles {
            if let LoopRole::Leading(columns) = role {
                leading.extend(columns.iter().map(|(_, slot)| {
                    outputs.scope.get(*slot).map_or(f64::NAN, mist_format::expr::Value::number)
                }));
            }
        }
        Ok(Gathered { leading, direction, samples: Vec::new() })
    }

    fn number(&self, placed: &PlacedExpression, outputs: &mut Outputs<'_>) -> Result<f64, Fault> {
        let place = placed.text.as_ref().unwrap_or(&self.section.place);
        outputs.number_at(&placed.expr, place)
    }

    /// The finished table.
    pub(crate) fn table(self) -> Result<ColourTable, Fault> {
        let section = self.section;
        let wrong = |message: String| {
            Box::new(Diagnostic::error("color/spectrum", section.place.span(), message))
        };
        let wavelengths: Vec<f64> =
            self.rows.first().map(|row| sorted(&row.samples)).unwrap_or_default();
        let grid = Grid::new(&wavelengths).map_err(|error| wrong(error.to_string()))?;
        let plan = ColourPlan::new(&grid, section.settings.clone())
            .map_err(|error| wrong(error.to_string()))?;
        let mut rows = Vec::with_capacity(self.rows.len());
        for (number, row) in self.rows.into_iter().enumerate() {
            if sorted(&row.samples) != wavelengths {
                let number = number + 1;
                return Err(wrong(format!(
                    "row {number} has other wavelengths than the first row"
                )));
            }
            rows.push(colour(row, section.spectrum.len(), &plan));
        }
        let all_v_zero = rows.iter().all(|row| row.spectra[3].iter().all(|v| *v == 0.0));
        let stokes = match section.spectrum.len() {
            4 if all_v_zero => 3,
            other => other,
        };
        let settings = &section.settings;
        let leading = section.roles.iter().flat_map(|role| match role {
            LoopRole::Leading(columns) => columns.iter().map(|(name, _)| name.clone()).collect(),
            LoopRole::Folded | LoopRole::Direction => Vec::new(),
        });
        let mut warnings = self.angles.warnings();
        warnings.extend(invisible_warning(&wavelengths));
        Ok(ColourTable {
            material: section.material.clone(),
            quantity: format!("{} {}", settings.quantity.name(), settings.quantity.unit()),
            incident: self.incident,
            frame: section.frame.clone(),
            interpolation: interpolation(&grid, settings.outside),
            wavelengths,
            illuminant: settings.illuminant.name().to_owned(),
            observer: settings.observer.name().to_owned(),
            space: settings.space.name().to_owned(),
            adaptation: settings.adaptation.name().to_owned(),
            white: plan.white().map_or([0.0, 0.0, 0.0], |white| [white.x, white.y, white.z]),
            layout: RowOrder::List,
            patch: patch(&section.patch),
            leading: leading.collect(),
            stokes,
            rows,
            albedo: Vec::new(),
            warnings,
        })
    }
}

/// Interpolation of spectra on `grid` to 1 nm, as in the header of the table.
pub(crate) fn interpolation(grid: &Grid, outside: Extrapolation) -> String {
    let how = match Interpolation::for_grid(grid) {
        // The word of the format.
        Interpolation::Cubic => "spline",
        other => other.name(),
    };
    let ends = match outside {
        Extrapolation::Hold => "hold",
        Extrapolation::Zero => "zero",
    };
    format!("{how} {ends}")
}

fn patch(text: &str) -> RowPatch {
    match text.split_whitespace().collect::<Vec<_>>()[..] {
        ["point"] => RowPatch::Point,
        ["cell"] => RowPatch::Cell,
        ["ring"] => RowPatch::Ring,
        ["circle", alpha] if alpha.parse::<f64>().is_ok() => {
            RowPatch::Circle(alpha.parse().unwrap_or_default())
        }
        _ => RowPatch::Other(text.to_owned()),
    }
}

fn sorted(samples: &[(f64, [f64; 4])]) -> Vec<f64> {
    let mut nm: Vec<f64> = samples.iter().map(|sample| sample.0).collect();
    nm.sort_by(f64::total_cmp);
    nm
}

fn colour(row: Gathered, components: usize, plan: &ColourPlan) -> ColourRow {
    let mut samples = row.samples;
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut spectra: [Vec<f64>; 4] = Default::default();
    for (component, spectrum) in spectra.iter_mut().enumerate().take(components) {
        *spectrum = samples.iter().map(|(_, stokes)| stokes[component]).collect();
    }
    let [thetai, thetas, phis, omega] = row.direction;
    coloured(plan, row.leading, [thetai, thetas, phis, omega], spectra, 0)
}

/// A row with the colours of `spectra`.
pub(crate) fn coloured(
    plan: &ColourPlan,
    leading: Vec<f64>,
    [thetai, thetas, phis, omega]: [f64; 4],
    spectra: [Vec<f64>; 4],
    flags: u8,
) -> ColourRow {
    let xyz: [Xyz; 4] = plan.stokes(spectra.each_ref().map(Vec::as_slice));
    let rgb = xyz.map(|xyz| plan.rgb(xyz));
    let below = rgb[0].iter().any(|channel| *channel < -GAMUT_SLACK);
    let outside = if below { ColourRow::OUT_OF_GAMUT } else { 0 };
    ColourRow {
        leading,
        thetai,
        thetas,
        phis,
        omega,
        rgb,
        xyz: xyz.map(|xyz| [xyz.x, xyz.y, xyz.z]),
        spectra,
        flags: flags | outside,
    }
}
