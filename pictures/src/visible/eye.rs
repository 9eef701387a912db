//! The eye: from luminance to contrast in units of its threshold.
//!
//! For high dynamic range: the optics blur, OTF(ν) = exp(−(ν/(20.9 − 2.1p))^(1.3 − 0.07p)) for a
//! pupil of p mm, ν in cycles per degree (R. J. Deeley, N. Drasdo, W. N. Charman, Ophthalmic
//! Physiol. Opt. 11, 91 (1991)), with p = 4.9 − 3 tanh(0.4 (log₁₀ L̄ + 1)) (P. Moon,
//! D. E. Spencer, J. Opt. Soc. Am. 34, 319 (1944)). Luminance becomes just noticeable steps,
//!
//! $$ \psi(L) = \frac{1}{0.6} \int_{10^{-4}}^{L} \frac{dL'}{c(L')\, L'}, $$
//!
//! where c is the contrast of one step. The sensitivity, divided by the blur it contains, filters
//! the steps at six adaptation luminances, and each pixel interpolates between them at its own
//! luminance.
//!
//! R. Mantiuk, S. Daly, K. Myszkowski, H.-P. Seidel, Proc. SPIE 5666, 204 (2005).

use rayon::prelude::*;
use spectra::interpolate::cubic_spline;

use super::{
    luminance::{DARK, Luminances},
    sensitivity::ContrastSensitivity,
    transform::{Frequency, Transform},
    viewing::Viewing,
};

/// Adaptation luminances between which pixels interpolate, in cd/m².
const ADAPTATIONS: [f64; 6] = [0.001, 0.01, 0.1, 1.0, 10.0, 100.0];

/// Threshold contrast of the most visible pattern, 0.006, relative to 0.01 of [`STEP_CONTRAST`].
const PEAK_CONTRAST: f64 = 0.006 / 0.01;

/// Contrast of one just noticeable step at log₁₀ L = −3.6, −3.4 … 4: slopes of the response that
/// HDR-VDP 1.7.1 uses, measured.
#[rustfmt::skip]
const STEP_CONTRAST: [f64; 39] = [
    0.66179, 0.52585, 0.41788, 0.33431, 0.26967, 0.21883, 0.1803, 0.1512, 0.12742, 0.10422,
    0.08767, 0.07343, 0.06033, 0.05004, 0.04236, 0.03647, 0.0315, 0.02781, 0.02414, 0.02128,
    0.01928, 0.01764, 0.01631, 0.01488, 0.01378, 0.01296, 0.01232, 0.01161, 0.01107, 0.01073,
    0.01048, 0.01032, 0.01021, 0.01014, 0.01009, 0.01005, 0.01003, 0.01001, 0.01,
];

/// The two pictures in units of threshold, by the front end for high dynamic range.
pub(super) fn hdr(
    pictures: [&Luminances; 2],
    viewing: &Viewing,
    compat: bool,
    transform: &Transform,
) -> [Vec<f64>; 2] {
    let per_degree = viewing.pixels_per_degree();
    let blur = Optics::new(pictures[1].log_mean(), per_degree, compat, transform).filter;
    let retina = pictures.map(|p| transform.picture(&transform.spectrum(p.values()), &blur));
    let adaptation = &retina[1];
    let response = LuminanceResponse::new();
    let steps = [0, 1].map(|which: usize| {
        let steps: Vec<f64> = retina[which].par_iter().map(|l| response.at(*l)).collect();
        transform.spectrum(&steps)
    });
    let mut perceived = [0, 1].map(|_| vec![0.0; adaptation.len()]);
    for (node, luminance) in ADAPTATIONS.into_iter().enumerate() {
        let sensitivity =
            ContrastSensitivity { luminance, area_deg2: 1.0, distance_m: viewing.distance_m() };
        let mut filter = transform.filter(|f| sensitivity.at(per_degree * f.radius(), f.angle()));
        let peak = filter.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        filter.par_iter_mut().zip(&blur).for_each(|(sensitivity, blur)| {
            // Where the sensitivity is zero the blur may have underflowed to zero.
            let freed = if *sensitivity > 0.0 { *sensitivity / peak / blur } else { 0.0 };
            *sensitivity = freed.min(1.0);
        });
        for (perceived, steps) in perceived.iter_mut().zip(&steps) {
            let filtered = transform.picture(steps, &filter);
            let pixels = perceived.par_iter_mut().zip(&filtered).zip(adaptation);
            pixels.for_each(|((perceived, value), l)| {
                *perceived += weight(node, *l) * value;
            });
        }
    }
    perceived
}

/// The two pictures in units of threshold, by Daly's front end: a compressive response and one
/// adaptation.
pub(super) fn daly(
    pictures: [&Luminances; 2],
    viewing: &Viewing,
    transform: &Transform,
) -> [Vec<f64>; 2] {
    let sensitivity = ContrastSensitivity {
        luminance: 30.0,
        area_deg2: viewing.area_deg2(),
        distance_m: viewing.distance_m(),
    };
    let per_degree = viewing.pixels_per_degree();
    let filter = transform.filter(|f| sensitivity.at(per_degree * f.radius(), f.angle()));
    pictures.map(|picture| {
        let response: Vec<f64> =
            picture.values().par_iter().map(|y| 100.0 * y / (y + 12.6 * y.powf(0.63))).collect();
        transform.picture(&transform.spectrum(&response), &filter)
    })
}

/// Weight of adaptation `node` for a pixel at `luminance`, linear between the nodes.
fn weight(node: usize, luminance: f64) -> f64 {
    let luminance = luminance.clamp(ADAPTATIONS[0], ADAPTATIONS[ADAPTATIONS.len() - 1]);
    let at = ADAPTATIONS[node];
    let other = if luminance < at { node.checked_sub(1) } else { Some(node + 1) };
    match other.and_then(|other| ADAPTATIONS.get(other)) {
        Some(other) => (1.0 - (luminance - at) / (other - at)).max(0.0),
        None => 1.0,
    }
}

/// The blur of the eye's optics.
struct Optics {
    filter: Vec<f64>,
}

impl Optics {
    /// The blur of an eye that is adapted to `luminance`. With `compat` the frequency of row or
    /// column k of N is 0.5 k/(⌊N/2⌋ + 1) cycles per pixel.
    fn new(luminance: f64, per_degree: f64, compat: bool, transform: &Transform) -> Self {
        let pupil_mm = 4.9 - 3.0 * (0.4 * (luminance.log10() + 1.0)).tanh();
        let transfer =
            |nu: f64| (-(nu.max(0.1) / (20.9 - 2.1 * pupil_mm)).powf(1.3 - 0.07 * pupil_mm)).exp();
        let [step_x, step_y] = transform.size().map(|n| 0.5 / (n / 2 + 1) as f64);
        let frequency = |f: Frequency| {
            let [kx, ky] = f.cycles.map(|k| k as f64);
            if compat { (kx * step_x).hypot(ky * step_y) } else { f.radius() }
        };
        let most = transfer(0.0);
        Self { filter: transform.filter(|f| transfer(per_degree * frequency(f)) / most) }
    }
}

/// ψ as a table over log₁₀ L.
struct LuminanceResponse {
    steps: Vec<f64>,
}

impl LuminanceResponse {
    const LOG_FIRST: f64 = -4.0;
    const LOG_LAST: f64 = 4.0;
    /// Entries per decade; linear interpolation has a relative error of 1e-6.
    const PER_DECADE: usize = 1000;

    fn new() -> Self {
        let knots: Vec<f64> = (0..STEP_CONTRAST.len()).map(|i| -3.6 + 0.2 * i as f64).collect();
        let logs = STEP_CONTRAST.map(f64::ln);
        let entries = (Self::LOG_LAST - Self::LOG_FIRST) as usize * Self::PER_DECADE;
        let step = 1.0 / Self::PER_DECADE as f64;
        // Twice as many points, for Simpson's rule.
        let at: Vec<f64> = (0..=2 * entries)
            .map(|i| (Self::LOG_FIRST + 0.5 * step * i as f64).clamp(knots[0], Self::LOG_LAST))
            .collect();
        let log_contrast = cubic_spline(&knots, &logs, &at).expect("the table has 39 entries");
        let density: Vec<f64> = log_contrast
            .iter()
            .map(|c| std::f64::consts::LN_10 / PEAK_CONTRAST / c.exp())
            .collect();
        let mut steps = vec![0.0];
        let mut sum = 0.0;
        for three in density.windows(3).step_by(2) {
            sum += step / 6.0 * (three[0] + 4.0 * three[1] + three[2]);
            steps.push(sum);
        }
        Self { steps }
    }

    /// ψ at `luminance` in cd/m²; beyond the table the contrast of a step is constant.
    fn at(&self, luminance: f64) -> f64 {
        if !(luminance > DARK) {
            return 0.0;
        }
        let place = (luminance.log10() - Self::LOG_FIRST) * Self::PER_DECADE as f64;
        let below = (place as usize).min(self.steps.len() - 2);
        let [low, high] = [self.steps[below], self.steps[below + 1]];
        low + (place - below as f64) * (high - low)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weights_of_a_pixel_add_to_one() {
        for luminance in [0.0, 0.001, 0.004, 0.1, 3.0, 99.0, 100.0, 1e5] {
            let sum: f64 = (0..ADAPTATIONS.len()).map(|node| weight(node, luminance)).sum();
            // Rounding of two numbers that add to one.
            assert!((sum - 1.0).abs() < 1e-14, "{luminance}: {sum}");
        }
        assert_eq!(weight(3, 1.0), 1.0);
    }

    #[test]
    fn a_step_at_high_luminance_is_six_tenths_of_a_percent() {
        let response = LuminanceResponse::new();
        // Above 10⁴ cd/m² c = 0.01, so ψ grows by Δln L / 0.006; the last interval of the table,
        // which goes on, begins at a contrast that is a little larger.
        let rise = response.at(1e6) - response.at(1e5);
        assert!((rise / (10_f64.ln() / 0.006) - 1.0).abs() < 1e-6, "{rise}");
    }

    #[test]
    fn the_response_begins_in_the_dark_and_rises() {
        let response = LuminanceResponse::new();
        assert_eq!(response.at(0.0), 0.0);
        assert_eq!(response.at(f64::NAN), 0.0);
        let mut before = 0.0;
        for i in 0..200 {
            let now = response.at(10_f64.powf(-3.99 + 0.05 * f64::from(i)));
            assert!(now > before);
            before = now;
        }
    }
}
