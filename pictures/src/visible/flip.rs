//! ꟻLIP: the difference that a viewer sees when flipping between two pictures, by the crate
//! `flip-rs`.
//!
//! P. Andersson et al., Proc. ACM Comput. Graph. Interact. Tech. 3(2), 15 (2020); for high dynamic
//! range P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Möller, Eurographics Short Papers (2021).

use flip_rs::{ErrorMap, FlipError, HdrOptions, RgbImage, hdr_flip, ldr_flip};

use super::error::VisibleError;

/// The range of the channels of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FlipRange {
    /// Encoded sRGB, 0 … 1.
    Encoded,
    /// Linear sRGB without limit; 1 is white.
    Linear,
}

/// Statistics of a ꟻLIP map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flip {
    /// Mean over the pixels, 0 … 1.
    pub mean: f64,
    /// Half of the total error lies in pixels below this value.
    pub weighted_median: f64,
    /// Largest.
    pub max: f64,
}

/// ꟻLIP between two pictures of `width` × `height` pixels, red, green and blue one after the
/// other. NaN counts as zero.
///
/// # Errors
///
/// If ꟻLIP is not defined for the pictures, as for a reference that is all black.
pub fn flip(
    [width, height]: [usize; 2],
    test: Vec<f32>,
    reference: Vec<f32>,
    pixels_per_degree: f64,
    range: FlipRange,
) -> Result<Flip, VisibleError> {
    let refused = |error: FlipError| VisibleError::Flip(error.to_string());
    let image = |mut values: Vec<f32>| {
        values.iter_mut().filter(|v| v.is_nan()).for_each(|v| *v = 0.0);
        RgbImage::new(width, height, values).map_err(refused)
    };
    let (test, reference) = (image(test)?, image(reference)?);
    let ppd = pixels_per_degree as f32;
    let map: ErrorMap = match range {
        FlipRange::Encoded => ldr_flip(&reference, &test, ppd).map_err(refused)?,
        FlipRange::Linear => {
            let mut options = HdrOptions::default();
            options.ppd = ppd;
            options.return_exposure_map = false;
            hdr_flip(&reference, &test, options).map_err(refused)?.error_map
        }
    };
    let sums = map.statistics();
    let [mean, weighted_median] = [sums.mean, sums.weighted_median].map(f64::from);
    let max = map.pixels().iter().copied().fold(0.0, f32::max);
    Ok(Flip { mean, weighted_median, max: f64::from(max) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pictures_do_not_differ_and_black_and_white_do() {
        let size = [16, 16];
        let picture = |v: f32| vec![v; 3 * 256];
        for range in [FlipRange::Encoded, FlipRange::Linear] {
            let same = flip(size, picture(0.5), picture(0.5), 30.0, range).unwrap();
            assert_eq!((same.mean, same.max), (0.0, 0.0));
            let other = flip(size, picture(0.0), picture(1.0), 30.0, range).unwrap();
            assert!(other.mean > 0.5, "{other:?}");
        }
    }

    #[test]
    fn a_black_reference_has_no_range_of_exposures() {
        let black = || vec![0.0; 3 * 4];
        assert!(flip([2, 2], black(), black(), 30.0, FlipRange::Linear).is_err());
    }
}
