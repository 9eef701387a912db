//! The family of slope distributions: its interface, and what its classes share.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

use crate::{
    Defect,
    lanes::{LaneKernel, Real, SimdLevel, WIDTH},
    spec::{self, Family, ParameterError, ParameterNode},
};

/// The family of slope distributions.
pub static FAMILY: Family = Family::new(
    "Slope_Distribution_Function",
    "Slope distributions",
    spec::classes::<dyn SlopeDistribution>,
)
.with_abstract(&[("Angle_Distribution_Function", "Slope_Distribution_Function")]);

/// A density of facet slopes; ∫∫ S dζ_x dζ_y = 1 where a class says so.
pub trait SlopeDistribution: Send + Sync {
    /// S(ζ_x, ζ_y), slopes in the frame of the sample.
    fn density(&self, zeta_x: f64, zeta_y: f64) -> f64;

    /// Puts S of each of the slopes `zeta` (ζ_x, ζ_y) into `out`, which has their number.
    ///
    /// Overridden where a closed form evaluates a batch; the bits do not change.
    fn densities(&self, zeta: &[[[f64; WIDTH]; 2]], out: &mut [[f64; WIDTH]]) {
        for ([x, y], out) in zeta.iter().zip(out) {
            *out = std::array::from_fn(|k| self.density(x[k], y[k]));
        }
    }

    /// Standard deviations of the slopes along x and y, where a closed form gives them.
    fn deviations(&self) -> Option<(f64, f64)> {
        None
    }
}

/// A density with a closed form for one slope or a batch.
pub(super) trait ClosedForm {
    fn at<R: Real>(&self, x: R, y: R) -> R;
}

/// [`SlopeDistribution::densities`] of a closed form.
pub(super) struct DensityKernel<'a, S> {
    pub(super) form: &'a S,
    pub(super) zeta: &'a [[[f64; WIDTH]; 2]],
    pub(super) out: &'a mut [[f64; WIDTH]],
}

impl<S: ClosedForm> LaneKernel for DensityKernel<'_, S> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, vectors: V) {
        for ([x, y], out) in self.zeta.iter().zip(self.out) {
            *out = vectors.store(self.form.at(vectors.load(x), vectors.load(y)));
        }
    }
}

/// The positive parameter `name`.
pub(super) fn width(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let x = node.number(name);
    if x > 0.0 && x.is_finite() {
        return Ok(x);
    }
    Err(ParameterError::new(name, format!("{x} is not positive")))
}

/// The constants of an exponential density with unit rms.
pub(super) struct ExponentialConstants {
    /// 3/π.
    pub(super) norm: f64,
    /// √6.
    pub(super) decay: f64,
    /// √6 π/2.
    pub(super) quarter_turn: f64,
}

impl ExponentialConstants {
    pub(super) fn of(node: &ParameterNode) -> Self {
        if node.reproduces(Defect::SlopeConstants) {
            return Self {
                norm: 0.954929658551,
                decay: 2.44948974278,
                quarter_turn: 3.84764949048,
            };
        }
        let decay = 6f64.sqrt();
        Self { norm: 3.0 * FRAC_1_PI, decay, quarter_turn: decay * FRAC_PI_2 }
    }
}

/// S = P(θ_n)/(1 + ζ²)² for a density P of the tilt angle θ_n = atan ζ.
pub(super) fn by_angle(x: f64, y: f64, density: impl Fn(f64) -> f64) -> f64 {
    let slope2 = x * x + y * y;
    let stretch = 1.0 + slope2;
    density(slope2.sqrt().atan()) / (stretch * stretch)
}
