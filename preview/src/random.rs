//! Counter-based random numbers: functions of pixel, sample and dimension.

/// The random numbers of one sample of one pixel, uniform in [0, 1).
#[derive(Clone, Copy, Debug)]
pub(crate) struct SampleRandom(u64);

impl SampleRandom {
    /// The numbers of a sample of a pixel.
    pub(crate) fn new(x: usize, y: usize, sample: usize) -> Self {
        Self(mix(mix(mix(x as u64) ^ y as u64) ^ sample as u64))
    }

    /// The number of a dimension.
    pub(crate) fn at(self, dimension: u64) -> f64 {
        (mix(self.0 ^ mix(dimension)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// The numbers of two dimensions.
    pub(crate) fn pair(self, dimension: u64) -> [f64; 2] {
        [self.at(2 * dimension), self.at(2 * dimension + 1)]
    }
}

/// The finalizer of SplitMix64 (Steele, Lea and Flood, OOPSLA 2014) after one step of its counter.
fn mix(x: u64) -> u64 {
    let mut z = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_is_a_half_in_every_dimension() {
        for dimension in 0..6 {
            let sum: f64 =
                (0..10_000).map(|i| SampleRandom::new(i % 100, i / 100, 3).at(dimension)).sum();
            // Four standard deviations of the mean of 10⁴ uniform numbers.
            assert!((sum / 1e4 - 0.5).abs() < 4.0 * 0.289 / 100.0, "{dimension}: {sum}");
        }
    }
}
