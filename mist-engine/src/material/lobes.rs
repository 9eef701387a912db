//! A material asked by the directions of a renderer: many pairs of vectors at once.
//!
//! Colours are linear in the spectrum, so the plan of a colour becomes one weight per wavelength,
//! Stokes component and channel, and no spectrum is stored:
//!
//! $$ \mathrm{RGB}_c = \sum_{\lambda,k} w_{ck}(\lambda)\,[\mathbf{M}(\lambda)\,\mathbf{S}]_k $$

use glam::DVec3;
use scattering::{Basis, DirectionPairs, Model, Mueller, Side, Stokes};
use spectra::{ColourPlan, ColourSettings, Grid};

use super::{MaterialError, PreparedMaterial, table::scale};

/// Pairs that are evaluated at a time: their matrices stay in the cache.
const BATCH: usize = 256;

/// Output for every pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LobeOutput {
    /// Linear RGB of the exit light.
    Rgb,
    /// The intensity of the exit light at every wavelength.
    Spectral,
    /// The Mueller matrix at every wavelength, row by row.
    Mueller,
}

impl LobeOutput {
    /// `rgb`, `spectral` or `mueller`.
    ///
    /// # Errors
    ///
    /// For other names.
    pub fn parse(text: &str) -> Result<Self, MaterialError> {
        match text {
            "rgb" => Ok(Self::Rgb),
            "spectral" => Ok(Self::Spectral),
            "mueller" => Ok(Self::Mueller),
            _ => {
                let problem = format!("{text:?} is none of rgb, spectral, mueller");
                Err(MaterialError::request("out", problem))
            }
        }
    }
}

/// Takes a Mueller matrix to the axes of a renderer: the matrix, the unit vectors to the source
/// and to the viewer.
pub type BasisChange = fn(Mueller, DVec3, DVec3) -> Mueller;

/// Settings for the evaluation of pairs.
#[derive(Clone, Debug)]
pub struct LobeRequest {
    /// Wavelengths, nm, rising.
    pub wavelengths: Vec<f64>,
    /// Settings for colours of spectra.
    pub settings: ColourSettings,
    /// Incident Stokes vector, in the basis.
    pub incident: [f64; 4],
    /// The basis of the matrices.
    pub basis: Basis,
    /// Transformation of the matrices after that.
    pub turn: Option<BasisChange>,
}

/// A material at the wavelengths of a view.
pub struct Lobes {
    models: Vec<Model>,
    /// Per wavelength and Stokes component what it gives to R, G and B; none for one wavelength.
    weights: Vec<[[f64; 3]; 4]>,
    /// Factor of intensities.
    scale: f64,
    light: Stokes,
    basis: Basis,
    turn: Option<BasisChange>,
}

impl Lobes {
    /// Builds the models of `material` at every wavelength.
    ///
    /// # Errors
    ///
    /// For wavelengths that are none, settings that do not fit, and values that the model cannot
    /// take.
    pub fn new(material: &PreparedMaterial, view: &LobeRequest) -> Result<Self, MaterialError> {
        let weights = match view.wavelengths.len() {
            1 => Vec::new(),
            _ => weights(&view.wavelengths, &view.settings)?,
        };
        Ok(Self {
            models: material.models(&view.wavelengths)?,
            weights,
            scale: scale(view.settings.quantity),
            light: Stokes(view.incident),
            basis: view.basis,
            turn: view.turn,
        })
    }

    /// Number of wavelengths.
    pub fn wavelengths(&self) -> usize {
        self.models.len()
    }

    /// Refuses what cannot be had.
    ///
    /// # Errors
    ///
    /// For colours of one wavelength.
    pub fn check(&self, out: LobeOutput) -> Result<(), MaterialError> {
        if out == LobeOutput::Rgb && self.weights.is_empty() {
            return Err(MaterialError::request("lambda", "a colour needs two wavelengths or more"));
        }
        Ok(())
    }

    /// Count of numbers per pair in the response.
    pub fn width(&self, out: LobeOutput) -> usize {
        match out {
            LobeOutput::Rgb => 3,
            LobeOutput::Spectral => self.models.len(),
            LobeOutput::Mueller => 16 * self.models.len(),
        }
    }

    /// The answers for `pairs` of vectors to the source and to the viewer, one after the other:
    /// 1/sr, without the cosine; zero below the horizon and for vectors without a direction.
    pub fn evaluate(&self, pairs: &[(DVec3, DVec3)], out: LobeOutput) -> Vec<f32> {
        let width = self.width(out);
        let mut answers = vec![0.0; pairs.len() * width];
        for (pairs, answers) in pairs.chunks(BATCH).zip(answers.chunks_mut(BATCH * width)) {
            self.batch(pairs, out, answers);
        }
        answers
    }

    fn batch(&self, pairs: &[(DVec3, DVec3)], out: LobeOutput, answers: &mut [f32]) {
        // The side does not depend on the wavelength.
        let side = self.models.first().map_or(Side::DownUp, |model| model.common().side);
        let seen = DirectionPairs::new(side, pairs);
        let mut matrices = vec![Mueller::ZERO; seen.places().len()];
        let mut colours = vec![[0.0; 3]; matrices.len()];
        let width = self.width(out);
        for (at, model) in self.models.iter().enumerate() {
            matrices.fill(Mueller::ZERO);
            model.evaluate_pairs(&seen, self.basis, &mut matrices);
            if let Some(turn) = self.turn {
                for (m, place) in matrices.iter_mut().zip(seen.places()) {
                    if *m != Mueller::ZERO {
                        *m = turn(*m, pairs[*place].0, pairs[*place].1);
                    }
                }
            }
            if out == LobeOutput::Rgb {
                self.add(&mut colours, &matrices, at);
                continue;
            }
            for (m, place) in matrices.iter().zip(seen.places()) {
                let numbers = &mut answers[place * width..(place + 1) * width];
                if out == LobeOutput::Spectral {
                    numbers[at] = (self.scale * self.component(m, 0)) as f32;
                } else {
                    let row = m.to_row_major().map(|x| x as f32);
                    numbers[16 * at..16 * (at + 1)].copy_from_slice(&row);
                }
            }
        }
        if out == LobeOutput::Rgb {
            for (colour, place) in colours.iter().zip(seen.places()) {
                answers[3 * place..3 * (place + 1)].copy_from_slice(&colour.map(|x| x as f32));
            }
        }
    }

    /// A Stokes component of the exit light.
    fn component(&self, m: &Mueller, row: usize) -> f64 {
        m.0[row].iter().zip(&self.light.0).map(|(m, light)| m * light).sum()
    }

    /// Adds what the wavelength number `at` gives.
    fn add(&self, colours: &mut [[f64; 3]], matrices: &[Mueller], at: usize) {
        for (row, weight) in self.weights[at].iter().enumerate() {
            // Without a filter only the intensity has a colour.
            if *weight == [0.0; 3] {
                continue;
            }
            for (colour, m) in colours.iter_mut().zip(matrices) {
                let light = self.scale * self.component(m, row);
                for (sum, w) in colour.iter_mut().zip(weight) {
                    *sum += light * w;
                }
            }
        }
    }
}

/// The colours of unit spectra.
fn weights(
    wavelengths: &[f64],
    settings: &ColourSettings,
) -> Result<Vec<[[f64; 3]; 4]>, MaterialError> {
    let grid = Grid::new(wavelengths).map_err(|error| MaterialError::request("lambda", error))?;
    let plan = ColourPlan::new(&grid, settings.clone())
        .map_err(|error| MaterialError::request("adaptation", error))?;
    let count = grid.len();
    let unit = |at: usize| (0..count).map(|k| f64::from(u8::from(k == at))).collect();
    let one = |at: usize| {
        let spectrum: Vec<f64> = unit(at);
        [0, 1, 2, 3].map(|component| {
            let mut components: [&[f64]; 4] = [&[]; 4];
            components[component] = &spectrum;
            plan.rgb(plan.stokes(components)[0])
        })
    };
    Ok((0..count).map(one).collect())
}

#[cfg(test)]
mod tests {
    use scattering::Mode;
    use spectra::{Adaptation, Extrapolation, Filter, Illuminant, Observer, Quantity, RgbSpace};

    use super::*;
    use crate::{
        Control,
        material::{Material, table::table},
        request::{Patch, PatchRow, TableDirections, TableRequest},
    };

    fn settings(filters: Vec<Filter>) -> ColourSettings {
        ColourSettings {
            quantity: Quantity::Brdf,
            illuminant: Illuminant::parse("A").unwrap(),
            observer: Observer::parse("CIE1931_2").unwrap(),
            space: RgbSpace::parse("sRGB").unwrap(),
            adaptation: Adaptation::parse("Bradford").unwrap(),
            filters,
            outside: Extrapolation::Hold,
        }
    }

    fn glass() -> PreparedMaterial {
        let json = r#"{"model":"Facet_BRDF_Model",
            "parameters":{"substrate":"(1.5,0)","sdf.s":0.3}}"#;
        Material::from_json(json).unwrap().prepare(Mode::Sound, None).unwrap()
    }

    fn vector(theta: f64, phi: f64) -> DVec3 {
        let (theta, phi) = (theta.to_radians(), phi.to_radians());
        DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
    }

    #[test]
    fn pairs_have_the_colours_of_the_points_of_a_table() {
        let wavelengths: Vec<f64> = (0..8).map(|k| 400.0 + 40.0 * f64::from(k)).collect();
        for filters in [vec![], vec![Filter::parse("linear(0.4)").unwrap()]] {
            let settings = settings(filters);
            let place = |thetas, phis| PatchRow { thetai: 50.0, thetas, phis, patch: Patch::Point };
            let request = TableRequest {
                material: "glass".into(),
                directions: TableDirections::List(vec![place(50.0, 0.0), place(30.0, 75.0)]),
                wavelengths: wavelengths.clone(),
                settings: settings.clone(),
                incident: [1.0, 0.3, 0.1, 0.0],
                stokes: true,
                basis: Basis::Psps,
                sampling: None,
                limits: crate::Limits::default(),
            };
            let table = table(&glass(), &request, &Control::default()).unwrap();
            let (incident, basis) = (request.incident, Basis::Psps);
            let view = LobeRequest {
                wavelengths: wavelengths.clone(),
                settings,
                incident,
                basis,
                turn: None,
            };
            let lobes = Lobes::new(&glass(), &view).unwrap();
            // Light comes from -x.
            let source = vector(50.0, 180.0);
            let pairs = [(source, vector(50.0, 0.0)), (source, vector(30.0, 75.0))];
            let colours = lobes.evaluate(&pairs, LobeOutput::Rgb);
            for (row, colour) in table.rows.iter().zip(colours.chunks(3)) {
                for (expected, found) in row.rgb[0].iter().zip(colour) {
                    // The answer is rounded to f32.
                    let close = (expected - f64::from(*found)).abs() < 2e-7 * row.rgb[0][0].abs();
                    assert!(close, "{expected} {found}");
                }
            }
            let spectra = lobes.evaluate(&pairs, LobeOutput::Spectral);
            assert_eq!(spectra.len(), 2 * lobes.width(LobeOutput::Spectral));
            assert!((f64::from(spectra[3]) - table.rows[0].spectra[0][3]).abs() < 1e-6);
        }
    }

    #[test]
    fn vectors_below_the_horizon_and_vectors_that_are_none_are_black() {
        let view = LobeRequest {
            wavelengths: vec![550.0],
            settings: settings(vec![]),
            incident: [1.0, 0.0, 0.0, 0.0],
            basis: Basis::Plane,
            turn: None,
        };
        let lobes = Lobes::new(&glass(), &view).unwrap();
        let up = DVec3::Z;
        let pairs = [(-up, up), (up, -up), (DVec3::ZERO, up), (up, DVec3::splat(f64::NAN))];
        assert!(lobes.evaluate(&pairs, LobeOutput::Mueller).iter().all(|x| *x == 0.0));
    }
}
