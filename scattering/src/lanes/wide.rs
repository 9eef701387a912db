//! The vectors of the processor, for batches.
//!
//! On processors with vectors of [`WIDTH`] numbers a [`Batch`] is computed in them, elsewhere in
//! [`Lanes`]. Both do the operations of one number in their order, so the bits are the same. No two
//! operations become one, which would change them.

use std::{
    array::from_ref,
    ops::{Add, Div, Mul, Neg, Sub},
};

use pulp::{Simd, WithSimd, bytemuck::cast_slice};

use super::{Lanes, Real, WIDTH};

/// Work on a batch of directions.
///
/// `run` and what it calls must be inlined: only then is it compiled for the processor.
pub trait Batch {
    /// Does the work with `vectors`.
    fn run<V: Vectors>(self, vectors: V);
}

/// Runs `batch` with the vectors of this processor.
pub fn with_widest(batch: impl Batch) {
    pulp::Arch::new().dispatch(Dispatched(batch));
}

struct Dispatched<B>(B);

impl<B: Batch> WithSimd for Dispatched<B> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        if S::F64_LANES == WIDTH {
            self.0.run(Wide(simd));
        } else {
            self.0.run(Plain);
        }
    }
}

/// A kind of vectors of [`WIDTH`] numbers.
pub trait Vectors: Copy {
    /// A vector.
    type Real: Real;

    /// The vector of the numbers `x`.
    fn load(self, x: &[f64; WIDTH]) -> Self::Real;

    /// The numbers of the vector `x`.
    fn store(self, x: Self::Real) -> [f64; WIDTH];
}

/// [`Lanes`].
#[derive(Clone, Copy)]
struct Plain;

impl Vectors for Plain {
    type Real = Lanes;

    #[inline(always)]
    fn load(self, x: &[f64; WIDTH]) -> Lanes {
        Lanes(*x)
    }

    #[inline(always)]
    fn store(self, x: Lanes) -> [f64; WIDTH] {
        x.0
    }
}

/// Registers of the processor; only for those of [`WIDTH`] numbers.
#[derive(Clone, Copy)]
struct Wide<S>(S);

impl<S: Simd> Vectors for Wide<S> {
    type Real = Vector<S>;

    #[inline(always)]
    fn load(self, x: &[f64; WIDTH]) -> Vector<S> {
        Vector { simd: self.0, x: S::as_simd_f64s(x).0[0] }
    }

    #[inline(always)]
    fn store(self, x: Vector<S>) -> [f64; WIDTH] {
        x.numbers()
    }
}

/// [`WIDTH`] numbers in a register.
#[derive(Clone, Copy, Debug)]
struct Vector<S: Simd> {
    simd: S,
    x: S::f64s,
}

impl<S: Simd> Vector<S> {
    #[inline(always)]
    fn with(self, x: S::f64s) -> Self {
        Self { simd: self.simd, x }
    }

    #[inline(always)]
    fn numbers(self) -> [f64; WIDTH] {
        let all: &[f64] = cast_slice(from_ref(&self.x));
        std::array::from_fn(|k| all[k])
    }
}

impl<S: Simd> Real for Vector<S> {
    #[inline(always)]
    fn all(self, x: f64) -> Self {
        self.with(self.simd.splat_f64s(x))
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Wide(self.simd).load(&self.numbers().map(f))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.with(self.simd.abs_f64s(self.x))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.with(self.simd.sqrt_f64s(self.x))
    }

    #[inline(always)]
    fn choose(self, a: Self, b: Self) -> Self {
        let simd = self.simd;
        let is_positive = simd.greater_than_or_equal_f64s(self.x, simd.splat_f64s(0.0));
        self.with(simd.select_f64s(is_positive, a.x, b.x))
    }
}

impl<S: Simd> Neg for Vector<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self.simd.neg_f64s(self.x))
    }
}

macro_rules! arithmetic {
    ($($operation:ident $function:ident $of_vectors:ident)*) => {$(
        impl<S: Simd> $operation for Vector<S> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                self.with(self.simd.$of_vectors(self.x, other.x))
            }
        }

        impl<S: Simd> $operation<f64> for Vector<S> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: f64) -> Self {
                self.$function(self.all(other))
            }
        }
    )*};
}

arithmetic!(Add add add_f64s Sub sub sub_f64s Mul mul mul_f64s Div div div_f64s);
