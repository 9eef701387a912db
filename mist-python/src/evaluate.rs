//! Quantities of prepared models in arrays of directions.

use std::{
    ops::Range,
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
    time::Instant,
};

use rayon::prelude::*;
use scattering::{
    Basis, Direction, Incidence, Model, Mueller, Stokes,
    interrupt::{self, Interrupted},
};

use crate::angles::{Beam, DirectionArray};

/// Directions that one task evaluates.
const TASK: usize = 512;
/// Directions whose matrices are computed at a time.
const BATCH: usize = 128;

/// A prepared model, and its cost as it was seen last.
pub(crate) struct TimedModel {
    pub(crate) model: Model,
    /// Nanoseconds of a direction in the last evaluation; `u64::MAX` before the first.
    cost: AtomicU64,
}

impl TimedModel {
    pub(crate) fn new(model: Model) -> Self {
        Self { model, cost: AtomicU64::new(u64::MAX) }
    }

    /// Nanoseconds that `count` directions are expected to take.
    pub(crate) fn expected(&self, count: usize) -> u64 {
        self.cost.load(Ordering::Relaxed).saturating_mul(count as u64)
    }
}

/// A quantity of each direction.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Quantity {
    /// The Mueller BRDF: sixteen numbers (1/sr).
    Mueller(Basis),
    /// The BRDF of one incident light and one sensitivity: one number (1/sr).
    Brdf { basis: Basis, incident: Stokes, sensitivity: Stokes },
    /// The Jones matrix: four complex numbers (sr^-1/2).
    Jones(Basis),
}

impl Quantity {
    /// Numbers of a direction.
    pub(crate) fn width(self) -> usize {
        match self {
            Self::Mueller(_) => 16,
            Self::Brdf { .. } => 1,
            Self::Jones(_) => 8,
        }
    }

    /// Writes the numbers of the directions of one beam.
    fn write(self, model: &Model, incidence: &Incidence, to: &[Direction], out: &mut [f64]) {
        match self {
            Self::Mueller(basis) => matrices(model, incidence, to, basis, |k, m| {
                out[16 * k..16 * k + 16].copy_from_slice(m.0.as_flattened());
            }),
            Self::Brdf { basis, incident, sensitivity } => {
                matrices(model, incidence, to, basis, |k, m| {
                    let rows = m.0.iter().zip(sensitivity.0);
                    let row = |row: &[f64; 4]| -> f64 {
                        row.iter().zip(incident.0).map(|(m, i)| m * i).sum()
                    };
                    out[k] = rows.map(|(elements, s)| s * row(elements)).sum();
                });
            }
            Self::Jones(basis) => {
                for (to, out) in to.iter().zip(out.chunks_exact_mut(8)) {
                    let j = model.jones(incidence, to, basis).unwrap_or_default();
                    for (z, out) in
                        [j.ss, j.ps, j.sp, j.pp].into_iter().zip(out.chunks_exact_mut(2))
                    {
                        out.copy_from_slice(&[z.re, z.im]);
                    }
                }
            }
        }
    }
}

fn matrices(
    model: &Model,
    incidence: &Incidence,
    to: &[Direction],
    basis: Basis,
    mut write: impl FnMut(usize, &Mueller),
) {
    let mut matrices = [Mueller::ZERO; BATCH];
    for (number, to) in to.chunks(BATCH).enumerate() {
        let matrices = &mut matrices[..to.len()];
        model.evaluate(incidence, to, basis, matrices);
        for (k, m) in matrices.iter().enumerate() {
            write(number * BATCH + k, m);
        }
    }
}

/// Evaluates directions of one beam; where an angle is NaN the numbers are NaN.
fn evaluate(
    quantity: Quantity,
    timed: &TimedModel,
    beam: Beam,
    angles: (&[f64], &[f64]),
    out: &mut [f64],
) {
    if beam.is_nan() {
        out.fill(f64::NAN);
        return;
    }
    let (theta_s, phi_s) = angles;
    let started = Instant::now();
    let incidence = Incidence::new(beam.theta_i, beam.rotation);
    let width = quantity.width();
    if let ([theta], [phi]) = (theta_s, phi_s) {
        quantity.write(&timed.model, &incidence, &[Direction::new(*theta, *phi)], out);
    } else {
        let to: Vec<Direction> =
            theta_s.iter().zip(phi_s).map(|(theta, phi)| Direction::new(*theta, *phi)).collect();
        quantity.write(&timed.model, &incidence, &to, out);
    }
    for ((theta, phi), out) in theta_s.iter().zip(phi_s).zip(out.chunks_exact_mut(width)) {
        if theta.is_nan() || phi.is_nan() {
            out.fill(f64::NAN);
        }
    }
    let cost = started.elapsed().as_nanos() as u64 / theta_s.len().max(1) as u64;
    timed.cost.store(cost, Ordering::Relaxed);
}

/// A part of the directions of one beam, with the place of its numbers.
struct Task<'a> {
    beam: usize,
    range: Range<usize>,
    out: &'a mut [f64],
}

impl DirectionArray {
    /// Number of directions.
    pub(crate) fn count(&self) -> usize {
        self.theta_s.len()
    }

    /// Writes the numbers of all directions into `out`; `models` has a model per beam.
    ///
    /// # Errors
    ///
    /// If `flag` was set.
    pub(crate) fn evaluate(
        &self,
        quantity: Quantity,
        models: &[Arc<TimedModel>],
        flag: &Arc<AtomicBool>,
        out: &mut [f64],
    ) -> Result<(), Interrupted> {
        let Some(places) = &self.places else {
            return self.evaluate_sorted(quantity, models, flag, out);
        };
        let width = quantity.width();
        let mut sorted = vec![0.0; out.len()];
        self.evaluate_sorted(quantity, models, flag, &mut sorted)?;
        for (place, numbers) in places.iter().zip(sorted.chunks_exact(width)) {
            out[place * width..(place + 1) * width].copy_from_slice(numbers);
        }
        Ok(())
    }

    fn evaluate_sorted(
        &self,
        quantity: Quantity,
        models: &[Arc<TimedModel>],
        flag: &Arc<AtomicBool>,
        mut out: &mut [f64],
    ) -> Result<(), Interrupted> {
        let width = quantity.width();
        let mut tasks = Vec::with_capacity(self.beams.len() + self.count() / TASK);
        for (beam, (_, range)) in self.beams.iter().enumerate() {
            for start in range.clone().step_by(TASK) {
                let range = start..(start + TASK).min(range.end);
                let (own, rest) = out.split_at_mut(range.len() * width);
                out = rest;
                tasks.push(Task { beam, range, out: own });
            }
        }
        let least = (tasks.len() / 4096).max(1);
        tasks.into_par_iter().with_min_len(least).try_for_each(|task| {
            let Task { beam, range, out } = task;
            let angles = (&self.theta_s[range.clone()], &self.phi_s[range]);
            interrupt::until(flag, || {
                evaluate(quantity, &models[beam], self.beams[beam].0, angles, out);
            })
        })
    }

    /// Writes the numbers of the directions of the only beam on the calling thread.
    pub(crate) fn evaluate_here(&self, quantity: Quantity, model: &TimedModel, out: &mut [f64]) {
        for (beam, range) in &self.beams {
            let angles = (&self.theta_s[range.clone()], &self.phi_s[range.clone()]);
            evaluate(quantity, model, *beam, angles, out);
        }
    }
}
