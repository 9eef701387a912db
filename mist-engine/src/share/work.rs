//! The evaluation of a block of steps: unique pieces of work, done in parallel.

use std::{collections::BTreeSet, f64::consts::FRAC_PI_2, fmt::Write as _, sync::Arc};

use mist_format::number::general;
use rayon::prelude::*;
use scattering::{Direction, Incidence, Mueller, Notice, ParamError};

use super::{
    kept::{Kept, Map},
    models::{ModelCell, Models},
};
use crate::{
    Control, Failure, Job,
    fault::Fault,
    integrate::{contract, integrate, samples},
    limits::Meter,
    parameters::Fingerprint,
    region::Region,
    sampling::{Layout, LayoutKey},
    step::{Integral, Step},
};

/// Bytes of all layouts kept.
const KEPT_LAYOUTS: usize = 256 << 20;
/// Mueller integrals kept.
const KEPT_INTEGRALS: usize = 1 << 17;
/// Digits of the numbers in a samples file.
const SAMPLE_DIGITS: usize = 6;

/// All that determines a Mueller integral.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Key {
    model: Fingerprint,
    theta_i: u64,
    rotation: u64,
    aperture: Aperture,
}

/// Where light is collected.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Aperture {
    /// One direction: the bits of θ and φ.
    Point(u64, u64),
    /// The layout with this number.
    Area(u64),
}

/// The directions of a piece of work.
#[derive(Clone)]
enum Place {
    Point(f64, f64),
    Area(Arc<Layout>),
}

/// A Mueller integral to be computed.
struct Work {
    key: Key,
    cell: Arc<ModelCell>,
    incidence: Incidence,
    place: Place,
    /// The step that wants it first, and which of its integrals.
    wanted_by: (usize, usize),
}

/// Everything that steps share.
pub(crate) struct Shared<'a> {
    job: &'a Job,
    control: &'a Control,
    models: Models,
    layouts: Kept<LayoutKey, (u64, Arc<Layout>)>,
    next_layout: u64,
    integrals: Kept<Key, Mueller>,
    met: BTreeSet<Notice>,
}

impl<'a> Shared<'a> {
    pub(crate) fn new(job: &'a Job, control: &'a Control) -> Self {
        Self {
            job,
            control,
            models: Models::new(job.options.mode),
            layouts: Kept::up_to(KEPT_LAYOUTS),
            next_layout: 0,
            integrals: Kept::up_to(KEPT_INTEGRALS),
            met: BTreeSet::new(),
        }
    }

    /// The values of all integrals of all steps.
    pub(crate) fn evaluate(
        &mut self,
        block: &[Step],
        meter: &mut Meter<'_>,
    ) -> Result<Vec<Vec<f64>>, Failure> {
        let layouts = self.lay_out(block)?;
        let mut known: Map<Key, Mueller> = Map::default();
        let mut work: Vec<Work> = Vec::new();
        let mut keys = Vec::with_capacity(block.len());
        for (at, step) in block.iter().enumerate() {
            keys.push(self.keys(at, step, &layouts, &mut known, &mut work));
        }
        meter.add(work.iter().map(Work::evaluations).sum()).map_err(Failure::Limit)?;
        self.do_all(block, work, &mut known)?;
        let value = |(integral, key): (&Integral, &Key)| {
            contract(&known[key], &integral.pol, &integral.inpol)
        };
        let both = block.iter().zip(&keys);
        Ok(both.map(|(step, keys)| step.integrals.iter().zip(keys).map(value).collect()).collect())
    }

    /// The layout of every area in the block, made in parallel where it is new.
    fn lay_out(&mut self, block: &[Step]) -> Result<Map<LayoutKey, (u64, Arc<Layout>)>, Failure> {
        let mut layouts = Map::default();
        let mut wanted: Vec<(LayoutKey, (usize, usize))> = Vec::new();
        let mut seen = BTreeSet::new();
        for (at, step) in block.iter().enumerate() {
            for (number, integral) in step.integrals.iter().enumerate() {
                if matches!(integral.region, Region::Differential { .. }) {
                    continue;
                }
                let key = LayoutKey::new(&integral.region, &integral.sampling);
                if layouts.contains_key(&key) || seen.contains(&key) {
                    continue;
                }
                if let Some(found) = self.layouts.get(&key) {
                    layouts.insert(key, found.clone());
                } else {
                    seen.insert(key.clone());
                    wanted.push((key, (at, number)));
                }
            }
        }
        let made: Vec<_> = wanted
            .par_iter()
            .map(|(_, (at, number))| {
                let integral = &block[*at].integrals[*number];
                Layout::new(&integral.region, &integral.sampling)
            })
            .collect();
        for ((key, wanted_by), layout) in wanted.into_iter().zip(made) {
            let layout = layout.map_err(|error| {
                self.failure(block, wanted_by, |n| self.job.region_fault(n, &error))
            })?;
            let numbered = (self.next_layout, Arc::new(layout));
            self.next_layout += 1;
            self.layouts.insert(key.clone(), numbered.clone(), numbered.1.bytes());
            layouts.insert(key, numbered);
        }
        Ok(layouts)
    }

    /// The keys of the integrals of one step; what nobody has computed yet becomes work.
    fn keys(
        &mut self,
        at: usize,
        step: &Step,
        layouts: &Map<LayoutKey, (u64, Arc<Layout>)>,
        known: &mut Map<Key, Mueller>,
        work: &mut Vec<Work>,
    ) -> Vec<Key> {
        if step.integrals.is_empty() {
            return Vec::new();
        }
        let cell = self.models.cell(&step.parameters);
        let mut keys = Vec::with_capacity(step.integrals.len());
        for (number, integral) in step.integrals.iter().enumerate() {
            let (aperture, place) = match &integral.region {
                Region::Differential { center: (theta, phi) } => {
                    (Aperture::Point(theta.to_bits(), phi.to_bits()), Place::Point(*theta, *phi))
                }
                region => {
                    let key = LayoutKey::new(region, &integral.sampling);
                    let (id, layout) = &layouts[&key];
                    (Aperture::Area(*id), Place::Area(layout.clone()))
                }
            };
            let key = Key {
                model: step.parameters.fingerprint(),
                theta_i: step.theta_i.to_bits(),
                rotation: step.rotation.to_bits(),
                aperture,
            };
            keys.push(key);
            if known.contains_key(&key) {
                continue;
            }
            if let Some(found) = self.integrals.get(&key) {
                known.insert(key, *found);
                continue;
            }
            known.insert(key, Mueller::ZERO);
            let incidence = Incidence::new(step.theta_i, step.rotation);
            work.push(Work { key, cell: cell.clone(), incidence, place, wanted_by: (at, number) });
        }
        keys
    }

    /// Does the work and puts what came out into `known`.
    fn do_all(
        &mut self,
        block: &[Step],
        work: Vec<Work>,
        known: &mut Map<Key, Mueller>,
    ) -> Result<(), Failure> {
        let stop = || self.control.is_cancelled();
        let basis = self.job.basis;
        let done: Vec<Result<Option<Mueller>, ParamError>> =
            work.par_iter().map(|piece| piece.compute(basis, &stop)).collect();
        for (piece, result) in work.iter().zip(done) {
            match result {
                Ok(Some(integral)) => {
                    known.insert(piece.key, integral);
                    self.integrals.insert(piece.key, integral, 1);
                }
                Ok(None) => return Err(Failure::Cancelled),
                Err(error) => {
                    return Err(
                        self.failure(block, piece.wanted_by, |_| self.job.parameter_fault(&error))
                    );
                }
            }
            if let Ok(built) = piece.cell.get() {
                self.met.extend(&built.met);
            }
        }
        if self.control.is_cancelled() { Err(Failure::Cancelled) } else { Ok(()) }
    }

    fn failure(
        &self,
        block: &[Step],
        (at, number): (usize, usize),
        fault: impl FnOnce(usize) -> Fault,
    ) -> Failure {
        crate::run::at_step(block[at].index, fault(number))
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
        for integral in &step.integrals {
            // The region was laid out before without an error.
            let Ok(layout) = Layout::new(&integral.region, &integral.sampling) else { continue };
            let light = (&integral.pol, &integral.inpol);
            samples(&built.model, &incidence, self.job.basis, &layout, light, &mut |sample| {
                let [x, y, z] = sample.xyz();
                let _ = write!(text, "{}", step.index);
                for value in [sample.theta, sample.phi, x, y, z, sample.brdf] {
                    let _ = write!(text, "\t{}", general(value, SAMPLE_DIGITS));
                }
                text.push('\n');
            });
        }
        text
    }
}

impl Work {
    /// How many evaluations of the model it costs.
    fn evaluations(&self) -> f64 {
        match &self.place {
            Place::Point(..) => 1.0,
            Place::Area(layout) => layout.directions() as f64,
        }
    }

    /// The Mueller integral, or nothing if it was stopped.
    fn compute(
        &self,
        basis: scattering::Basis,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Mueller>, ParamError> {
        let below = |theta: f64| theta.abs() >= FRAC_PI_2;
        match &self.place {
            // NIST's program does not ask the model here either, so its errors do not matter.
            Place::Point(theta, _) if below(self.incidence.theta) || below(*theta) => {
                Ok(Some(Mueller::ZERO))
            }
            Place::Point(theta, phi) => {
                let built = self.cell.get().map_err(Clone::clone)?;
                let direction = Direction::new(*theta, *phi);
                let mut out = [Mueller::ZERO];
                built.model.evaluate(&self.incidence, &[direction], basis, &mut out);
                Ok(Some(out[0] * direction.cos))
            }
            Place::Area(layout) => {
                let built = self.cell.get().map_err(Clone::clone)?;
                Ok(integrate(&built.model, &self.incidence, basis, layout, stop))
            }
        }
    }
}
