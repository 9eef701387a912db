//! The family of scalar phase functions: its interface, and what its classes share.

use crate::spec::{self, Family};

/// The family of scalar phase functions.
pub static FAMILY: Family =
    Family::new("Phase_Function", "Phase functions", spec::classes::<dyn Phase>);

/// A scalar phase function in 1/sr.
pub trait Phase: Send + Sync {
    /// p at the cosine of the scattering angle; ∫ p dΩ = 1 where a class says so.
    fn at_cosine(&self, cos: f64) -> f64;
}
