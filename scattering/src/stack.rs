//! Film stacks: which films lie on an interface.

use num_complex::Complex64;

use crate::{
    optics::Index,
    spec::{Family, Member, Spec},
};

/// One film.
#[derive(Clone, Debug)]
pub struct Film {
    /// Its index of refraction.
    pub index: Index,
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
pub const ALL: &[&Spec<Stack>] = &[];

impl Member for Stack {
    const FAMILY: Family = Family::Stack;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}
