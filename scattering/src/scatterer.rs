//! Particles in free space.

use crate::spec::{Family, Member, Spec};

/// A particle in a homogeneous medium.
pub trait Scatterer: Send + Sync {
    /// Vacuum wavelength it was prepared for, µm.
    fn lambda(&self) -> f64;
    /// Index of the surrounding medium at that wavelength.
    fn medium(&self) -> num_complex::Complex64;
    /// Scattering matrix between the beams `k_in` and `k_out` (unit vectors in the frame of the
    /// particle), dimensionless: |S|²/k² is the differential cross-section. Output and input are
    /// in the frames (s, p) = (`Frame::first`, `Frame::second`) given.
    fn jones(
        &self,
        k_in: glam::DVec3,
        k_out: glam::DVec3,
        frame_in: &crate::polarization::Frame,
        frame_out: &crate::polarization::Frame,
    ) -> crate::Jones;
}

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Scatterer>] = &[];

impl Member for dyn Scatterer {
    const FAMILY: Family = Family::Scatterer;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}
