//! Parameters that are set before the class of their object is chosen, and are lost.

use mist_format::Diagnostic;
use scattering::Mode;

use crate::{Job, plan::VariableEntry};

/// One finding for each parameter that a later entry replaces by a default: an error in sound runs,
/// a warning under compat, where NIST's program computes with the default.
pub(super) fn lost_parameters(job: &Job) -> Vec<Diagnostic> {
    let entries = &job.plan.entries;
    let found = entries.iter().enumerate().filter_map(|(at, entry)| {
        let path = entry.parameter.as_ref()?;
        let chooses = |later: &VariableEntry| {
            let object = later.parameter.as_ref();
            object.is_some_and(|object| object.names_object() && path.is_inside(object))
        };
        let chosen = at + 1 + entries[at + 1..].iter().position(chooses)?;
        let is_set_again = |later: &VariableEntry| later.parameter_name() == Some(path.as_str());
        let is_lost = !entries[chosen + 1..].iter().any(is_set_again);
        is_lost.then(|| lost(job, entry, &entries[chosen]))
    });
    found.collect()
}

fn lost(job: &Job, entry: &VariableEntry, chosen: &VariableEntry) -> Diagnostic {
    let variables = &job.plan.program.variables;
    let (name, object) = (&variables[entry.variable].name, &variables[chosen.variable].name);
    let message = format!(
        "`{name}` is set above `{object}`, which makes a new object with defaults: the value is lost"
    );
    let found = match job.options.mode {
        Mode::Sound => Diagnostic::error("parameter/lost", name.span(), message),
        Mode::Compat => Diagnostic::warning("parameter/lost", name.span(), message),
    };
    found
        .help(format!("write `{name} = …` below `{object} = …`"))
        .note_at(object.span(), "the class is chosen here")
}
