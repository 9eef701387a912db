//! The parameters of a model as programs set them: numbers and texts by dotted names.
//!
//! `source1.sdf.s = 0.2` walks from the model to its first source, to its slope distribution,
//! and sets a number there. Naming a class (`sdf = Gaussian_…`) makes a new object with
//! defaults. A [`ParameterPath`] resolves the dotted name once; a number is then stored with all
//! its bits. Text is read only for parameters that are texts, and under compat, where NIST's
//! program hands every number over with sixteen digits.
//!
//! The tree is persistent: a step keeps its state while later steps change theirs. Two states are
//! equal if they build equal models; the comparison is exact.

mod entries;
mod error;
mod films;
mod formula;
mod index;
mod input;
mod path;
mod persistent;
mod source;
mod spectral;
mod state;
mod table;
mod text;

pub use entries::ParameterEntry;
pub use error::SetError;
pub use input::ParameterInput;
pub use path::ParameterPath;
pub(crate) use spectral::{TableFinding, TableUses};

use input::ParameterContext;

use mist_format::number;
use persistent::Persistent;
use scattering::{Class, Mode, ParameterNode, spec::SharedNotices};
use state::ObjectState;

use crate::DataFiles;

/// The state of a model's parameters.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ModelParameters {
    root: Persistent<ObjectState>,
}

impl ModelParameters {
    /// Every parameter of `class` at its default.
    pub fn new(class: &'static Class) -> Self {
        Self { root: Persistent::new(ObjectState::new(class)) }
    }

    /// The class of the model.
    pub fn class(&self) -> &'static Class {
        self.root.class
    }

    /// All parameters in the order of their classes, each before those of the object that it holds.
    ///
    /// Setting the texts of those that are not defaults, in this order, makes equal parameters.
    pub fn entries(&self) -> Vec<ParameterEntry> {
        entries::of_object(&self.root)
    }

    /// Sets the parameter at `path`.
    ///
    /// `previous` are the parameters of the last evaluation; NIST's library remembers optical
    /// constants by them.
    ///
    /// # Errors
    ///
    /// For a name that is not known, an input that is not a value of the parameter's kind, and a
    /// file that cannot be read.
    pub fn set(
        &mut self,
        path: &ParameterPath,
        input: ParameterInput<'_>,
        library: &DataFiles,
        mode: Mode,
        previous: Option<&Self>,
    ) -> Result<(), SetError> {
        let mut context = ParameterContext { library, mode, evaluated_at: None, is_nested: false };
        let before = previous.map(|parameters| &*parameters.root);
        self.root
            .edit()
            .set(path.relative_to_model(), input, &mut context, before)
            .map_err(|error| error.named(path.as_str()))
    }

    /// Sets the number at `path`, with all its bits in a sound run.
    ///
    /// # Errors
    ///
    /// As [`ModelParameters::set`].
    pub fn set_number(
        &mut self,
        path: &ParameterPath,
        x: f64,
        library: &DataFiles,
        mode: Mode,
    ) -> Result<(), SetError> {
        self.set(path, ParameterInput::Numbers(&[x]), library, mode, None)
    }

    /// True if `path` names a parameter of an object, which forgets what it was when it is set,
    /// and not a setting of a table, of optical constants or of films.
    pub(crate) fn belongs_to_object(&self, path: &ParameterPath) -> bool {
        self.root.owns(path.relative_to_model())
    }

    /// Sets every parameter called `lambda`, of the model and of all objects in it, in µm; under
    /// compat to sixteen digits.
    pub fn set_wavelength(&mut self, lambda: f64, mode: Mode) {
        let rounded = if mode == Mode::Compat { number::reread(lambda) } else { None };
        self.root.edit().set_wavelength(rounded.unwrap_or(lambda));
    }

    /// The hash of the state, which is kept until the state changes.
    pub(crate) fn hash_code(&self) -> u64 {
        self.root.hash_code()
    }

    /// True if both share all their memory, which says that they are equal.
    pub(crate) fn is_same_as(&self, other: &Self) -> bool {
        self.root.is_same_as(&other.root)
    }

    /// The typed values from which the model is built.
    pub fn node(&self, mode: Mode, met: &SharedNotices) -> ParameterNode {
        self.root.node(mode, met)
    }

    /// Optical constants remembered for another wavelength than the present one are forgotten.
    pub(crate) fn forget_other_wavelengths(&mut self) {
        if self.root.remembers() {
            self.root.edit().forget_other_wavelengths(None);
        }
    }
}
