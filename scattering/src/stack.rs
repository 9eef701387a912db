//! Film stacks: which films lie on an interface.

use num_complex::Complex64;

use crate::{
    optics::RefractiveIndex,
    spec::{Family, Member, ParameterError, Spec},
};

pub mod double;
pub mod graded;
pub mod list;
pub mod none;
pub mod single;

/// One film.
#[derive(Clone, Debug)]
pub struct Film {
    /// Its index of refraction.
    pub index: RefractiveIndex,
    /// Its thickness, µm.
    pub thickness: f64,
}

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

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<Stack>] =
    &[&none::SPEC, &list::SPEC, &single::SPEC, &double::SPEC, &graded::SPEC];

impl Member for Stack {
    const FAMILY: Family = Family::Stack;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}

fn check_thickness(parameter: &str, thickness: f64) -> Result<f64, ParameterError> {
    if thickness >= 0.0 && thickness.is_finite() {
        return Ok(thickness);
    }
    Err(ParameterError::new(parameter, format!("{thickness} um is not a thickness")))
}
