//! Materials outside of programs: a model with parameters and data files, ready to be asked.
//!
//! A [`Material`] is the JSON that a user writes, a [`PreparedMaterial`] is evaluated: by
//! [`eval`] for single geometries, by [`lobes`] for the directions of a renderer, by [`table`] for
//! its colour tables.

pub mod eval;
pub mod lobes;
pub mod results;
pub mod table;

mod description;
mod patch;

use std::{
    collections::BTreeSet,
    sync::{Arc, Mutex, PoisonError},
};

use rayon::prelude::*;

use crate::{
    DataFiles, Failure, Files, Job, Warning,
    deviation::dialect,
    files::LayeredFiles,
    parameters::{
        ModelParameters, ParameterInput, ParameterPath, SetError, TableFinding, TableUses,
    },
    region::RegionError,
    replay::Replay,
    request::RequestError,
};
use mist_format::suggestion::did_you_mean;
use scattering::{Mode, Model, ParameterError, models, notice::keep_largest, spec::SharedNotices};

pub use crate::request::Material;

/// Error of reading, preparing, evaluating or tabulating a material.
#[derive(Debug, thiserror::Error)]
pub enum MaterialError {
    /// The JSON text is not a material or a request.
    #[error("not a valid request: {0}")]
    Json(#[from] serde_json::Error),
    /// No model has this name.
    #[error("no model is called {name:?}")]
    Model {
        /// The name.
        name: String,
        /// Suggested name.
        help: Option<String>,
    },
    /// A parameter cannot be set.
    #[error(transparent)]
    Set(#[from] SetError),
    /// The model cannot be built with these values.
    #[error(transparent)]
    Build(#[from] ParameterError),
    /// The program of the material is wrong.
    #[error("{0}")]
    Program(#[from] Failure),
    /// A part of the request is wrong.
    #[error(transparent)]
    Request(#[from] RequestError),
    /// A patch of the request cannot be integrated over.
    #[error("patch {number}: {error}")]
    Patch {
        /// Which one, from 1, in the order of the request.
        number: usize,
        /// The reason.
        error: RegionError,
    },
    /// The model has no finite value somewhere.
    #[error("the model is not finite at {0}")]
    NotFinite(String),
    /// A limit was reached.
    #[error("{0}")]
    Limit(String),
    /// It was stopped from outside.
    #[error("cancelled")]
    Cancelled,
}

impl MaterialError {
    /// A part of a request that is wrong.
    pub(crate) fn request(part: impl Into<String>, problem: impl std::fmt::Display) -> Self {
        Self::Request(RequestError::new(part, problem))
    }

    /// Suggested text, if there is one.
    pub fn help(&self) -> Option<&str> {
        match self {
            Self::Model { help, .. } => help.as_deref(),
            Self::Program(Failure::Program(found)) => found.first()?.help.as_deref(),
            Self::Set(error) => error.help.as_deref(),
            _ => None,
        }
    }

    /// The parameter or the part of the request at fault, if it is one.
    pub fn part(&self) -> Option<&str> {
        match self {
            Self::Model { .. } => Some("model"),
            Self::Set(error) => Some(&error.path),
            Self::Build(error) => Some(&error.parameter),
            Self::Request(error) => Some(&error.key),
            _ => None,
        }
    }
}

impl Material {
    /// Reads a material from JSON.
    ///
    /// # Errors
    ///
    /// For texts that are not JSON, and for unknown and missing keys.
    pub fn from_json(json: &str) -> Result<Self, MaterialError> {
        Ok(serde_json::from_str(json)?)
    }

    /// Sets the parameters; files that the material does not hold come from `more_files`.
    ///
    /// # Errors
    ///
    /// For unknown models and parameters, values of the wrong kind and missing files.
    pub fn prepare(
        &self,
        mode: Mode,
        more_files: Option<Arc<dyn Files + Send + Sync>>,
    ) -> Result<PreparedMaterial, MaterialError> {
        let files = LayeredFiles::new(&self.files, more_files);
        let library = DataFiles::new(Arc::new(files), dialect(mode));
        let class = class(&self.model)?;
        let mut parameters = ModelParameters::new(class);
        let paths = self.parameters.iter().map(|(path, _)| ParameterPath::resolve(class, path));
        let paths: Vec<_> = paths.collect();
        if mode == Mode::Sound {
            check_order(&paths)?;
        }
        for (path, (_, value)) in paths.iter().zip(&self.parameters) {
            parameters.set(path, ParameterInput::Text(value), &library, mode, None)?;
        }
        Ok(PreparedMaterial::new(parameters, mode))
    }
}

/// Refuses a parameter that a later choice of a class replaces by its default.
fn check_order(paths: &[ParameterPath]) -> Result<(), MaterialError> {
    for (at, path) in paths.iter().enumerate() {
        let later = &paths[at + 1..];
        let chooses = |object: &ParameterPath| object.names_object() && path.is_inside(object);
        let Some(chosen) = later.iter().position(chooses) else { continue };
        if !later[chosen + 1..].iter().any(|again| again.as_str() == path.as_str()) {
            let object = later[chosen].as_str();
            let problem =
                format!("it is set before {object}, which makes a new object: it is lost");
            let help = format!("write {} behind {object}", path.as_str());
            return Err(SetError::value(problem).help(help).named(path.as_str()).into());
        }
    }
    Ok(())
}

fn class(name: &str) -> Result<&'static scattering::Class, MaterialError> {
    let found = models::find(name).map(|spec| &spec.class);
    found.ok_or_else(|| MaterialError::Model {
        name: name.to_owned(),
        help: did_you_mean(name, models::all().map(|spec| spec.class.name)),
    })
}

/// A material with its parameters set and its files read.
#[derive(Clone, Debug)]
pub struct PreparedMaterial {
    parameters: ModelParameters,
    mode: Mode,
    /// Warnings of the models that were built; clones share them.
    warnings: Arc<Mutex<BTreeSet<Warning>>>,
    /// Warnings of the program that describes it.
    program_warnings: Arc<[Warning]>,
    /// Notices of the models that were built and evaluated; clones share them.
    met: SharedNotices,
}

impl PreparedMaterial {
    /// The material of the first step of a program.
    ///
    /// # Errors
    ///
    /// The errors of the program in this step.
    pub fn of_step(job: &Job) -> Result<Self, Failure> {
        let step = Replay::new(job).next_step().map_err(|fault| Failure::Program(vec![*fault]))?;
        let empty = || Failure::Limit("the loops of the program have no step".into());
        let prepared = Self::new(step.ok_or_else(empty)?.parameters, job.options.mode);
        Ok(Self { program_warnings: job.slips().iter().map(Warning::from).collect(), ..prepared })
    }

    /// The same at another wavelength (µm): that of the model and of everything inside of it.
    #[must_use]
    pub fn at(&self, lambda: f64) -> Self {
        let mut parameters = self.parameters.clone();
        parameters.set_wavelength(lambda, self.mode);
        if self.mode == Mode::Compat {
            parameters.forget_other_wavelengths();
        }
        Self { parameters, ..self.clone() }
    }

    /// The models at all `wavelengths` (nm), built in parallel.
    ///
    /// Their notices become [`PreparedMaterial::warnings`].
    ///
    /// # Errors
    ///
    /// For tables that have none of the wavelengths, and values that the model cannot take.
    pub fn models(&self, wavelengths: &[f64]) -> Result<Vec<Model>, MaterialError> {
        let lambdas: Vec<f64> = wavelengths.iter().map(|nm| nm / 1000.0).collect();
        self.models_at(&lambdas)
    }

    /// [`PreparedMaterial::models`] at wavelengths in µm.
    ///
    /// # Errors
    ///
    /// As [`PreparedMaterial::models`].
    pub fn models_at(&self, lambdas: &[f64]) -> Result<Vec<Model>, MaterialError> {
        let all: Vec<Self> = lambdas.iter().map(|lambda| self.at(*lambda)).collect();
        self.check_tables(&all)?;
        all.par_iter().map(|material| Ok(material.model()?.0)).collect()
    }

    /// The model at its own wavelength, as [`PreparedMaterial::models`].
    ///
    /// # Errors
    ///
    /// As [`PreparedMaterial::models`].
    pub fn own_model(&self) -> Result<(Model, SharedNotices), MaterialError> {
        self.check_tables(std::slice::from_ref(self))?;
        self.model()
    }

    /// Warnings of the models that were built and evaluated so far.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut met = self.met.lock().unwrap_or_else(PoisonError::into_inner).clone();
        keep_largest(&mut met);
        let mut warnings = self.warnings.lock().unwrap_or_else(PoisonError::into_inner).clone();
        warnings.extend(met.iter().filter_map(Warning::of_notice));
        warnings.into_iter().collect()
    }

    /// Warnings of slips in the text of the program that describes the material.
    pub fn program_warnings(&self) -> &[Warning] {
        &self.program_warnings
    }

    /// The same material with warnings of its own.
    #[must_use]
    pub fn with_own_warnings(&self) -> Self {
        let program_warnings = self.program_warnings.clone();
        Self { program_warnings, ..Self::new(self.parameters.clone(), self.mode) }
    }

    fn new(parameters: ModelParameters, mode: Mode) -> Self {
        let (warnings, program_warnings) = (Arc::default(), Arc::default());
        Self { parameters, mode, warnings, program_warnings, met: SharedNotices::default() }
    }

    fn warn(&self, found: impl Iterator<Item = Warning>) {
        self.warnings.lock().unwrap_or_else(PoisonError::into_inner).extend(found);
    }

    /// Compares the tables with the wavelengths at which the materials `all` ask them.
    fn check_tables(&self, all: &[Self]) -> Result<(), MaterialError> {
        let mut uses = TableUses::default();
        all.iter().for_each(|material| uses.see(&material.parameters));
        for TableFinding { paths, is_error, warning } in uses.findings() {
            if is_error && self.mode == Mode::Sound {
                let path = paths.first().map_or("", String::as_str);
                let error = SetError::value(warning.message).help_if(warning.help).named(path);
                return Err(error.into());
            }
            self.warn(std::iter::once(warning));
        }
        Ok(())
    }

    /// The parameters.
    pub fn parameters(&self) -> &ModelParameters {
        &self.parameters
    }

    /// Notices of the models that were built and evaluated so far.
    pub fn notices(&self) -> &SharedNotices {
        &self.met
    }

    /// Sound physics or NIST's numbers.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// The model, and the notices of its build and of its evaluations: defects of NIST's library that a sound one steps
    /// around, limits that its parameters pass.
    ///
    /// # Errors
    ///
    /// For values that the model cannot take.
    pub fn model(&self) -> Result<(Model, SharedNotices), MaterialError> {
        let model = models::build(&self.parameters.node(self.mode, &self.met))?;
        Ok((model, self.met.clone()))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::MemoryFiles;

    fn error(json: &str) -> MaterialError {
        Material::from_json(json).unwrap().prepare(Mode::Sound, None).unwrap_err()
    }

    #[test]
    fn wrong_names_are_told_with_what_was_meant() {
        let unknown = error(r#"{"model": "Lambertian_BRDF_Modl"}"#);
        assert!(unknown.help().unwrap().contains("Lambertian_BRDF_Model"), "{unknown}");
        let unknown =
            error(r#"{"model": "Facet_BRDF_Model", "parameters": {"substrat": "(1.5,0)"}}"#);
        assert_eq!(unknown.part(), Some("substrat"));
        assert!(unknown.help().unwrap().contains("substrate"), "{unknown}");
    }

    #[test]
    fn a_parent_in_an_object_is_set_before_its_parameters() {
        let json = r#"{"model": "Lambertian_BRDF_Model",
            "parameters": {"reflectance.table": 0.5, "reflectance": "Table_Reflectance"}}"#;
        let material = Material::from_json(json).unwrap();
        assert_eq!(material.parameters[1], ("reflectance.table".into(), "0.5".into()));
        material.prepare(Mode::Sound, None).unwrap();
    }

    #[test]
    fn files_of_the_material_hide_those_around_it() {
        let json = r#"{"model": "Facet_BRDF_Model",
            "parameters": [["substrate", "x.txt"], ["lambda", 0.5]],
            "files": {"x.txt": "0.4 1.2 3\n0.6 1.2 3\n"}}"#;
        let around = MemoryFiles(BTreeMap::from([("x.txt".to_owned(), Arc::from("0.4 9 9\n"))]));
        let prepared =
            Material::from_json(json).unwrap().prepare(Mode::Sound, Some(Arc::new(around)));
        let (model, _) = prepared.unwrap().model().unwrap();
        assert!((model.common().substrate.re - 1.2).abs() < 1e-15);
    }
}
