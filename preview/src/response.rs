//! The light of a surface point under a distant lamp, as a function of its normal.
//!
//! Camera and lamp are distant, so their directions are fixed and the light of a point depends on its
//! normal alone, for isotropic and for anisotropic materials. The function
//!
//! $$ g(n) = R_c\, f(n)\, R_l\, S \cos\theta_i \cos\theta_s $$
//!
//! with its four Stokes components in XYZ is tabulated over the azimuthal equidistant map of the
//! normal (distance from the centre: its angle to the view) in squares. Each square has nine values,
//! interpolated by a polynomial of second degree in both coordinates. A square is divided until the
//! polynomial equals g at the centres of its four quarters within [`TOLERANCE`] of I, or of the I of
//! a body with the reflectance [`DARK`] if that is more. Squares that the horizon of lamp or camera
//! crosses, and squares beyond the limits of depth and number, hold no values: there each sample is
//! evaluated.

use std::{
    collections::VecDeque,
    f64::consts::{FRAC_PI_2, PI},
};

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use spectra::Xyz;

/// Relative error of the interpolation.
const TOLERANCE: f64 = 1e-3;
/// Reflectance below which the error is relative to a body of this reflectance.
const DARK: f64 = 0.02;
/// Root squares across the map.
const ACROSS: usize = 16;
/// Maximum depth of a tree.
const DEEPEST: u32 = 8;
/// Maximum depth of squares that a horizon crosses.
const AT_HORIZON: u32 = 4;

/// XYZ of I, Q, U and V.
type StokesXyz = [Xyz; 4];

/// The function of the normal for one lamp.
#[derive(Debug)]
pub(crate) struct NormalResponse {
    toward: DVec3,
    /// Trees of squares, row by row; the first square of a tree is its root.
    trees: Vec<Vec<MapSquare>>,
}

#[derive(Debug)]
enum MapSquare {
    /// The first of four quarters.
    Divided(usize),
    /// Values on 3 × 3 points, row by row.
    Smooth(Box<[StokesXyz; 9]>),
    /// No values: every sample is evaluated.
    Rough,
}

/// A square of the map that is not yet judged, with its values if they are known.
struct OpenSquare {
    low: DVec2,
    side: f64,
    depth: u32,
    values: Option<[StokesXyz; 9]>,
}

impl NormalResponse {
    /// Tabulates the function for a lamp in the direction `toward`; `evaluate` gives its values at
    /// normals, without the cosines, and is called for about `most` normals at most.
    pub(crate) fn new(
        toward: DVec3,
        most: usize,
        evaluate: &(impl Fn(&[DVec3]) -> Vec<StokesXyz> + Sync),
    ) -> Self {
        // A square needs sixteen normals at most and seven on average.
        let squares = most / (8 * ACROSS * ACROSS);
        let builder = TreeBuilder { toward, squares, evaluate };
        let trees = (0..ACROSS * ACROSS).into_par_iter().map(|k| builder.tree(k)).collect();
        Self { toward, trees }
    }

    /// f cos θ_i at a normal; none where the sample has to be evaluated.
    pub(crate) fn at(&self, normal: DVec3) -> Option<StokesXyz> {
        let scale = normal.z * normal.dot(self.toward);
        if normal.z <= 0.0 || scale <= 0.0 {
            return None;
        }
        let unit = (map_point(normal) / PI + 0.5) * ACROSS as f64;
        let first = unit.floor().clamp(DVec2::ZERO, DVec2::splat(ACROSS as f64 - 1.0));
        let tree = &self.trees[first.y as usize * ACROSS + first.x as usize];
        let (mut index, mut at) = (0, unit - first);
        loop {
            match &tree[index] {
                MapSquare::Rough => return None,
                MapSquare::Smooth(values) => {
                    return Some(interpolated(values, at).map(|xyz| xyz * normal.z.recip()));
                }
                MapSquare::Divided(quarters) => {
                    let half = (2.0 * at).floor().clamp(DVec2::ZERO, DVec2::ONE);
                    index = quarters + 2 * half.y as usize + half.x as usize;
                    at = 2.0 * at - half;
                }
            }
        }
    }
}

/// Builds the trees of a [`NormalResponse`].
struct TreeBuilder<'a, F> {
    toward: DVec3,
    squares: usize,
    evaluate: &'a F,
}

impl<F: Fn(&[DVec3]) -> Vec<StokesXyz> + Sync> TreeBuilder<'_, F> {
    /// The tree of root square `number`; large squares are divided before small ones.
    fn tree(&self, number: usize) -> Vec<MapSquare> {
        let side = PI / ACROSS as f64;
        let [x, y] = [number % ACROSS, number / ACROSS].map(|k| k as f64 * side - FRAC_PI_2);
        let mut tree = vec![MapSquare::Rough];
        let first = OpenSquare { low: DVec2::new(x, y), side, depth: 0, values: None };
        let mut waiting = VecDeque::from([(0, first)]);
        while let Some((index, square)) = waiting.pop_front() {
            if tree.len() > self.squares {
                break;
            }
            let quarters = match self.judge(&square) {
                SquareVerdict::Keep(square) => {
                    tree[index] = square;
                    continue;
                }
                SquareVerdict::Divide(quarters) => quarters,
            };
            tree[index] = MapSquare::Divided(tree.len());
            for quarter in *quarters {
                waiting.push_back((tree.len(), quarter));
                tree.push(MapSquare::Rough);
            }
        }
        tree
    }

    fn judge(&self, square: &OpenSquare) -> SquareVerdict {
        let points: [DVec2; 9] = std::array::from_fn(|k| square.point([k % 3, k / 3], 2));
        let valid = points.iter().filter(|point| self.is_lit(**point)).count();
        if valid < 9 {
            let is_last = square.depth == AT_HORIZON || valid == 0 && square.depth > 1;
            let quarters = || SquareVerdict::Divide(square.quarters(None));
            return if is_last { SquareVerdict::Keep(MapSquare::Rough) } else { quarters() };
        }
        let values = square.values.unwrap_or_else(|| self.values(points));
        let tests = [[1, 1], [3, 1], [1, 3], [3, 3]];
        let found = self.values(tests.map(|at| square.point(at, 4)));
        let is_met = tests.iter().zip(&found).all(|(at, found)| {
            let expected = interpolated(&values, DVec2::new(at[0] as f64, at[1] as f64) / 4.0);
            self.is_near(&expected, found, normal(square.point(*at, 4)))
        });
        match (is_met, square.depth) {
            (true, _) => SquareVerdict::Keep(MapSquare::Smooth(Box::new(values))),
            (false, DEEPEST) => SquareVerdict::Keep(MapSquare::Rough),
            (false, _) => {
                SquareVerdict::Divide(square.quarters(Some(self.lattice(square, &values, found))))
            }
        }
    }

    /// Values on 5 × 5 points; those of the square and of its tests are known.
    fn lattice(
        &self,
        square: &OpenSquare,
        known: &[StokesXyz; 9],
        tests: [StokesXyz; 4],
    ) -> [StokesXyz; 25] {
        let new: [[usize; 2]; 12] = {
            let mut odd = (0..25).map(|k| [k % 5, k / 5]).filter(|at| (at[0] + at[1]) % 2 == 1);
            std::array::from_fn(|_| odd.next().expect("12 points of 25 have an odd sum"))
        };
        let mut new = self.values(new.map(|at| square.point(at, 4))).into_iter();
        std::array::from_fn(|k| match [k % 5, k / 5] {
            [x, y] if (x + y) % 2 == 1 => new.next().expect("in the order of the points"),
            [x, y] if x % 2 == 1 => tests[y / 2 * 2 + x / 2],
            [x, y] => known[y / 2 * 3 + x / 2],
        })
    }

    fn values<const N: usize>(&self, points: [DVec2; N]) -> [StokesXyz; N] {
        let normals = points.map(normal);
        let seen = (self.evaluate)(&normals);
        std::array::from_fn(|k| {
            seen[k].map(|xyz| xyz * (normals[k].z * normals[k].dot(self.toward)))
        })
    }

    /// True if lamp and camera are above the horizon of the normal.
    fn is_lit(&self, point: DVec2) -> bool {
        point.length() < FRAC_PI_2 && normal(point).dot(self.toward) > 0.0
    }

    fn is_near(&self, expected: &StokesXyz, found: &StokesXyz, normal: DVec3) -> bool {
        let dark = DARK / PI * normal.z * normal.dot(self.toward);
        let size = |xyz: &Xyz| xyz.x.abs().max(xyz.y.abs()).max(xyz.z.abs());
        let most = TOLERANCE * size(&found[0]).max(dark);
        expected.iter().zip(found).all(|(a, b)| size(&(*a - *b)) <= most)
    }
}

/// The result of judging a square.
enum SquareVerdict {
    Keep(MapSquare),
    Divide(Box<[OpenSquare; 4]>),
}

impl OpenSquare {
    /// The point of column and row on a lattice of `parts` parts.
    fn point(&self, at: [usize; 2], parts: usize) -> DVec2 {
        self.low + self.side / parts as f64 * DVec2::new(at[0] as f64, at[1] as f64)
    }

    /// The four quarters; their values are on a lattice of 5 × 5 points.
    fn quarters(&self, lattice: Option<[StokesXyz; 25]>) -> Box<[Self; 4]> {
        Box::new(std::array::from_fn(|q| {
            let [x, y] = [q % 2, q / 2];
            let pick = |k: usize, all: &[StokesXyz; 25]| all[(2 * y + k / 3) * 5 + 2 * x + k % 3];
            Self {
                low: self.point([x, y], 2),
                side: self.side / 2.0,
                depth: self.depth + 1,
                values: lattice.map(|all| std::array::from_fn(|k| pick(k, &all))),
            }
        }))
    }
}

/// The polynomial through nine values, at a point of the unit square.
fn interpolated(values: &[StokesXyz; 9], at: DVec2) -> StokesXyz {
    let weights = |t: f64| [(1.0 - t) * (1.0 - 2.0 * t), 4.0 * t * (1.0 - t), t * (2.0 * t - 1.0)];
    let (across, down) = (weights(at.x), weights(at.y));
    let mut sum = [Xyz::new(0.0, 0.0, 0.0); 4];
    for (k, value) in values.iter().enumerate() {
        let weight = across[k % 3] * down[k / 3];
        for (sum, xyz) in sum.iter_mut().zip(value) {
            *sum += *xyz * weight;
        }
    }
    sum
}

/// The point of a normal on the map.
fn map_point(normal: DVec3) -> DVec2 {
    let across = normal.truncate();
    let sin = across.length();
    if sin > 0.0 { sin.atan2(normal.z) / sin * across } else { DVec2::ZERO }
}

/// The normal of a point of the map.
fn normal(point: DVec2) -> DVec3 {
    let angle = point.length();
    let (sin, cos) = angle.sin_cos();
    let across = if angle > 0.0 { sin / angle * point } else { DVec2::ZERO };
    across.extend(cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A lobe of the width 0.1 around the half-way direction, partly polarized, on a grey body.
    fn lobe(normals: &[DVec3], toward: DVec3) -> Vec<StokesXyz> {
        let half = (toward + DVec3::Z).normalize();
        let value = |n: &DVec3| {
            let lobe = (-(1.0 - n.dot(half)) / 0.005).exp() + 0.05;
            [1.0, 0.5 * n.x, 0.5 * n.y, 0.0].map(|part| Xyz::new(1.0, 1.0, 0.5) * (lobe * part))
        };
        normals.iter().map(value).collect()
    }

    #[test]
    fn values_between_are_as_near_as_stated_and_few_samples_are_evaluated() {
        let toward = DVec3::new(0.3, 0.6, 0.8).normalize();
        let response =
            NormalResponse::new(toward, 1 << 19, &|normals: &[DVec3]| lobe(normals, toward));
        let (mut asked, mut known) = (0, 0);
        for k in 0..40_000 {
            let [x, y] = [k % 200, k / 200].map(|i| (f64::from(i) + 0.37) / 100.0 - 1.0);
            let Some(z) = Some(1.0 - x * x - y * y).filter(|z| *z > 0.0).map(f64::sqrt) else {
                continue;
            };
            let normal = DVec3::new(x, y, z);
            let cos = normal.dot(toward);
            if cos <= 0.0 {
                continue;
            }
            asked += 1;
            let Some(found) = response.at(normal) else { continue };
            known += 1;
            for (a, b) in found.iter().zip(&lobe(&[normal], toward)[0]) {
                // Twice what is tested at four points of each square.
                let most = 2.0 * TOLERANCE * cos * lobe(&[normal], toward)[0][0].y;
                assert!((a.y - b.y * cos).abs() <= most, "{normal} {} {}", a.y, b.y * cos);
            }
        }
        assert!(f64::from(known) > 0.95 * f64::from(asked), "{known} of {asked}");
    }

    #[test]
    fn a_small_picture_is_evaluated_without_a_table() {
        let response = NormalResponse::new(DVec3::Z, 1000, &|_: &[DVec3]| unreachable!());
        assert_eq!(response.at(DVec3::Z), None);
    }

    #[test]
    fn the_map_brings_normals_back() {
        for n in [DVec3::Z, DVec3::new(0.6, 0.0, 0.8), DVec3::new(-0.48, 0.6, 0.64)] {
            assert!((normal(map_point(n)) - n).length() < 1e-15);
        }
    }
}
