//! Slope distributions: the density of facet slopes.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

use crate::{
    Defect,
    lanes::{LaneKernel, Real, SimdLevel, WIDTH},
    spec::{Family, Member, ParameterError, ParameterNode, Spec},
};

pub mod anisotropic_exponential;
pub mod anisotropic_gaussian;
pub mod ellipsoid;
pub mod exponential;
pub mod exponential_angle;
pub mod gaussian;
pub mod gaussian_angle;
pub mod mixture;
pub mod table;
pub mod table_angle;
pub mod unit;

/// A density of facet slopes; ∫∫ S dζ_x dζ_y = 1 where a class says so.
pub trait SlopeDistribution: Send + Sync {
    /// S(ζ_x, ζ_y), slopes in the frame of the sample.
    fn density(&self, zeta_x: f64, zeta_y: f64) -> f64;

    /// Puts S of each of the slopes `zeta` (ζ_x, ζ_y) into `out`, which has their number.
    ///
    /// Overridden where a closed form works on several numbers at once; the bits do not change.
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

/// A density with a closed form for one slope or several.
trait ClosedForm {
    fn at<R: Real>(&self, x: R, y: R) -> R;
}

/// [`SlopeDistribution::densities`] of a closed form.
struct DensityKernel<'a, S> {
    form: &'a S,
    zeta: &'a [[[f64; WIDTH]; 2]],
    out: &'a mut [[f64; WIDTH]],
}

impl<S: ClosedForm> LaneKernel for DensityKernel<'_, S> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, vectors: V) {
        for ([x, y], out) in self.zeta.iter().zip(self.out) {
            *out = vectors.store(self.form.at(vectors.load(x), vectors.load(y)));
        }
    }
}

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn SlopeDistribution>] = &[
    &unit::SPEC,
    &exponential::SPEC,
    &gaussian::SPEC,
    &table::SPEC,
    &anisotropic_exponential::SPEC,
    &anisotropic_gaussian::SPEC,
    &ellipsoid::SPEC,
    &mixture::SPEC,
    &gaussian_angle::SPEC,
    &exponential_angle::SPEC,
    &table_angle::SPEC,
];

impl Member for dyn SlopeDistribution {
    const FAMILY: Family = Family::Slope;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}

/// The positive parameter `name`.
fn width(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let x = node.number(name);
    if x > 0.0 && x.is_finite() {
        return Ok(x);
    }
    Err(ParameterError::new(name, format!("{x} is not positive")))
}

/// The constants of an exponential density with unit rms.
struct ExponentialConstants {
    /// 3/π.
    norm: f64,
    /// √6.
    decay: f64,
    /// √6 π/2.
    quarter_turn: f64,
}

impl ExponentialConstants {
    fn of(node: &ParameterNode) -> Self {
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
fn by_angle(x: f64, y: f64, density: impl Fn(f64) -> f64) -> f64 {
    let slope2 = x * x + y * y;
    let stretch = 1.0 + slope2;
    density(slope2.sqrt().atan()) / (stretch * stretch)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mode, ParameterValue, spec};

    fn built(name: &str, params: &[(&str, f64)], mode: Mode) -> Box<dyn SlopeDistribution> {
        let class = spec::find_class(name).unwrap();
        let node =
            params.iter().fold(ParameterNode::with_defaults(class, mode), |node, (name, x)| {
                node.with(name, ParameterValue::Number(*x)).unwrap()
            });
        spec::build::<dyn SlopeDistribution>(&node).unwrap()
    }

    /// (∫∫S, ⟨ζ_x²⟩, ⟨ζ_y²⟩) by the trapezoidal rule in ln ζ and azimuth, which converges faster
    /// than any power for densities that are smooth in both.
    fn moments(s: &dyn SlopeDistribution) -> [f64; 3] {
        let (radial, azimuths) = (2000, 64);
        let mut sum = [0.0; 3];
        for i in 0..radial {
            let slope = (-25.0 + 32.0 * i as f64 / radial as f64).exp();
            for j in 0..azimuths {
                let phi = std::f64::consts::TAU * j as f64 / azimuths as f64;
                let (x, y) = (slope * phi.cos(), slope * phi.sin());
                let weight = s.density(x, y)
                    * slope
                    * slope
                    * (32.0 / radial as f64)
                    * (std::f64::consts::TAU / azimuths as f64);
                for (total, power) in sum.iter_mut().zip([1.0, x * x, y * y]) {
                    *total += weight * power;
                }
            }
        }
        sum
    }

    #[test]
    fn densities_integrate_to_one_and_have_the_stated_deviations() {
        for (name, params) in [
            ("Exponential_Slope_Distribution_Function", &[("s", 0.3)][..]),
            ("Gaussian_Slope_Distribution_Function", &[("s", 0.3)]),
            ("Anisotropic_Exponential_Slope_Distribution_Function", &[("sx", 0.4), ("sy", 0.25)]),
            (
                "Anisotropic_Gaussian_Slope_Distribution_Function",
                &[("sigmax", 0.4), ("sigmay", 0.25)],
            ),
        ] {
            let s = built(name, params, Mode::Sound);
            let (x, y) = s.deviations().unwrap();
            for (got, want) in moments(&*s).into_iter().zip([1.0, x * x, y * y]) {
                // The azimuthal sum of the exponential with axes 0.4 : 0.25 is good to 10⁻⁹.
                assert!((got - want).abs() < 1e-8 * want, "{name}: {got} is not {want}");
            }
        }
    }

    #[test]
    fn ellipsoids_cover_their_share_of_the_area() {
        let s = built("Ellipsoid_Slope_Distribution_Function", &[("ry", 7.0)], Mode::Sound);
        let covered = std::f64::consts::PI * 10.0 * 7.0 * 1e-4;
        // Slopes beyond e⁷ are cut: they hold e⁻¹⁴/49 of the whole.
        assert!((moments(&*s)[0] - covered).abs() < 1e-6 * covered);
    }

    #[test]
    fn equal_deviations_give_the_isotropic_gaussian() {
        let a = built(
            "Anisotropic_Gaussian_Slope_Distribution_Function",
            &[("sigmax", 0.2), ("sigmay", 0.2)],
            Mode::Sound,
        );
        let b =
            built("Gaussian_Slope_Distribution_Function", &[("s", 0.2 * 2f64.sqrt())], Mode::Sound);
        for (x, y) in [(0.0, 0.0), (0.1, -0.3), (0.5, 0.2)] {
            assert!((a.density(x, y) / b.density(x, y) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn twelve_digit_constants_are_kept_for_compat_only() {
        let name = "Exponential_Slope_Distribution_Function";
        let at = |mode| built(name, &[("s", 1.0)], mode).density(0.0, 0.0);
        assert_eq!(at(Mode::Compat), 0.954929658551);
        assert_eq!(at(Mode::Sound), 3.0 * FRAC_1_PI);
    }

    #[test]
    fn widths_that_are_not_positive_are_refused() {
        let class = spec::find_class("Gaussian_Slope_Distribution_Function").unwrap();
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let node = ParameterNode::with_defaults(class, Mode::Sound)
                .with("s", ParameterValue::Number(bad));
            let error = spec::build::<dyn SlopeDistribution>(&node.unwrap()).err().unwrap();
            assert_eq!(error.parameter, "s");
        }
    }
}
