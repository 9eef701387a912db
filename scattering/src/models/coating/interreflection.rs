//! Diffuse light between a surface, transmitting flakes and a diffuse body below them.
//!
//! Light that came in once by a flake is diffuse in one of two spaces: going down onto the flakes
//! with the radiance a·w, w what the surface sends back of light from below, or going up from the
//! body with the flux b. Balance of the two, with the source s of each,
//!
//! $$ \begin{pmatrix} \rho-r_w & -\tau_w \\ -\tau_w & 1/\alpha-r \end{pmatrix}
//!    \begin{pmatrix} a \\ b \end{pmatrix} = \begin{pmatrix} s_a \\ s_b \end{pmatrix}, \qquad
//!    \mathbf F = \frac{1}{\pi n^2}\,(l\,a + c\,b) $$
//!
//! ρ = ⟨w⟩, τ_w = ⟨wτB⟩, r_w = ⟨w F w⟩ with the flakes' transmittance τ and BRDF F, r = ⟨rB²⟩ their
//! reflectance from below, α the albedo of the body, αB(μ) what it returns of a beam; l and c are
//! what of a beam from outside gets into each space, c times B. The matrix is symmetric, so F obeys
//! reciprocity. Where nothing absorbs, B is 1 and its row sums are ⟨l⟩ and ⟨c⟩, so all light comes
//! out again.

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
    /// ⟨l⟩ and ⟨c⟩: parts of a uniform radiance in each space that leave the coating.
    pub(super) escapes: (f64, f64),
}

/// The inverse of the matrix: what comes out by l and l, by l and c, by c and c.
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
    /// Errors of the means are kept on the side of loss.
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
