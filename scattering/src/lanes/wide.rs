//! The vectors of the processor, for batches.
//!
//! A [`LaneKernel`] goes by [`WIDTH`] numbers: one register of processors with AVX-512, two of those with
//! AVX2, and [`Lanes`] elsewhere. All do the operations of one number in their order, so the bits
//! are the same. No two operations become one, which would change them.

use std::ops::{Add, Div, Mul, Neg, Sub};

#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};
use pulp::{Simd, WithSimd};

use super::{
    array::{Lanes, WIDTH},
    real::Real,
};

/// Work on a batch of directions.
///
/// `run` and what it calls must be inlined: only then is it compiled for the processor.
pub trait LaneKernel {
    /// Does the work with `vectors`.
    fn run<V: SimdLevel>(self, vectors: V);
}

/// Runs `batch` with the vectors of this processor.
pub fn dispatch(batch: impl LaneKernel) {
    SimdKind::of_this_processor().next().unwrap_or(SimdKind::Plain).run(batch);
}

/// The kinds of vectors.
#[derive(Clone, Copy, Debug)]
pub(super) enum SimdKind {
    /// AVX-512.
    #[cfg(target_arch = "x86_64")]
    V4(V4),
    /// AVX2.
    #[cfg(target_arch = "x86_64")]
    V3(V3),
    /// [`Lanes`].
    Plain,
}

impl SimdKind {
    /// Those that this processor has, the widest first.
    #[inline]
    pub(super) fn of_this_processor() -> impl Iterator<Item = Self> {
        #[cfg(target_arch = "x86_64")]
        let registers = {
            let [v4, v3] = [V4::try_new().map(Self::V4), V3::try_new().map(Self::V3)];
            v4.into_iter().chain(v3)
        };
        #[cfg(not(target_arch = "x86_64"))]
        let registers = std::iter::empty();
        registers.chain([Self::Plain])
    }

    /// Runs `batch` with these vectors.
    #[inline]
    pub(super) fn run(self, batch: impl LaneKernel) {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::V4(simd) => Simd::vectorize(simd, Registers::<_, 1>(batch)),
            #[cfg(target_arch = "x86_64")]
            Self::V3(simd) => Simd::vectorize(simd, Registers::<_, 2>(batch)),
            Self::Plain => batch.run(Plain),
        }
    }
}

/// A batch in vectors of `N` registers.
struct Registers<B, const N: usize>(B);

impl<B: LaneKernel, const N: usize> WithSimd for Registers<B, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        const { assert!(N * S::F64_LANES == WIDTH) };
        self.0.run(Wide::<S, N>(simd));
    }
}

/// A kind of vectors of [`WIDTH`] numbers.
pub trait SimdLevel: Copy {
    /// A vector.
    type Vector: Real;

    /// The vector of the numbers `x`.
    fn load(self, x: &[f64; WIDTH]) -> Self::Vector;

    /// The numbers of the vector `x`.
    fn store(self, x: Self::Vector) -> [f64; WIDTH];
}

/// No registers, but [`Lanes`].
#[derive(Clone, Copy)]
struct Plain;

impl SimdLevel for Plain {
    type Vector = Lanes;

    #[inline(always)]
    fn load(self, x: &[f64; WIDTH]) -> Lanes {
        Lanes(*x)
    }

    #[inline(always)]
    fn store(self, x: Lanes) -> [f64; WIDTH] {
        x.0
    }
}

/// `N` registers of the processor.
#[derive(Clone, Copy)]
struct Wide<S, const N: usize>(S);

impl<S: Simd, const N: usize> SimdLevel for Wide<S, N> {
    type Vector = Vector<S, N>;

    #[inline(always)]
    fn load(self, numbers: &[f64; WIDTH]) -> Vector<S, N> {
        let mut x = [self.0.splat_f64s(0.0); N];
        x.copy_from_slice(S::as_simd_f64s(numbers).0);
        Vector { simd: self.0, x }
    }

    #[inline(always)]
    fn store(self, x: Vector<S, N>) -> [f64; WIDTH] {
        x.numbers()
    }
}

/// [`WIDTH`] numbers in `N` registers.
#[derive(Clone, Copy, Debug)]
struct Vector<S: Simd, const N: usize> {
    simd: S,
    x: [S::f64s; N],
}

impl<S: Simd, const N: usize> Vector<S, N> {
    #[inline(always)]
    fn numbers(self) -> [f64; WIDTH] {
        let mut numbers = [0.0; WIDTH];
        S::as_mut_simd_f64s(&mut numbers).0.copy_from_slice(&self.x);
        numbers
    }
}

impl<S: Simd, const N: usize> Real for Vector<S, N> {
    #[inline(always)]
    fn splat(self, x: f64) -> Self {
        Self { x: [self.simd.splat_f64s(x); N], ..self }
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Wide(self.simd).load(&self.numbers().map(f))
    }

    #[inline(always)]
    fn abs(mut self) -> Self {
        for x in &mut self.x {
            *x = self.simd.abs_f64s(*x);
        }
        self
    }

    #[inline(always)]
    fn sqrt(mut self) -> Self {
        for x in &mut self.x {
            *x = self.simd.sqrt_f64s(*x);
        }
        self
    }

    #[inline(always)]
    fn select(mut self, a: Self, b: Self) -> Self {
        let zero = self.simd.splat_f64s(0.0);
        for k in 0..N {
            let is_positive = self.simd.greater_than_or_equal_f64s(self.x[k], zero);
            self.x[k] = self.simd.select_f64s(is_positive, a.x[k], b.x[k]);
        }
        self
    }
}

impl<S: Simd, const N: usize> Neg for Vector<S, N> {
    type Output = Self;

    #[inline(always)]
    fn neg(mut self) -> Self {
        for x in &mut self.x {
            *x = self.simd.neg_f64s(*x);
        }
        self
    }
}

macro_rules! arithmetic {
    ($($operation:ident $function:ident $of_vectors:ident)*) => {$(
        impl<S: Simd, const N: usize> $operation for Vector<S, N> {
            type Output = Self;

            #[inline(always)]
            fn $function(mut self, other: Self) -> Self {
                for k in 0..N {
                    self.x[k] = self.simd.$of_vectors(self.x[k], other.x[k]);
                }
                self
            }
        }

        impl<S: Simd, const N: usize> $operation<f64> for Vector<S, N> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: f64) -> Self {
                self.$function(self.splat(other))
            }
        }
    )*};
}

arithmetic!(Add add add_f64s Sub sub sub_f64s Mul mul mul_f64s Div div div_f64s);
