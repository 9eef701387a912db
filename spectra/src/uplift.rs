//! A smooth reflectance for a colour that is given as RGB.
//!
//! Many reflectances have one colour, so the result is invented. It is the smooth function
//!
//! $$ R(\lambda) = S(c_0 t^2 + c_1 t + c_2), \qquad S(x) = \tfrac12 + \frac{x}{2\sqrt{1 + x^2}},
//!    \qquad t = \frac{\lambda - 360}{470} \qquad (1) $$
//!
//! with values between 0 and 1, whose colour under the white of the RGB space is the given one.
//! The coefficients follow from Newton's method along the line from grey to the colour.
//!
//! W. Jakob and J. Hanika, *A low-dimensional function space for efficient spectral upsampling*,
//! Comput. Graph. Forum 38, 147 (2019).

use crate::{
    Extrapolation, Illuminant, Matrix3, Observer, RgbSpace, XyzWeights, matrix,
    wavelength::{Grid, fine_wavelengths},
};

/// Largest |R − target| of the linear RGB values of a solution.
const SOLVED: f64 = 1e-10;

/// Values of RGB closer than this to 0 or 1 are moved inside: R = 0 and R = 1 are limits of (1).
const MARGIN: f64 = 1e-4;

/// Steps from grey to the colour, and Newton steps at each of them.
const STEPS: (i32, usize) = (64, 12);

/// A smooth reflectance with a given colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UpliftedReflectance {
    /// c₀, c₁ and c₂ of (1).
    coefficients: [f64; 3],
    /// Largest difference of its linear RGB values from the colour.
    error: f64,
}

impl UpliftedReflectance {
    /// The reflectance at a wavelength in nm.
    pub fn at(&self, nm: f64) -> f64 {
        sigmoid(polynomial(self.coefficients, nm))
    }

    /// The largest difference of the linear RGB values of this reflectance from the given colour.
    ///
    /// Colours near the limits of the space, such as a pure primary, are not reached: no smooth
    /// reflectance has them.
    pub fn error(&self) -> f64 {
        self.error
    }
}

/// Finds smooth reflectances for colours of one RGB space under one illuminant.
#[derive(Clone, Debug)]
pub struct ReflectanceUplift {
    weights: XyzWeights,
    to_rgb: Matrix3,
}

impl ReflectanceUplift {
    /// For linear values of `space`, whose white (1, 1, 1) is a perfect diffuser under `illuminant`.
    ///
    /// The illuminant should have the white of the space: D65 for sRGB. A remaining difference is
    /// scaled away in each channel.
    pub fn new(space: &RgbSpace, illuminant: &Illuminant, observer: Observer) -> Self {
        let nm: Vec<f64> = fine_wavelengths().collect();
        let weights = match Grid::new(&nm) {
            Ok(grid) => XyzWeights::new(&grid, illuminant, observer, Extrapolation::Hold),
            Err(error) => unreachable!("the 1 nm grid is valid: {error}"),
        };
        let white = space.linear(weights.xyz(&vec![1.0; nm.len()]));
        let mut to_rgb = *space.from_xyz_matrix();
        for (row, white) in to_rgb.iter_mut().zip(white) {
            *row = row.map(|x| x / white);
        }
        Self { weights, to_rgb }
    }

    /// A reflectance with the linear values `rgb`; values are clipped to 0 … 1.
    pub fn reflectance(&self, rgb: [f64; 3]) -> UpliftedReflectance {
        let target = rgb.map(|x| x.clamp(MARGIN, 1.0 - MARGIN));
        let grey = target.iter().sum::<f64>() / 3.0;
        let mut best = UpliftedReflectance { coefficients: [0.0, 0.0, logit(grey)], error: 1.0 };
        for step in 1..=STEPS.0 {
            let part = f64::from(step) / f64::from(STEPS.0);
            let point = target.map(|x| grey + part * (x - grey));
            match self.newton(best.coefficients, point) {
                Some(coefficients) => best.coefficients = coefficients,
                None => break,
            }
        }
        let reached = self.rgb(best.coefficients);
        best.error = distance(reached, rgb);
        best
    }

    /// The coefficients of the colour `target` by Newton's method from `start`; `None` if it does not
    /// converge.
    fn newton(&self, start: [f64; 3], target: [f64; 3]) -> Option<[f64; 3]> {
        let mut c = start;
        for _ in 0..STEPS.1 {
            let (rgb, jacobian) = self.linearized(c);
            if distance(rgb, target) < SOLVED {
                return Some(c);
            }
            let missing = std::array::from_fn(|k| target[k] - rgb[k]);
            let step = matrix::apply(&matrix::inverse(&jacobian)?, missing);
            c = std::array::from_fn(|k| c[k] + step[k]);
        }
        (distance(self.rgb(c), target) < SOLVED.sqrt()).then_some(c)
    }

    /// Linear RGB values of the reflectance with these coefficients.
    fn rgb(&self, coefficients: [f64; 3]) -> [f64; 3] {
        self.linearized(coefficients).0
    }

    /// Linear RGB values and their derivatives with respect to the coefficients (columns).
    fn linearized(&self, coefficients: [f64; 3]) -> ([f64; 3], Matrix3) {
        let (mut xyz, mut slopes) = ([0.0; 3], [[0.0; 3]; 3]);
        for (nm, weights) in fine_wavelengths().zip(self.weights.rows()) {
            let x = polynomial(coefficients, nm);
            let (value, slope) = (sigmoid(x), 0.5 * (1.0 + x * x).powf(-1.5));
            let t = coordinate(nm);
            let basis = [t * t, t, 1.0];
            for k in 0..3 {
                xyz[k] += weights[k] * value;
                for (sum, b) in slopes[k].iter_mut().zip(basis) {
                    *sum += weights[k] * slope * b;
                }
            }
        }
        let row = |k: usize, of: &dyn Fn(usize) -> f64| -> f64 {
            self.to_rgb[k].iter().enumerate().map(|(j, m)| m * of(j)).sum()
        };
        let rgb = std::array::from_fn(|k| row(k, &|j| xyz[j]));
        let jacobian = std::array::from_fn(|k| std::array::from_fn(|c| row(k, &|j| slopes[j][c])));
        (rgb, jacobian)
    }
}

/// t of (1).
fn coordinate(nm: f64) -> f64 {
    (nm - 360.0) / 470.0
}

fn polynomial([c0, c1, c2]: [f64; 3], nm: f64) -> f64 {
    let t = coordinate(nm);
    (c0 * t + c1) * t + c2
}

/// S of (1).
fn sigmoid(x: f64) -> f64 {
    0.5 + 0.5 * x / (1.0 + x * x).sqrt()
}

/// x with S(x) = `value`.
fn logit(value: f64) -> f64 {
    let y = 2.0 * value - 1.0;
    y / (1.0 - y * y).sqrt()
}

/// The largest difference of two colours.
fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn uplift() -> ReflectanceUplift {
        let d65 = Illuminant::named("D65").unwrap();
        ReflectanceUplift::new(&RgbSpace::srgb(), &d65, Observer::Cie1931_2)
    }

    #[test]
    fn grey_is_flat() {
        let grey = uplift().reflectance([0.3; 3]);
        assert!(grey.error() < 1e-9);
        for nm in [380.0, 550.0, 780.0] {
            assert!((grey.at(nm) - 0.3).abs() < 1e-8);
        }
    }

    #[test]
    fn a_red_reflects_long_waves() {
        let red = uplift().reflectance([0.6, 0.1, 0.1]);
        assert!(red.error() < 1e-8, "{red:?}");
        assert!(red.at(650.0) > 3.0 * red.at(500.0));
    }

    #[test]
    fn a_primary_is_reached_approximately() {
        let error = uplift().reflectance([1.0, 0.0, 0.0]).error();
        assert!(error < 0.2, "{error}");
    }

    proptest! {
        #[test]
        fn colours_are_reached_within_1e_8(
            r in 0.05..0.8f64, g in 0.05..0.8f64, b in 0.05..0.8f64,
        ) {
            let found = uplift().reflectance([r, g, b]);
            prop_assert!(found.error() < 1e-8, "{found:?}");
            for nm in fine_wavelengths() {
                prop_assert!((0.0..=1.0).contains(&found.at(nm)));
            }
        }
    }
}
