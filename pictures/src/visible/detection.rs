//! The probability of detection at each pixel.

use rayon::prelude::*;

use super::{
    channel, error::VisibleError, eye, luminance::Luminances, transform::Transform,
    viewing::Viewing,
};

/// Differences below this luminance, in cd/m², do not count.
const NO_DIFFERENCE: f64 = 1e-4;

/// The model of the eye: from luminance to contrast in units of threshold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FrontEnd {
    /// Optics of the eye, just noticeable steps of luminance, adaptation at each pixel
    /// (Mantiuk and others 2005).
    #[default]
    Hdr,
    /// One adaptation for the whole picture (Daly 1993).
    Daly1993,
}

/// The settings of [`detect`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DetectorSettings {
    /// The model of the eye.
    pub front_end: FrontEnd,
    /// Repeat two deviations of HDR-VDP 1.7: orientations of negative vertical frequencies are taken
    /// one row off, and the optics step through frequency by 0.5/(⌊N/2⌋ + 1) in place of 1/N.
    pub compat: bool,
}

/// The probability of detection at each pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct DetectionMap {
    width: usize,
    height: usize,
    probability: Vec<f64>,
}

impl DetectionMap {
    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The probabilities, row by row from the top.
    pub fn probability(&self) -> &[f64] {
        &self.probability
    }

    /// Percentage of the pixels whose probability is above `threshold`.
    pub fn percent_above(&self, threshold: f64) -> f64 {
        let above = self.probability.iter().filter(|p| **p > threshold).count();
        100.0 * above as f64 / self.probability.len() as f64
    }

    /// Mean of the probabilities.
    pub fn mean(&self) -> f64 {
        self.probability.iter().sum::<f64>() / self.probability.len() as f64
    }

    /// Largest probability.
    pub fn max(&self) -> f64 {
        self.probability.iter().copied().fold(0.0, f64::max)
    }
}

/// The probability that an observer sees, at each pixel, that `test` differs from `reference`.
///
/// # Errors
///
/// If the pictures have different sizes.
pub fn detect(
    test: &Luminances,
    reference: &Luminances,
    viewing: &Viewing,
    settings: &DetectorSettings,
) -> Result<DetectionMap, VisibleError> {
    if test.size() != reference.size() {
        return Err(VisibleError::Differ { test: test.size(), reference: reference.size() });
    }
    let [width, height] = reference.size();
    let transform = Transform::new(width, height);
    let [seen, expected] = match settings.front_end {
        FrontEnd::Hdr => eye::hdr([test, reference], viewing, settings.compat, &transform),
        FrontEnd::Daly1993 => eye::daly([test, reference], viewing, &transform),
    };
    let mut probability = channel::detect(&seen, &expected, &transform, settings.compat);
    let pairs = test.values().par_iter().zip(reference.values());
    probability.par_iter_mut().zip(pairs).for_each(|(probability, (test, reference))| {
        if (test - reference).abs() < NO_DIFFERENCE {
            *probability = 0.0;
        }
    });
    Ok(DetectionMap { width, height, probability })
}

#[cfg(test)]
mod tests;
