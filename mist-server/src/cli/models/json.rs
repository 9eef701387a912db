//! The registry for programs.

use scattering::Class;
use serde_json::Value;

use crate::registry;

/// All classes, by family.
pub(super) fn list() -> String {
    line(&registry::list())
}

/// One class.
pub(super) fn class(class: &Class) -> String {
    line(&registry::class(class))
}

fn line(value: &Value) -> String {
    format!("{value:#}\n")
}
