//! Diffuse light between a surface, transmitting flakes and a diffuse body below them.
//!
//! Light that has entered and has met a flake is diffuse in one of two spaces. Above the flakes it
//! goes down with the radiance a·w; w is the internal reflectance of the surface. Below them it goes
//! up from the body with the flux b. With the source s of each space the balance is
//!
//! $$ \begin{pmatrix} \rho-r_w & -\tau_w \\ -\tau_w & 1/\alpha-r \end{pmatrix}
//!    \begin{pmatrix} a \\ b \end{pmatrix} = \begin{pmatrix} s_a \\ s_b \end{pmatrix}, \qquad (1) $$
//! $$ \mathbf F = \frac{1}{\pi n^2}\,(l\,a + c\,b) \qquad (2) $$
//!
//! | symbol | quantity |
//! |---|---|
//! | ρ = ⟨w⟩ | mean internal reflectance |
//! | τ_w = ⟨wτB⟩ | τ the transmittance of the flakes |
//! | r_w = ⟨w F w⟩ | F the BRDF of the flakes |
//! | r = ⟨rB²⟩ | reflectance of the flakes from below |
//! | α, αB(μ) | albedo of the body for diffuse light and for a beam |
//! | l, c | parts of a beam from outside that reach each space, c times B |
//!
//! The matrix is symmetric, so F is reciprocal. Without absorption B is 1 and the row sums of the
//! matrix are ⟨l⟩ and ⟨c⟩, so all light leaves again.

/// The means over diffuse light inside the binder.
#[derive(Clone, Copy, Debug)]
pub(super) struct DiffuseMeans {
    /// ρ.
    pub(super) internal_reflectance: f64,
    /// r_w.
    pub(super) caught_again: f64,
    /// τ_w.
    pub(super) passed_down: f64,
    /// r.
    pub(super) below: f64,
    /// ⟨l⟩ and ⟨c⟩: fractions of a uniform radiance in each space that leave the coating.
    pub(super) escapes: (f64, f64),
}

/// Inverse of the matrix in (1): its elements for l and l, l and c, c and c.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct InterreflectionMatrix {
    pub(super) ll: f64,
    pub(super) lc: f64,
    pub(super) cc: f64,
}

/// Below this the surface returns no light.
const NOTHING: f64 = 1e-12;

impl InterreflectionMatrix {
    /// Over a body of albedo `alpha`.
    ///
    /// Errors of the means are rounded to the side of loss, so that no energy is gained.
    pub(super) fn new(means: &DiffuseMeans, alpha: f64) -> Self {
        let tau = means.passed_down;
        let (l, c) = means.escapes;
        let a = (means.internal_reflectance - means.caught_again).max(l + alpha * tau);
        // α times the lower right element.
        let b = (1.0 - alpha * means.below).max(c + tau);
        if a < NOTHING {
            return Self { ll: 0.0, lc: 0.0, cc: alpha / b };
        }
        let determinant = a * b - alpha * tau * tau;
        Self { ll: b / determinant, lc: alpha * tau / determinant, cc: alpha * a / determinant }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_absorption_all_light_comes_out_of_both_spaces() {
        // Of the internal reflectance 0.6, 0.2 pass down, 0.1 are caught again, 0.3 get out.
        let means = DiffuseMeans {
            internal_reflectance: 0.6,
            caught_again: 0.1,
            passed_down: 0.2,
            below: 0.35,
            escapes: (0.3, 0.45),
        };
        let g = InterreflectionMatrix::new(&means, 1.0);
        assert!((g.ll * 0.3 + g.lc * 0.45 - 1.0).abs() < 1e-15);
        assert!((g.lc * 0.3 + g.cc * 0.45 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn flakes_that_are_not_there_leave_the_body_under_its_surface() {
        let (rho, alpha) = (0.6, 0.7);
        let means = DiffuseMeans {
            internal_reflectance: rho,
            caught_again: 0.0,
            passed_down: rho,
            below: 0.0,
            escapes: (0.0, 1.0 - rho),
        };
        let g = InterreflectionMatrix::new(&means, alpha);
        assert!((g.cc - alpha / (1.0 - rho * alpha)).abs() < 1e-15);
    }

    #[test]
    fn a_black_body_gives_nothing_back() {
        let means = DiffuseMeans {
            internal_reflectance: 0.6,
            caught_again: 0.1,
            passed_down: 0.2,
            below: 0.35,
            escapes: (0.3, 0.45),
        };
        let g = InterreflectionMatrix::new(&means, 0.0);
        assert_eq!((g.lc, g.cc), (0.0, 0.0));
        assert!(g.ll > 0.0);
    }
}
