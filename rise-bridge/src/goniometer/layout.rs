//! The forms of a goniometer table, and its nodes.

use crate::export::ExportError;

/// Azimuth of the light, degrees.
pub(super) const LIGHT_AZIMUTH: f64 = 180.0;

/// The form of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoniometerForm {
    /// ASAM OpenMATERIAL 3D 1.0: JSON with a BRDF lookup table.
    OpenMaterial,
    /// Comma-separated in the style of ASTM E1392, for programs that read measured BRDFs.
    Astm,
    /// Comma-separated for Ocean.
    Ocean,
}

/// The nodes of a table in degrees, rising.
#[derive(Clone, Debug, PartialEq)]
pub struct GoniometerAxes {
    /// Polar angles of incidence, below 90°.
    pub thetai: Vec<f64>,
    /// Polar angles of scattering, below 90°.
    pub thetas: Vec<f64>,
    /// Azimuths of scattering, 0 on the specular side.
    pub phis: Vec<f64>,
}

impl GoniometerAxes {
    /// The number of pairs of directions.
    pub fn directions(&self) -> usize {
        self.thetai.len() * self.thetas.len() * self.phis.len()
    }

    /// Checks that the nodes rise and lie above the horizon.
    ///
    /// # Errors
    ///
    /// If an axis is empty, does not rise or leaves its range.
    pub fn check(&self) -> Result<(), ExportError> {
        let axes = [
            ("thetai", &self.thetai, 0.0, 90.0),
            ("thetas", &self.thetas, 0.0, 90.0),
            ("phis", &self.phis, -180.0, 360.0 + 1e-9),
        ];
        for (name, nodes, low, high) in axes {
            let rising = nodes.windows(2).all(|pair| pair[0] < pair[1]);
            if nodes.is_empty() || !rising || nodes.iter().any(|x| !(low..high).contains(x)) {
                let problem =
                    format!("expected rising angles from {low} to below {high:.0} degrees");
                return Err(ExportError::refused(name, problem));
            }
        }
        Ok(())
    }

    /// All pairs of directions: θ_i, θ_s, φ_s in degrees, the last fastest.
    pub(super) fn rows(&self) -> impl Iterator<Item = [f64; 3]> {
        let outer = self.thetai.iter().flat_map(|i| self.thetas.iter().map(move |s| (*i, *s)));
        outer.flat_map(|(i, s)| self.phis.iter().map(move |phi| [i, s, *phi]))
    }
}
