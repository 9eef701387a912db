//! The axes in which renderers have their Stokes vectors.

use mist_engine::material::lobes::BasisChange;
use rise_bridge::mitsuba::frame;

/// The change from `psps` to the basis called `name`, if it is that of a renderer.
pub(super) fn turn(name: Option<&str>) -> Option<BasisChange> {
    match name {
        Some("mitsuba") => Some(frame::from_psps),
        _ => None,
    }
}
