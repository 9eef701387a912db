//! The parameters of a model as programs set them: texts by dotted names.
//!
//! `source1.sdf.s = 0.2` walks from the model to its first source, to its slope distribution,
//! and sets a number there. Naming a class (`sdf = Gaussian_…`) makes a new object with
//! defaults. The whole is persistent: a step keeps its state while later steps change theirs.

mod error;
mod films;
mod fingerprint;
mod formula;
mod index;
mod object;
mod persistent;
mod source;
mod state;
mod table;

pub use error::SetError;
pub(crate) use fingerprint::Digest;
pub use fingerprint::Fingerprint;

use object::ObjectState;
use persistent::Persistent;
use scattering::{Class, Mode, ParameterNode, spec::SharedNotices};

use crate::DataFiles;

/// Whether the dotted name `lower` is that of something inside of what `upper` names.
pub(crate) fn is_below(lower: &str, upper: &str) -> bool {
    lower.strip_prefix(upper).is_some_and(|rest| rest.starts_with('.'))
}

/// The state of a model's parameters.
#[derive(Clone, Debug)]
pub struct ModelParameters {
    root: Persistent<ObjectState>,
}

/// What setting a parameter needs besides its name and text.
pub(crate) struct ParameterContext<'a> {
    pub(crate) library: &'a DataFiles,
    pub(crate) mode: Mode,
    /// The wavelength for which the objects around were evaluated last, if any.
    pub(crate) evaluated_at: Option<f64>,
    /// Whether the parameter belongs to an object inside of the model.
    pub(crate) is_nested: bool,
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

    /// Sets the parameter with the dotted name `path` to what `text` says.
    ///
    /// `previous` are the parameters of the last evaluation; NIST's library remembers optical
    /// constants by them.
    ///
    /// # Errors
    ///
    /// For a name that is not known, a text that is not a value of the parameter's kind, and a
    /// file that cannot be read.
    pub fn set(
        &mut self,
        path: &str,
        text: &str,
        library: &DataFiles,
        mode: Mode,
        previous: Option<&Self>,
    ) -> Result<(), SetError> {
        let mut context = ParameterContext { library, mode, evaluated_at: None, is_nested: false };
        let before = previous.map(|parameters| &*parameters.root);
        self.root.edit().set(path, text, &mut context, before).map_err(|error| error.named(path))
    }

    /// Whether `path` names a parameter of an object, which forgets what it was when it is set,
    /// and not a setting of a table, of optical constants or of films.
    pub(crate) fn belongs_to_object(&self, path: &str) -> bool {
        self.root.owns(path)
    }

    /// Sets every parameter called `lambda`, of the model and of all objects in it, in µm.
    pub fn set_wavelength(&mut self, lambda: f64) {
        self.root.edit().set_wavelength(lambda);
    }

    /// Equal for states that build equal models.
    pub fn fingerprint(&self) -> Fingerprint {
        self.root.digest()
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
