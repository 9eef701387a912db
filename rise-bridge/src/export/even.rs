//! Directions spread evenly, and what most of the light over them has.

/// Steps of an even sequence in three dimensions: the powers of 1/1.2207440846.
///
/// M. Roberts, *The unreasonable effectiveness of quasirandom sequences* (2018).
const STEPS: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3];

/// The n-th point in the unit cube.
pub(crate) fn even(n: usize) -> [f64; 3] {
    STEPS.map(|step| (0.5 + n as f64 * step).fract())
}

/// The value below which this `part` of the light lies; pairs are (value, light).
pub(crate) fn quantile(mut pairs: Vec<(f64, f64)>, part: f64) -> f64 {
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let all: f64 = pairs.iter().map(|pair| pair.1).sum();
    let mut sum = 0.0;
    let found = pairs.iter().find(|pair| {
        sum += pair.1;
        sum >= part * all
    });
    found.map_or(0.0, |pair| pair.0)
}
