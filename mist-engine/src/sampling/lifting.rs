//! Points of the plane are put on the sphere, and those that belong to the region are kept: most
//! are kept or left several at once, by the cells of the region's polygon.

use glam::{DVec2, DVec3};
use scattering::{
    Direction,
    lanes::{LaneKernel, Real, SimdLevel, WIDTH, dispatch},
};

use super::{points::PlanePoints, projection::Projection};
use crate::region::{AxisRotation, CellContent, Polygon, PolygonCells};

/// Condition for a direction of the cone to belong to the region.
#[derive(Clone, Debug)]
pub(super) enum Membership {
    /// Nothing: the region is the cone.
    Cone,
    /// To be inside of a polygon.
    Polygon(Polygon),
    /// To be outside of the cone with this axis and cosine.
    Outside { axis: DVec3, cos: f64 },
    /// The region is one direction, laid out without a cone.
    One(Direction),
}

/// Unit vectors with their weights, part by part; there is room behind the last one.
#[derive(Debug, Default)]
pub(super) struct Lifted {
    count: usize,
    v: [Vec<f64>; 3],
    /// Weight of the projection, times cos θ.
    weights: Vec<f64>,
}

/// A point about which has to be asked.
#[derive(Clone, Copy)]
pub(super) struct UndecidedPoint {
    /// In the plane.
    pub(super) plane: DVec2,
    /// On the sphere.
    pub(super) v: DVec3,
    /// Weight of the projection.
    pub(super) weight: f64,
}

/// Known position of points.
pub(super) struct PointClassifier<'a> {
    projection: Projection,
    frame: &'a AxisRotation,
    inside: &'a Membership,
    /// By number: the first tells nothing, the last is outside.
    verdicts: &'a [CellContent],
}

/// The verdicts where there are no cells, and their numbers.
const WITHOUT_CELLS: &[CellContent] =
    &[CellContent::Edges, CellContent::Inside, CellContent::Outside];
const ASK: f64 = 0.0;
const INSIDE: f64 = 1.0;
const OUTSIDE: f64 = 2.0;

impl<'a> PointClassifier<'a> {
    /// About points that `projection` puts on a cone with this frame and that are to lie `inside`.
    pub(super) fn new(
        projection: Projection,
        frame: &'a AxisRotation,
        inside: &'a Membership,
    ) -> Self {
        let verdicts = inside.cells().map_or(WITHOUT_CELLS, PolygonCells::all);
        Self { projection, frame, inside, verdicts }
    }

    /// The numbers of the verdicts on points.
    #[inline(always)]
    fn numbers<R: Real>(&self, plane: [R; 2], [x, y, z]: [R; 3]) -> R {
        let above = match (self.inside, self.inside.cells()) {
            (_, Some(cells)) => cells.number([x, y]),
            (Membership::Cone, _) => z.splat(INSIDE),
            (Membership::Outside { axis, cos }, _) => {
                let to_axis = x * axis.x + y * axis.y + z * axis.z;
                (-to_axis + *cos).select(z.splat(INSIDE), z.splat(OUTSIDE))
            }
            (Membership::Polygon(_) | Membership::One(_), None) => z.splat(ASK),
        };
        let outside = z.splat((self.verdicts.len() - 1) as f64);
        let clearance = self.projection.clearance(plane, z);
        clearance.select(z.select(above, outside), z.splat(ASK))
    }
}

impl Membership {
    fn cells(&self) -> Option<&PolygonCells> {
        match self {
            Self::Polygon(polygon) => polygon.cells(),
            Self::Cone | Self::Outside { .. } | Self::One(_) => None,
        }
    }
}

impl Lifted {
    /// Becomes the points that belong to the region. `ask` returns the unit vectors of those about
    /// which nothing is known and their weights times cos θ, if they belong to it.
    pub(super) fn fill(
        &mut self,
        points: &mut PlanePoints,
        known: &PointClassifier<'_>,
        ask: impl FnMut(UndecidedPoint) -> Option<(DVec3, f64)>,
    ) {
        let whole = points.count().next_multiple_of(WIDTH);
        self.v.iter_mut().chain([&mut self.weights]).for_each(|part| part.resize(whole, 0.0));
        self.count = 0;
        dispatch(Lifting { points, known, ask, lifted: self });
    }

    /// Number of terms.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The unit vectors and their weights in groups; what fills up the last one means nothing.
    pub(super) fn groups(&self) -> impl Iterator<Item = ([&[f64; WIDTH]; 3], &[f64; WIDTH])> {
        let [x, y, z] = self.v.each_ref().map(|part| part.as_chunks().0);
        let v = x.iter().zip(y).zip(z).map(|((x, y), z)| [x, y, z]);
        v.zip(self.weights.as_chunks().0).take(self.count.div_ceil(WIDTH))
    }

    #[inline(always)]
    fn push(&mut self, v: DVec3, weight: f64) {
        (self.v[0][self.count], self.v[1][self.count], self.v[2][self.count]) = v.into();
        self.weights[self.count] = weight;
        self.count += 1;
    }

    #[inline(always)]
    fn push_group<V: SimdLevel>(&mut self, vectors: V, v: [V::Vector; 3], weights: V::Vector) {
        let place = self.count..self.count + WIDTH;
        for (part, v) in self.v.iter_mut().zip(v) {
            part[place.clone()].copy_from_slice(&vectors.store(v));
        }
        self.weights[place].copy_from_slice(&vectors.store(weights));
        self.count += WIDTH;
    }
}

struct Lifting<'a, F> {
    points: &'a mut PlanePoints,
    known: &'a PointClassifier<'a>,
    ask: F,
    lifted: &'a mut Lifted,
}

impl<F: FnMut(UndecidedPoint) -> Option<(DVec3, f64)>> LaneKernel for Lifting<'_, F> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, vectors: V) {
        let Self { points, known, mut ask, lifted } = self;
        let mut left = points.count();
        for (px, py) in points.groups() {
            let plane = [vectors.load(px), vectors.load(py)];
            let (u, weight) = known.projection.lift(plane[0], plane[1]);
            let v = known.frame.turn(u);
            let numbers = vectors.store(known.numbers(plane, v));
            let mut verdicts = [CellContent::Edges; WIDTH];
            for (verdict, number) in verdicts.iter_mut().zip(numbers) {
                *verdict = known.verdicts[whole(number)];
            }
            let here = left.min(WIDTH);
            left -= here;
            if verdicts == [CellContent::Outside; WIDTH] {
                continue;
            }
            let projected = weight * v[2];
            if verdicts == [CellContent::Inside; WIDTH] && here == WIDTH {
                lifted.push_group(vectors, v, projected);
                continue;
            }
            let (weight, projected) = (vectors.store(weight), vectors.store(projected));
            let v = [vectors.store(v[0]), vectors.store(v[1]), vectors.store(v[2])];
            for k in 0..here {
                let v = DVec3::new(v[0][k], v[1][k], v[2][k]);
                let kept = match verdicts[k] {
                    CellContent::Outside => None,
                    CellContent::Inside => Some((v, projected[k])),
                    CellContent::Edges => ask(UndecidedPoint {
                        plane: DVec2::new(px[k], py[k]),
                        v,
                        weight: weight[k],
                    }),
                };
                if let Some((v, weight)) = kept {
                    lifted.push(v, weight);
                }
            }
        }
    }
}

/// The whole number `x` from 0 to 2³² − 1, faster than a conversion of any number.
#[inline(always)]
fn whole(x: f64) -> usize {
    const IN_LAST_BITS: f64 = (1_u64 << 52) as f64;
    (x + IN_LAST_BITS).to_bits() as u32 as usize
}
