//! ASTM E308 by weights at 10 and 20 nm, for comparison with instruments and other programs.
//!
//! The products P(λ) = S c̄ at 1 nm from 360 to 780 nm are spread onto the nodes 360, 370, … 780 nm by
//! cubic Lagrange coefficients (quadratic in the first and the last interval) and divided by Σ W_y.
//! Weights beyond the ends of the samples are added to the first and the last one. AstmSamples at 20 nm
//! are first brought to 10 nm. At 5 nm every fifth product is summed, at 1 nm each.
//!
//! The 1 nm sum of [`crate::xyz`] is more accurate; the error of this method is 1e-4 for many
//! spectra.
//!
//! ASTM E308-18 and E2022-16, as implemented by colour-science 0.4.7.

use thiserror::Error;

use crate::{
    Illuminant, Observer, Spectrum,
    xyz::{Xyz, from_array},
};

/// First and last wavelength of the tables, in nm, and their step.
const FIRST: usize = 360;
const LAST: usize = 780;
const STEP: usize = 10;
const NODES: usize = (LAST - FIRST) / STEP + 1;

/// Samples that the method does not provide for.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum AstmError {
    /// Neither of the four steps, or not on multiples of the step.
    #[error(
        "astm e308 needs equal steps of 1, 5, 10 or 20 nm on multiples of the step (of 10 nm for 20)"
    )]
    Step,
    /// Too few samples between 360 and 780 nm.
    #[error("astm e308 needs at least {needed} samples from 360 to 780 nm, got {got}")]
    TooFew {
        /// The number of samples.
        got: usize,
        /// The required number.
        needed: usize,
    },
}

/// XYZ of a reflectance under an illuminant; a perfect diffuser has Y = 1.
///
/// # Errors
///
/// If the steps are not 1, 5, 10 or 20 nm, or there are too few samples.
pub fn reflected(
    reflectance: &Spectrum,
    illuminant: &Illuminant,
    observer: Observer,
) -> Result<Xyz, AstmError> {
    let samples = AstmSamples::new(reflectance)?;
    let products = products(illuminant, observer);
    let xyz = match samples.step {
        20 => weighted(&samples.halved()?, &products),
        10 => weighted(&samples, &products),
        _ => summed(&samples, &products),
    };
    Ok(from_array(xyz))
}

/// AstmSamples on whole nanometres between 360 and 780 nm.
struct AstmSamples {
    first: usize,
    step: usize,
    values: Vec<f64>,
}

impl AstmSamples {
    fn new(spectrum: &Spectrum) -> Result<Self, AstmError> {
        let nm = spectrum.grid().nm();
        let step = spectrum.grid().step_nm().ok_or(AstmError::Step)?.round() as usize;
        let multiple = match step {
            1 | 5 | 10 => step,
            20 => 10,
            _ => return Err(AstmError::Step),
        };
        if nm.iter().any(|nm| nm.fract() != 0.0 || nm % multiple as f64 != 0.0) {
            return Err(AstmError::Step);
        }
        let inside: Vec<(f64, f64)> = nm
            .iter()
            .copied()
            .zip(spectrum.values().iter().copied())
            .filter(|(nm, _)| (FIRST as f64..=LAST as f64).contains(nm))
            .collect();
        match inside.first() {
            Some(&(first, _)) => Ok(Self {
                first: first as usize,
                step,
                values: inside.into_iter().map(|(_, value)| value).collect(),
            }),
            None => Err(AstmError::TooFew { got: 0, needed: 1 }),
        }
    }

    fn last(&self) -> usize {
        self.first + self.step * (self.values.len() - 1)
    }

    /// The sample at a wavelength on the grid, the nearest one outside.
    fn held(&self, nm: usize) -> f64 {
        self.values[(nm.clamp(self.first, self.last()) - self.first) / self.step]
    }

    /// AstmSamples at half the step by the four-point formula, the ends continued quadratically.
    fn halved(&self) -> Result<Self, AstmError> {
        let v = &self.values;
        let n = v.len();
        if n < 3 {
            return Err(AstmError::TooFew { got: n, needed: 3 });
        }
        let mut padded = vec![3.0 * v[0] - 3.0 * v[1] + v[2]];
        padded.extend_from_slice(v);
        padded.push(3.0 * v[n - 1] - 3.0 * v[n - 2] + v[n - 3]);
        let mut values = vec![v[0]];
        for (p, value) in padded.windows(4).zip(&v[1..]) {
            values.push((-p[0] + 9.0 * p[1] + 9.0 * p[2] - p[3]) / 16.0);
            values.push(*value);
        }
        Ok(Self { first: self.first, step: self.step / 2, values })
    }
}

/// S c̄ at 360, 361, … 780 nm.
fn products(illuminant: &Illuminant, observer: Observer) -> Vec<[f64; 3]> {
    let both = illuminant.fine().iter().zip(observer.functions());
    both.take(LAST - FIRST + 1).map(|(s, c)| c.map(|c| s * c)).collect()
}

/// AstmSamples at 10 nm with the products spread onto their nodes.
fn weighted(samples: &AstmSamples, products: &[[f64; 3]]) -> [f64; 3] {
    let weights = node_weights(products);
    let total: f64 = weights.iter().map(|w| w[1]).sum();
    let mut sum = [0.0; 3];
    for (node, weight) in weights.iter().enumerate() {
        // Holding the ends adds the outer weights to the first and the last sample.
        let value = samples.held(FIRST + STEP * node);
        for (sum, weight) in sum.iter_mut().zip(weight) {
            *sum += value * weight / total;
        }
    }
    sum
}

fn node_weights(products: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut weights = vec![[0.0; 3]; NODES];
    for (i, product) in products.iter().enumerate() {
        let (interval, offset) = (i / STEP, i % STEP);
        if offset == 0 {
            add(&mut weights[interval], product, 1.0);
            continue;
        }
        let first = interval.saturating_sub(1);
        let last = (interval + 2).min(NODES - 1);
        let at = i as f64 / STEP as f64;
        for node in first..=last {
            add(&mut weights[node], product, lagrange(node, first..=last, at));
        }
    }
    weights
}

fn add(sum: &mut [f64; 3], product: &[f64; 3], factor: f64) {
    for (sum, product) in sum.iter_mut().zip(product) {
        *sum += factor * product;
    }
}

/// The Lagrange coefficient of a node among neighbouring nodes, at a place in units of the step.
fn lagrange(node: usize, nodes: std::ops::RangeInclusive<usize>, at: f64) -> f64 {
    let others = nodes.filter(|other| *other != node).map(|other| other as f64);
    others.map(|other| (at - other) / (node as f64 - other)).product()
}

/// AstmSamples at 1 or 5 nm with the products at their wavelengths.
fn summed(samples: &AstmSamples, products: &[[f64; 3]]) -> [f64; 3] {
    let (mut sum, mut total) = ([0.0; 3], 0.0);
    for (i, product) in products.iter().enumerate().step_by(samples.step) {
        let value = samples.held(FIRST + i);
        add(&mut sum, product, value);
        total += product[1];
    }
    sum.map(|sum| sum / total)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn constant(first: f64, step: f64, n: usize) -> Spectrum {
        let nm: Vec<f64> = (0..n).map(|i| first + step * i as f64).collect();
        Spectrum::new(&nm, &vec![1.0; n]).unwrap()
    }

    #[test]
    fn a_perfect_diffuser_has_unit_luminance_at_every_step() {
        let light = Illuminant::named("D65").unwrap();
        for (first, step, n) in
            [(400.0, 1.0, 301), (400.0, 5.0, 61), (400.0, 10.0, 31), (410.0, 20.0, 15)]
        {
            let xyz = reflected(&constant(first, step, n), &light, Observer::Cie1931_2).unwrap();
            // Rounding of a sum of normalized weights.
            assert!((xyz.y - 1.0).abs() < 1e-13, "{step}: {}", xyz.y);
        }
    }

    #[test]
    fn other_steps_are_refused() {
        let light = Illuminant::named("D65").unwrap();
        let refused = |spectrum| reflected(&spectrum, &light, Observer::Cie1931_2).unwrap_err();
        assert_eq!(refused(constant(400.0, 2.0, 50)), AstmError::Step);
        assert_eq!(refused(constant(405.0, 10.0, 20)), AstmError::Step);
        assert_eq!(refused(constant(400.5, 1.0, 20)), AstmError::Step);
        assert_eq!(refused(constant(200.0, 10.0, 5)), AstmError::TooFew { got: 0, needed: 1 });
        assert_eq!(refused(constant(400.0, 20.0, 2)), AstmError::TooFew { got: 2, needed: 3 });
    }
}
