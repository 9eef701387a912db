//! The reference in grey, with visible differences in colour.
//!
//! Luminance is brought into the range of a display by E. Reinhard, M. Stark, P. Shirley,
//! J. Ferwerda, ACM Trans. Graph. 21, 267 (2002), equation 4: the log mean becomes 0.18 and the
//! largest luminance white.

use spectra::rgb::Curve;

use crate::{
    image::{Encoding, Image},
    visible::{DetectionMap, Luminances},
};

/// Colours of pixels whose detection probability is above a threshold.
const COLOURS: [(f64, [f64; 3]); 2] = [(0.95, [1.0, 0.1, 0.1]), (0.75, [1.0, 0.9, 0.1])];
/// Opacity of the colour.
const COVER: f64 = 0.65;
/// The value of the log mean of the luminance.
const KEY: f64 = 0.18;

pub(super) fn draw(reference: &Luminances, map: &DetectionMap) -> Image {
    let luminances = reference.values();
    let logs: f64 = luminances.iter().map(|l| l.ln()).sum();
    let mean = (logs / luminances.len() as f64).exp();
    let most = KEY * reference.range()[1] / mean;
    let grey = |luminance: f64| {
        let key = KEY * luminance / mean;
        Curve::Srgb.encode(key * (1.0 + key / (most * most)) / (1.0 + key))
    };
    let pixel = |(luminance, probability): (&f64, &f64)| {
        let grey = grey(*luminance);
        match COLOURS.iter().find(|(threshold, _)| probability > threshold) {
            Some((_, colour)) => colour.map(|c| (COVER * c + (1.0 - COVER) * grey) as f32),
            None => [grey as f32; 3],
        }
    };
    let values = luminances.iter().zip(map.probability()).flat_map(pixel).collect();
    Image::new(map.size(), 3, values, Encoding::Srgb).expect("a map has a value for each pixel")
}
