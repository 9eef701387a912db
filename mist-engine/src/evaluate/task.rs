//! One Mueller integral to be computed.

use std::sync::Arc;

use scattering::{Direction, Incidence, Mueller, ParameterError};

use super::{
    models::{ModelCell, ModelId},
    remarks::AccuracyRemark,
};
use crate::{
    integrate::{MissedLobe, contract, integrate_counting},
    region::{Region, RegionError},
    sampling::{
        Layout, SamplingRule,
        adaptive::{self, Accuracy, AdaptiveError},
    },
    step::{Evaluated, StepIntegral},
};

/// Everything that determines a Mueller integral: the model, the bits of the angle of incidence
/// and of the rotation, the aperture.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct IntegralKey {
    pub(super) model: ModelId,
    pub(super) beam: [u64; 2],
    pub(super) aperture: ApertureId,
}

/// Region in which light is collected.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum ApertureId {
    /// One direction: the bits of θ and φ.
    Point(u64, u64),
    /// The layout, or the adaptive aperture, with this number.
    Area(u64),
}

/// The directions of an aperture, to be shared.
pub(super) type NumberedDirections = (u64, TaskDirections);

/// The directions of a piece of work.
#[derive(Clone)]
pub(super) enum TaskDirections {
    Point(Direction),
    Area(Arc<Layout>),
    Adaptive(Arc<(Region, Accuracy)>),
}

impl TaskDirections {
    /// Region in which `integral` collects light, unless it is one direction.
    pub(super) fn area(integral: &StepIntegral) -> Result<Self, RegionError> {
        let region = &integral.region;
        Ok(match integral.rule {
            SamplingRule::Adaptive(accuracy) => {
                Self::Adaptive(Arc::new((region.clone(), accuracy)))
            }
            SamplingRule::Grid(plane) => {
                Self::Area(Arc::new(Layout::planned(region, &plane, None)?))
            }
            SamplingRule::MonteCarlo { plane, seed } => {
                Self::Area(Arc::new(Layout::planned(region, &plane, Some(seed))?))
            }
        })
    }

    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::Area(layout) => layout.bytes(),
            Self::Point(..) | Self::Adaptive(_) => size_of::<(Region, Accuracy)>(),
        }
    }
}

/// A Mueller integral that was computed.
#[derive(Clone)]
pub(super) struct MuellerResult {
    pub(super) matrix: Mueller,
    /// The error of each element, of adaptive integrals.
    pub(super) error: Option<Arc<Mueller>>,
}

impl MuellerResult {
    pub(super) fn evaluated(&self, integral: &StepIntegral) -> Evaluated {
        let (pol, inpol) = (&integral.pol, &integral.inpol);
        let error = match (&self.error, integral.rule.accuracy()) {
            (Some(error), _) => adaptive::contracted_error(error, pol, inpol),
            (None, Some(_)) => 0.0,
            (None, None) => f64::NAN,
        };
        Evaluated { value: contract(&self.matrix, pol, inpol), error }
    }
}

/// Result of a task.
pub(super) struct TaskResult {
    pub(super) found: MuellerResult,
    /// Evaluations of the model.
    pub(super) evaluations: u64,
    pub(super) remark: Option<AccuracyRemark>,
}

/// Reason why a task has no result.
pub(super) enum TaskError {
    Parameter(ParameterError),
    Adaptive(AdaptiveError),
    Stopped,
}

/// A Mueller integral to be computed.
pub(super) struct IntegralTask {
    pub(super) key: IntegralKey,
    pub(super) cell: Arc<ModelCell>,
    pub(super) incidence: Incidence,
    pub(super) place: TaskDirections,
    /// Place of its result.
    pub(super) found: usize,
    /// The step that wants it first, and which of its integrals.
    pub(super) wanted_by: (usize, usize),
}

impl IntegralTask {
    /// True if a later block should find the result: not the only direction of a quick model.
    pub(super) fn is_worth_keeping(&self) -> bool {
        let is_quick = || self.cell.get().is_ok_and(|built| built.model.is_quick());
        !(matches!(self.place, TaskDirections::Point(..)) && is_quick())
    }

    /// The Mueller integral, and how many evaluations of the model it took. A grid in place of
    /// `checked` is compared with lobes that may fall between its directions.
    pub(super) fn compute(
        &self,
        basis: scattering::Basis,
        checked: Option<&StepIntegral>,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<TaskResult, TaskError> {
        let exact = |(matrix, evaluations)| {
            let found = MuellerResult { matrix, error: None };
            TaskResult { found, evaluations, remark: None }
        };
        let built = || self.cell.get().map_err(|error| TaskError::Parameter(error.clone()));
        match &self.place {
            TaskDirections::Point(direction) => {
                if !(self.incidence.is_above() && direction.is_above()) {
                    // NIST's program does not ask the model here either, so its errors do not
                    // matter.
                    return Ok(exact((Mueller::ZERO, 1)));
                }
                let mut out = [Mueller::ZERO];
                built()?.model.evaluate(&self.incidence, &[*direction], basis, &mut out);
                Ok(exact((out[0] * direction.cos, 1)))
            }
            TaskDirections::Area(layout) => {
                let model = &built()?.model;
                let found = integrate_counting(model, &self.incidence, basis, layout, stop);
                let found = found.ok_or(TaskError::Stopped)?;
                let region = checked.and_then(|one| Some((&one.region, one.rule.plane()?.0)));
                let missed = region.and_then(|region| {
                    MissedLobe::find((model, &self.incidence, basis), region, &found.0, stop)
                });
                Ok(TaskResult { remark: missed.map(AccuracyRemark::Missed), ..exact(found) })
            }
            TaskDirections::Adaptive(aperture) => {
                let (region, accuracy) = &**aperture;
                let model = &built()?.model;
                adaptive::integrate(model, &self.incidence, basis, region, accuracy, stop)
                    .map(|estimate| {
                        let (matrix, error) = (estimate.matrix, Some(Arc::new(estimate.error)));
                        let found = MuellerResult { matrix, error };
                        let tolerance = accuracy.tolerance;
                        let is_met = estimate.relative_error() <= tolerance;
                        let remark =
                            (!is_met).then_some(AccuracyRemark::Unmet { estimate, tolerance });
                        TaskResult { found, evaluations: estimate.evaluations, remark }
                    })
                    .map_err(|error| match error {
                        AdaptiveError::Stopped => TaskError::Stopped,
                        other => TaskError::Adaptive(other),
                    })
            }
        }
    }
}
