//! Filters between the sample and the eye, as Mueller matrices that may depend on wavelength.
//!
//! Angles are in radians from the +Q axis of the Stokes vector; V > 0 is left-handed. A filter acts
//! on the 1 nm grid, before the sum, so dispersion (a retarder) is exact.
//!
//! For a filter without dispersion and transmittances k₁, k₂,
//! XYZ = ½[(k₁+k₂) XYZ(I) + (k₁−k₂)(cos 2θ XYZ(Q) + sin 2θ XYZ(U))]: the XYZ of the components
//! serve every angle of a polarizer.
//!
//! D. H. Goldstein, *Polarized Light*, 3rd ed. (2011), chapters 5 and 6.

use std::f64::consts::TAU;

use thiserror::Error;

use crate::name::{UnknownName, call, fold, similar};

/// A Mueller matrix, row by row.
pub type FilterMatrix = [[f64; 4]; 4];

/// Errors of making a filter.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FilterError {
    /// Not the name of a filter, or not of the form `name(number, …)`.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// The wrong number of arguments.
    #[error("{filter} takes {expected}, got {got} arguments")]
    Arguments {
        /// The filter.
        filter: &'static str,
        /// The accepted arguments.
        expected: &'static str,
        /// The number of arguments.
        got: usize,
    },
    /// An argument out of range.
    #[error("{filter}: {argument} is {value}, expected {expected}")]
    OutOfRange {
        /// The filter.
        filter: &'static str,
        /// The argument.
        argument: &'static str,
        /// Its value.
        value: f64,
        /// The accepted values.
        expected: &'static str,
    },
}

/// A polarizing filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Filter {
    /// A linear polarizer.
    Linear {
        /// Direction of the transmitted vibration, in radians from +Q.
        angle: f64,
        /// Transmittance of light polarized along it.
        k1: f64,
        /// Transmittance of light polarized across it.
        k2: f64,
    },
    /// A linear retarder of the same path difference at every wavelength.
    Retarder {
        /// Direction of the fast axis, in radians from +Q.
        fast_axis: f64,
        /// Path difference in nm.
        retardance_nm: f64,
    },
    /// An ideal circular analyser.
    Circular {
        /// Passes V > 0 (left) rather than V < 0.
        left: bool,
    },
}

impl Filter {
    /// The filter written `linear(angle[,k1,k2])`, `retarder(fast_axis,nm)`, `circular(1)` or
    /// `circular(-1)`; angles in radians.
    ///
    /// # Errors
    ///
    /// If the text is none of these or an argument is out of range.
    pub fn parse(text: &str) -> Result<Self, FilterError> {
        match call(text) {
            Some((name, arguments)) => Self::from_call(&name, &arguments),
            None => Err(unknown(text).into()),
        }
    }

    /// The filter `name` with arguments that are numbers already, angles in radians.
    ///
    /// # Errors
    ///
    /// If there is no such filter, or the arguments do not fit.
    pub fn from_call(name: &str, arguments: &[f64]) -> Result<Self, FilterError> {
        match (fold(name).as_str(), arguments) {
            ("linear", &[angle]) => Self::linear(angle, 1.0, 0.0),
            ("linear", &[angle, k1, k2]) => Self::linear(angle, k1, k2),
            ("retarder", &[fast_axis, nm]) => Self::retarder(fast_axis, nm),
            ("circular", &[handedness]) => Self::circular(handedness),
            ("linear", _) => Err(arguments_error("linear", "angle[, k1, k2]", arguments)),
            ("retarder", _) => Err(arguments_error("retarder", "fast axis, nm", arguments)),
            ("circular", _) => Err(arguments_error("circular", "1 or -1", arguments)),
            _ => Err(unknown(name).into()),
        }
    }

    /// A linear polarizer at `angle` radians with principal transmittances `k1` and `k2`.
    ///
    /// # Errors
    ///
    /// If the angle is not finite or a transmittance is not from 0 to 1.
    pub fn linear(angle: f64, k1: f64, k2: f64) -> Result<Self, FilterError> {
        check("linear", "angle", angle, angle.is_finite(), "a finite number")?;
        check("linear", "k1", k1, (0.0..=1.0).contains(&k1), "from 0 to 1")?;
        check("linear", "k2", k2, (0.0..=1.0).contains(&k2), "from 0 to 1")?;
        Ok(Self::Linear { angle, k1, k2 })
    }

    /// A linear retarder with its fast axis at `fast_axis` radians.
    ///
    /// # Errors
    ///
    /// If a number is not finite.
    pub fn retarder(fast_axis: f64, retardance_nm: f64) -> Result<Self, FilterError> {
        let finite = "a finite number";
        check("retarder", "fast axis", fast_axis, fast_axis.is_finite(), finite)?;
        check("retarder", "retardance", retardance_nm, retardance_nm.is_finite(), finite)?;
        Ok(Self::Retarder { fast_axis, retardance_nm })
    }

    /// An ideal circular analyser; 1 passes V > 0 (left), −1 passes V < 0.
    ///
    /// # Errors
    ///
    /// If the handedness is neither.
    pub fn circular(handedness: f64) -> Result<Self, FilterError> {
        check("circular", "handedness", handedness, handedness.abs() == 1.0, "1 or -1")?;
        Ok(Self::Circular { left: handedness > 0.0 })
    }

    /// The Mueller matrix at a wavelength in nm.
    pub fn mueller(&self, nm: f64) -> FilterMatrix {
        match *self {
            Self::Linear { angle, k1, k2 } => linear_mueller(angle, k1, k2),
            Self::Retarder { fast_axis, retardance_nm } => {
                retarder_mueller(fast_axis, TAU * retardance_nm / nm)
            }
            Self::Circular { left } => circular_mueller(if left { 1.0 } else { -1.0 }),
        }
    }
}

/// The Mueller matrix of filters in the order in which light meets them, at a wavelength in nm.
pub fn stack_mueller(filters: &[Filter], nm: f64) -> FilterMatrix {
    let mut stack = [[0.0; 4]; 4];
    for (i, row) in stack.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for filter in filters {
        stack = multiply(&filter.mueller(nm), &stack);
    }
    stack
}

/// The Mueller matrix times a Stokes vector.
pub(crate) fn apply(m: &FilterMatrix, stokes: [f64; 4]) -> [f64; 4] {
    m.map(|row| row.iter().zip(stokes).map(|(m, s)| m * s).sum())
}

fn multiply(a: &FilterMatrix, b: &FilterMatrix) -> FilterMatrix {
    a.map(|row| [0, 1, 2, 3].map(|j| (0..4).map(|k| row[k] * b[k][j]).sum()))
}

fn linear_mueller(angle: f64, k1: f64, k2: f64) -> FilterMatrix {
    let (s, c) = (2.0 * angle).sin_cos();
    let (a, b, r) = (0.5 * (k1 + k2), 0.5 * (k1 - k2), (k1 * k2).sqrt());
    [
        [a, b * c, b * s, 0.0],
        [b * c, a * c * c + r * s * s, (a - r) * c * s, 0.0],
        [b * s, (a - r) * c * s, a * s * s + r * c * c, 0.0],
        [0.0, 0.0, 0.0, r],
    ]
}

fn retarder_mueller(fast_axis: f64, delta: f64) -> FilterMatrix {
    let (s, c) = (2.0 * fast_axis).sin_cos();
    let (sin, cos) = delta.sin_cos();
    [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, c * c + s * s * cos, c * s * (1.0 - cos), -s * sin],
        [0.0, c * s * (1.0 - cos), s * s + c * c * cos, c * sin],
        [0.0, s * sin, -c * sin, cos],
    ]
}

fn circular_mueller(h: f64) -> FilterMatrix {
    [[0.5, 0.0, 0.0, 0.5 * h], [0.0; 4], [0.0; 4], [0.5 * h, 0.0, 0.0, 0.5]]
}

fn check(
    filter: &'static str,
    argument: &'static str,
    value: f64,
    accepted: bool,
    expected: &'static str,
) -> Result<(), FilterError> {
    if accepted {
        Ok(())
    } else {
        Err(FilterError::OutOfRange { filter, argument, value, expected })
    }
}

fn arguments_error(filter: &'static str, expected: &'static str, arguments: &[f64]) -> FilterError {
    FilterError::Arguments { filter, expected, got: arguments.len() }
}

fn unknown(text: &str) -> UnknownName {
    let forms = ["linear(angle[,k1,k2])", "retarder(fast_axis,nm)", "circular(1)"];
    let mut unknown = UnknownName::new("filter", text, forms.map(str::to_owned).into());
    let name = text.split('(').next().unwrap_or_default();
    unknown.similar = similar(name, ["linear", "retarder", "circular"].into_iter());
    unknown
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    use super::*;

    #[test]
    fn texts_name_filters() {
        assert_eq!(Filter::parse("linear(0.5)"), Filter::linear(0.5, 1.0, 0.0));
        assert_eq!(Filter::parse("linear(0.5, 0.9, 0.01)"), Filter::linear(0.5, 0.9, 0.01));
        assert_eq!(Filter::parse("Retarder(0.1, 560)"), Filter::retarder(0.1, 560.0));
        assert_eq!(Filter::parse("circular(-1)"), Ok(Filter::Circular { left: false }));
    }

    #[test]
    fn wrong_texts_are_answered_with_what_is_accepted() {
        let Err(FilterError::Unknown(unknown)) = Filter::parse("linaer(0)") else {
            panic!("linaer is not a filter")
        };
        assert_eq!(unknown.similar, ["linear"]);
        for bad in
            ["linear", "linear()", "linear(1,2)", "linear(0,1.5,0)", "circular(0)", "retarder(1)"]
        {
            assert!(Filter::parse(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn crossed_polarizers_pass_nothing_and_add_up_to_no_filter() {
        for angle in [0.0, 0.3, 1.2] {
            let along = Filter::linear(angle, 1.0, 0.0).unwrap();
            let across = Filter::linear(angle + FRAC_PI_2, 1.0, 0.0).unwrap();
            let stokes = [1.0, 0.3, -0.5, 0.2];
            let sum =
                apply(&along.mueller(500.0), stokes)[0] + apply(&across.mueller(500.0), stokes)[0];
            // Sine and cosine at an angle of rounded 90°.
            assert!((sum - 1.0).abs() < 1e-15);
            let crossed = apply(&stack_mueller(&[along, across], 500.0), stokes);
            assert!(crossed.iter().all(|s| s.abs() < 1e-15), "{crossed:?}");
        }
    }

    #[test]
    fn a_quarter_wave_plate_before_a_polarizer_analyses_circular_light() {
        let plate = Filter::retarder(-FRAC_PI_4, 125.0).unwrap();
        let polarizer = Filter::linear(0.0, 1.0, 0.0).unwrap();
        let stack = stack_mueller(&[plate, polarizer], 500.0);
        let circular = Filter::circular(1.0).unwrap().mueller(500.0);
        for stokes in [[1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, -1.0], [1.0, 0.2, 0.3, 0.4]] {
            // cos 90° = 6e-17.
            assert!((apply(&stack, stokes)[0] - apply(&circular, stokes)[0]).abs() < 1e-15);
        }
    }
}
