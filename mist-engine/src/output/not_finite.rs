//! Outputs that are not finite numbers, counted over the steps of a run.

use mist_format::Diagnostic;

use crate::Job;

/// Steps in which an output is not finite.
#[derive(Clone, Copy, Debug, Default)]
struct StepCount {
    steps: u64,
    /// The first of them, from 0.
    first: u64,
}

/// For each output the steps in which it is not finite.
#[derive(Clone, Debug, Default)]
pub(crate) struct NotFinite(Vec<StepCount>);

impl NotFinite {
    /// None so far, of `outputs` outputs.
    pub(super) fn new(outputs: usize) -> Self {
        Self(vec![StepCount::default(); outputs])
    }

    /// Counts the output number `output` in the step number `step`.
    pub(super) fn add(&mut self, output: usize, step: u64) {
        self.0[output].merge(StepCount { steps: 1, first: step });
    }

    /// Adds the counts of other steps.
    pub(crate) fn merge(&mut self, other: &Self) {
        for (count, other) in self.0.iter_mut().zip(&other.0) {
            count.merge(*other);
        }
    }

    /// One warning per output, for a run of `steps` steps.
    pub(crate) fn warnings(&self, job: &Job, steps: u64) -> Vec<Diagnostic> {
        let all = self.0.iter().zip(&job.plan.outputs).filter(|(count, _)| count.steps > 0);
        all.map(|(count, output)| {
            let (label, first) = (&output.label, count.first + 1);
            let message = format!(
                "{label} is nan or infinite in {} of {steps} steps, first in step {first}",
                count.steps
            );
            Diagnostic::warning("output/not-finite", output.text.span(), message).help(
                "look for divisions by 0, logarithms of 0 and directions at which a lobe is \
                 infinite",
            )
        })
        .collect()
    }
}

impl StepCount {
    fn merge(&mut self, other: Self) {
        if other.steps == 0 {
            return;
        }
        self.first = if self.steps == 0 { other.first } else { self.first.min(other.first) };
        self.steps += other.steps;
    }
}
