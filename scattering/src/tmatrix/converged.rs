//! T-matrices that know how good they are.
//!
//! A truncated null-field system has no bound of its error. Here every result is computed twice,
//! with different orders and at different nodes: the distance of the two, relative to their size, is
//! the error that truncation, quadrature and rounding leave together. The orders rise until it is
//! small; what stays is stated or, above one per cent, refused.
//!
//! The order m = 1 costs little and converges no faster than the others. For bodies whose orders m
//! are expensive it finds the number of orders l, and refuses what is far out of reach, before the
//! others are computed.

use num_complex::Complex64;

use super::{ComplexMatrix, MOST, TMatrix};
use crate::{
    ModelLimit, ParameterError, ParameterNode, ParameterValue, scatterer::layered, shape::Shape,
    spec, special::harmonics::Harmonics,
};

/// Relative error of amplitudes at which the orders need not rise further.
const AIM: f64 = 1e-7;
/// Relative error from which on a result says so.
const STATED: f64 = 1e-4;
/// Relative error above which a result is refused.
const REFUSED: f64 = 1e-2;
/// Number of times that the orders are raised.
const ATTEMPTS: usize = 4;

/// Multiple of [`REFUSED`] that the low orders m may differ by before the others are computed.
const HOPEFUL: f64 = 3.0;
/// Margin of the error where more orders need not make it smaller.
const CHANCE: f64 = 2.0;
/// The largest m by which the number of orders l is found.
const LOW: usize = 1;

/// One of the two computations: orders up to `l_max`, at many nodes or at fewer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Level {
    /// The largest l.
    pub l_max: usize,
    /// The largest m.
    pub m_max: usize,
    /// True for the more accurate one of the two.
    pub is_fine: bool,
}

/// The number of orders to start with, and whether it is all that may be taken.
#[derive(Clone, Debug)]
pub(crate) struct Orders {
    start: usize,
    is_fixed: bool,
    /// True if the low orders m are computed first.
    low_first: bool,
    /// The least multiple of the distance of two results that counts as their error.
    margin: f64,
    /// The part of a refusal that says which bodies converge.
    remedy: String,
}

impl Orders {
    /// The largest l to start with.
    pub(crate) fn start(&self) -> usize {
        self.start
    }

    /// The orders that the parameter `lmax` asks for where the size needs `needed`.
    pub(crate) fn read(node: &ParameterNode, needed: usize) -> Result<Self, ParameterError> {
        Ok(Self {
            start: super::l_max(node, needed)?,
            is_fixed: node.integer("lmax") > 0,
            low_first: false,
            margin: 1.0,
            remedy: "a smaller, rounder or smoother body converges".to_owned(),
        })
    }

    /// The orders of a body of revolution of the size parameter `x`.
    pub(crate) fn of_body(node: &ParameterNode, x: f64) -> Result<Self, ParameterError> {
        let orders = Self::read(node, super::terms(x))?;
        let remedy = format!("{} (its size parameter is {x:.3})", orders.remedy);
        Ok(Self { low_first: true, remedy, ..orders })
    }

    /// The same for a sequence that need not converge, in which two results may agree by chance.
    pub(crate) fn asymptotic(self, remedy: String) -> Self {
        Self { remedy, margin: CHANCE, ..self }
    }
}

/// Two results and their distance.
struct Compared<T> {
    fine: T,
    coarse: T,
    error: f64,
}

/// The results for orders up to `l` and some more.
fn compare<T>(
    l: usize,
    m_max: usize,
    compute: &impl Fn(Level) -> Option<T>,
    distance: &impl Fn(&T, &T) -> f64,
) -> Option<Compared<T>> {
    let fine = compute(Level { l_max: above(l), m_max, is_fine: true })?;
    let coarse = compute(Level { l_max: l, m_max, is_fine: false })?;
    let error = distance(&fine, &coarse);
    Some(Compared { fine, coarse, error: if error.is_nan() { f64::INFINITY } else { error } })
}

/// The orders l of the finer one of two results.
fn above(l: usize) -> usize {
    (l + step(l)).min(MOST)
}

/// The best of a sequence of orders.
struct Found<T> {
    compared: Compared<T>,
    l: usize,
    /// Multiple of the distance that all following orders add up to where convergence is slow.
    rest: f64,
}

/// The best that `compute` gives for orders m up to `m_max`.
fn search<T>(
    orders: &Orders,
    m_max: usize,
    compute: &impl Fn(Level) -> Option<T>,
    distance: &impl Fn(&T, &T) -> f64,
) -> Option<Found<T>> {
    let mut best: Option<Found<T>> = None;
    let (mut l, mut before) = (orders.start, None::<(usize, f64)>);
    for _ in 0..ATTEMPTS {
        crate::interrupt::check();
        let high = above(l);
        let Some(compared) = compare(l, m_max, compute, distance) else { break };
        let error = compared.error;
        // Where convergence is slow, all that follows is more than one step of it.
        let rest = before.map_or(1.0, |(from, last)| {
            let per_step = (error / last).powf((high - l) as f64 / (l - from) as f64);
            if per_step < 1.0 { (1.0 - per_step).recip() } else { 1.0 }
        });
        let smallest = best.as_ref().map_or(f64::INFINITY, |best| best.compared.error);
        if error < smallest {
            best = Some(Found { compared, l, rest });
        }
        // Beyond the reach of the arithmetic more orders make it worse.
        if error < AIM || error > 4.0 * smallest || orders.is_fixed || high >= MOST {
            break;
        }
        before = Some((l, error));
        l = (high + step(high) / 2).min(MOST - step(MOST));
    }
    best
}

/// The best that `compute` gives, by the `distance` of two results relative to their size.
///
/// # Errors
///
/// If the error stays above one per cent: at the parameter `lmax`.
pub(crate) fn converged<T>(
    node: &ParameterNode,
    orders: &Orders,
    compute: impl Fn(Level) -> Option<T>,
    distance: impl Fn(&T, &T) -> f64,
) -> Result<T, ParameterError> {
    let overflow =
        || ParameterError::new("lmax", "too many multipoles for this body: they overflow");
    let low = if orders.low_first { LOW } else { usize::MAX };
    let mut found = search(orders, low, &compute, &distance).ok_or_else(overflow)?;
    if orders.low_first && found.compared.error <= HOPEFUL * REFUSED {
        found.compared = compare(found.l, usize::MAX, &compute, &distance).ok_or_else(overflow)?;
    }
    let Found { compared: Compared { fine, coarse, error }, l, rest } = found;
    let error = if error < AIM { error } else { error * rest.max(orders.margin) };
    if error > REFUSED {
        let fixed = if orders.is_fixed { "lmax = 0 takes as many as needed; " } else { "" };
        let problem = format!(
            "out of reach: with l up to {} the amplitudes of this body are known to {error:.1e} of \
             their size only; {fixed}{}",
            above(l),
            orders.remedy
        );
        return Err(ParameterError::new("lmax", problem));
    }
    if error > STATED {
        node.note_limit(ModelLimit::Unconverged { millionths: (error * 1e6).ceil() as u32 });
    }
    Ok(if orders.is_fixed { coarse } else { fine })
}

/// By how many orders the two results differ.
fn step(l: usize) -> usize {
    3 + l / 12
}

/// The distance of two results of blocks by m, relative to the size of the first one; every wave
/// counts with its power.
pub(crate) fn distance<'a>(
    a: impl Iterator<Item = (usize, &'a ComplexMatrix)>,
    b: impl Iterator<Item = (usize, &'a ComplexMatrix)>,
) -> f64 {
    let (mut difference, mut size) = (0.0, 0.0);
    let mut others = b;
    for (m, block) in a {
        let other = others.next().map(|(_, other)| other);
        let l_min = Harmonics::l_min(m);
        let degeneracy = if m == 0 { 1.0 } else { 2.0 };
        let half = |matrix: &ComplexMatrix| (matrix.nrows() / 2, matrix.ncols() / 2);
        let (rows, columns) = half(block);
        let strength = |l: usize| (l * (l + 1)) as f64;
        for column in 0..2 * columns {
            for row in 0..2 * rows {
                let (to, from) = (row % rows, column % columns);
                let value = block[(row, column)];
                let opposite = other.map_or(Complex64::ZERO, |other| {
                    let (other_rows, other_columns) = half(other);
                    if to >= other_rows || from >= other_columns {
                        return Complex64::ZERO;
                    }
                    other[(row / rows * other_rows + to, column / columns * other_columns + from)]
                });
                let weight = degeneracy * strength(l_min + to) / strength(l_min + from);
                difference += weight * (value - opposite).norm_sqr();
                size += weight * value.norm_sqr();
            }
        }
    }
    (difference / size).sqrt()
}

/// The T-matrix of `shape` at a level.
pub(crate) fn at_level(
    node: &ParameterNode,
    shape: &Shape,
    index: Complex64,
    k: f64,
    m_max: usize,
    level: Level,
) -> Option<TMatrix> {
    let orders = (level.l_max, m_max.min(level.m_max).min(level.l_max));
    if let Some(spheroid) = shape.spheroid() {
        if spheroid.aspect() == 1.0 {
            let series = layered::coefficients(&[(index, k * spheroid.vertical)], orders.0);
            return Some(TMatrix::sphere(&series).truncated(orders.1));
        }
        let nodes = 40.0 + 20.0 * spheroid.aspect().sqrt() + 1.5 * level.l_max as f64;
        let nodes = if level.is_fine { nodes } else { 0.8 * nodes };
        return TMatrix::of_spheroid(spheroid, index, k, orders, nodes as usize);
    }
    /// The most nodes of an outline.
    const MOST_POINTS: usize = 10_000;
    let outline = node.child("Shape");
    let points = (outline.integer("npoints").max(1) as usize).max(4 * level.l_max);
    let points = if level.is_fine { 2 * points } else { points + points / 2 };
    let points = ParameterValue::Integer(points.min(MOST_POINTS) as i32);
    let shape = spec::build::<Shape>(&outline.clone().with("npoints", points).ok()?).ok()?;
    TMatrix::of_revolution(&shape, index, k, orders.0, orders.1)
}
