//! The family of crossed gratings: its interface, and what its classes share.

use num_complex::Complex64;

use super::{lattice::Lattice, pattern::CrossSlice};
use crate::{
    optics::RefractiveIndex,
    spec::{self, Family, Parameter, ParameterError, ParameterNode},
};

/// The family of crossed gratings.
pub static FAMILY: Family =
    Family::new("CrossGrating", "Crossed gratings", spec::classes::<dyn CrossGrating>)
        .with_abstract(&[("Gridded_CrossGrating", "CrossGrating")]);

/// A crossed grating.
pub trait CrossGrating: Send + Sync {
    /// The grating at the vacuum wavelength `lambda` µm.
    ///
    /// # Errors
    ///
    /// If the materials at that wavelength do not fit together.
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParameterError>;
}

/// A crossed grating at one wavelength.
#[derive(Clone, Debug)]
pub struct CrossProfile {
    /// The two periods and their angle.
    pub lattice: Lattice,
    /// Index of the medium above.
    pub above: Complex64,
    /// Index of the medium below.
    pub below: Complex64,
    /// Slices, the topmost first.
    pub slices: Vec<CrossSlice>,
}

/// The media on both sides: the first group of every crossed grating.
pub const MEDIA: &[Parameter] = &[
    Parameter::index("medium_i", (1.0, 0.0), "Index of the medium above"),
    Parameter::index("medium_t", (4.05, 0.05), "Index of the medium below"),
];

/// The media on both sides of a crossed grating.
#[derive(Clone, Debug)]
pub struct CrossGratingMedia {
    /// The medium above.
    pub above: RefractiveIndex,
    /// The medium below.
    pub below: RefractiveIndex,
}

impl CrossGratingMedia {
    /// Reads the parameters of [`MEDIA`].
    pub fn read(node: &ParameterNode) -> Self {
        Self { above: node.index("medium_i").clone(), below: node.index("medium_t").clone() }
    }

    /// The profile between these media.
    pub fn profile(&self, lambda: f64, lattice: Lattice, slices: Vec<CrossSlice>) -> CrossProfile {
        let (above, below) = (self.above.at(lambda), self.below.at(lambda));
        CrossProfile { lattice, above, below, slices }
    }

    /// An error at `name` unless the medium above is that of the part that lies on top.
    pub(crate) fn starts_with(
        &self,
        lambda: f64,
        name: &str,
        part: Complex64,
    ) -> Result<(), ParameterError> {
        same(name, part, self.above.at(lambda))
    }

    /// An error at `name` unless the medium below is that of the lowest part.
    pub(crate) fn ends_with(
        &self,
        lambda: f64,
        name: &str,
        part: Complex64,
    ) -> Result<(), ParameterError> {
        same(name, part, self.below.at(lambda))
    }
}

/// An error at `name` unless two neighbours have the same medium between them.
pub(crate) fn same(name: &str, this: Complex64, other: Complex64) -> Result<(), ParameterError> {
    if this == other {
        return Ok(());
    }
    Err(ParameterError::new(name, format!("{this} differs from its neighbour, {other}")))
}
