//! Colour differences of pictures: statistics of CIEDE2000 over the pixels.

use rayon::prelude::*;
use spectra::{difference::delta_e_2000, lab::Lab};

/// The colour differences of two pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ColourDifference {
    /// Mean over the pixels.
    pub mean: f64,
    /// Not exceeded by 95 % of the pixels.
    pub p95: f64,
    /// Largest.
    pub max: f64,
}

/// CIEDE2000 between two pictures, pixel by pixel up to the length of the shorter one.
///
/// Pixels whose difference is not finite are left out.
pub fn differences(test: &[Lab], reference: &[Lab]) -> ColourDifference {
    let pairs = test.par_iter().zip(reference);
    let mut all: Vec<f64> =
        pairs.map(|(a, b)| delta_e_2000(*a, *b)).filter(|d| d.is_finite()).collect();
    all.sort_by(f64::total_cmp);
    let (Some(max), count) = (all.last().copied(), all.len()) else {
        return ColourDifference::default();
    };
    let p95 = all[(count * 95).div_ceil(100) - 1];
    ColourDifference { mean: all.iter().sum::<f64>() / count as f64, p95, max }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_changed_pixel_of_forty_is_seen_in_mean_and_maximum_only() {
        let reference = vec![Lab::new(50.0, 0.0, 0.0); 40];
        let mut test = reference.clone();
        test[7] = Lab::new(54.0, 0.0, 0.0);
        let found = differences(&test, &reference);
        let one = delta_e_2000(test[7], reference[7]);
        // The mean of one number and zeros.
        assert!((found.mean - one / 40.0).abs() < 1e-15);
        assert_eq!((found.p95, found.max), (0.0, one));
        assert_eq!(differences(&[], &[]), ColourDifference::default());
    }
}
