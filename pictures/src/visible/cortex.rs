//! The channels of the cortex: bands of spatial frequency, five of them split by orientation.
//!
//! Band b = 1 … 4 passes what lies between two low-pass filters, mesa_{b−1} − mesa_b, where mesa_k
//! falls to one half at 2^−k cycles per pixel as a raised cosine of width ⅔·2^−k. Band 5 is
//! mesa_4 − base and band 6 the base, a Gaussian that ends at 2^−5 (1 + ⅓). Bands 1 to 5 are split
//! into six fans ½ (1 + cos(π Δθ/30°)), 30° apart.
//!
//! S. Daly (1993), see [`super`]; after A. B. Watson, Comput. Vision Graphics Image Process. 39,
//! 311 (1987).

use std::f64::consts::PI;

use super::transform::{Frequency, Transform};

/// Bands of spatial frequency.
const BANDS: usize = 6;
/// Fans into which a band is split, and the degrees between them.
const FANS: usize = 6;
const FAN_DEG: f64 = 30.0;
/// The end of the base, in cycles per pixel.
const BASE_END: f64 = 4.0 / 3.0 / 32.0;

/// A channel: its pass band, and the low-pass that spreads its masking.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CorticalChannel {
    band: usize,
    /// Centre of its fan in degrees; none for the base.
    centre: Option<f64>,
}

/// All channels.
pub(super) fn channels() -> impl Iterator<Item = CorticalChannel> {
    (1..=BANDS).flat_map(|band| {
        let fans = if band < BANDS { FANS } else { 1 };
        (0..fans).map(move |fan| {
            let centre = (band < BANDS).then_some(90.0 - FAN_DEG * fan as f64);
            CorticalChannel { band, centre }
        })
    })
}

impl CorticalChannel {
    /// The filter of the channel. With `compat` orientations of negative vertical frequencies are
    /// taken one row off.
    pub(super) fn filter(self, transform: &Transform, compat: bool) -> Vec<f64> {
        let row = 1.0 / transform.size()[1] as f64;
        transform.filter(|frequency| {
            let band = self.band(frequency.radius());
            match self.centre {
                Some(centre) if band > 0.0 => band * fan(frequency, centre, row, compat),
                _ => band,
            }
        })
    }

    /// The low-pass that spreads the masking of structure.
    pub(super) fn spread(self, transform: &Transform) -> Vec<f64> {
        transform.filter(|frequency| {
            let f = frequency.radius();
            if self.band == BANDS { base(f) } else { mesa(self.band - 1, f) }
        })
    }

    /// Transmission of the band at `f` cycles per pixel.
    fn band(self, f: f64) -> f64 {
        let passed = match self.band {
            BANDS => base(f),
            5 => mesa(4, f) - base(f),
            band => mesa(band - 1, f) - mesa(band, f),
        };
        passed.max(0.0)
    }
}

/// Low-pass that is one half at 2^−k cycles per pixel.
fn mesa(k: usize, f: f64) -> f64 {
    let half = 0.5_f64.powi(k as i32);
    let width = half * 2.0 / 3.0;
    let beyond = f - half + 0.5 * width;
    if beyond <= 0.0 {
        1.0
    } else if beyond >= width {
        0.0
    } else {
        0.5 * (1.0 + (PI * beyond / width).cos())
    }
}

/// The lowest band.
fn base(f: f64) -> f64 {
    let sigma = BASE_END / 3.0;
    if f < BASE_END { (-f * f / (2.0 * sigma * sigma)).exp() } else { 0.0 }
}

/// Transmission of the fan around `centre` degrees.
fn fan(frequency: Frequency, centre: f64, row: f64, compat: bool) -> f64 {
    if frequency.cycles == [0, 0] {
        return 0.0;
    }
    let below = frequency.y < 0.0;
    let y = if compat && below { frequency.y + row } else { frequency.y };
    let mut away = (Frequency { y, ..frequency }.angle().to_degrees() - centre).abs();
    if below && away >= 90.0 {
        away = 180.0 - away;
    }
    if away <= FAN_DEG { 0.5 * (1.0 + (PI * away / FAN_DEG).cos()) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_thirty_one_channels() {
        assert_eq!(channels().count(), 31);
    }

    #[test]
    fn the_channels_pass_everything_once() {
        let transform = Transform::new(64, 48);
        let mut sum = vec![0.0; 33 * 48];
        for channel in channels() {
            for (sum, passed) in sum.iter_mut().zip(channel.filter(&transform, false)) {
                *sum += passed;
            }
        }
        // The mean goes through the base; the corners are above mesa_0's knee at 2/3.
        let all = transform.filter(|f| mesa(0, f.radius()));
        for (sum, all) in sum.iter().zip(all) {
            // Rounding of a few sums of numbers of order one.
            assert!((sum - all).abs() < 1e-13, "{sum} {all}");
        }
    }
}
