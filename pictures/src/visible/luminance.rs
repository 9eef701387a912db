//! A picture of luminances.

use super::error::{MOST_PIXELS, VisibleError};

/// The luminance of the lowest visible step, in cd/m².
pub(super) const DARK: f64 = 1e-4;

/// A picture of luminances.
#[derive(Clone, Debug, PartialEq)]
pub struct Luminances {
    width: usize,
    height: usize,
    values: Vec<f64>,
}

impl Luminances {
    /// A picture of `values` in cd/m², row by row from the top.
    ///
    /// Values that are not positive, and NaN, count as the smallest positive value of the picture.
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
        let least = if least.is_finite() { least } else { DARK };
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

    /// The smallest and the largest luminance.
    pub fn range(&self) -> [f64; 2] {
        let least = self.values.iter().copied().fold(f64::INFINITY, f64::min);
        [least, self.values.iter().copied().fold(0.0, f64::max)]
    }

    /// The geometric mean.
    pub(super) fn log_mean(&self) -> f64 {
        (self.values.iter().map(|value| value.ln()).sum::<f64>() / self.values.len() as f64).exp()
    }
}
