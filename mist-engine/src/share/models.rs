//! Models by their parameters.

use std::sync::{Arc, OnceLock};

use scattering::{Mode, Model, Notice, ParameterError, spec::SharedNotices};

use super::cache::WeightedCache;
use crate::parameters::{Fingerprint, ModelParameters};

/// Models kept at the same time.
const MODELS: usize = 4096;

/// A model that is built when it is first needed.
pub(crate) struct ModelCell {
    parameters: ModelParameters,
    mode: Mode,
    built: OnceLock<Result<Built, ParameterError>>,
}

/// A model with the defects that its sound build stepped around.
pub(crate) struct Built {
    pub(crate) model: Model,
    pub(crate) met: Vec<Notice>,
}

impl ModelCell {
    /// The model, built now if it has not been.
    pub(crate) fn get(&self) -> Result<&Built, &ParameterError> {
        self.built
            .get_or_init(|| {
                let met = SharedNotices::default();
                let model = scattering::models::build(&self.parameters.node(self.mode, &met))?;
                let met = met.lock().expect("no build panics").iter().copied().collect();
                Ok(Built { model, met })
            })
            .as_ref()
    }
}

/// Models by their parameters.
pub(crate) struct Models {
    mode: Mode,
    cells: WeightedCache<Fingerprint, Arc<ModelCell>>,
}

impl Models {
    pub(crate) fn new(mode: Mode) -> Self {
        Self { mode, cells: WeightedCache::up_to(MODELS) }
    }

    /// The cell of the model with these parameters.
    pub(crate) fn cell(&mut self, parameters: &ModelParameters) -> Arc<ModelCell> {
        let key = parameters.fingerprint();
        if let Some(cell) = self.cells.get(&key) {
            return cell.clone();
        }
        let parameters = parameters.clone();
        let cell = Arc::new(ModelCell { parameters, mode: self.mode, built: OnceLock::new() });
        self.cells.insert(key, cell.clone(), 1);
        cell
    }
}
