//! Stokes vectors, Jones and Mueller matrices, and the bases they are written in.

mod basis;
mod jones;
mod mueller;
mod stokes;
mod weights;

pub use basis::{Basis, BeamPair, TransverseFrame, UnknownBasis, change_basis, perp};
pub(crate) use basis::{change_jones_basis, is_normal};
pub use jones::Jones;
pub(crate) use jones::{elements, muellers};
pub use mueller::Mueller;
pub use stokes::Stokes;
pub use weights::{DirectionWeights, SignedWeights};
