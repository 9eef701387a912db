//! The steps of a job that runs again and again with other parameters of the model.

use rustc_hash::FxHashMap;
use scattering::Mode;

use super::reader::{BLOCK_STEPS, StepReader};
use crate::{
    Control, Failure, Job,
    fault::at_step,
    parameters::{ModelParameters, ParameterInput},
    step::Step,
};

/// The largest number of steps that are kept in memory.
const STEPS: u64 = 1 << 12;

/// The steps of one run, from which those of another one differ in their parameters only.
pub(crate) struct ReusableSteps {
    /// The steps in blocks, each with the position of its parameters in `states`.
    blocks: Vec<Vec<(Step, usize)>>,
    /// The different parameters of the steps.
    states: Vec<ModelParameters>,
    /// The entries of VARIABLES that set the parameters.
    entries: Vec<usize>,
}

impl ReusableSteps {
    /// The steps of `job`. None if the entries `given` change more than parameters of the model, if
    /// there are too many steps, or if there is an error: a run tells it.
    #[expect(clippy::mutable_key_type, reason = "the hash memo of parameters is not part of them")]
    pub(crate) fn of(job: &Job, given: &[usize], control: &Control) -> Option<Self> {
        if job.options.mode == Mode::Compat {
            return None;
        }
        let entries = job.graph.parameters_of(&job.plan, given)?;
        let mut reader = StepReader::new(job, control, None, true);
        let (mut blocks, mut states) = (Vec::new(), Vec::new());
        let mut known = FxHashMap::default();
        loop {
            let block = reader.block(BLOCK_STEPS).ok().filter(|_| reader.next <= STEPS)?;
            if block.is_empty() {
                break;
            }
            let with_state = |mut step: Step| {
                step.listing.clear();
                let state = *known.entry(step.parameters.clone()).or_insert_with(|| {
                    states.push(step.parameters.clone());
                    states.len() - 1
                });
                (step, state)
            };
            blocks.push(block.into_iter().map(with_state).collect());
        }
        let paths = || entries.iter().filter_map(|at| job.plan.entries[*at].parameter.as_ref());
        let belong = |state: &ModelParameters| paths().all(|path| state.belongs_to_object(path));
        (reader.steps_are_independent() && states.iter().all(belong)).then_some(Self {
            blocks,
            states,
            entries,
        })
    }

    /// The blocks of steps with the values of `job`; the columns of loops only if it `shows` them.
    ///
    /// # Errors
    ///
    /// A value that a parameter cannot have.
    pub(super) fn blocks_for(
        &self,
        job: &Job,
        shows: bool,
    ) -> Result<impl Iterator<Item = impl Iterator<Item = Step>>, Failure> {
        let states = self.states.iter().map(|state| self.with_values(state.clone(), job));
        let states = states.collect::<Result<Vec<_>, _>>()?;
        Ok(self.blocks.iter().map(move |block| {
            let states = states.clone();
            block.iter().map(move |(step, state)| Step {
                parameters: states[*state].clone(),
                columns: if shows { step.columns.clone() } else { Default::default() },
                ..step.clone()
            })
        }))
    }

    /// The parameters `state` with the values of the entries in `job`.
    fn with_values(
        &self,
        mut state: ModelParameters,
        job: &Job,
    ) -> Result<ModelParameters, Failure> {
        for at in &self.entries {
            let entry = &job.plan.entries[*at];
            let value = job.initial.iter().find(|(slot, _)| Some(*slot) == entry.slot);
            let (Some((_, value)), Some(path)) = (value, &entry.parameter) else { continue };
            let input = ParameterInput::Numbers(value.as_slice());
            state
                .set(path, input, &job.library, job.options.mode, None)
                .map_err(|error| at_step(0, job.set_fault(*at, &error)))?;
        }
        state.hash_code();
        Ok(state)
    }
}
