//! One spectral goniometer table in the forms that optics programs read, and back.
//!
//! Every row is a pair of directions with the BRDF (1/sr, no cosine) for unpolarized light. Azimuths
//! are those of vectors away from the surface: the light stands at 180°, so 0° is the side of the
//! specular reflection.
//!
//! | form | angles | rows | columns |
//! | --- | --- | --- | --- |
//! | [`Form::OpenMaterial`] | radians | λ slowest, φ fastest | λ in m, θ_i, θ_o, φ_o, f |
//! | [`Form::Astm`] | radians | θ_i slowest, φ fastest | θ_i, φ_i, θ_s, φ_s, one per wavelength |
//! | [`Form::Ocean`] | degrees | the same | the same |

mod read;
mod spread;
mod write;

pub use read::{Goniometer, Row, read};
pub use spread::{choose_axes, spread};
pub use write::write;

use crate::export::ExportError;

/// How the table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// ASAM OpenMATERIAL 3D 1.0: JSON with a BRDF lookup table.
    OpenMaterial,
    /// Comma-separated in the style of ASTM E1392, as programs for measured BRDFs read it.
    Astm,
    /// Comma-separated for Ocean.
    Ocean,
}

/// The nodes, degrees, rising.
#[derive(Clone, Debug, PartialEq)]
pub struct Axes {
    /// Polar angles of incidence, below 90°.
    pub thetai: Vec<f64>,
    /// Polar angles of scattering, below 90°.
    pub thetas: Vec<f64>,
    /// Azimuths of scattering, 0 on the specular side.
    pub phis: Vec<f64>,
}

/// Azimuth of the light, degrees.
const LIGHT: f64 = 180.0;

impl Axes {
    /// How many pairs of directions there are.
    pub fn directions(&self) -> usize {
        self.thetai.len() * self.thetas.len() * self.phis.len()
    }

    /// Whether the nodes rise and lie above the horizon.
    ///
    /// # Errors
    ///
    /// If they do not.
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
    fn rows(&self) -> impl Iterator<Item = [f64; 3]> {
        let outer = self.thetai.iter().flat_map(|i| self.thetas.iter().map(move |s| (*i, *s)));
        outer.flat_map(|(i, s)| self.phis.iter().map(move |phi| [i, s, *phi]))
    }
}
