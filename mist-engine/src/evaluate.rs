//! Evaluation of steps: models, layouts and Mueller integrals, each computed once.
//!
//! A loop over a polarization or an output evaluates no model again, and a loop over the
//! wavelength lays out no aperture again. Caches are emptied when they have grown large; that
//! costs time, never changes a number. Keys are compared exactly: a model by its parameters, a
//! beam by the bits of its angles, an aperture by its layout.

mod cache;
mod models;
mod remarks;
mod task;
mod task_list;

use std::{collections::BTreeSet, fmt::Write as _, sync::Arc};

use mist_format::{Diagnostic, number::general};
use rayon::prelude::*;
use scattering::{Incidence, Mode, Mueller, Notice};

use crate::{
    Control, Failure, Job,
    fault::{Fault, at_step},
    integrate::{Sample, adaptive_samples, samples},
    limits::Meter,
    region::Region,
    sampling::{Layout, LayoutKey, SamplingRule, adaptive::AdaptiveError},
    step::{Evaluated, Step, StepIntegral},
};
use cache::{FastMap, WeightedCache};
use models::Models;
use remarks::AccuracyRemarks;
use task::{
    IntegralKey, IntegralTask, MuellerResult, NumberedDirections, TaskDirections, TaskError,
    TaskResult,
};
use task_list::TaskList;

/// Bytes of all layouts kept.
const KEPT_LAYOUTS: usize = 256 << 20;
/// Mueller integrals kept.
const KEPT_INTEGRALS: usize = 1 << 17;
/// Digits of the numbers in a samples file.
const SAMPLE_DIGITS: usize = 6;

/// Everything that steps share.
pub(crate) struct Evaluator<'a> {
    job: &'a Job,
    control: &'a Control,
    models: Models,
    layouts: WeightedCache<LayoutKey, NumberedDirections>,
    next_layout: u64,
    integrals: WeightedCache<IntegralKey, MuellerResult>,
    met: BTreeSet<Notice>,
    remarks: AccuracyRemarks,
    /// Empty between two blocks.
    todo: TaskList,
}

impl<'a> Evaluator<'a> {
    pub(crate) fn new(job: &'a Job, control: &'a Control) -> Self {
        Self {
            job,
            control,
            models: Models::new(job.options.mode),
            layouts: WeightedCache::up_to(KEPT_LAYOUTS),
            next_layout: 0,
            integrals: WeightedCache::up_to(KEPT_INTEGRALS),
            met: BTreeSet::new(),
            remarks: AccuracyRemarks::default(),
            todo: TaskList::default(),
        }
    }

    /// The values of all integrals of all steps, one step after the other.
    ///
    /// All steps of a block have the same number of integrals.
    pub(crate) fn evaluate(
        &mut self,
        block: &[&Step],
        meter: &mut Meter<'_>,
    ) -> Result<Vec<Evaluated>, Failure> {
        let layouts = self.lay_out(block)?;
        let mut todo = std::mem::take(&mut self.todo);
        for (at, step) in block.iter().enumerate() {
            self.find(at, step, &layouts, &mut todo);
        }
        todo.store_shared();
        let spent = self.do_all(block, &mut todo)?;
        meter.add(spent).map_err(Failure::Limit)?;
        let integrals = block.iter().flat_map(|step| &*step.integrals);
        let value =
            |(integral, place): (&StepIntegral, &usize)| todo.found[*place].evaluated(integral);
        let values = integrals.zip(&todo.places).map(value).collect();
        todo.forget();
        self.todo = todo;
        Ok(values)
    }

    /// The layout of every area in the block, made in parallel where it is new.
    fn lay_out(
        &mut self,
        block: &[&Step],
    ) -> Result<FastMap<LayoutKey, NumberedDirections>, Failure> {
        let mut layouts = FastMap::default();
        let mut wanted: Vec<(LayoutKey, (usize, usize))> = Vec::new();
        let mut seen = BTreeSet::new();
        for (at, step) in block.iter().enumerate() {
            if at > 0 && Arc::ptr_eq(&step.integrals, &block[at - 1].integrals) {
                continue;
            }
            for (number, integral) in step.integrals.iter().enumerate() {
                if matches!(integral.region, Region::Differential { .. }) {
                    continue;
                }
                let key = integral.layout_key();
                if layouts.contains_key(&key) || seen.contains(&key) {
                    continue;
                }
                if let Some(found) = self.layouts.get(&key) {
                    if let TaskDirections::Area(layout) = &found.1 {
                        self.todo.again.push(layout.clone());
                    }
                    layouts.insert(key, found.clone());
                } else {
                    seen.insert(key.clone());
                    wanted.push((key, (at, number)));
                }
            }
        }
        let made: Vec<_> = wanted
            .par_iter()
            .map(|(_, (at, number))| TaskDirections::area(&block[*at].integrals[*number]))
            .collect();
        for ((key, wanted_by), place) in wanted.into_iter().zip(made) {
            let place = place.map_err(|error| {
                self.failure(block, wanted_by, |n| self.job.region_fault(n, &error))
            })?;
            let numbered = (self.next_layout, place);
            self.next_layout += 1;
            self.layouts.insert(key.clone(), numbered.clone(), numbered.1.bytes());
            layouts.insert(key, numbered);
        }
        Ok(layouts)
    }

    /// Places of the integrals of one step; integrals that are not computed yet become tasks.
    fn find(
        &mut self,
        at: usize,
        step: &Step,
        layouts: &FastMap<LayoutKey, NumberedDirections>,
        todo: &mut TaskList,
    ) {
        if step.integrals.is_empty() {
            return;
        }
        let model = self.models.id(&step.parameters);
        let beam = [step.theta_i, step.rotation].map(f64::to_bits);
        todo.look_at(&step.integrals, layouts);
        for number in 0..step.integrals.len() {
            let (aperture, place) = &todo.apertures[number];
            if number > 0 && todo.apertures[number - 1].0 == *aperture {
                todo.places.extend_from_within(todo.places.len() - 1..);
                continue;
            }
            let key = IntegralKey { model, beam, aperture: *aperture };
            if let Some((last, place)) = todo.last
                && last == key
            {
                todo.places.push(place);
                continue;
            }
            let next = todo.found.len();
            let here = *todo.known.entry(key).or_insert(next);
            if here == next {
                let found = self.integrals.get(&key).cloned();
                if found.is_none() {
                    let cell = self.models.cell(model, &step.parameters);
                    let (place, wanted_by) = (place.clone(), (at, number));
                    let incidence = todo.beam_of(step);
                    todo.work.push(IntegralTask {
                        key,
                        cell,
                        incidence,
                        place,
                        found: here,
                        wanted_by,
                    });
                }
                todo.found
                    .push(found.unwrap_or(MuellerResult { matrix: Mueller::ZERO, error: None }));
            }
            todo.last = Some((key, here));
            todo.places.push(here);
        }
    }

    /// Does the work and keeps what came out; says how many evaluations of the model it took.
    fn do_all(&mut self, block: &[&Step], todo: &mut TaskList) -> Result<f64, Failure> {
        let stop = || self.control.is_cancelled();
        let basis = self.job.plan.basis;
        let is_sound = self.job.options.mode == Mode::Sound;
        let integral = |(at, number): (usize, usize)| &block[at].integrals[number];
        let remarks = &self.remarks;
        let all = todo.work.par_iter().map(|piece| {
            let is_checked = is_sound && !remarks.has(piece.wanted_by.1);
            piece.compute(basis, is_checked.then(|| integral(piece.wanted_by)), &stop)
        });
        all.collect_into_vec(&mut todo.done);
        let mut spent = 0.0;
        for (piece, result) in todo.work.iter().zip(todo.done.drain(..)) {
            let fault = match result {
                Ok(TaskResult { found, evaluations, remark }) => {
                    spent += evaluations as f64;
                    if let Some(remark) = remark {
                        let (at, number) = piece.wanted_by;
                        let place = (number, block[at].index);
                        self.remarks.note(place, remark, integral(piece.wanted_by));
                    }
                    if piece.is_worth_keeping() {
                        self.integrals.insert(piece.key, found.clone(), 1);
                    }
                    todo.found[piece.found] = found;
                    None
                }
                Err(TaskError::Stopped) => return Err(Failure::Cancelled),
                Err(TaskError::Parameter(error)) => Some(self.job.parameter_fault(&error)),
                Err(TaskError::Adaptive(error)) => Some(self.adaptive(piece.wanted_by.1, &error)),
            };
            if let Some(fault) = fault {
                return Err(self.failure(block, piece.wanted_by, |_| fault));
            }
            if let Ok(built) = piece.cell.get() {
                self.met.extend(built.met.lock().expect("no model panics while it notes").iter());
            }
        }
        if self.control.is_cancelled() { Err(Failure::Cancelled) } else { Ok(spent) }
    }

    fn failure(
        &self,
        block: &[&Step],
        (at, number): (usize, usize),
        fault: impl FnOnce(usize) -> Fault,
    ) -> Failure {
        at_step(block[at].index, fault(number))
    }

    /// The fault of an adaptive integral that has no value.
    fn adaptive(&self, number: usize, error: &AdaptiveError) -> Fault {
        let plan = &self.job.plan.integrals[number];
        let help = match error {
            AdaptiveError::Region(error) => return self.job.region_fault(number, error),
            AdaptiveError::Budget { .. } => {
                "make tolerance larger or maxevaluations (1e7 unless VARIABLES says otherwise) \
                 larger, or integrate over a grid, integrationmode = 2"
            }
            AdaptiveError::NotFinite | AdaptiveError::Stopped => {
                "leave the direction of the mirror out with an ANNULUS, or check the parameters"
            }
        };
        let message = format!("{}: {error}", plan.name);
        Box::new(Diagnostic::error("integral/tolerance", plan.name.span(), message).help(help))
    }

    /// The defects met since the last call.
    pub(crate) fn take_met(&mut self) -> BTreeSet<Notice> {
        std::mem::take(&mut self.met)
    }

    /// Warnings of integrals that are less accurate than they should be.
    pub(crate) fn warnings(&self) -> Vec<Diagnostic> {
        self.remarks.warnings(&self.job.plan.integrals)
    }

    /// The lines of the samples file for `step`.
    pub(crate) fn samples(&mut self, step: &Step) -> String {
        let mut text = String::new();
        let id = self.models.id(&step.parameters);
        let cell = self.models.cell(id, &step.parameters);
        let Ok(built) = cell.get() else { return text };
        let incidence = Incidence::new(step.theta_i, step.rotation);
        let (model, basis) = (&built.model, self.job.plan.basis);
        for integral in step.integrals.iter() {
            let light = (&integral.pol, &integral.inpol);
            let mut write = |sample: Sample| {
                let [x, y, z] = sample.xyz();
                let _ = write!(text, "{}", step.index);
                for value in [sample.theta, sample.phi, x, y, z, sample.brdf] {
                    let _ = write!(text, "\t{}", general(value, SAMPLE_DIGITS));
                }
                text.push('\n');
            };
            // The region was integrated over before without an error.
            match &integral.rule {
                SamplingRule::Adaptive(accuracy) => {
                    let region = (&integral.region, accuracy);
                    adaptive_samples(model, &incidence, basis, region, light, &mut write);
                }
                rule => {
                    let Some((plane, seed)) = rule.plane() else { continue };
                    let layout = Layout::new(&integral.region, plane, seed);
                    let Ok(layout) = layout else { continue };
                    samples(model, &incidence, basis, &layout, light, &mut write);
                }
            }
        }
        text
    }
}
