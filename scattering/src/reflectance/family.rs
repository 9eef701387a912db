//! The family of reflectances: its interface, and what its classes share.

use crate::{
    Mode, ParameterError, ParameterNode,
    spec::{self, Family},
};

/// The family of reflectances.
pub static FAMILY: Family =
    Family::new("Reflectance", "Reflectances", spec::classes::<dyn Reflectance>);

/// A reflectance as a function of wavelength.
pub trait Reflectance: Send + Sync {
    /// R at the vacuum wavelength `lambda` µm.
    fn at(&self, lambda: f64) -> f64;
}

/// The reflectance `name` of `node` at the vacuum wavelength `lambda` µm.
///
/// # Errors
///
/// Invalid parameters of the class; in a sound build a value that is not finite.
pub fn read(node: &ParameterNode, name: &str, lambda: f64) -> Result<f64, ParameterError> {
    let reflectance = node.member::<dyn Reflectance>(name)?.at(lambda);
    if node.mode == Mode::Sound && !reflectance.is_finite() {
        let problem = format!("{reflectance} at {lambda} um is not a reflectance");
        return Err(ParameterError::new(name, problem));
    }
    Ok(reflectance)
}
