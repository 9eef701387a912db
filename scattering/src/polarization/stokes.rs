//! Stokes vectors.

/// A Stokes vector (I, Q, U, V) with I = |E_s|² + |E_p|², Q = |E_s|² − |E_p|²,
/// U = 2 Re(E_s* E_p), V = 2 Im(E_s* E_p).
///
/// U > 0 lies along s + p; V > 0 is left circular: counter-clockwise for an observer who looks
/// at the source.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stokes(pub [f64; 4]);

impl Stokes {
    /// Unpolarized light of intensity 1.
    pub const UNPOLARIZED: Self = Self([1.0, 0.0, 0.0, 0.0]);

    /// The sum of the products of the components: a detector with this sensitivity sees it.
    pub fn dot(&self, other: &Self) -> f64 {
        self.0.iter().zip(&other.0).map(|(a, b)| a * b).sum()
    }
}
