//! VARIABLES: its entries, and the variables that every step reads.

use std::collections::BTreeSet;

use mist_format::{
    Diagnostic, Program,
    expr::{Expr, OperandStack, Value},
    program::{ProgramVariable, VariableKind},
};
use scattering::{Class, Mode};

use super::{binder::Binder, outputs::varies};
use crate::{
    DataFiles,
    deviation::EngineDeviation,
    fault::placed,
    parameters::ParameterPath,
    plan::{RequiredVariables, VariableEntry},
    slots::{SlotNames, SlotValues},
};

/// The variables that every step reads.
pub(super) fn required(program: &Program, binder: &mut Binder<'_>) -> RequiredVariables {
    let last = program.variables.iter().rev();
    let incidentpol = last
        .filter(|v| v.kind == VariableKind::Local)
        .find(|v| v.name.as_str().eq_ignore_ascii_case("incidentpol"))
        .map(|variable| variable.value.clone());
    let incidentpol = incidentpol.and_then(|text| {
        let expr = binder.expr(&text).ok()?;
        Some((text, binder.share(expr)))
    });
    RequiredVariables {
        incidentangle: binder.names.slot("incidentangle"),
        differential: binder.names.slot("differential"),
        incidentpol,
        minsamples: binder.names.slot("minsamples"),
        rotation: binder.names.slot("rotation"),
        integrationmode: binder.names.slot("integrationmode"),
        polygonsides: binder.names.slot("polygonsides"),
        tolerance: binder.names.slot("tolerance"),
        maxevaluations: binder.names.slot("maxevaluations"),
        gives_mode: program.variables.iter().any(|v| v.name.as_str() == "integrationmode")
            || varies(program, binder.library, "integrationmode"),
        pi: binder.names.slot("pi"),
        deg: binder.names.slot("deg"),
    }
}

/// The entries of VARIABLES; the parameters are those of `class`, if it is known.
pub(super) fn entries(
    variables: &[ProgramVariable],
    class: Option<&'static Class>,
    binder: &mut Binder<'_>,
) -> Vec<VariableEntry> {
    let mut entries = Vec::with_capacity(variables.len());
    for (at, variable) in variables.iter().enumerate() {
        let path = |(class, name)| ParameterPath::resolve(class, name);
        let parameter = class.zip(variable.parameter()).map(path);
        let (slot, expr) = match variable.kind {
            VariableKind::Literal => (None, None),
            VariableKind::Local | VariableKind::Parameter => {
                let slot = binder.names.slot(variable.name.as_str());
                (Some(slot), binder.expr_or_note(&variable.value))
            }
        };
        entries.push(VariableEntry { slot, variable: at, expr, parameter });
    }
    entries
}

/// The constants that VARIABLES may read.
pub(crate) fn early_constants(required: &RequiredVariables, mode: Mode) -> Vec<(u32, Value)> {
    if EngineDeviation::LateConstants.applies_in(mode) {
        return Vec::new();
    }
    required.constants().into_iter().map(|(slot, x)| (slot, x.into())).collect()
}

/// Evaluates every entry once, in order, with what is defined before it; at first the `constants`.
/// Entries of `given` have those values. An entry that fails is handed to `note` and has no value.
pub(crate) fn initial_values(
    (entries, variables): (&[VariableEntry], &[ProgramVariable]),
    (names, library): (&SlotNames, &DataFiles),
    constants: Vec<(u32, Value)>,
    given: &[(usize, f64)],
    mut note: impl FnMut(Diagnostic),
) -> Vec<(u32, Value)> {
    let mut values = SlotValues::new(names.len(), library.clone());
    let mut stack = OperandStack::default();
    let mut initial = constants;
    for (slot, value) in &initial {
        values.put(*slot, Some(value));
    }
    // Names whose own entry is wrong: their users are not blamed for it.
    let mut broken = BTreeSet::new();
    for (at, entry) in entries.iter().enumerate() {
        let Some(slot) = entry.slot else { continue };
        let given = given.iter().find(|(entry, _)| *entry == at);
        let value = match (given, &entry.expr) {
            (Some((_, x)), _) => Ok((*x).into()),
            (None, Some(expr)) if expr.slots().iter().all(|read| !broken.contains(read)) => {
                values.value(expr, &mut stack).map_err(|error| {
                    let known: Vec<_> = values.defined().map(|slot| names.name(slot)).collect();
                    predefined_help(error.diagnostic(known), expr)
                })
            }
            _ => {
                broken.insert(slot);
                continue;
            }
        };
        match value {
            Ok(value) => {
                values.put(slot, Some(&value));
                initial.push((slot, value));
            }
            Err(diagnostic) => {
                note(*placed(&variables[entry.variable].value, diagnostic));
                broken.insert(slot);
            }
        }
    }
    initial
}

/// Predefined variables exist in every step, but not all of them while VARIABLES is read.
fn predefined_help(diagnostic: Diagnostic, expr: &Expr) -> Diagnostic {
    let early = ["pi", "deg", "integrationmode", "polygonsides"];
    let reads_early = expr.names().iter().any(|name| early.contains(&name.as_str()));
    if reads_early && diagnostic.code == "expr/unknown-name" {
        return diagnostic
            .note(
                "integrationmode, polygonsides and, with --compat, pi and deg are not yet defined",
            )
            .help("define it at the top of VARIABLES, such as pi = 4*atan(1), deg = pi/180");
    }
    diagnostic
}
