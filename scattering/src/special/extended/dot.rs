//! Sums of products of [`Extended`] numbers, several side by side.
//!
//! The error of a product is the same with a fused multiply-add, where the processor has one, and
//! without: so are the bits of a sum.

#[cfg(target_arch = "x86_64")]
use pulp::{NullaryFnOnce, x86::V3};

use super::Extended;

/// Number of sums that run side by side.
const LANES: usize = 4;

/// Numbers, their leading parts and the others apart, filled up with zeros.
#[derive(Clone, Debug, Default)]
pub struct ExtendedRow {
    high: Vec<[f64; LANES]>,
    low: Vec<[f64; LANES]>,
}

impl FromIterator<Extended> for ExtendedRow {
    fn from_iter<I: IntoIterator<Item = Extended>>(numbers: I) -> Self {
        let mut row = Self::default();
        for (at, number) in numbers.into_iter().enumerate() {
            if at % LANES == 0 {
                row.high.push([0.0; LANES]);
                row.low.push([0.0; LANES]);
            }
            row.high[at / LANES][at % LANES] = number.high;
            row.low[at / LANES][at % LANES] = number.low;
        }
        row
    }
}

impl ExtendedRow {
    /// Σ a b.
    pub fn dot(&self, other: &Self) -> Extended {
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = V3::try_new() {
            return simd.vectorize(Fused(self, other));
        }
        dot::<false>(self, other)
    }
}

/// The sum on processors with fused multiply-add.
#[cfg(target_arch = "x86_64")]
struct Fused<'a>(&'a ExtendedRow, &'a ExtendedRow);

#[cfg(target_arch = "x86_64")]
impl NullaryFnOnce for Fused<'_> {
    type Output = Extended;

    #[inline(always)]
    fn call(self) -> Extended {
        dot::<true>(self.0, self.1)
    }
}

#[inline(always)]
fn dot<const FUSED: bool>(a: &ExtendedRow, b: &ExtendedRow) -> Extended {
    let (mut high, mut low) = ([0.0; LANES], [0.0; LANES]);
    let numbers = a.high.iter().zip(&a.low).zip(b.high.iter().zip(&b.low));
    for ((a_high, a_low), (b_high, b_low)) in numbers {
        for k in 0..LANES {
            let leading = a_high[k] * b_high[k];
            let error = if FUSED {
                a_high[k].mul_add(b_high[k], -leading)
            } else {
                super::product(a_high[k], b_high[k]).low
            };
            let error = error + (a_high[k] * b_low[k] + a_low[k] * b_high[k]);
            let total = high[k] + leading;
            let part = total - high[k];
            let rest = (high[k] - (total - part)) + (leading - part);
            let rest = rest + (low[k] + error);
            high[k] = total + rest;
            low[k] = rest - (high[k] - total);
        }
    }
    let sums = high.into_iter().zip(low).map(|(high, low)| Extended { high, low });
    sums.fold(Extended::ZERO, |total, sum| total + sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_have_the_bits_of_the_other_and_the_value_of_single_products() {
        let number =
            |k: usize| Extended::from(1.0 + k as f64) / Extended::from(7.0 - 0.3 * k as f64);
        let (a, b): (Vec<_>, Vec<_>) = (0..19).map(|k| (number(k), number(2 * k + 1))).unzip();
        let expected = a.iter().zip(&b).fold(Extended::ZERO, |sum, (&a, &b)| sum + a * b);
        let (a, b): (ExtendedRow, ExtendedRow) = (a.into_iter().collect(), b.into_iter().collect());
        assert_eq!(a.dot(&b), dot::<false>(&a, &b));
        assert!((a.dot(&b) - expected).to_f64().abs() < 1e-28 * expected.to_f64().abs());
    }
}
