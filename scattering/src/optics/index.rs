//! Complex index of refraction n + ik as a function of the vacuum wavelength.

use num_complex::Complex64;

use super::function::RealFunction;

/// An index of refraction: two functions of the vacuum wavelength in µm, k ≥ 0 absorbing.
#[derive(Clone, Debug)]
pub struct RefractiveIndex {
    /// The real part n.
    pub n: RealFunction,
    /// The imaginary part k.
    pub k: RealFunction,
}

impl RefractiveIndex {
    /// The same index at every wavelength.
    pub fn constant(n: f64, k: f64) -> Self {
        Self { n: RealFunction::constant(n), k: RealFunction::constant(k) }
    }

    /// n + ik at the vacuum wavelength `lambda` µm.
    pub fn at(&self, lambda: f64) -> Complex64 {
        Complex64::new(self.n.at(lambda), self.k.at(lambda))
    }

    /// The same material with k = 0.
    pub fn without_absorption(&self) -> Self {
        Self { n: self.n.clone(), k: RealFunction::constant(0.0) }
    }
}

/// A homogeneous film.
#[derive(Clone, Debug)]
pub struct Film {
    /// Index of refraction.
    pub index: RefractiveIndex,
    /// Thickness, µm.
    pub thickness: f64,
}
