//! Real functions of one variable: constants, tabulated points, formulas.

use std::{fmt, sync::Arc};

/// A function of one variable given by a formula.
pub type FormulaFn = Arc<dyn Fn(f64) -> f64 + Send + Sync>;

/// Scale of the abscissa between two points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AbscissaScale {
    /// Linear.
    #[default]
    Linear,
    /// Logarithmic.
    Log,
}

/// Interpolation of the ordinate between two points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TableInterpolation {
    /// Straight line.
    #[default]
    Linear,
    /// Straight line of the logarithm.
    Log,
    /// Cubic Hermite with the slopes of parabolas; slope 0 at both ends.
    Spline,
    /// The same for the logarithm.
    LogSpline,
}

/// A real function of one variable.
#[derive(Clone)]
pub enum RealFunction {
    /// The same value everywhere.
    Constant(f64),
    /// Points; outside their range the end values are held.
    Points(Arc<TabulatedPoints>),
    /// A formula.
    Formula(FormulaFn),
}

/// Tabulated points, prepared for interpolation.
#[derive(Debug)]
pub struct TabulatedPoints {
    /// Points as given, sorted by (x, y).
    points: Vec<(f64, f64)>,
    /// The first point of the file, whose ordinate its abscissa returns exactly.
    first: (f64, f64),
    /// Abscissae and ordinates on the scales of interpolation.
    scaled: Vec<(f64, f64)>,
    /// Slopes at the nodes for the splines.
    slopes: Vec<f64>,
    axis: AbscissaScale,
    rise: TableInterpolation,
}

impl fmt::Debug for RealFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => write!(f, "{value}"),
            Self::Points(points) => write!(f, "table of {} points", points.points.len()),
            Self::Formula(_) => write!(f, "formula"),
        }
    }
}

impl RealFunction {
    /// The same value everywhere.
    pub fn constant(value: f64) -> Self {
        Self::Constant(value)
    }

    /// Points in the order of their file; they are sorted by (x, y) here. One point is a constant.
    ///
    /// # Panics
    ///
    /// If there are no points.
    pub fn points(rows: &[(f64, f64)], axis: AbscissaScale, rise: TableInterpolation) -> Self {
        let first = *rows.first().expect("a table has at least one point");
        if rows.len() == 1 {
            return Self::Constant(first.1);
        }
        let mut points = rows.to_vec();
        points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        // A parabola needs three points.
        let rise = match rise {
            TableInterpolation::Spline if points.len() < 3 => TableInterpolation::Linear,
            TableInterpolation::LogSpline if points.len() < 3 => TableInterpolation::Log,
            other => other,
        };
        let scaled: Vec<_> =
            points.iter().map(|&(x, y)| (scale_x(axis, x), scale_y(rise, y))).collect();
        let slopes = match rise {
            TableInterpolation::Spline | TableInterpolation::LogSpline => parabola_slopes(&scaled),
            TableInterpolation::Linear | TableInterpolation::Log => Vec::new(),
        };
        Self::Points(Arc::new(TabulatedPoints { points, first, scaled, slopes, axis, rise }))
    }

    /// The value at `x`.
    pub fn at(&self, x: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Points(points) => points.at(x),
            Self::Formula(f) => f(x),
        }
    }

    /// The constant or the tabulated values; none of a formula.
    pub(crate) fn ordinates(&self) -> impl Iterator<Item = f64> {
        let (constant, points) = match self {
            Self::Constant(value) => (Some(*value), &[][..]),
            Self::Points(p) => (None, &p.points[..]),
            Self::Formula(_) => (None, &[][..]),
        };
        constant.into_iter().chain(points.iter().map(|point| point.1))
    }

    /// True if the function is negative at a point or, for a spline, between two points.
    pub(crate) fn dips_below_zero(&self) -> bool {
        /// Places that are looked at between two points.
        const STEPS: u32 = 32;
        if self.ordinates().any(|value| value < 0.0) {
            return true;
        }
        let Self::Points(p) = self else { return false };
        let between = |pair: &[(f64, f64)]| {
            let (from, to) = (pair[0].0, pair[1].0);
            (1..STEPS).any(|i| self.at(from + (to - from) * f64::from(i) / f64::from(STEPS)) < 0.0)
        };
        p.rise == TableInterpolation::Spline && p.points.windows(2).any(between)
    }

    /// True if every value between two points is finite.
    pub(crate) fn can_interpolate(&self) -> bool {
        let Self::Points(p) = self else { return true };
        let scaled = p.scaled.iter().flat_map(|point| [point.0, point.1]);
        p.points
            .iter()
            .map(|point| point.0)
            .chain(scaled)
            .chain(p.slopes.iter().copied())
            .all(f64::is_finite)
    }

    /// The number of tabulated points and their range, or nothing for constants and formulas.
    pub fn extent(&self) -> Option<(usize, f64, f64)> {
        match self {
            Self::Points(p) => {
                Some((p.points.len(), p.points[0].0, p.points[p.points.len() - 1].0))
            }
            Self::Constant(_) | Self::Formula(_) => None,
        }
    }
}

impl TabulatedPoints {
    fn at(&self, x: f64) -> f64 {
        let last = self.points.len() - 1;
        if x == self.first.0 {
            return self.first.1;
        }
        if x <= self.points[0].0 {
            return self.points[0].1;
        }
        if x >= self.points[last].0 {
            return self.points[last].1;
        }
        // x_j ≤ x < x_{j+1}
        let j = self.points.partition_point(|p| p.0 <= x) - 1;
        let ((x0, y0), (x1, y1)) = (self.scaled[j], self.scaled[j + 1]);
        let h = x1 - x0;
        let t = (scale_x(self.axis, x) - x0) / h;
        let straight = y0 + (y1 - y0) * t;
        match self.rise {
            TableInterpolation::Linear => straight,
            TableInterpolation::Log => straight.exp(),
            TableInterpolation::Spline => self.hermite(j, t, h),
            TableInterpolation::LogSpline => self.hermite(j, t, h).exp(),
        }
    }

    fn hermite(&self, j: usize, t: f64, h: f64) -> f64 {
        let (y0, y1) = (self.scaled[j].1, self.scaled[j + 1].1);
        let (m0, m1) = (self.slopes[j] * h, self.slopes[j + 1] * h);
        let (t2, t3) = (t * t, t * t * t);
        (2.0 * t3 - 3.0 * t2 + 1.0) * y0
            + (t3 - 2.0 * t2 + t) * m0
            + (3.0 * t2 - 2.0 * t3) * y1
            + (t3 - t2) * m1
    }
}

fn scale_x(axis: AbscissaScale, x: f64) -> f64 {
    match axis {
        AbscissaScale::Linear => x,
        AbscissaScale::Log => x.ln(),
    }
}

fn scale_y(rise: TableInterpolation, y: f64) -> f64 {
    match rise {
        TableInterpolation::Linear | TableInterpolation::Spline => y,
        TableInterpolation::Log | TableInterpolation::LogSpline => y.ln(),
    }
}

/// At each inner node the derivative of the parabola through it and its neighbours; 0 at the ends.
fn parabola_slopes(p: &[(f64, f64)]) -> Vec<f64> {
    let mut slopes = vec![0.0; p.len()];
    for j in 1..p.len() - 1 {
        let (left, right) = (p[j].0 - p[j - 1].0, p[j + 1].0 - p[j].0);
        let (rise_left, rise_right) = ((p[j].1 - p[j - 1].1) / left, (p[j + 1].1 - p[j].1) / right);
        slopes[j] = (rise_left * right + rise_right * left) / (left + right);
    }
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(rise: TableInterpolation) -> RealFunction {
        RealFunction::points(
            &[(1.0, 1.0), (2.0, 4.0), (4.0, 2.0), (5.0, 3.0)],
            AbscissaScale::Linear,
            rise,
        )
    }

    #[test]
    fn end_values_are_held_outside_the_range() {
        for rise in [
            TableInterpolation::Linear,
            TableInterpolation::Log,
            TableInterpolation::Spline,
            TableInterpolation::LogSpline,
        ] {
            assert_eq!(table(rise).at(-3.0), 1.0);
            assert_eq!(table(rise).at(9.0), 3.0);
        }
    }

    #[test]
    fn every_interpolation_passes_through_the_points() {
        for rise in [
            TableInterpolation::Linear,
            TableInterpolation::Log,
            TableInterpolation::Spline,
            TableInterpolation::LogSpline,
        ] {
            for (x, y) in [(1.0, 1.0), (2.0, 4.0), (4.0, 2.0), (5.0, 3.0)] {
                assert!((table(rise).at(x) - y).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn the_log_axis_is_straight_in_the_logarithm_of_x() {
        let t = RealFunction::points(
            &[(1.0, 0.0), (100.0, 2.0)],
            AbscissaScale::Log,
            TableInterpolation::Linear,
        );
        assert!((t.at(10.0) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_first_row_of_the_file_wins_at_its_own_abscissa() {
        let t = RealFunction::points(
            &[(2.0, 7.0), (2.0, 1.0), (3.0, 0.0)],
            AbscissaScale::Linear,
            TableInterpolation::Linear,
        );
        assert_eq!(t.at(2.0), 7.0);
    }
}
