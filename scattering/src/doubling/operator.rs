//! Reflection and transmission operators of a layer, and adding them.
//!
//! Light is ψ = √(μw) L/n at every node, L the radiance as a Stokes vector. With this scaling
//! reciprocity is R = P Rᵀ P and T↓ = P T↑ᵀ P, P = diag(1, 1, −1, 1), and the factor n² of the radiance
//! law is included. For a
//! system a above a system b
//!
//! $$ x = (1 - R^\downarrow_b R^\uparrow_a)^{-1} R^\downarrow_b T^\downarrow_a, \qquad
//!    z = (1 - R^\uparrow_a R^\downarrow_b)^{-1} R^\uparrow_a T^\uparrow_b $$
//!
//! $$ R^\downarrow = R^\downarrow_a + T^\uparrow_a x, \quad
//!    T^\downarrow = T^\downarrow_b(T^\downarrow_a + R^\uparrow_a x), \quad
//!    R^\uparrow = R^\uparrow_b + T^\downarrow_b z, \quad
//!    T^\uparrow = T^\uparrow_a(T^\uparrow_b + R^\downarrow_b z) $$
//!
//! J. F. de Haan, P. B. Bosma and J. W. Hovenier, Astron. Astrophys. 183, 371 (1987).

use super::block::{RealMatrix, TransferBlock, between, identity};

/// Reflection and transmission of a layer from both sides, in one block.
#[derive(Clone, Debug)]
pub struct LayerOperator {
    /// Reflection of light from above.
    pub r_down: RealMatrix,
    /// Transmission of light from above.
    pub t_down: RealMatrix,
    /// Reflection of light from below.
    pub r_up: RealMatrix,
    /// Transmission of light from below.
    pub t_up: RealMatrix,
}

impl LayerOperator {
    /// The identity: an empty layer, for `n` rows.
    pub fn nothing(n: usize) -> Self {
        Self {
            r_down: RealMatrix::zeros(n, n),
            t_down: identity(n),
            r_up: RealMatrix::zeros(n, n),
            t_up: identity(n),
        }
    }

    /// An interface that neither reflects nor transmits, with `above` and `below` rows.
    pub fn opaque(above: usize, below: usize) -> Self {
        Self {
            r_down: RealMatrix::zeros(above, above),
            t_down: RealMatrix::zeros(below, above),
            r_up: RealMatrix::zeros(below, below),
            t_up: RealMatrix::zeros(above, below),
        }
    }

    /// The part of `block` in operators with all four components.
    pub fn of_whole(&self, block: TransferBlock) -> Self {
        Self {
            r_down: block.of_whole(&self.r_down),
            t_down: block.of_whole(&self.t_down),
            r_up: block.of_whole(&self.r_up),
            t_up: block.of_whole(&self.t_up),
        }
    }

    /// Puts these operators of `block` into `whole`, which has all four components.
    pub fn into_whole(self, block: TransferBlock, whole: &mut Self) {
        block.put(&self.r_down, &mut whole.r_down);
        block.put(&self.t_down, &mut whole.t_down);
        block.put(&self.r_up, &mut whole.r_up);
        block.put(&self.t_up, &mut whole.t_up);
    }

    /// This layer over the layer `below`.
    pub fn over(&self, below: &Self) -> Self {
        crate::interrupt::check();
        let x = between(&below.r_down, &self.r_up, &(&below.r_down * &self.t_down));
        let z = between(&self.r_up, &below.r_down, &(&self.r_up * &below.t_up));
        Self {
            r_down: &self.r_down + &self.t_up * &x,
            t_down: &below.t_down * (&self.t_down + &self.r_up * &x),
            r_up: &below.r_up + &below.t_down * &z,
            t_up: &self.t_up * (&below.t_up + &below.r_down * &z),
        }
    }

    /// The reflection of this layer over something opaque with the reflection `bottom`.
    pub fn over_opaque(&self, bottom: &RealMatrix) -> RealMatrix {
        &self.r_down + &self.t_up * between(bottom, &self.r_up, &(bottom * &self.t_down))
    }
}
