//! Closed forms for a batch of directions, several numbers per instruction.
//!
//! A formula is written once over [`Real`] and works on one number or, in a [`LaneKernel`], on several.
//! Each lane goes through the operations of one number in their order, so a batch has the bits of
//! its directions one by one, on every machine.

mod array;
mod complex;
mod elementary;
mod real;
mod wide;

pub use array::WIDTH;
pub(crate) use array::filled_up;
pub(crate) use complex::{Complex, ratios};
pub use elementary::{sin_cos_of_half_turn, sinh_cosh};
pub use real::Real;
pub(crate) use real::polynomial;
pub use wide::{LaneKernel, SimdLevel, dispatch};

#[cfg(test)]
mod tests {
    use super::{wide::SimdKind, *};

    #[test]
    fn the_falling_exponential_is_that_of_the_standard_library() {
        for k in 0..=70_000 {
            let x = -0.01 * f64::from(k) - 1e-5 * f64::from(k % 97);
            let (got, expected) = (x.exp_falling(), x.exp());
            // Two units in the last place.
            assert!((got - expected).abs() <= 4.5e-16 * expected, "{x}: {got:e} {expected:e}");
        }
        assert_eq!([0f64, -709.0].map(f64::exp_falling), [1.0, 0.0]);
        assert_eq!([-1e300, f64::NEG_INFINITY].map(f64::exp_falling), [0.0, 0.0]);
        assert!(f64::NAN.exp_falling().is_nan());
    }

    #[test]
    fn numbers_are_rounded_and_kept_within_their_range() {
        let x = [-3.0, -0.2, 0.4, 0.6, 6.7, 7.2, 1e300, f64::INFINITY, f64::NAN];
        let want = [0.0, 0.0, 0.0, 1.0, 7.0, 7.0, 7.0, 7.0, 0.0];
        assert_eq!(x.map(|x| x.rounded_within(7.0)), want);
    }

    #[inline(always)]
    fn formula<R: Real>(x: R, y: R) -> R {
        let z = Complex { re: x, im: y - 0.3 };
        let w = z.over(Complex { re: y, im: x * 2.0 + 1.0 }) * (x * x + y).sqrt();
        let (sin, _) = w.im.sin_cos();
        (x - y).select((-(w.norm_sqr())).exp_falling(), (w.re + sin).abs() / y)
    }

    /// The formula in the registers of this processor.
    struct LaneFormula<'a>([f64; WIDTH], [f64; WIDTH], &'a mut [f64; WIDTH]);

    impl LaneKernel for LaneFormula<'_> {
        #[inline(always)]
        fn run<V: SimdLevel>(self, vectors: V) {
            *self.2 = vectors.store(formula(vectors.load(&self.0), vectors.load(&self.1)));
        }
    }

    #[test]
    fn every_lane_has_the_bits_of_its_number_alone() {
        let x = [0.1, 7.0, 0.2, 1e-3, -0.7, 1e9, 0.5, 1.0];
        let y = [0.4, 6.9, 0.3, 0.0, -2e-5, 3.0, 0.6, 1.0];
        let alone = std::array::from_fn(|k| formula(x[k], y[k]).to_bits());
        let mut batch = [0.0; WIDTH];
        for kind in SimdKind::of_this_processor() {
            kind.run(LaneFormula(x, y, &mut batch));
            assert_eq!(batch.map(f64::to_bits), alone, "{kind:?}");
        }
    }

    #[test]
    fn what_is_not_a_number_chooses_and_stays_the_same_in_every_kind_of_lane() {
        let x = [f64::NAN, -0.0, f64::INFINITY, f64::NEG_INFINITY, 0.0, -f64::NAN, 1e-320, -1e-320];
        let y = [1.0, f64::NAN, -2.0, -0.0, f64::INFINITY, 3.0, f64::NAN, 4.0];
        let alone = std::array::from_fn(|k| x[k].select(y[k], 5.0).to_bits());
        let mut batch = [0.0; WIDTH];
        for kind in SimdKind::of_this_processor() {
            kind.run(Choice(x, y, &mut batch));
            assert_eq!(batch.map(f64::to_bits), alone, "{kind:?}");
        }
    }

    /// The second numbers where the first are not negative, 5 elsewhere.
    struct Choice<'a>([f64; WIDTH], [f64; WIDTH], &'a mut [f64; WIDTH]);

    impl LaneKernel for Choice<'_> {
        #[inline(always)]
        fn run<V: SimdLevel>(self, vectors: V) {
            let (x, y) = (vectors.load(&self.0), vectors.load(&self.1));
            *self.2 = vectors.store(x.select(y, x.splat(5.0)));
        }
    }
}
