//! The material along one period of a slice, and its Fourier series.

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::rcw::{
    layer::{LayerOperators, MaterialTensor},
    toeplitz::{FourierSeries, inverse},
};

/// Permittivity and permeability along x, y and z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GratingMaterial {
    /// ε_x, ε_y, ε_z.
    pub epsilon: [Complex64; 3],
    /// μ_x, μ_y, μ_z.
    pub mu: [Complex64; 3],
}

impl GratingMaterial {
    /// The isotropic, non-magnetic material of this index.
    pub fn from_index(n: Complex64) -> Self {
        Self { epsilon: [n * n; 3], mu: [Complex64::ONE; 3] }
    }
}

/// The material as a function of x.
#[derive(Clone, Debug, PartialEq)]
pub enum LinePattern {
    /// `materials[b]` between `edges[b]` and `edges[b + 1]`, µm; the edges span one period.
    Bands {
        /// Ends of the bands, ascending, one more than materials.
        edges: Vec<f64>,
        /// Materials.
        materials: Vec<GratingMaterial>,
    },
    /// ε = mean + swing cos(2πx/period + phase).
    Cosine {
        /// Mean permittivity.
        mean: Complex64,
        /// Amplitude.
        swing: Complex64,
        /// Phase at x = 0, radians.
        phase: f64,
        /// Period, µm.
        period: f64,
        /// Series of 1/ε.
        reciprocal: CosineReciprocal,
    },
}

/// Series of the inverse of a cosine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CosineReciprocal {
    /// In closed form.
    Exact,
    /// Powers 0…19 of the contrast ([`Defect::VolumeSeries`](crate::Defect::VolumeSeries)).
    TwentyPowers,
}

impl LinePattern {
    /// One material everywhere.
    pub fn uniform(material: GratingMaterial, period: f64) -> Self {
        Self::Bands { edges: vec![0.0, period], materials: vec![material] }
    }

    /// A line of `inside` from `start` to `end`, `outside` elsewhere.
    pub fn line(
        start: f64,
        end: f64,
        period: f64,
        inside: GratingMaterial,
        outside: GratingMaterial,
    ) -> Self {
        let width = end - start;
        if width <= 0.0 || inside == outside {
            Self::uniform(outside, period)
        } else if width >= period {
            Self::uniform(inside, period)
        } else {
            Self::Bands {
                edges: vec![start, end, start + period],
                materials: vec![inside, outside],
            }
        }
    }

    /// The same pattern moved by `by` µm along x.
    #[must_use]
    pub fn shifted(&self, by: f64) -> Self {
        match self {
            Self::Bands { edges, materials } if materials.len() > 1 => Self::Bands {
                edges: edges.iter().map(|x| x + by).collect(),
                materials: materials.clone(),
            },
            Self::Bands { .. } => self.clone(),
            Self::Cosine { mean, swing, phase, period, reciprocal } => Self::Cosine {
                mean: *mean,
                swing: *swing,
                phase: phase - TAU * by / period,
                period: *period,
                reciprocal: *reciprocal,
            },
        }
    }

    /// The same pattern with −x for x.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        match self {
            Self::Bands { edges, materials } => Self::Bands {
                edges: edges.iter().rev().map(|x| -x).collect(),
                materials: materials.iter().rev().copied().collect(),
            },
            Self::Cosine { mean, swing, phase, period, reciprocal } => Self::Cosine {
                mean: *mean,
                swing: *swing,
                phase: -phase,
                period: *period,
                reciprocal: *reciprocal,
            },
        }
    }

    /// True if the pattern is equal to its mirror image up to rounding errors.
    pub fn is_symmetric(&self) -> bool {
        match self {
            Self::Bands { materials, .. } => {
                let isotropic = |of: fn(&GratingMaterial) -> [Complex64; 3]| {
                    (0..3).all(|axis| {
                        let series = self.bands(4, |m| of(m)[axis]);
                        let scale: f64 = materials.iter().map(|m| of(m)[axis].norm()).sum();
                        (1..=4).all(|m| (series.at(m) - series.at(-m)).norm() < 1e-13 * scale)
                    })
                };
                isotropic(|m| m.epsilon) && isotropic(|m| m.mu)
            }
            Self::Cosine { swing, phase, .. } => swing.norm() == 0.0 || phase.sin().abs() < 1e-13,
        }
    }

    /// Effect on fields of the harmonics −`order`…`order`, in a slice of `depth` (in 1/k₀).
    pub fn operators(&self, order: usize, depth: f64) -> LayerOperators {
        LayerOperators {
            depth,
            epsilon: self.tensor(order, |m| m.epsilon),
            mu: self.tensor(order, |m| m.mu),
            waves: None,
        }
    }

    /// Li's rules: across the lines (x) the inverse of the series of the inverse, along them (y)
    /// the series itself, and for the normal field the inverse of the series.
    fn tensor(
        &self,
        order: usize,
        of: impl Fn(&GratingMaterial) -> [Complex64; 3],
    ) -> MaterialTensor {
        let n = 2 * order + 1;
        if let Self::Bands { materials, .. } = self
            && materials.iter().all(|m| of(m) == [Complex64::ONE; 3])
        {
            return MaterialTensor::vacuum(n);
        }
        let (straight, reciprocal) = match self {
            Self::Bands { .. } => {
                let series = |axis: usize, power: i32| {
                    self.bands(2 * order, |m| of(m)[axis].powi(power)).matrix(n)
                };
                ([series(1, 1), series(2, 1)], series(0, -1))
            }
            Self::Cosine { mean, swing, phase, reciprocal, .. } => {
                if of(&GratingMaterial::from_index(*mean)) == [Complex64::ONE; 3] {
                    return MaterialTensor::vacuum(n);
                }
                let series = cosine(*mean, *swing, *phase, 2 * order).matrix(n);
                let inverse = match reciprocal {
                    CosineReciprocal::Exact => inverse_cosine,
                    CosineReciprocal::TwentyPowers => powers_of_cosine,
                };
                let reciprocal = inverse(*mean, *swing, *phase, 2 * order).matrix(n);
                ([series.clone(), series], reciprocal)
            }
        };
        let [yy, zz] = straight;
        MaterialTensor { xx: inverse(&reciprocal), xy: None, yy, zz_inverse: inverse(&zz) }
    }

    /// Series −`most`…`most` of a function of the material, exact for bands.
    fn bands(&self, most: usize, of: impl Fn(&GratingMaterial) -> Complex64) -> FourierSeries {
        let Self::Bands { edges, materials } = self else {
            return FourierSeries(vec![Complex64::ZERO; 2 * most + 1]);
        };
        let period = edges[edges.len() - 1] - edges[0];
        let values: Vec<Complex64> = materials.iter().map(of).collect();
        let coefficient = |m: isize| -> Complex64 {
            let bands = edges.windows(2).zip(&values);
            if m == 0 {
                return bands.map(|(x, v)| v * ((x[1] - x[0]) / period)).sum();
            }
            let turn = TAU * m as f64;
            let wave = |x: f64| Complex64::cis(-turn * (x / period));
            let sum: Complex64 = bands.map(|(x, v)| v * (wave(x[1]) - wave(x[0]))).sum();
            sum * Complex64::new(0.0, 1.0 / turn)
        };
        let most = most as isize;
        FourierSeries((-most..=most).map(coefficient).collect())
    }
}

fn cosine(mean: Complex64, swing: Complex64, phase: f64, most: usize) -> FourierSeries {
    let mut series = FourierSeries(vec![Complex64::ZERO; 2 * most + 1]);
    series.0[most] = mean;
    if most > 0 {
        series.0[most + 1] = 0.5 * swing * Complex64::cis(phase);
        series.0[most - 1] = 0.5 * swing * Complex64::cis(-phase);
    }
    series
}

/// 1/(a + b cos θ) = Σ q^|m| e^{imθ}/√(a² − b²), q = (√(a² − b²) − a)/b with |q| < 1.
fn inverse_cosine(mean: Complex64, swing: Complex64, phase: f64, most: usize) -> FourierSeries {
    let root = {
        // The sign that makes |q| < 1 is that of a.
        let root = (mean * mean - swing * swing).sqrt();
        if (root * mean.conj()).re < 0.0 { -root } else { root }
    };
    // b/(−a − root), free of cancellation and right for b = 0.
    let q = -swing / (mean + root);
    let most = most as isize;
    FourierSeries(
        (-most..=most)
            .map(|m| q.powi(m.unsigned_abs() as i32) / root * Complex64::cis(phase * m as f64))
            .collect(),
    )
}

/// The same as Σ_j (−b cos θ)^j/a^{j+1}, j < 20.
fn powers_of_cosine(mean: Complex64, swing: Complex64, phase: f64, most: usize) -> FourierSeries {
    let most = most as isize;
    let coefficient = |m: isize| {
        let size = m.unsigned_abs();
        let (mut sum, ratio) = (Complex64::ZERO, -0.5 * swing / mean);
        for j in (size..20).step_by(2) {
            // cos^j θ has the coefficient C(j, (j − |m|)/2)/2^j.
            let binomial: f64 =
                (1..=(j - size) / 2).map(|k| (j + 1 - k) as f64 / k as f64).product();
            sum += ratio.powi(j as i32) * binomial;
        }
        sum / mean * Complex64::cis(phase * m as f64)
    };
    FourierSeries((-most..=most).map(coefficient).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_of_the_inverse_cosine_sums_to_the_function() {
        let (a, b) = (Complex64::new(2.4, 0.3), Complex64::new(0.7, -0.1));
        let series = inverse_cosine(a, b, 0.4, 60);
        for x in [0.0, 0.7, 2.9] {
            let sum: Complex64 =
                (-60..=60).map(|m| series.at(m) * Complex64::cis(x * m as f64)).sum();
            // |q|^60 is below the rounding of 121 terms.
            assert!((sum - 1.0 / (a + b * (x + 0.4).cos())).norm() < 1e-14);
        }
    }

    #[test]
    fn powers_of_a_small_contrast_are_the_closed_form() {
        let (a, b) = (Complex64::new(2.4, 0.3), Complex64::new(0.1, -0.05));
        let (exact, powers) = (inverse_cosine(a, b, 0.4, 6), powers_of_cosine(a, b, 0.4, 6));
        for m in -6..=6 {
            // Rounding of a value of 0.4.
            assert!((exact.at(m) - powers.at(m)).norm() < 3e-16, "{m}");
        }
    }

    #[test]
    fn moving_a_pattern_turns_the_phases_of_its_series() {
        let (line, space) = (
            GratingMaterial::from_index(Complex64::new(2.0, 0.1)),
            GratingMaterial::from_index(Complex64::new(1.0, 0.0)),
        );
        let here = LinePattern::line(-0.1, 0.2, 0.8, line, space);
        let (a, b) =
            (here.bands(4, |m| m.epsilon[0]), here.shifted(0.3).bands(4, |m| m.epsilon[0]));
        for m in -4..=4 {
            let turned = a.at(m) * Complex64::cis(-TAU * m as f64 * 0.3 / 0.8);
            assert!((b.at(m) - turned).norm() < 1e-14);
        }
    }
}
