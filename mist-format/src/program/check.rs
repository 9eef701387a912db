//! Checks of a readable program that need no run.

use super::limits::MAX_ERRORS;
use super::tree::{Loop, Program, VariableKind};
use crate::diagnostic::Diagnostic;
use crate::dialect::Dialect;
use crate::span::Span;
use crate::suggestion::did_you_mean;
use std::collections::HashSet;

/// Variables that NIST's program reads at every step; there are no defaults. The first two are the
/// settings of a grid, which sound runs read for a grid only.
pub const REQUIRED_VARIABLES: [&str; 5] =
    ["minsamples", "differential", "incidentangle", "incidentpol", "rotation"];

/// The number of settings of a grid at the beginning of [`REQUIRED_VARIABLES`].
const GRID_SETTINGS: usize = 2;

pub(super) fn check(program: &Program, dialect: Dialect) -> Vec<Diagnostic> {
    let mut found = missing_variables(program, dialect);
    found.extend(unknown_loop_variables(program));
    found
}

fn missing_variables(program: &Program, dialect: Dialect) -> Vec<Diagnostic> {
    let end = program.sections.variables.end;
    let place = Span::new(end.saturating_sub("END".len()), end);
    let wanted = match dialect {
        Dialect::Sound => &REQUIRED_VARIABLES[GRID_SETTINGS..],
        Dialect::Compat => &REQUIRED_VARIABLES[..],
    };
    let missing = wanted.iter().filter(|wanted| !is_defined(program, wanted));
    let found = missing.map(|wanted| {
        let other_case = program
            .variables
            .iter()
            .find(|variable| variable.name.as_str().eq_ignore_ascii_case(wanted));
        let message = format!("the required variable `{wanted}` is not defined");
        match other_case {
            Some(variable) => Diagnostic::error("program/required", variable.name.span(), message)
                .help(format!("write `{wanted}` in lower case")),
            None => {
                let help = format!("write `{wanted} = {}` in VARIABLES", usual_value(wanted));
                Diagnostic::error("program/required", place, message).help(help)
            }
        }
    });
    found.collect()
}

fn is_defined(program: &Program, wanted: &str) -> bool {
    let any_case = wanted == "incidentpol";
    program.variables.iter().any(|variable| {
        let name = variable.name.as_str();
        name == wanted || (any_case && name.eq_ignore_ascii_case(wanted))
    })
}

fn usual_value(wanted: &str) -> &'static str {
    match wanted {
        "minsamples" => "10",
        "differential" => "(2*deg)^2",
        "incidentpol" => "(1,0,0,0)",
        _ => "0",
    }
}

fn unknown_loop_variables(program: &Program) -> Vec<Diagnostic> {
    let known = || program.variables.iter().map(|variable| variable.name.as_str());
    let fors = program.loops.iter().filter_map(|each| match each {
        Loop::For(each) => Some(&each.variable),
        Loop::List(_) => None,
    });
    let folded: HashSet<String> = known().map(str::to_ascii_lowercase).collect();
    let unknown =
        fors.filter(|name| !folded.contains(&name.as_str().to_ascii_lowercase())).take(MAX_ERRORS);
    let found = unknown.map(|name| {
        let message = format!("invalid variable `{name}`: a loop can only change a variable");
        let with_sigil = known().find(|known| {
            VariableKind::of(known) != VariableKind::Local
                && known[1..].eq_ignore_ascii_case(name.as_str())
        });
        Diagnostic::error("program/loop-variable", name.span(), message)
            .help(format!("define `{name}` in VARIABLES"))
            .help_if(did_you_mean(name.as_str(), known()))
            .help_if(with_sigil.map(|known| format!("did you mean `{known}`?")))
    });
    found.collect()
}
