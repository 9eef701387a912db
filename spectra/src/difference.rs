//! Colour differences.
//!
//! | function | meant for |
//! | --- | --- |
//! | [`delta_e_76`] | large differences, cheap |
//! | [`delta_e_2000`] | small differences of surfaces; the usual number |
//! | [`delta_e_itp`] | absolute luminance, HDR images; 1 is just visible |
//!
//! palette's CIEDE2000 leaves out one branch of the mean hue (up to 1.5e-5), so the formula here is
//! our own. `tests/palette_faults.rs` keeps the difference.

use std::f64::consts::TAU;

use crate::{
    lab::Lab,
    matrix::{Matrix3, apply},
    rgb::RgbSpace,
    xyz::Xyz,
};

/// CIE 1976 difference: the distance in L\*a\*b\*.
pub fn delta_e_76(a: Lab, b: Lab) -> f64 {
    ((a.l - b.l).powi(2) + (a.a - b.a).powi(2) + (a.b - b.b).powi(2)).sqrt()
}

/// CIEDE2000 with kL = kC = kH = 1.
///
/// G. Sharma, W. Wu, E. N. Dalal, Color Res. Appl. 30, 21 (2005); the equation numbers are theirs.
pub fn delta_e_2000(first: Lab, second: Lab) -> f64 {
    // (2)–(7): a′, chroma and hue.
    let mean_c = 0.5 * (first.a.hypot(first.b) + second.a.hypot(second.b));
    let g = 0.5 * (1.0 - chroma_weight(mean_c));
    let [(c1, h1), (c2, h2)] = [first, second].map(|lab| {
        let a = (1.0 + g) * lab.a;
        (a.hypot(lab.b), hue(a, lab.b))
    });
    let achromatic = c1 * c2 == 0.0;

    // (8)–(11): differences.
    let delta_l = second.l - first.l;
    let delta_c = c2 - c1;
    let delta_hue = if achromatic { 0.0 } else { wrap(h2 - h1) };
    let delta_h = 2.0 * (c1 * c2).sqrt() * (0.5 * delta_hue).sin();

    // (12)–(14): means.
    let l = 0.5 * (first.l + second.l);
    let c = 0.5 * (c1 + c2);
    let h = if achromatic { h1 + h2 } else { mean_hue(h1, h2) };

    // (15)–(21): weights and rotation.
    let t = 1.0 - 0.17 * (h - 30_f64.to_radians()).cos()
        + 0.24 * (2.0 * h).cos()
        + 0.32 * (3.0 * h + 6_f64.to_radians()).cos()
        - 0.20 * (4.0 * h - 63_f64.to_radians()).cos();
    let theta = 30_f64.to_radians() * (-((h.to_degrees() - 275.0) / 25.0).powi(2)).exp();
    let s_l = 1.0 + 0.015 * (l - 50.0).powi(2) / (20.0 + (l - 50.0).powi(2)).sqrt();
    let s_c = 1.0 + 0.045 * c;
    let s_h = 1.0 + 0.015 * c * t;
    let r_t = -(2.0 * theta).sin() * 2.0 * chroma_weight(c);

    // (22)
    let (l, c, h) = (delta_l / s_l, delta_c / s_c, delta_h / s_h);
    (l * l + c * c + h * h + r_t * c * h).sqrt()
}

/// ΔE ITP between two XYZ in cd/m² (ITU-R BT.2124).
pub fn delta_e_itp(first: Xyz, second: Xyz) -> f64 {
    let (a, b) = (ictcp(first), ictcp(second));
    let [i, t, p] = [0, 1, 2].map(|k| a[k] - b[k]);
    720.0 * (i * i + 0.25 * t * t + p * p).sqrt()
}

/// ICtCp of XYZ in cd/m² by the PQ curve (ITU-R BT.2100). Cone responses below zero count as zero.
pub fn ictcp(xyz: Xyz) -> [f64; 3] {
    const TO_LMS: Matrix3 =
        [[1688.0, 2146.0, 262.0], [683.0, 2951.0, 462.0], [99.0, 309.0, 3688.0]];
    const TO_ICTCP: Matrix3 =
        [[2048.0, 2048.0, 0.0], [6610.0, -13613.0, 7003.0], [17933.0, -17390.0, -543.0]];
    let rgb = RgbSpace::rec2020().linear(xyz);
    let lms = apply(&TO_LMS, rgb).map(|cone| perceptual_quantizer(cone / 4096.0));
    apply(&TO_ICTCP, lms).map(|component| component / 4096.0)
}

/// The PQ curve of SMPTE ST 2084 for a luminance in cd/m².
fn perceptual_quantizer(luminance: f64) -> f64 {
    const M1: f64 = 2610.0 / 16384.0;
    const M2: f64 = 2523.0 / 32.0;
    const C1: f64 = 3424.0 / 4096.0;
    const C2: f64 = 2413.0 / 128.0;
    const C3: f64 = 2392.0 / 128.0;
    let y = (luminance.max(0.0) / 10_000.0).powf(M1);
    ((C1 + C2 * y) / (1.0 + C3 * y)).powf(M2)
}

/// √(c⁷ / (c⁷ + 25⁷)).
fn chroma_weight(c: f64) -> f64 {
    let c7 = c.powi(7);
    (c7 / (c7 + 25_f64.powi(7))).sqrt()
}

/// Hue in radians from 0 to 2π; zero for grey.
fn hue(a: f64, b: f64) -> f64 {
    if a == 0.0 && b == 0.0 { 0.0 } else { b.atan2(a).rem_euclid(TAU) }
}

/// A difference of hues, brought to ±π.
fn wrap(difference: f64) -> f64 {
    if difference > 0.5 * TAU {
        difference - TAU
    } else if difference < -0.5 * TAU {
        difference + TAU
    } else {
        difference
    }
}

/// The mean of two hues on the shorter arc, from 0 to 2π.
fn mean_hue(h1: f64, h2: f64) -> f64 {
    let sum = h1 + h2;
    if (h1 - h2).abs() <= 0.5 * TAU {
        0.5 * sum
    } else if sum < TAU {
        0.5 * (sum + TAU)
    } else {
        0.5 * (sum - TAU)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn itp_of_a_known_pair() {
        let (a, b) = (Xyz::new(25.0, 40.0, 10.0), Xyz::new(26.0, 41.0, 10.5));
        // Computed with colour-science 0.4.7, ten decimals.
        for (ours, theirs) in ictcp(a).iter().zip([0.4150404826, -0.1975505098, -0.0222906018]) {
            assert!((ours - theirs).abs() < 1e-10, "{ours} {theirs}");
        }
        // Differences of numbers of order one, times 720.
        assert!((delta_e_itp(a, b) - 2.31428439305).abs() < 1e-9, "{}", delta_e_itp(a, b));
    }

    #[test]
    fn the_same_colour_differs_by_nothing_and_order_does_not_matter() {
        let (a, b) = (Lab::new(50.0, 2.5, -80.0), Lab::new(52.0, -30.0, 10.0));
        assert_eq!(delta_e_2000(a, a), 0.0);
        assert_eq!(delta_e_2000(Lab::new(0.0, 0.0, 0.0), Lab::new(0.0, 0.0, 0.0)), 0.0);
        // Rounding of a sum in another order.
        assert!((delta_e_2000(a, b) - delta_e_2000(b, a)).abs() < 1e-13);
    }
}
