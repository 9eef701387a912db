//! ABC spectrum, also called K-correlation: flat below 1/B, a power law above.
//!
//! $$ \mathrm{PSD} = \frac{A}{[1 + (B f)^2]^{C/2}} $$
//!
//! f = √(f_x² + f_y²), A the density at f = 0, B a correlation length, C the exponent of the
//! fractal part.
//!
//! E. L. Church and P. Z. Takacs, *The optimal estimation of finish parameters*,
//! Proc. SPIE 1530, 71 (1991).

use crate::{
    psd::{Psd, strength},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of an [`Abc`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "ABC_PSD_Function",
        parent: "PSD_Function",
        summary: "ABC (K-correlation) spectrum",
        equation: "PSD = A/(1+(B f)^2)^(C/2)",
        source: "church-1991",
        params: &[&[
            Parameter::number("A", 0.01, "um^4", "Density at zero frequency"),
            Parameter::number("B", 362.0, "um", "Correlation length"),
            Parameter::number("C", 2.5, "1", "Exponent of the fall"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let (b, c) = (node.number("B"), node.number("C"));
        Ok(Box::new(Abc { a: strength(node, "A")?, b2: b * b, power: AbcExponent::new(-0.5 * c) }))
    },
};

/// An ABC spectrum.
#[derive(Clone, Debug)]
pub struct Abc {
    /// A, µm⁴.
    a: f64,
    /// B², µm².
    b2: f64,
    /// −C/2.
    power: AbcExponent,
}

/// An exponent; the usual ones are multiples of a quarter, which two square roots and a few
/// products evaluate.
#[derive(Clone, Copy, Debug)]
enum AbcExponent {
    Quarters(i32),
    Any(f64),
}

impl AbcExponent {
    /// The largest number of quarters: so few products keep 14 digits.
    const MOST: f64 = 16.0;

    fn new(power: f64) -> Self {
        let quarters = 4.0 * power;
        if quarters.fract() == 0.0 && quarters.abs() <= Self::MOST {
            Self::Quarters(quarters as i32)
        } else {
            Self::Any(power)
        }
    }

    /// x to this power.
    #[inline]
    fn of(self, x: f64) -> f64 {
        match self {
            Self::Quarters(count) => x.sqrt().sqrt().powi(count),
            Self::Any(power) => x.powf(power),
        }
    }
}

impl Psd for Abc {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        let f2 = fx * fx + fy * fy;
        self.a * self.power.of(1.0 + self.b2 * f2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multiples_of_a_quarter_are_the_powers_of_the_standard_library() {
        for quarters in -20_i32..=20 {
            let power = 0.25 * f64::from(quarters);
            assert_eq!(
                matches!(AbcExponent::new(power), AbcExponent::Quarters(_)),
                quarters.abs() <= 16
            );
            for x in [1.0, 1.7, 37.0, 2.5e9] {
                let (got, expected) = (AbcExponent::new(power).of(x), x.powf(power));
                assert!((got - expected).abs() <= 1e-14 * expected, "{x}^{power}: {got:e}");
            }
        }
        assert!(matches!(AbcExponent::new(0.3), AbcExponent::Any(_)));
        assert!(AbcExponent::new(f64::NAN).of(2.0).is_nan());
    }
}
