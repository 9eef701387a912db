//! The size of a table and the channels of its images.

use crate::export::ExportError;

/// Numbers of viewers and pixels of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BsdfSize {
    /// Azimuths of the viewer; 1 for isotropic materials.
    pub phi_i: usize,
    /// Polar angles of the viewer.
    pub theta_i: usize,
    /// Pixels per side of an image.
    pub side: usize,
}

impl BsdfSize {
    /// Parses `24x64` (θ_i, side) or `37x20x48` (φ_i, θ_i, side).
    ///
    /// # Errors
    ///
    /// If the text has another form, or an axis is too short or too long.
    pub fn parse(text: &str) -> Result<Self, ExportError> {
        let refused = || {
            let problem = format!(
                "{text:?}: expected theta_i x side of the image, such as 24x64, or \
                 phi_i x theta_i x side, such as 37x20x48; at least 2 theta_i and 4 pixels"
            );
            ExportError::refused("grid", problem)
        };
        let numbers: Result<Vec<usize>, _> = text.split('x').map(str::parse).collect();
        let size = match numbers.as_deref() {
            Ok(&[theta_i, side]) => Self { phi_i: 1, theta_i, side },
            Ok(&[phi_i, theta_i, side]) => Self { phi_i, theta_i, side },
            _ => return Err(refused()),
        };
        let phi_good = size.phi_i == 1 || (4..=1024).contains(&size.phi_i);
        let good =
            phi_good && (2..=1024).contains(&size.theta_i) && (4..=4096).contains(&size.side);
        good.then_some(size).ok_or_else(refused)
    }
}

/// The channels of the images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BsdfChannels {
    /// One image per wavelength.
    Spectra,
    /// Three images: linear sRGB under D65, for the observer of 1931; not below 0.
    Rgb,
}
