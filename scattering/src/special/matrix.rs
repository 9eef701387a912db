//! Dense complex matrices.

use faer::Mat;
use num_complex::Complex64;

/// A dense matrix of complex numbers.
pub type ComplexMatrix = Mat<Complex64>;
