//! Power spectral densities of surface height.

use crate::spec::{Family, Member, Spec};

/// A two-dimensional power spectral density of surface height.
pub trait Psd: Send + Sync {
    /// PSD(f_x, f_y) in µm⁴, spatial frequencies in 1/µm in the frame of the sample.
    fn density(&self, fx: f64, fy: f64) -> f64;
}

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Psd>] = &[];

impl Member for dyn Psd {
    const FAMILY: Family = Family::Psd;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}
