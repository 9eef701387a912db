//! The family of film stacks: its interface, and what its classes share.

use num_complex::Complex64;

use crate::{
    optics::Film,
    spec::{self, Family, ParameterError},
};

/// The family of film stacks.
pub static FAMILY: Family = Family::new("StackModel", "Film stacks", spec::classes::<Stack>);

/// Films in the order of growth: the one next to the substrate first.
#[derive(Clone, Debug, Default)]
pub struct Stack {
    /// The films.
    pub films: Vec<Film>,
}

impl Stack {
    /// (index, thickness µm) of every film at the vacuum wavelength `lambda` µm.
    pub fn at(&self, lambda: f64) -> Vec<(Complex64, f64)> {
        self.films.iter().map(|film| (film.index.at(lambda), film.thickness)).collect()
    }
}

pub(super) fn check_thickness(parameter: &str, thickness: f64) -> Result<f64, ParameterError> {
    if thickness >= 0.0 && thickness.is_finite() {
        return Ok(thickness);
    }
    Err(ParameterError::new(parameter, format!("{thickness} um is not a thickness")))
}
