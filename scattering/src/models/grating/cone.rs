//! A diffracted order as a cone.

use glam::DVec3;

use crate::Mueller;

/// A diffracted order as light in a cone.
#[derive(Clone, Copy, Debug)]
pub(super) struct OrderCone {
    pub(super) axis: DVec3,
    /// Efficiency over πα².
    pub(super) mueller: Mueller,
}
