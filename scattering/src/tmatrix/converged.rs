//! T-matrices that know how good they are.
//!
//! A truncated null-field system has no bound of its error. Here every result is computed twice,
//! with different orders and at different nodes: the distance of the two, relative to their size, is
//! the error that truncation, quadrature and rounding leave together. The orders rise until it is
//! small; what stays is stated or, above one per cent, refused.

use num_complex::Complex64;

use super::{ComplexMatrix, MOST, TMatrix};
use crate::{
    ModelLimit, ParameterError, ParameterNode, ParameterValue, shape::Shape, spec,
    special::harmonics::Harmonics,
};

/// Relative error of amplitudes at which the orders need not rise further.
const AIM: f64 = 1e-7;
/// Relative error from which on a result says so.
const STATED: f64 = 1e-4;
/// Relative error above which a result is refused.
const REFUSED: f64 = 1e-2;
/// Number of times that the orders are raised.
const ATTEMPTS: usize = 4;

/// One of the two computations: orders up to `l_max`, at many nodes or at fewer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Level {
    /// The largest l.
    pub l_max: usize,
    /// True for the more accurate one of the two.
    pub is_fine: bool,
}

/// The number of orders to start with, and whether it is all that may be taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Orders {
    start: usize,
    is_fixed: bool,
}

impl Orders {
    /// The largest l to start with.
    pub(crate) fn start(&self) -> usize {
        self.start
    }

    /// The orders that the parameter `lmax` asks for where the size needs `needed`.
    pub(crate) fn read(node: &ParameterNode, needed: usize) -> Result<Self, ParameterError> {
        let asked = node.integer("lmax");
        Ok(Self { start: super::l_max(node, needed)?, is_fixed: asked > 0 })
    }
}

/// The best that `compute` gives, by the `distance` of two results relative to their size.
///
/// # Errors
///
/// If the error stays above one per cent: at the parameter `lmax`.
pub(crate) fn converged<T>(
    node: &ParameterNode,
    orders: Orders,
    compute: impl Fn(Level) -> Option<T>,
    distance: impl Fn(&T, &T) -> f64,
) -> Result<T, ParameterError> {
    let mut best: Option<(T, f64)> = None;
    let (mut l, mut before) = (orders.start, None::<(usize, f64)>);
    for _ in 0..ATTEMPTS {
        crate::interrupt::check();
        let high = (l + step(l)).min(MOST);
        let fine = Level { l_max: high, is_fine: true };
        let coarse = Level { l_max: l, is_fine: false };
        let (Some(a), Some(b)) = (compute(fine), compute(coarse)) else { break };
        let error = distance(&a, &b);
        let error = if error.is_nan() { f64::INFINITY } else { error };
        // Where convergence is slow, all that follows is more than one step of it.
        let rest = before.map_or(1.0, |(from, last)| {
            let per_step = (error / last).powf((high - l) as f64 / (l - from) as f64);
            if per_step < 1.0 { (1.0 - per_step).recip() } else { 1.0 }
        });
        let smallest = best.as_ref().map_or(f64::INFINITY, |best| best.1);
        if error < smallest {
            let result = if orders.is_fixed { b } else { a };
            best = Some((result, if error < AIM { error } else { error * rest }));
        }
        // Beyond the reach of the arithmetic more orders make it worse.
        if error < AIM || error > 4.0 * smallest || orders.is_fixed || high >= MOST {
            break;
        }
        before = Some((l, error));
        l = (high + step(high) / 2).min(MOST - step(MOST));
    }
    let Some((result, error)) = best else {
        return Err(ParameterError::new(
            "lmax",
            "too many multipoles for this body: they overflow",
        ));
    };
    if error > REFUSED {
        let remedy = if orders.is_fixed { "; lmax = 0 takes as many as needed" } else { "" };
        let problem = format!(
            "out of reach: with l up to {l} the amplitudes of this body are known to {error:.1e} of \
             their size only{remedy}; a smaller, rounder or smoother body converges"
        );
        return Err(ParameterError::new("lmax", problem));
    }
    if error > STATED {
        node.note_limit(ModelLimit::Unconverged { millionths: (error * 1e6).ceil() as u32 });
    }
    Ok(result)
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
    let orders = (level.l_max, m_max.min(level.l_max));
    if let Some(spheroid) = shape.spheroid() {
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
