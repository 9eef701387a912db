//! Materials and programs from their descriptions.

use std::sync::Arc;

use mist_format::Diagnostic;
use scattering::Mode;

use super::{MaterialError, PreparedMaterial};
use crate::{
    Failure, Files, Job, Limits, Options, compile,
    files::LayeredFiles,
    request::{MaterialDescription, ProgramDescription},
};

impl ProgramDescription {
    /// The options of its run within `limits`; a job without a name is called `job`.
    pub fn options(&self, job: &str, limits: Limits) -> Options {
        Options {
            mode: if self.compat { Mode::Compat } else { Mode::Sound },
            job: self.job.clone().unwrap_or_else(|| job.to_owned()),
            seed: self.seed.unwrap_or(1),
            limits,
        }
    }

    /// The files of the description, then those `around` it.
    pub fn files_before(
        &self,
        around: Option<Arc<dyn Files + Send + Sync>>,
    ) -> Arc<dyn Files + Send + Sync> {
        Arc::new(LayeredFiles::new(&self.files, around))
    }

    /// Compiles the program; files that the description does not hold come from `around`.
    ///
    /// # Errors
    ///
    /// Every mistake of the program, in the order of the text.
    pub fn compile(
        &self,
        options: &Options,
        around: Option<Arc<dyn Files + Send + Sync>>,
    ) -> Result<Job, Vec<Diagnostic>> {
        compile(&self.program, self.files_before(around), options)
    }
}

impl MaterialDescription {
    /// The material; files that the description does not hold come from `around`.
    ///
    /// In `mode` compat, and for programs that ask for it, the material has NIST's numbers.
    ///
    /// # Errors
    ///
    /// As [`Material::prepare`](super::Material::prepare), or [`MaterialError::Program`] for what is
    /// wrong with the program up to its first step.
    pub fn prepare(
        &self,
        mode: Mode,
        around: Option<Arc<dyn Files + Send + Sync>>,
    ) -> Result<PreparedMaterial, MaterialError> {
        match self {
            Self::Model(material) => material.prepare(mode, around),
            Self::Program(program) => {
                let mut options = program.options("job", Limits::default());
                if mode == Mode::Compat {
                    options.mode = mode;
                }
                let job = program.compile(&options, around).map_err(Failure::Program)?;
                Ok(PreparedMaterial::of_step(&job)?)
            }
        }
    }
}
