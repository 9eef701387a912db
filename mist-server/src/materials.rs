//! The materials that the service keeps ready.

use std::{
    collections::BTreeMap,
    sync::{Arc, PoisonError, RwLock},
};

use mist_engine::{
    material::{MaterialError, PreparedMaterial},
    request::{MaterialDescription, ProgramDescription},
};
use scattering::Mode;
use sha2::{Digest, Sha256};

use crate::{
    limits::ServeLimits,
    program::{ProgramError, admit, compiled},
};

/// A material that is ready to be evaluated.
#[derive(Debug)]
pub(crate) struct StoredMaterial {
    /// The body of the request that brought it.
    pub(crate) text: String,
    /// True for JSON, false for the text of a program.
    pub(crate) is_json: bool,
    /// The client that stored it, if known.
    pub(crate) owner: Option<String>,
    /// `sha256-…` of that body.
    pub(crate) hash: String,
    /// The material.
    pub(crate) prepared: PreparedMaterial,
}

/// The reason why there is no such material.
#[derive(Debug)]
pub(crate) enum MaterialsError {
    /// No material has this name.
    Unknown(String),
    /// The material is wrong.
    Material(MaterialError),
    /// The program of the material is wrong.
    Program(ProgramError),
}

impl From<MaterialError> for MaterialsError {
    fn from(error: MaterialError) -> Self {
        Self::Material(error)
    }
}

impl From<ProgramError> for MaterialsError {
    fn from(error: ProgramError) -> Self {
        Self::Program(error)
    }
}

impl MaterialsError {
    /// The message for people.
    pub(crate) fn message(self) -> String {
        match self {
            Self::Unknown(name) => format!("there is no material {name:?}"),
            Self::Material(error) => error.to_string(),
            Self::Program(error) => error.report().message,
        }
    }
}

impl StoredMaterial {
    /// The material that `text` describes: material JSON, a program with files as JSON, or the
    /// bare text of a program that needs none.
    pub(crate) fn new(
        text: String,
        is_json: bool,
        owner: Option<String>,
        limits: &ServeLimits,
    ) -> Result<Self, MaterialsError> {
        let prepared = prepare(&text, is_json, limits)?;
        // Errors of values show when the model is built: now rather than at every table.
        prepared.model()?;
        let hash = format!("sha256-{:x}", Sha256::digest(text.as_bytes()));
        Ok(Self { text, is_json, owner, hash, prepared })
    }
}

fn prepare(
    text: &str,
    is_json: bool,
    limits: &ServeLimits,
) -> Result<PreparedMaterial, MaterialsError> {
    let described = if is_json {
        MaterialDescription::from_json(text).map_err(MaterialError::Json)?
    } else {
        MaterialDescription::Program(ProgramDescription::bare(text))
    };
    match described {
        MaterialDescription::Model(material) => Ok(material.prepare(Mode::Sound, None)?),
        MaterialDescription::Program(program) => first_step(&program, limits),
    }
}

/// The material of a program's first step.
fn first_step(
    program: &ProgramDescription,
    limits: &ServeLimits,
) -> Result<PreparedMaterial, MaterialsError> {
    admit(program, limits)?;
    let job = compiled(program, limits.engine(limits.max_time))?;
    let prepared = PreparedMaterial::of_step(&job);
    Ok(prepared.map_err(|failure| ProgramError::of(&program.program, failure))?)
}

/// Materials by name; clones share them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Materials(Arc<RwLock<BTreeMap<String, Arc<StoredMaterial>>>>);

impl Materials {
    /// The material called `name`.
    pub(crate) fn find(&self, name: &str) -> Result<Arc<StoredMaterial>, MaterialsError> {
        let all = self.0.read().unwrap_or_else(PoisonError::into_inner);
        all.get(name).cloned().ok_or_else(|| MaterialsError::Unknown(name.to_owned()))
    }

    /// Number of materials.
    pub(crate) fn len(&self) -> usize {
        self.0.read().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// Name and hash of every material, by name.
    pub(crate) fn list(&self) -> Vec<(String, String)> {
        let all = self.0.read().unwrap_or_else(PoisonError::into_inner);
        all.iter().map(|(name, stored)| (name.clone(), stored.hash.clone())).collect()
    }

    /// Puts a material in the place of any other with this name.
    pub(crate) fn insert(&self, name: String, material: StoredMaterial) {
        let mut all = self.0.write().unwrap_or_else(PoisonError::into_inner);
        all.insert(name, Arc::new(material));
    }

    /// Removes a material.
    pub(crate) fn remove(&self, name: &str) {
        self.0.write().unwrap_or_else(PoisonError::into_inner).remove(name);
    }
}
