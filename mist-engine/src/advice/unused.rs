//! Variables that nothing reads.

use std::collections::BTreeSet;

use mist_format::{
    Diagnostic,
    expr::Expr,
    program::{REQUIRED_VARIABLES, VariableKind},
    suggestion::did_you_mean,
};

use crate::{
    Job,
    deviation::dialect,
    plan::{ColourSection, LoopPlan},
};

/// Names that the language itself reads at every step.
const READ_BY_ALL: [&str; 7] =
    ["integrationmode", "polygonsides", "pi", "deg", "tolerance", "maxevaluations", "uncertainty"];

/// One warning for each variable that is computed in vain.
pub(super) fn warnings(job: &Job) -> Vec<Diagnostic> {
    let read = Read::of(job);
    let mut told = BTreeSet::new();
    let mut found = Vec::new();
    for (at, entry) in job.plan.entries.iter().enumerate() {
        let variable = &job.plan.program.variables[entry.variable];
        let Some(slot) = entry.slot.filter(|_| variable.kind == VariableKind::Local) else {
            continue;
        };
        let name = variable.name.as_str();
        if read.has(slot, name) || read.looped.contains(&at) || !told.insert(slot) {
            continue;
        }
        let message = format!("nothing reads the variable `{name}`");
        found.push(
            Diagnostic::warning("program/unused-variable", variable.name.span(), message)
                .help(help(job, name)),
        );
    }
    found
}

fn help(job: &Job, name: &str) -> String {
    let parameters = || job.plan.class.params.iter().flat_map(|group| group.iter());
    if parameters().any(|parameter| parameter.name == name) {
        return format!("write `#{name}` to set the model's parameter {name}");
    }
    let names = READ_BY_ALL.iter().chain(&REQUIRED_VARIABLES).copied();
    did_you_mean(name, names)
        .unwrap_or_else(|| "leave it out, or write its name where it is meant".into())
}

/// Names that some expression reads.
struct Read {
    slots: BTreeSet<u32>,
    /// Entries that loops write: the results show them.
    looped: BTreeSet<usize>,
}

impl Read {
    fn of(job: &Job) -> Self {
        let mut slots = BTreeSet::new();
        // `x = x + 1` alone is not a use of x.
        for entry in &job.plan.entries {
            if let Some(expr) = &entry.expr {
                let others = expr.slots().iter().filter(|read| Some(**read) != entry.slot);
                slots.extend(others);
            }
        }
        let outputs = job.plan.outputs.iter().map(|output| &output.expr);
        slots.extend(outputs.chain(&job.plan.expressions).flat_map(Expr::slots));
        slots.extend(job.plan.colour.iter().flat_map(ColourSection::reads));
        slots.extend(cells(job));
        Self { slots, looped: job.plan.loops.iter().flat_map(LoopPlan::entries).collect() }
    }

    fn has(&self, slot: u32, name: &str) -> bool {
        self.slots.contains(&slot)
            || READ_BY_ALL.contains(&name)
            || REQUIRED_VARIABLES.contains(&name)
            || name.eq_ignore_ascii_case("incidentpol")
    }
}

/// Variables that cells of LIST files read.
fn cells(job: &Job) -> BTreeSet<u32> {
    let mut found = BTreeSet::new();
    for each in &job.plan.loops {
        let LoopPlan::List(plan) = each else { continue };
        let columns = plan.columns.iter().enumerate().filter(|(_, column)| !column.is_text);
        for (at, _) in columns {
            for row in 0..plan.file.row_count() {
                let cell = plan.file.cell(row, at);
                if mist_format::number::whole_number(cell).is_some() {
                    continue;
                }
                if let Ok(expr) = Expr::compile(cell, dialect(job.options.mode)) {
                    found.extend(expr.names().iter().filter_map(|name| job.plan.names.find(name)));
                }
            }
        }
    }
    found
}
