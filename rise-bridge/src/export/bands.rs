//! The models of a material at every wavelength of a table.

use glam::DVec3;
use mist_engine::material::PreparedMaterial;
use scattering::{Basis, Geometry, Model, Mueller, Side, vectors::geometry};

use super::error::ExportError;

/// Relative differences below this are rounding. Rotation changes the matrix of a structured sample
/// by per cents.
const ROUNDING: f64 = 1e-7;

/// One model per wavelength, all of type 0 (reflection from outside).
pub struct Bands {
    nm: Vec<f64>,
    models: Vec<Model>,
}

impl Bands {
    /// The models of `material` at the wavelengths `nm` (nm).
    ///
    /// # Errors
    ///
    /// If there are no wavelengths or they do not rise, if a model transmits, or if its parameters
    /// are invalid.
    pub fn new(material: &PreparedMaterial, nm: &[f64]) -> Result<Self, ExportError> {
        let good = nm.iter().all(|x| x.is_finite() && *x > 0.0);
        if nm.is_empty() || !good || nm.windows(2).any(|pair| pair[0] >= pair[1]) {
            let problem = "expected rising wavelengths in nm, such as 450,500,550,600,650";
            return Err(ExportError::refused("wavelengths", problem));
        }
        let bands = Self { nm: nm.to_vec(), models: material.models(nm)? };
        let side = bands.models[0].common().side;
        if side != Side::DownUp {
            let problem = format!(
                "{} is not reflection: renderers read tables of reflection from outside (type 0) \
                 only",
                side.number()
            );
            return Err(ExportError::refused("type", problem));
        }
        Ok(bands)
    }

    /// The same bands, for a `format` without rotation of the sample.
    ///
    /// # Errors
    ///
    /// If rotation of the sample changes the matrix.
    pub fn isotropic(self, format: &str) -> Result<Self, ExportError> {
        if self.is_isotropic() {
            return Ok(self);
        }
        let problem = format!(
            "the matrices change when the sample is rotated, and {format} holds isotropic \
             materials only"
        );
        Err(ExportError::refused("material", problem))
    }

    /// True if rotation of the sample does not change the matrix in three test directions.
    pub fn is_isotropic(&self) -> bool {
        let directions = [(0.3, 0.5, 0.4), (0.9, 0.6, -1.9), (0.7, 0.75, 0.1)];
        directions.iter().all(|&(theta_i, theta_s, phi_s)| {
            let at = |rotation: f64| {
                let at = Geometry { theta_i, theta_s, phi_s, rotation };
                self.models[0].mueller(&at, Basis::Psps)
            };
            let reference = at(0.0);
            let size = reference.largest();
            [0.9, 2.1]
                .iter()
                .all(|rotation| (at(*rotation) - reference).largest() <= ROUNDING * size)
        })
    }

    /// The wavelengths, nm.
    pub fn nm(&self) -> &[f64] {
        &self.nm
    }

    /// The models, one per wavelength.
    pub fn models(&self) -> &[Model] {
        &self.models
    }

    /// The matrices (1/sr) at all wavelengths for light from `to_light`, seen from `to_viewer`:
    /// unit vectors away from the surface in its local frame, both above it.
    pub fn matrices(
        &self,
        to_light: DVec3,
        to_viewer: DVec3,
        basis: Basis,
    ) -> impl Iterator<Item = Mueller> + use<'_> {
        let at = geometry(Side::DownUp, to_light, to_viewer);
        self.models.iter().map(move |model| {
            let mut out = [Mueller::ZERO];
            if let Some((incidence, direction)) = at {
                model.evaluate(&incidence, &[direction], basis, &mut out);
            }
            out[0]
        })
    }

    /// The BRDF for unpolarized light, M00 (1/sr), at all wavelengths.
    pub fn unpolarized(
        &self,
        to_light: DVec3,
        to_viewer: DVec3,
    ) -> impl Iterator<Item = f64> + use<'_> {
        self.matrices(to_light, to_viewer, Basis::Psps).map(|m| m[(0, 0)])
    }
}

#[cfg(test)]
mod tests {
    use mist_engine::material::Material;
    use scattering::Mode;

    use super::*;

    fn bands(json: &str, nm: &[f64]) -> Result<Bands, ExportError> {
        Bands::new(&Material::from_json(json).unwrap().prepare(Mode::Sound, None).unwrap(), nm)
    }

    #[test]
    fn facets_are_isotropic_and_ridges_are_not() {
        let facets = bands(r#"{"model": "Facet_BRDF_Model"}"#, &[550.0]).unwrap();
        assert!(facets.isotropic("a table").is_ok());
        let ridges = r#"{"model": "Facet_BRDF_Model", "parameters": {
            "sdf": "Anisotropic_Gaussian_Slope_Distribution_Function",
            "sdf.sigmax": 0.1, "sdf.sigmay": 0.4}}"#;
        let problem = bands(ridges, &[550.0]).unwrap().isotropic("a table").err().unwrap();
        assert!(problem.to_string().contains("rotated"), "{problem}");
    }

    #[test]
    fn transmission_and_falling_wavelengths_are_refused() {
        let glass = r#"{"model": "Facet_BRDF_Model",
            "parameters": {"substrate": "(1.5,0)", "type": 1}}"#;
        assert!(bands(glass, &[550.0]).err().unwrap().to_string().starts_with("type: 1"));
        let metal = r#"{"model": "Facet_BRDF_Model"}"#;
        assert!(bands(metal, &[550.0, 450.0]).is_err());
        assert!(bands(metal, &[]).is_err());
        assert!(bands(metal, &[f64::NAN]).is_err());
    }
}
