//! Square roots of q² and phase factors of waves.

use num_complex::Complex64;

use crate::lanes::{Complex, Real};

/// e^{iδ} with δ = q·phase.
pub(super) fn phase_factor(q: Complex64, phase: f64) -> Complex64 {
    Complex64::from_polar((-q.im * phase).exp(), q.re * phase)
}

/// The square root with Re ≥ 0 where Re z ≥ 0 and with Im > 0 where Re z < 0.
///
/// For q² = n² − κ² this is the wave that propagates or decays away from its source.
pub fn decaying_root(z: Complex64) -> Complex64 {
    root(z.re, z.im).into()
}

/// [`decaying_root`] of a batch of numbers with one imaginary part.
#[inline(always)]
pub(crate) fn root<R: Real>(re: R, im: f64) -> Complex<R> {
    if im == 0.0 {
        let part = |x: R| (-x).select(x.splat(0.0), x).sqrt();
        return Complex { re: part(re), im: part(-re) };
    }
    let size = (re * re + im * im).sqrt();
    let large = ((size + re.abs()) * 0.5).sqrt();
    let small = re.splat(0.5 * im) / large;
    Complex { re: re.select(large, small), im: re.select(small, large) }
}
