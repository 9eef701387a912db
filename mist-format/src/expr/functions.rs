//! The functions of expressions. Angles are in radians but for those whose names end in `d`.

macro_rules! functions {
    ($($name:literal $variant:ident $arity:literal $summary:literal)*) => {
        /// A function of expressions.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Function {
            $(#[doc = $summary] $variant,)*
        }

        impl Function {
            /// Every function, in the order of the manual.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// The name in expressions; its case counts.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// The number of arguments: 1, 2 or 3.
            pub fn arity(self) -> usize {
                match self { $(Self::$variant => $arity,)* }
            }

            /// A summary of the function.
            pub fn summary(self) -> &'static str {
                match self { $(Self::$variant => $summary,)* }
            }
        }
    };
}

functions! {
    "exp" Exp 1 "e^x"
    "sin" Sin 1 "sine of x in radians"
    "cos" Cos 1 "cosine of x in radians"
    "tan" Tan 1 "tangent of x in radians"
    "sind" Sind 1 "sine of x in degrees"
    "cosd" Cosd 1 "cosine of x in degrees"
    "tand" Tand 1 "tangent of x in degrees"
    "asin" Asin 1 "arc sine in radians"
    "acos" Acos 1 "arc cosine in radians"
    "atan" Atan 1 "arc tangent in radians"
    "asind" Asind 1 "arc sine in degrees"
    "acosd" Acosd 1 "arc cosine in degrees"
    "atand" Atand 1 "arc tangent in degrees"
    "sinh" Sinh 1 "hyperbolic sine"
    "cosh" Cosh 1 "hyperbolic cosine"
    "tanh" Tanh 1 "hyperbolic tangent"
    "log" Log 1 "natural logarithm"
    "log10" Log10 1 "decimal logarithm"
    "sqrt" Sqrt 1 "square root"
    "abs" Abs 1 "absolute value"
    "not" Not 1 "1 if x = 0, else 0"
    "atan2" Atan2 2 "angle of the point (x,y) in radians; the arguments are y, x"
    "atan2d" Atan2d 2 "angle of the point (x,y) in degrees; the arguments are y, x"
    "min" Min 2 "a if a < b, else b"
    "max" Max 2 "a if a > b, else b"
    "or" Or 2 "1 if a or b is not 0, else 0"
    "nor" Nor 2 "1 if both a and b are 0, else 0"
    "and" And 2 "1 if neither a nor b is 0, else 0"
    "nand" Nand 2 "1 if a or b is 0, else 0"
    "resqrt" Resqrt 2 "real part of the square root of x + iy"
    "imsqrt" Imsqrt 2 "imaginary part of the square root of x + iy"
    "resqr" Resqr 2 "real part of the square of x + iy"
    "imsqr" Imsqr 2 "imaginary part of the square of x + iy"
    "gt" Gt 2 "1 if a > b, else 0"
    "lt" Lt 2 "1 if a < b, else 0"
    "ge" Ge 2 "1 if a >= b, else 0"
    "le" Le 2 "1 if a <= b, else 0"
    "eq" Eq 2 "1 if a = b, else 0"
    "ne" Ne 2 "1 if a is not b, else 0"
    "if" If 3 "a if c is not 0, else b; the arguments are c, a, b and all are computed"
}

impl Function {
    /// Finds a function by its exact name. No two functions share a name.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|function| function.name() == name)
    }

    /// The value; `None` if there are not [`Function::arity`] arguments.
    pub fn apply(self, arguments: &[f64]) -> Option<f64> {
        match (self.arity(), arguments) {
            (1, &[x]) => Some(self.of_one(x)),
            (2, &[a, b]) => Some(self.of_two(a, b)),
            (3, &[c, a, b]) => Some(self.of_three(c, a, b)),
            _ => None,
        }
    }

    /// The value of `if`, the only function of three arguments.
    pub(super) fn of_three(self, c: f64, a: f64, b: f64) -> f64 {
        if c != 0.0 { a } else { b }
    }

    /// The value of a function of one argument.
    pub(super) fn of_one(self, x: f64) -> f64 {
        // The same factor as NIST's: pi/180, multiplied or divided.
        const DEGREE: f64 = std::f64::consts::PI / 180.0;
        match self {
            Self::Exp => x.exp(),
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Sind => (x * DEGREE).sin(),
            Self::Cosd => (x * DEGREE).cos(),
            Self::Tand => (x * DEGREE).tan(),
            Self::Asin => x.asin(),
            Self::Acos => x.acos(),
            Self::Atan => x.atan(),
            Self::Asind => x.asin() / DEGREE,
            Self::Acosd => x.acos() / DEGREE,
            Self::Atand => x.atan() / DEGREE,
            Self::Sinh => x.sinh(),
            Self::Cosh => x.cosh(),
            Self::Tanh => x.tanh(),
            Self::Log => x.ln(),
            Self::Log10 => x.log10(),
            Self::Sqrt => x.sqrt(),
            Self::Abs => x.abs(),
            _ => truth(x == 0.0),
        }
    }

    /// True for functions of one argument that are slower than a look-up of the value.
    pub(super) fn is_slow(self) -> bool {
        self.arity() == 1 && !matches!(self, Self::Sqrt | Self::Abs | Self::Not)
    }

    /// The value of a function of two arguments.
    pub(super) fn of_two(self, a: f64, b: f64) -> f64 {
        const DEGREE: f64 = std::f64::consts::PI / 180.0;
        let (yes_a, yes_b) = (a != 0.0, b != 0.0);
        match self {
            Self::Atan2 => a.atan2(b),
            Self::Atan2d => a.atan2(b) / DEGREE,
            Self::Min => {
                if a < b {
                    a
                } else {
                    b
                }
            }
            Self::Max => {
                if a > b {
                    a
                } else {
                    b
                }
            }
            Self::Or => truth(yes_a || yes_b),
            Self::Nor => truth(!(yes_a || yes_b)),
            Self::And => truth(yes_a && yes_b),
            Self::Nand => truth(!(yes_a && yes_b)),
            Self::Resqrt => complex_root(a, b).0,
            Self::Imsqrt => complex_root(a, b).1,
            Self::Resqr => a * a - b * b,
            Self::Imsqr => 2.0 * a * b,
            Self::Gt => truth(a > b),
            Self::Lt => truth(a < b),
            Self::Ge => truth(a >= b),
            Self::Le => truth(a <= b),
            Self::Eq => truth(a == b),
            _ => truth(a != b),
        }
    }
}

fn truth(yes: bool) -> f64 {
    f64::from(u8::from(yes))
}

/// Real and imaginary part of the principal root of x + iy.
fn complex_root(x: f64, y: f64) -> (f64, f64) {
    let modulus = x.hypot(y);
    let half = ((modulus + x.abs()) / 2.0).sqrt();
    if half == 0.0 {
        (0.0, y)
    } else if x >= 0.0 {
        (half, y / (2.0 * half))
    } else {
        (y.abs() / (2.0 * half), half.copysign(y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_function_is_found_by_its_name_and_refuses_other_numbers_of_arguments() {
        for function in Function::ALL {
            assert_eq!(Function::find(function.name()), Some(*function));
            for count in 0..5 {
                let value = function.apply(&[0.5; 4][..count.min(4)]);
                assert_eq!(value.is_some(), count.min(4) == function.arity());
            }
        }
        assert_eq!(Function::find("Sin"), None);
    }

    #[test]
    fn the_square_of_a_complex_root_is_the_number() {
        for (x, y) in [(3.0, 4.0), (-3.0, 4.0), (-3.0, -4.0), (-2.0, 0.0), (0.0, 2.0), (0.0, 0.0)] {
            let (re, im) = complex_root(x, y);
            // Two roundings per part of numbers of order one.
            assert!((re * re - im * im - x).abs() < 1e-14 && (2.0 * re * im - y).abs() < 1e-14);
            assert!(re >= 0.0);
        }
    }

    #[test]
    fn not_a_number_counts_as_true_and_loses_comparisons() {
        let nan = f64::NAN;
        assert_eq!(Function::If.apply(&[nan, 1.0, 2.0]), Some(1.0));
        assert_eq!(Function::Min.apply(&[nan, 1.0]), Some(1.0));
        assert_eq!(Function::Max.apply(&[nan, 1.0]), Some(1.0));
        assert_eq!(Function::Not.apply(&[nan]), Some(0.0));
    }
}
