//! Models that a material keeps.

use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use crate::evaluate::TimedModel;

/// Models that are kept for wavelengths other than that of the material.
const KEPT_MODELS: usize = 32;

/// The models of a material at its own and at the last other wavelengths (µm).
#[derive(Default)]
pub(crate) struct ModelCache {
    own: OnceLock<Arc<TimedModel>>,
    /// Models at other wavelengths by their bits, the one that was used last at the end.
    others: Mutex<Vec<(u64, Arc<TimedModel>)>>,
}

impl ModelCache {
    /// The model at `lambda`, if it is kept.
    pub(crate) fn get(&self, lambda: Option<f64>) -> Option<Arc<TimedModel>> {
        let Some(lambda) = lambda else { return self.own.get().cloned() };
        let others = locked(&self.others);
        let found = others.iter().find(|(bits, _)| *bits == lambda.to_bits());
        found.map(|(_, model)| Arc::clone(model))
    }

    /// Keeps `model`, which was used last.
    pub(crate) fn put(&self, lambda: Option<f64>, model: &Arc<TimedModel>) {
        let Some(lambda) = lambda else {
            self.own.get_or_init(|| Arc::clone(model));
            return;
        };
        let bits = lambda.to_bits();
        let mut others = locked(&self.others);
        others.retain(|(other, _)| *other != bits);
        if others.len() == KEPT_MODELS {
            others.remove(0);
        }
        others.push((bits, Arc::clone(model)));
    }

    /// Number of the models.
    pub(crate) fn count(&self) -> usize {
        usize::from(self.own.get().is_some()) + locked(&self.others).len()
    }
}

/// The value of a mutex whose holders keep it valid.
pub(crate) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
