//! Visible differences: how likely an observer sees, at each pixel, that two pictures differ.
//!
//! [`detect`] is the visible differences predictor of Daly in the form for high dynamic range of
//! Mantiuk and others. Two pictures of luminances in cd/m², seen from a known distance, pass
//!
//! 1. the optics of the eye and the response of its receptors ([`FrontEnd`]),
//! 2. the contrast sensitivity S(ρ, θ) at the luminance to which the eye is adapted,
//! 3. the cortex: 31 channels c of spatial frequency and orientation, in which structure of the
//!    pictures masks their difference,
//!
//! $$ P_c = 1 - \exp\left[-\left(\frac{|t_c - r_c|}{m_c}\right)^{3.5}\right], \qquad
//!    P = 1 - \prod_c (1 - P_c), $$
//!
//! where t_c and r_c are the test and the reference in units of their threshold and m_c ≥ 1 is how
//! much the structure raises it. A map is summed up by the part of the pixels with P > 0.75 and
//! P > 0.95 ([`Detection::percent_above`]).
//!
//! Limits: luminance only — a difference of hue at equal luminance is not seen, so [`colour`] and
//! [`flip`](mod@flip) stand beside it. Pictures are continued periodically: what leaves on the
//! right enters on the left. In [`FrontEnd::Daly1993`] the contrast is not calibrated, and
//! differences are about twelve times too visible.
//!
//! S. Daly, in *Digital Images and Human Vision*, ed. A. B. Watson (MIT Press, 1993), 179;
//! R. Mantiuk, S. Daly, K. Myszkowski, H.-P. Seidel, Proc. SPIE 5666, 204 (2005).
//!
//! ```
//! use spectra::visible::{Luminances, Settings, Viewing, detect};
//!
//! let wave = |contrast: f64| -> Vec<f64> {
//!     (0..64 * 64).map(|i| 50.0 * (1.0 + contrast * (i as f64 * 0.9).sin())).collect()
//! };
//! let [test, reference] = [0.05, 0.0].map(|c| Luminances::new(64, 64, wave(c)).unwrap());
//! let seen = detect(&test, &reference, &Viewing::default(), &Settings::default())?;
//! assert!(seen.percent_above(0.75) > 50.0);
//! # Ok::<(), spectra::visible::VisibleError>(())
//! ```

mod channel;
pub mod colour;
mod cortex;
mod eye;
pub mod flip;
mod sensitivity;
mod transform;
mod viewing;

pub use viewing::Viewing;

use rayon::prelude::*;

use transform::Transform;

/// Pixels of a picture at most: 8K. The planes of a comparison take about 150 bytes per pixel.
pub const MOST_PIXELS: usize = 1 << 25;

/// Differences below this, in cd/m², are no differences.
const NO_DIFFERENCE: f64 = 1e-4;

/// A picture of luminances.
#[derive(Clone, Debug, PartialEq)]
pub struct Luminances {
    width: usize,
    height: usize,
    values: Vec<f64>,
}

/// Why two pictures cannot be compared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VisibleError {
    /// The size and the number of values do not fit.
    #[error("a picture of {width} × {height} pixels has {found} values")]
    Values {
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
        /// Values that were given.
        found: usize,
    },
    /// The picture is too small or too large.
    #[error(
        "a picture of {width} × {height} pixels cannot be compared: it must have 2 × 2 to \
         {MOST_PIXELS} pixels; cut or scale it"
    )]
    Size {
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// A luminance is infinite.
    #[error("the luminance at column {column}, row {row} is infinite")]
    Infinite {
        /// Column, from 0.
        column: usize,
        /// Row, from 0.
        row: usize,
    },
    /// The pictures have different sizes.
    #[error(
        "the test has {} × {} pixels, the reference {} × {}: they must show the same view",
        .test[0], .test[1], .reference[0], .reference[1]
    )]
    Differ {
        /// Columns and rows of the test.
        test: [usize; 2],
        /// Columns and rows of the reference.
        reference: [usize; 2],
    },
    /// A viewing condition is no positive number.
    #[error("{name} is {value}; it must be a positive number ({unit})")]
    Viewing {
        /// Which one.
        name: &'static str,
        /// The value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// FLIP refuses the pictures.
    #[error("FLIP cannot compare the pictures: {0}")]
    Flip(String),
}

impl Luminances {
    /// A picture of `values` in cd/m², row by row from the top.
    ///
    /// Values that are not positive, or no numbers, count as the smallest positive value of the
    /// picture.
    ///
    /// # Errors
    ///
    /// If the number of values is not that of the pixels, or a value is infinite.
    pub fn new(width: usize, height: usize, mut values: Vec<f64>) -> Result<Self, VisibleError> {
        if width.checked_mul(height) != Some(values.len()) {
            return Err(VisibleError::Values { width, height, found: values.len() });
        }
        if width < 2 || height < 2 || values.len() > MOST_PIXELS {
            return Err(VisibleError::Size { width, height });
        }
        if let Some(at) = values.iter().position(|value| *value == f64::INFINITY) {
            return Err(VisibleError::Infinite { column: at % width, row: at / width });
        }
        let least = values.iter().copied().filter(|v| *v > 0.0).fold(f64::INFINITY, f64::min);
        let least = if least.is_finite() { least } else { eye::DARK };
        for value in &mut values {
            if !(*value > 0.0) {
                *value = least;
            }
        }
        Ok(Self { width, height, values })
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The luminances in cd/m², row by row from the top; all are positive.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The least and the largest luminance.
    pub fn range(&self) -> [f64; 2] {
        let least = self.values.iter().copied().fold(f64::INFINITY, f64::min);
        [least, self.values.iter().copied().fold(0.0, f64::max)]
    }

    fn log_mean(&self) -> f64 {
        (self.values.iter().map(|value| value.ln()).sum::<f64>() / self.values.len() as f64).exp()
    }
}

/// How luminance becomes contrast before the cortex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FrontEnd {
    /// Optics of the eye, just noticeable steps of luminance, adaptation at each pixel
    /// (Mantiuk and others 2005).
    #[default]
    Hdr,
    /// One adaptation for the whole picture (Daly 1993).
    Daly1993,
}

/// How pictures are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Settings {
    /// From luminance to contrast.
    pub front_end: FrontEnd,
    /// Repeat two habits of HDR-VDP 1.7: orientations of negative vertical frequencies are taken
    /// one row off, and the optics step through frequency by 0.5/(⌊N/2⌋ + 1) in place of 1/N.
    pub compat: bool,
}

/// A map of the probability that a difference is seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Detection {
    width: usize,
    height: usize,
    probability: Vec<f64>,
}

impl Detection {
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

/// How likely an observer sees, at each pixel, that `test` differs from `reference`.
///
/// # Errors
///
/// If the pictures have different sizes.
pub fn detect(
    test: &Luminances,
    reference: &Luminances,
    viewing: &Viewing,
    settings: &Settings,
) -> Result<Detection, VisibleError> {
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
    let pairs = test.values.par_iter().zip(&reference.values);
    probability.par_iter_mut().zip(pairs).for_each(|(probability, (test, reference))| {
        if (test - reference).abs() < NO_DIFFERENCE {
            *probability = 0.0;
        }
    });
    Ok(Detection { width, height, probability })
}

#[cfg(test)]
mod tests;
