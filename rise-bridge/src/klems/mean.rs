//! XYZ of the mean BRDF of a patch.

use glam::DVec3;
use mist_engine::{
    material::MaterialError,
    region::PolarCell,
    request::ColourQuery,
    sampling::adaptive::{self, Accuracy, Domain, KnownPeaks},
};
use scattering::{Basis, Incidence, Model};
use spectra::{ColourPlan, Grid};

use super::basis::KlemsPatch;
use crate::export::{Bands, ExportError};

/// Accuracy of the mean of a patch.
const ACCURACY: Accuracy = Accuracy { budget: 400_000, ..Accuracy::DEFAULT };

/// Largest relative error of the mean of a patch that a file holds.
const LARGEST_ERROR: f64 = 1e-3;

/// The plan of CIE XYZ under equal energy.
pub(super) fn equal_energy(bands: &Bands) -> Result<ColourPlan, ExportError> {
    let wrong =
        |error: &dyn std::fmt::Display| ExportError::refused("wavelengths", error.to_string());
    let grid = Grid::new(bands.nm()).map_err(|error| wrong(&error))?;
    let names = ColourQuery { illuminant: Some("E".into()), ..ColourQuery::default() };
    ColourPlan::new(&grid, names.settings(None)?).map_err(|error| wrong(&error))
}

/// The mean BRDFs of patches under light from one direction.
pub(super) struct MeansUnderLight<'a> {
    bands: &'a Bands,
    plan: &'a ColourPlan,
    light: DVec3,
    incidence: Incidence,
    /// Azimuth of the mirror direction.
    mirror: f64,
    /// Per wavelength.
    peaks: Vec<KnownPeaks>,
}

impl<'a> MeansUnderLight<'a> {
    /// For light from the unit vector `light`.
    pub(super) fn new(bands: &'a Bands, plan: &'a ColourPlan, light: DVec3) -> Self {
        let mirror =
            if light.x == 0.0 && light.y == 0.0 { 0.0 } else { (-light.y).atan2(-light.x) };
        let incidence = Incidence::new(light.x.hypot(light.y).atan2(light.z), 0.0);
        let find = |model: &Model| KnownPeaks::find(model, &incidence, Basis::Psps);
        let peaks = bands.models().iter().map(find).collect();
        Self { bands, plan, light, incidence, mirror, peaks }
    }

    /// XYZ of the mean BRDF over the patch `to`, each wavelength adaptive.
    ///
    /// # Errors
    ///
    /// If a mean is not finite, or has an error above [`LARGEST_ERROR`] when the evaluations are
    /// spent.
    pub(super) fn xyz(&self, to: &KlemsPatch) -> Result<[f64; 3], ExportError> {
        let start = to.phi - 0.5 * to.width - self.mirror;
        let (theta, phi) = ((to.lower, to.upper), (start, start + to.width));
        let cell = PolarCell { theta, phi, center: None };
        let (domain, omega) = (Domain::Cell(cell), cell.projected_solid_angle());
        let mut spectrum = Vec::with_capacity(self.peaks.len());
        for (at, (model, peaks)) in self.bands.models().iter().zip(&self.peaks).enumerate() {
            let beam = (model, &self.incidence, Basis::Psps);
            let place = || format!("light from {:.3}, {} nm", self.light, self.bands.nm()[at]);
            let found = adaptive::over(beam, &domain, peaks, &ACCURACY, &|| false);
            match found.map(|found| (found.matrix[(0, 0)] / omega, found.relative_error())) {
                Ok((f, reached)) if f.is_finite() && reached <= LARGEST_ERROR => spectrum.push(f),
                Ok((f, reached)) if f.is_finite() => {
                    let problem = format!(
                        "{}: the relative error of a patch is {reached:.1e}, more than \
                         {LARGEST_ERROR:e}",
                        place()
                    );
                    return Err(ExportError::refused("material", problem));
                }
                _ => return Err(MaterialError::NotFinite(place()).into()),
            }
        }
        let xyz = self.plan.unpolarized(&spectrum);
        Ok([xyz.x, xyz.y, xyz.z].map(|x| x.max(0.0)))
    }
}
