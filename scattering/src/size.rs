//! Size distributions: numbers of particles per volume or area and per diameter.

use crate::spec::{Family, Member, Spec};

/// Particles per volume.
pub trait VolumeSize: Send + Sync {
    /// Number density in 1/(µm³ µm) at the diameter `d` µm.
    fn density(&self, d: f64) -> f64;
}

/// Particles per area.
pub trait SurfaceSize: Send + Sync {
    /// Number density in 1/(µm² µm) at the diameter `d` µm.
    fn density(&self, d: f64) -> f64;
}

/// The distributions over a volume, in the order they are listed to users.
pub const VOLUME: &[&Spec<dyn VolumeSize>] = &[];

/// The distributions over an area, in the order they are listed to users.
pub const SURFACE: &[&Spec<dyn SurfaceSize>] = &[];

impl Member for dyn VolumeSize {
    const FAMILY: Family = Family::VolumeSize;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(VOLUME.iter().copied())
    }
}

impl Member for dyn SurfaceSize {
    const FAMILY: Family = Family::SurfaceSize;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(SURFACE.iter().copied())
    }
}
