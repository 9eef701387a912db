//! The complementary error function for one number or a batch.
//!
//! $$ \mathrm{erfc}\,x = \frac{e^{-x^2}}{1+2x}\,f(t), \quad
//!    t = \frac{x-K}{x+K}, \quad K = 3.75 $$
//!
//! f is smooth on −1 ≤ t < 1, that is for all x ≥ 0, and a short series gives it. The coefficients
//! are those of the Chebyshev series, computed with 50 digits and sorted by powers of t; the first
//! one left out is below 2·10⁻¹⁷.
//!
//! M. M. Shepherd and J. G. Laframboise, Math. Comp. 36, 249 (1981).

use std::f64::consts::FRAC_2_SQRT_PI;

use crate::lanes::{Real, polynomial};

/// √π.
pub(crate) const ROOT_PI: f64 = 2.0 / FRAC_2_SQRT_PI;

/// K, the x of t = 0.
const MIDDLE: f64 = 3.75;

/// The coefficients of t²⁴, t²³, …, 1 in f.
const SERIES: [f64; 25] = [
    4.251_471_444_796_389_5e-10,
    3.111_433_380_979_925_4e-10,
    -5.173_990_214_011_309_5e-9,
    -3.744_210_080_962_018e-9,
    3.867_533_424_222_235_4e-8,
    2.326_350_870_885_912_4e-8,
    -2.586_685_071_615_588_4e-7,
    -5.721_823_060_322_408_6e-8,
    1.751_637_648_849_062e-6,
    -9.735_598_967_367_75e-7,
    -1.144_414_623_770_052_4e-5,
    2.238_423_915_508_223e-5,
    5.164_909_889_268_241e-5,
    -2.901_540_805_408_417e-4,
    2.937_136_655_913_448e-4,
    1.755_625_852_895_295_4e-3,
    -9.746_579_558_029_276e-3,
    2.836_227_741_895_640_6e-2,
    -5.869_339_858_963_677e-2,
    9.230_432_116_037_748e-2,
    -1.088_039_301_417_488_6e-1,
    8.227_673_849_014_52e-2,
    3.585_415_485_464_429_3e-3,
    -1.402_405_985_855_469_7e-1,
    1.237_512_630_837_827_5,
];

/// e^{−x²} and f = (1 + 2x) e^{x²} erfc x for x ≥ 0. The first one is 0 from x = 26.6 on.
#[inline(always)]
pub(crate) fn falling_and_scaled<R: Real>(x: R) -> [R; 2] {
    let t = (x - MIDDLE) / (x + MIDDLE);
    [(-(x * x)).exp_falling(), polynomial(&SERIES, t)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_complementary_error_function() {
        for k in 0..=2_650 {
            let x = 0.01 * f64::from(k) + 1e-4 * f64::from(k % 89);
            let [falling, scaled] = falling_and_scaled(x);
            let erfc = falling * scaled / (1.0 + 2.0 * x);
            // The rounding of x² becomes a relative error of x²·10⁻¹⁶.
            let tolerance = 6e-16 + 1.2e-16 * x * x;
            let expected = libm::erfc(x);
            assert!((erfc - expected).abs() <= tolerance * expected, "{x}: {erfc:e} {expected:e}");
            let expected = (-x * x).exp();
            assert!((falling - expected).abs() <= tolerance * expected, "{x}");
        }
    }
}
