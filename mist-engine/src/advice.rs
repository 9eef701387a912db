//! Warnings of valid but suspicious text, and errors of a run: the part of `mist check`
//! behind compiling.
//!
//! Unused variables show in the text. The rest needs numbers: the steps are replayed (see
//! [`Replay`]) without asking the model for anything, and what angles, wavelengths and apertures
//! become on the way is looked at.

mod angles;
mod apertures;
mod format;
mod order;
mod origin;
mod reading;
mod tables;
mod unused;
mod wavelength;
mod words;

#[cfg(test)]
mod tests;

use std::collections::HashSet;

use mist_format::Diagnostic;
use scattering::spec::SharedNotices;

use crate::{
    Job,
    fault::Fault,
    output::{Outputs, TableLine},
    parameters::{ModelParameters, TableUses},
    region::Region,
    replay::Replay,
    step::{Evaluated, Step},
};
use apertures::Apertures;
use reading::Reading;

/// Steps that are looked at; those of longer programs are estimated from them.
const STEPS: u64 = 4096;
/// Steps at the ends of loops that are looked at.
const END_STEPS: u64 = 512;
/// Different models that are built.
const MODELS: usize = 16;

impl Job {
    /// Errors that a run would meet in its first steps, and warnings, in the order of the text.
    ///
    /// Up to 4096 steps are replayed and up to 16 models built; none is evaluated.
    pub fn advice(&self) -> Vec<Diagnostic> {
        let mut rehearsal = Rehearsal::new(self);
        let mut found: Vec<_> = rehearsal.run().err().into_iter().map(|fault| *fault).collect();
        rehearsal.see_ends();
        found.extend(unused::warnings(self));
        found.extend(rehearsal.slips());
        found.extend(rehearsal.apertures.warnings(rehearsal.all_steps()));
        in_order_of_text(found)
    }

    /// Warnings of slips, found when the job was compiled: degrees for radians, nm for µm, tables
    /// without the wavelengths that are asked, formats without separators. They are part of
    /// [`Job::advice`]; every command prints them.
    pub fn slips(&self) -> Vec<Diagnostic> {
        self.slips.to_vec()
    }

    /// Finds the slips, warnings and errors, in the order of the text.
    ///
    /// Up to 512 steps at the ends of the loops are replayed; no model is built.
    pub(crate) fn find_slips(&self) -> Vec<Diagnostic> {
        let mut rehearsal = Rehearsal::new(self);
        rehearsal.see_ends();
        in_order_of_text(rehearsal.slips())
    }
}

/// The findings in the order of the text, one of a kind at each place.
fn in_order_of_text(mut found: Vec<Diagnostic>) -> Vec<Diagnostic> {
    found.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    found.dedup_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    found
}

/// The steps of a job, looked at one by one.
struct Rehearsal<'j> {
    job: &'j Job,
    readings: Vec<Reading<'j>>,
    apertures: Apertures<'j>,
    tables: TableUses,
    /// Parameters of the models that were built.
    models: HashSet<ModelParameters>,
    steps: u64,
    /// Number of the steps that were replayed.
    fraction: f64,
    is_whole: bool,
    /// True if all steps at the ends of loops were looked at.
    has_all_ends: bool,
}

impl<'j> Rehearsal<'j> {
    fn new(job: &'j Job) -> Self {
        let mut readings = angles::readings(job);
        readings.extend(wavelength::readings(job));
        Self {
            job,
            readings,
            apertures: Apertures::new(job),
            tables: TableUses::default(),
            models: HashSet::new(),
            steps: 0,
            fraction: 0.0,
            is_whole: false,
            has_all_ends: false,
        }
    }

    /// Goes through the steps up to the first that fails.
    fn run(&mut self) -> Result<(), Fault> {
        let mut replay = Replay::new(self.job);
        while self.steps < STEPS {
            let next = replay.next_step().map_err(|fault| self.in_step(fault))?;
            let Some(step) = next else {
                self.is_whole = true;
                return Ok(());
            };
            self.readings
                .iter_mut()
                .for_each(|reading| reading.see(replay.values_mut().slots_mut()));
            self.fraction = step.fraction;
            self.see(&step).map_err(|fault| self.in_step(fault))?;
            self.steps += 1;
            if self.job.graph.in_order {
                // The next step reads results that nobody has computed.
                return Ok(());
            }
        }
        Ok(())
    }

    /// Looks at the numbers of the steps at the ends of loops, up to the first that fails.
    fn see_ends(&mut self) {
        let mut replay = Replay::new(self.job).showing(false).at_ends();
        let mut last: Option<ModelParameters> = None;
        for _ in 0..END_STEPS {
            let step = match replay.next_step() {
                Ok(Some(step)) => step,
                end => {
                    self.has_all_ends = end.is_ok();
                    return;
                }
            };
            let slots = replay.values_mut().slots_mut();
            self.readings.iter_mut().for_each(|reading| reading.see(slots));
            if !last.as_ref().is_some_and(|last| last.is_same_as(&step.parameters)) {
                self.tables.see(&step.parameters);
                last = Some(step.parameters);
            }
            if self.job.graph.in_order {
                return;
            }
        }
    }

    /// Warnings of the numbers that were seen.
    fn slips(&self) -> Vec<Diagnostic> {
        let mut found: Vec<_> =
            self.readings.iter().filter_map(|reading| reading.warning(self.job)).collect();
        found.extend(angles::functions(self.job));
        found.extend(order::lost_parameters(self.job));
        found.extend(format::separators(self.job));
        found.extend(tables::findings(self.job, &self.tables, self.has_all_ends));
        found
    }

    fn see(&mut self, step: &Step) -> Result<(), Fault> {
        self.apertures.see(step)?;
        self.build(step)?;
        if self.steps == 0 {
            self.outputs(step)?;
        }
        Ok(())
    }

    /// Names and functions of the outputs, with 1 for each integral.
    fn outputs(&self, step: &Step) -> Result<(), Fault> {
        let one = Evaluated { value: 1.0, error: 0.0 };
        let ones = vec![one; self.job.plan.integrals.len()];
        let about_names = |code| {
            matches!(code, "expr/unknown-name" | "expr/unknown-function" | "expr/file-arguments")
        };
        match Outputs::new(self.job, true).fill(&mut TableLine::default(), step, &ones) {
            Err(fault) if about_names(fault.code) => Err(fault),
            _ => Ok(()),
        }
    }

    /// Builds the model of a step, if the step asks it for anything and it is a new one.
    fn build(&mut self, step: &Step) -> Result<(), Fault> {
        let below = |theta: f64| theta.abs() >= std::f64::consts::FRAC_PI_2;
        let asks = step.integrals.iter().any(|integral| match integral.region {
            Region::Differential { center } => !below(center.0) && !below(step.theta_i),
            _ => true,
        });
        if !asks || self.models.len() >= MODELS {
            return Ok(());
        }
        if !self.models.insert(step.parameters.clone()) {
            return Ok(());
        }
        let node = step.parameters.node(self.job.options.mode, &SharedNotices::default());
        match scattering::models::build(&node) {
            Ok(_) => Ok(()),
            Err(error) => Err(self.job.parameter_fault(&error)),
        }
    }

    /// A fault of a later step says which.
    fn in_step(&self, fault: Fault) -> Fault {
        match self.steps {
            0 => fault,
            step => Box::new(fault.note(format!("in step {}", step + 1))),
        }
    }

    /// Number of steps of the run, if it can be determined.
    fn all_steps(&self) -> f64 {
        let seen = self.steps as f64;
        if self.is_whole || self.job.graph.in_order {
            seen
        } else {
            seen / self.fraction.clamp(1e-3, 1.0)
        }
    }
}
