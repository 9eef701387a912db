//! VARY: the loops.

use std::collections::BTreeSet;

use mist_format::{
    Diagnostic, Program,
    expr::Expr,
    number::whole_number,
    program::{ForLoop, ListLoop, Loop, ProgramVariable, SourceText, VariableKind},
    suggestion::did_you_mean,
    table::ListTable,
};

use super::binder::Binder;
use crate::{
    deviation::{EngineDeviation, dialect},
    fault::fault,
    plan::{ForPlan, ListColumn, ListPlan, LoopPlan, VariableEntry},
};

/// The sections that a loop refers to.
#[derive(Clone, Copy)]
pub(super) struct LoopScope<'a> {
    pub(super) variables: &'a [ProgramVariable],
    pub(super) entries: &'a [VariableEntry],
    /// Slots of integrals and outputs.
    pub(super) results: &'a BTreeSet<u32>,
}

/// The loops; those that are wrong are noted.
pub(super) fn loops(
    statements: &[Loop],
    scope: LoopScope<'_>,
    binder: &mut Binder<'_>,
) -> Vec<LoopPlan> {
    let plan = |each: &Loop| match each {
        Loop::For(statement) => {
            for_plan(statement, scope, binder).map(|plan| LoopPlan::For(Box::new(plan)))
        }
        Loop::List(statement) => list_plan(statement, scope, binder).map(LoopPlan::List),
    };
    statements.iter().filter_map(plan).collect()
}

/// The first entry with this name, whatever its case.
fn entry(
    name: &str,
    place: &SourceText,
    scope: LoopScope<'_>,
    binder: &mut Binder<'_>,
) -> Option<usize> {
    let of = |entry: &VariableEntry| scope.variables[entry.variable].name.as_str();
    let found = scope.entries.iter().position(|entry| of(entry).eq_ignore_ascii_case(name));
    if found.is_none() {
        let names: Vec<&str> = scope.entries.iter().map(of).collect();
        let message = format!("there is no variable {name:?} that a loop could change");
        let help = did_you_mean(name, names)
            .unwrap_or_else(|| format!("give it a value in VARIABLES: `{name} = 0`"));
        binder.note(fault("loop/unknown-variable", place, message).help(help));
    }
    found
}

fn for_plan(statement: &ForLoop, scope: LoopScope<'_>, binder: &mut Binder<'_>) -> Option<ForPlan> {
    let entry = entry(statement.variable.as_str(), &statement.variable, scope, binder);
    let from = binder.expression_or_note(&statement.from);
    let to = binder.expression_or_note(&statement.to);
    let by = binder.expression_or_note(&statement.by);
    let (entry, from, to, by) = (entry?, from?, to?, by?);
    let mut read = [from, to, by].into_iter().flat_map(|id| binder.expressions[id.0].slots());
    let fed_back = read.any(|slot| scope.results.contains(slot));
    let variable = &scope.variables[scope.entries[entry].variable];
    Some(ForPlan {
        statement: statement.clone(),
        entry,
        title: statement.variable.as_str().to_owned(),
        is_text: variable.kind == VariableKind::Literal,
        from,
        to,
        by,
        fed_back,
    })
}

fn list_plan(
    statement: &ListLoop,
    scope: LoopScope<'_>,
    binder: &mut Binder<'_>,
) -> Option<ListPlan> {
    let name = statement.file.as_str();
    let file = match binder.library.list(name) {
        Ok(file) => file,
        Err(message) => {
            let help = "a LIST file has a line with names of variables, and a row with a value \
                        for each of them for every step, up to the first empty line";
            let fault = fault("loop/list-file", &statement.file, message);
            binder.note(fault.help(help));
            return None;
        }
    };
    let mut columns = Vec::new();
    for title in file.names() {
        let entry = entry(title, &statement.file, scope, binder)?;
        let variable = &scope.variables[scope.entries[entry].variable];
        let is_text = variable.kind == VariableKind::Literal;
        columns.push(ListColumn { entry, title: title.to_owned(), is_text });
    }
    let fed_back = reads_results(&file, &columns, scope.results, binder);
    Some(ListPlan { statement: statement.clone(), file, columns, fed_back })
}

/// True if a cell of a LIST file names an integral or an output.
fn reads_results(
    file: &ListTable,
    columns: &[ListColumn],
    results: &BTreeSet<u32>,
    binder: &Binder<'_>,
) -> bool {
    (0..file.row_count()).any(|row| {
        columns.iter().enumerate().filter(|(_, column)| !column.is_text).any(|(at, _)| {
            let cell = file.cell(row, at);
            whole_number(cell).is_none()
                && Expr::compile(cell, dialect(binder.mode)).is_ok_and(|expr| {
                    let mut slots = expr.names().iter().filter_map(|name| binder.names.find(name));
                    slots.any(|slot| results.contains(&slot))
                })
        })
    })
}

/// Refuses, without compat, a loop over incidentpol that no INPOL reads: it changes nothing.
pub(super) fn check_incident_loops(
    program: &Program,
    entries: &[VariableEntry],
    loops: &[LoopPlan],
    binder: &mut Binder<'_>,
) {
    if EngineDeviation::FixedIncidentPolarization.applies_in(binder.mode) {
        return;
    }
    let is_incident = |at: usize| {
        let name = program.variables[entries[at].variable].name.as_str();
        name.eq_ignore_ascii_case("incidentpol")
    };
    let read = program.integrals.iter().flat_map(|i| &i.parameters).any(|parameter| {
        parameter.key() == "INPOL"
            && parameter.value.as_str().to_ascii_lowercase().contains("incidentpol")
    });
    for each in loops {
        if read || !each.entries().into_iter().any(is_incident) {
            continue;
        }
        let span = match each {
            LoopPlan::For(plan) => plan.statement.span,
            LoopPlan::List(plan) => plan.statement.span,
        };
        binder.note(
            Diagnostic::error(
                "loop/incidentpol",
                span,
                "a loop over incidentpol does not change the incident light",
            )
            .help("write INPOL = incidentpol in every integral that should follow the loop")
            .note("NIST's program keeps the expression in VARIABLES for the whole run"),
        );
    }
}
