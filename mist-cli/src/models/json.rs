//! The registry for programs.

use mist_runner::registry;
use scattering::Class;
use serde_json::Value;

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
