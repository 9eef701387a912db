//! The evaluation of a block of steps: unique pieces of work, done in parallel.

use std::{collections::BTreeSet, fmt::Write as _, sync::Arc};

use mist_format::{Diagnostic, number::general};
use rayon::prelude::*;
use scattering::{Direction, Incidence, Mueller, Notice, ParameterError};

use super::{
    cache::{FastMap, WeightedCache},
    models::{ModelCell, Models},
};
use crate::{
    Control, Failure, Job,
    fault::Fault,
    integrate::{Sample, adaptive_samples, contract, integrate_counting, samples},
    limits::Meter,
    parameters::Fingerprint,
    region::{Region, RegionError},
    sampling::{
        Layout, LayoutKey, SamplingRule,
        adaptive::{self, Accuracy, AdaptiveError},
    },
    step::{Evaluated, Step, StepIntegral},
};

/// Bytes of all layouts kept.
const KEPT_LAYOUTS: usize = 256 << 20;
/// Mueller integrals kept.
const KEPT_INTEGRALS: usize = 1 << 17;
/// Digits of the numbers in a samples file.
const SAMPLE_DIGITS: usize = 6;

/// The digest of all that determines a Mueller integral.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct IntegralKey(Fingerprint);

impl IntegralKey {
    fn new(step: &Step, model: Fingerprint, aperture: ApertureId) -> Self {
        let beam = (step.theta_i.to_bits(), step.rotation.to_bits());
        Self(Fingerprint::of(&(model, beam, aperture)))
    }
}

/// Where light is collected.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum ApertureId {
    /// One direction: the bits of θ and φ.
    Point(u64, u64),
    /// The layout, or the adaptive aperture, with this number.
    Area(u64),
}

/// The directions of an aperture, to be shared.
type NumberedDirections = (u64, TaskDirections);

/// The directions of a piece of work.
#[derive(Clone)]
enum TaskDirections {
    Point(Direction),
    Area(Arc<Layout>),
    Adaptive(Arc<(Region, Accuracy)>),
}

impl TaskDirections {
    /// Where `integral` collects light, unless that is one direction.
    fn area(integral: &StepIntegral) -> Result<Self, RegionError> {
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

    fn bytes(&self) -> usize {
        match self {
            Self::Area(layout) => layout.bytes(),
            Self::Point(..) | Self::Adaptive(_) => size_of::<(Region, Accuracy)>(),
        }
    }
}

/// A Mueller integral that was computed.
#[derive(Clone)]
struct MuellerResult {
    matrix: Mueller,
    /// The error of each element, of adaptive integrals.
    error: Option<Arc<Mueller>>,
}

impl MuellerResult {
    fn evaluated(&self, integral: &StepIntegral) -> Evaluated {
        let (pol, inpol) = (&integral.pol, &integral.inpol);
        let error = match (&self.error, integral.rule.accuracy()) {
            (Some(error), _) => adaptive::contracted_error(error, pol, inpol),
            (None, Some(_)) => 0.0,
            (None, None) => f64::NAN,
        };
        Evaluated { value: contract(&self.matrix, pol, inpol), error }
    }
}

/// Why a piece of work has no result.
enum TaskError {
    Parameter(ParameterError),
    Adaptive(AdaptiveError),
    Stopped,
}

/// A Mueller integral to be computed.
struct IntegralTask {
    key: IntegralKey,
    cell: Arc<ModelCell>,
    incidence: Incidence,
    place: TaskDirections,
    /// Where its result goes.
    found: usize,
    /// The step that wants it first, and which of its integrals.
    wanted_by: (usize, usize),
}

/// What a block of steps wants.
#[derive(Default)]
struct TaskList {
    /// For every integral of every step, in order, the place of its result.
    places: Vec<usize>,
    found: Vec<MuellerResult>,
    known: FastMap<IntegralKey, usize>,
    /// The key that was looked for last, and its place.
    last: Option<(IntegralKey, usize)>,
    work: Vec<IntegralTask>,
    /// Layouts that an earlier block has used.
    again: Vec<Arc<Layout>>,
    /// What the work gave.
    done: Vec<Result<(MuellerResult, u64), TaskError>>,
    /// The integrals that were looked at last, and where they collect light.
    integrals: Option<Arc<Vec<StepIntegral>>>,
    apertures: Vec<(ApertureId, TaskDirections)>,
    /// The beam that was looked at last.
    beam: Option<Incidence>,
}

impl TaskList {
    /// Stores the directions of layouts that more than one integral wants.
    fn store_shared(&self) {
        let mut wanted: Vec<&Arc<Layout>> = self.again.iter().collect();
        wanted.extend(self.work.iter().filter_map(|piece| match &piece.place {
            TaskDirections::Area(layout) => Some(layout),
            _ => None,
        }));
        wanted.sort_unstable_by_key(|layout| Arc::as_ptr(layout));
        let shared = wanted.chunk_by(|a, b| Arc::ptr_eq(a, b)).filter(|uses| uses.len() > 1);
        let shared: Vec<&Arc<Layout>> = shared.map(|uses| uses[0]).collect();
        shared.into_par_iter().for_each(|layout| layout.store());
    }

    /// Makes room for the next block; the memory is used again.
    fn forget(&mut self) {
        self.places.clear();
        self.found.clear();
        self.known.clear();
        self.last = None;
        self.work.clear();
        self.again.clear();
        self.integrals = None;
        self.apertures.clear();
    }

    /// The beam of `step`.
    fn beam_of(&mut self, step: &Step) -> Incidence {
        let angles = [step.theta_i, step.rotation].map(f64::to_bits);
        match self.beam {
            Some(beam) if [beam.theta(), beam.rotation()].map(f64::to_bits) == angles => beam,
            _ => self.next_beam(step),
        }
    }

    /// Apart from the other, else its sines are computed whether they are wanted or not.
    #[cold]
    #[inline(never)]
    fn next_beam(&mut self, step: &Step) -> Incidence {
        *self.beam.insert(Incidence::new(step.theta_i, step.rotation))
    }

    /// Where `integrals` collect light.
    fn look_at(
        &mut self,
        integrals: &Arc<Vec<StepIntegral>>,
        layouts: &FastMap<LayoutKey, NumberedDirections>,
    ) {
        if self.integrals.as_ref().is_some_and(|before| Arc::ptr_eq(before, integrals)) {
            return;
        }
        self.integrals = Some(integrals.clone());
        self.apertures.clear();
        self.apertures.extend(integrals.iter().map(|integral| match &integral.region {
            Region::Differential { center: (theta, phi) } => {
                let direction = Direction::new(*theta, *phi);
                (
                    ApertureId::Point(theta.to_bits(), phi.to_bits()),
                    TaskDirections::Point(direction),
                )
            }
            _ => {
                let (id, place) = &layouts[&integral.layout_key()];
                (ApertureId::Area(*id), place.clone())
            }
        }));
    }
}

/// Everything that steps share.
pub(crate) struct Evaluator<'a> {
    job: &'a Job,
    control: &'a Control,
    models: Models,
    layouts: WeightedCache<LayoutKey, NumberedDirections>,
    next_layout: u64,
    integrals: WeightedCache<IntegralKey, MuellerResult>,
    met: BTreeSet<Notice>,
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

    /// Where the integrals of one step will be; what nobody has computed yet becomes work.
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
        let model = step.parameters.fingerprint();
        todo.look_at(&step.integrals, layouts);
        for number in 0..step.integrals.len() {
            let (aperture, place) = &todo.apertures[number];
            if number > 0 && todo.apertures[number - 1].0 == *aperture {
                todo.places.extend_from_within(todo.places.len() - 1..);
                continue;
            }
            let key = IntegralKey::new(step, model, *aperture);
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
                    let cell = self.models.cell(&step.parameters);
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
        let basis = self.job.basis;
        let all = todo.work.par_iter().map(|piece| piece.compute(basis, &stop));
        all.collect_into_vec(&mut todo.done);
        let mut spent = 0.0;
        for (piece, result) in todo.work.iter().zip(todo.done.drain(..)) {
            let fault = match result {
                Ok((found, evaluations)) => {
                    spent += evaluations as f64;
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
                self.met.extend(&built.met);
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
        crate::run::at_step(block[at].index, fault(number))
    }

    /// The fault of an adaptive integral that has no value.
    fn adaptive(&self, number: usize, error: &AdaptiveError) -> Fault {
        let plan = &self.job.integrals[number];
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

    /// The lines of the samples file for `step`.
    pub(crate) fn samples(&mut self, step: &Step) -> String {
        let mut text = String::new();
        let cell = self.models.cell(&step.parameters);
        let Ok(built) = cell.get() else { return text };
        let incidence = Incidence::new(step.theta_i, step.rotation);
        let (model, basis) = (&built.model, self.job.basis);
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

impl IntegralTask {
    /// Whether a later block should find the result: not the only direction of a quick model.
    fn is_worth_keeping(&self) -> bool {
        let is_quick = || self.cell.get().is_ok_and(|built| built.model.is_quick());
        !(matches!(self.place, TaskDirections::Point(..)) && is_quick())
    }

    /// The Mueller integral, and how many evaluations of the model it took.
    fn compute(
        &self,
        basis: scattering::Basis,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<(MuellerResult, u64), TaskError> {
        let exact = |(matrix, count)| (MuellerResult { matrix, error: None }, count);
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
                found.map(exact).ok_or(TaskError::Stopped)
            }
            TaskDirections::Adaptive(aperture) => {
                let (region, accuracy) = &**aperture;
                let model = &built()?.model;
                adaptive::integrate(model, &self.incidence, basis, region, accuracy, stop)
                    .map(|found| {
                        let (matrix, error) = (found.matrix, Some(Arc::new(found.error)));
                        (MuellerResult { matrix, error }, found.evaluations)
                    })
                    .map_err(|error| match error {
                        AdaptiveError::Stopped => TaskError::Stopped,
                        other => TaskError::Adaptive(other),
                    })
            }
        }
    }
}
