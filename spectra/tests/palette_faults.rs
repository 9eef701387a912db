//! Errors of palette 0.7.7 that our own formulas avoid.
//!
//! If one of these tests fails after an update of palette, a fault was mended there.

use palette::{
    Lab as PaletteLab, LinSrgb, Xyz as PaletteXyz,
    color_difference::Ciede2000,
    convert::FromColorUnclamped,
    encoding::{AdobeRgb, FromLinear, Srgb},
    white_point,
};
use spectra::{Lab, RgbSpace, difference::delta_e_2000, rgb::typed, xyz::from_chromaticity};

#[test]
fn its_srgb_matrix_does_not_take_the_white_of_srgb_to_one() {
    let white = from_chromaticity([0.3127, 0.3290]);
    let theirs = LinSrgb::<f64>::from_color_unclamped(PaletteXyz::<white_point::D65, f64>::new(
        white.x, white.y, white.z,
    ));
    let off = [theirs.red, theirs.green, theirs.blue].map(|v| (v - 1.0).abs());
    assert!(off.iter().any(|off| *off > 1e-4), "{off:?}");
    for v in RgbSpace::srgb().linear(white) {
        // Rounding of a product with matrix elements up to 3.3.
        assert!((v - 1.0).abs() < 2e-15);
    }
}

#[test]
fn its_ciede2000_leaves_out_a_branch_of_the_mean_hue() {
    // It shows where the hues differ by more than 180° and add up to more than 360°.
    let at = |hue: f64| {
        let (sin, cos) = hue.to_radians().sin_cos();
        [50.0, 60.0 * cos, 60.0 * sin]
    };
    let mut worst = 0.0_f64;
    for h1 in 0..36 {
        for h2 in 0..36 {
            let ([l1, a1, b1], [l2, a2, b2]) = (at(10.0 * f64::from(h1)), at(10.0 * f64::from(h2)));
            let ours = delta_e_2000(Lab::new(l1, a1, b1), Lab::new(l2, a2, b2));
            let theirs = PaletteLab::<white_point::D65, f64>::new(l1, a1, b1)
                .difference(PaletteLab::new(l2, a2, b2));
            worst = worst.max((ours - theirs).abs());
        }
    }
    // Rounding would be 1e-13.
    assert!(worst > 1e-9, "{worst:e}");
}

#[test]
fn its_curves_are_not_odd() {
    assert!(<AdobeRgb as FromLinear<f64, f64>>::from_linear(-0.1).is_nan());
    let theirs = <Srgb as FromLinear<f64, f64>>::from_linear(-0.1);
    assert!((theirs - -1.292).abs() < 1e-12, "{theirs}");
    let ours = <typed::Srgb as FromLinear<f64, f64>>::from_linear;
    assert_eq!(ours(-0.1), -ours(0.1));
    let ours = <typed::AdobeRgb1998 as FromLinear<f64, f64>>::from_linear;
    assert_eq!(ours(-0.1), -ours(0.1));
}
