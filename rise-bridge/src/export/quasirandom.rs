//! Quasirandom points and quantiles, for comparing a table with its material.

/// Steps of the sequence R3: the powers of 1/1.2207440846.
///
/// M. Roberts, *The unreasonable effectiveness of quasirandom sequences* (2018).
const STEPS: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3];
/// Steps of the sequence R4: the powers of 1/1.1673039783.
const FOUR_STEPS: [f64; 4] =
    [0.856_674_883_854_502_9, 0.733_891_856_627_126, 0.628_706_721_037_808_6, 0.538_597_257_223_61];

/// The n-th point of R3 in the unit cube.
pub(crate) fn r3_sequence(n: usize) -> [f64; 3] {
    STEPS.map(|step| (0.5 + n as f64 * step).fract())
}

/// The n-th point of R4 in the unit cube of four dimensions.
pub(crate) fn r4_sequence(n: usize) -> [f64; 4] {
    FOUR_STEPS.map(|step| (0.5 + n as f64 * step).fract())
}

/// The value below which the fraction `part` of the weight lies; pairs are (value, weight).
pub(crate) fn weighted_quantile(mut pairs: Vec<(f64, f64)>, part: f64) -> f64 {
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let all: f64 = pairs.iter().map(|pair| pair.1).sum();
    let mut sum = 0.0;
    let found = pairs.iter().find(|pair| {
        sum += pair.1;
        sum >= part * all
    });
    found.map_or(0.0, |pair| pair.0)
}
