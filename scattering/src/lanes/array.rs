//! Lanes in an array, for processors without vector registers and for the last directions.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::real::Real;

/// The number of lanes.
pub const WIDTH: usize = 8;

/// The group of `rest`, fewer than [`WIDTH`], and the last of them again; nothing of nothing.
pub(crate) fn filled_up<T: Copy>(rest: &[T]) -> Option<[T; WIDTH]> {
    let last = rest.len().checked_sub(1)?;
    Some(std::array::from_fn(|k| rest[k.min(last)]))
}

/// [`WIDTH`] numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lanes(pub(crate) [f64; WIDTH]);

impl Lanes {
    /// The number `x` in every lane.
    pub(crate) const fn new(x: f64) -> Self {
        Self([x; WIDTH])
    }
}

impl Real for Lanes {
    #[inline(always)]
    fn splat(self, x: f64) -> Self {
        Self::new(x)
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut all = self.0;
        for x in &mut all {
            *x = f(*x);
        }
        Self(all)
    }

    #[inline(always)]
    fn select(self, a: Self, b: Self) -> Self {
        let mut all = b;
        for k in 0..WIDTH {
            all.0[k] = self.0[k].select(a.0[k], b.0[k]);
        }
        all
    }
}

impl Neg for Lanes {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

macro_rules! arithmetic {
    ($($operation:ident $function:ident)*) => {$(
        impl $operation for Lanes {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                let mut all = self.0;
                for (x, y) in all.iter_mut().zip(other.0) {
                    *x = x.$function(y);
                }
                Self(all)
            }
        }

        impl $operation<f64> for Lanes {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: f64) -> Self {
                self.map(|x| x.$function(other))
            }
        }
    )*};
}

arithmetic!(Add add Sub sub Mul mul Div div);
