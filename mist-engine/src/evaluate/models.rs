//! Models by their parameters.

use std::sync::{Arc, OnceLock};

use scattering::{Mode, Model, ParameterError, spec::SharedNotices};

use super::cache::{FastMap, WeightedCache};
use crate::parameters::ModelParameters;

/// Models kept at the same time.
const MODELS: usize = 4096;

/// States of parameters that are numbered at the same time.
const NUMBERED: usize = 1 << 16;

/// The number of a state of parameters; never used again for another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct ModelId(u64);

/// A model that is built when it is first needed.
pub(super) struct ModelCell {
    parameters: ModelParameters,
    mode: Mode,
    built: OnceLock<Result<Built, ParameterError>>,
}

/// A model with the notices of its build and of the evaluations until now.
pub(super) struct Built {
    pub(super) model: Model,
    pub(super) met: SharedNotices,
}

impl ModelCell {
    /// The model, built now if it has not been.
    pub(super) fn get(&self) -> Result<&Built, &ParameterError> {
        self.built
            .get_or_init(|| {
                let met = SharedNotices::default();
                let model = scattering::models::build(&self.parameters.node(self.mode, &met))?;
                Ok(Built { model, met })
            })
            .as_ref()
    }
}

/// The models of a run. Equal parameters share one.
pub(super) struct Models {
    mode: Mode,
    ids: FastMap<ModelParameters, ModelId>,
    next: u64,
    /// The parameters that were numbered last.
    last: Option<(ModelParameters, ModelId)>,
    cells: WeightedCache<ModelId, Arc<ModelCell>>,
}

impl Models {
    pub(super) fn new(mode: Mode) -> Self {
        let (ids, cells) = (FastMap::default(), WeightedCache::up_to(MODELS));
        Self { mode, ids, next: 0, last: None, cells }
    }

    /// The number of these parameters.
    pub(super) fn id(&mut self, parameters: &ModelParameters) -> ModelId {
        if let Some((last, id)) = &self.last
            && last.is_same_as(parameters)
        {
            return *id;
        }
        let id = self.numbered(parameters);
        self.last = Some((parameters.clone(), id));
        id
    }

    fn numbered(&mut self, parameters: &ModelParameters) -> ModelId {
        if let Some(id) = self.ids.get(parameters) {
            return *id;
        }
        if self.ids.len() >= NUMBERED {
            self.ids.clear();
        }
        let id = ModelId(self.next);
        self.next += 1;
        self.ids.insert(parameters.clone(), id);
        id
    }

    /// The cell of the model with this number and these parameters.
    pub(super) fn cell(&mut self, id: ModelId, parameters: &ModelParameters) -> Arc<ModelCell> {
        if let Some(cell) = self.cells.get(&id) {
            return cell.clone();
        }
        let parameters = parameters.clone();
        let cell = Arc::new(ModelCell { parameters, mode: self.mode, built: OnceLock::new() });
        self.cells.insert(id, cell.clone(), 1);
        cell
    }
}
