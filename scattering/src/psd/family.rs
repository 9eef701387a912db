//! The family of power spectral densities: its interface, and what its classes share.

use crate::spec::{self, Family, ParameterError, ParameterNode};

/// The family of power spectral densities.
pub static FAMILY: Family =
    Family::new("PSD_Function", "Power spectral densities", spec::classes::<dyn Psd>);

/// A two-dimensional power spectral density of surface height.
pub trait Psd: Send + Sync {
    /// PSD(f_x, f_y) in µm⁴, spatial frequencies in 1/µm in the frame of the sample.
    fn density(&self, fx: f64, fy: f64) -> f64;
}

/// The number `name`, which must not make the density negative.
pub(super) fn strength(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let value = node.number(name);
    if value >= 0.0 {
        return Ok(value);
    }
    Err(ParameterError::new(name, format!("{value} would make the spectral density negative")))
}

/// sin x / x.
pub(super) fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.sin() / x }
}
