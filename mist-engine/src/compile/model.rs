//! MODEL: the class of the model.

use mist_format::{program::SourceText, suggestion::did_you_mean};
use scattering::{Class, registry};

use super::binder::Binder;
use crate::fault::fault;

/// The class of the model; an unknown one is noted.
pub(super) fn class(model: &SourceText, binder: &mut Binder<'_>) -> Option<&'static Class> {
    let name = model.as_str();
    if let Some(found) = scattering::models::find(name) {
        return Some(&found.class);
    }
    let all: Vec<&str> = scattering::models::all().map(|spec| spec.class.name).collect();
    let other = registry::find_class(name).map(|class| format!("{name} is a {}", class.parent));
    let message = match other {
        Some(what) => format!("{what}, not a BRDF model"),
        None if name == "BRDF_Model" || registry::is_abstract(name) => {
            format!("{name} is a family of models, not one of them")
        }
        None => format!("there is no BRDF model called {name:?}"),
    };
    let is_family = message.ends_with("not one of them");
    let help = did_you_mean(name, all)
        .filter(|_| !is_family)
        .unwrap_or_else(|| "`mist models` lists all models; case matters".into());
    binder.note(fault("program/unknown-model", model, message).help(help));
    None
}
