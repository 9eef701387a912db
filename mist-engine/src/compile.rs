//! Program text + data files → job, or everything that is wrong with it.
//!
//! One module per section of the program: each turns the section's syntax tree into its plan and
//! notes the faults that it finds.

mod binder;
mod detector;
mod integrals;
mod loops;
mod model;
mod outputs;
mod variables;

use std::{collections::BTreeSet, sync::Arc};

use mist_format::{Diagnostic, Program, expr::Value, program::parse};
use scattering::{Basis, Mode};

pub(crate) use variables::{early_constants, initial_values};

use crate::{
    DataFiles, Files, Job, Options,
    colour::section,
    deviation::dialect,
    graph::DependencyGraph,
    parameters::ModelParameters,
    plan::{ColourSection, ErrorColumns, IntegralPlan, LoopPlan, OutputPlan, Plan, VariableEntry},
};
use binder::Binder;
use loops::LoopScope;

/// Compiles `source`; its data files come from `files`.
///
/// # Errors
///
/// Everything that is wrong with the program and can be told without running it.
pub fn compile(
    source: &str,
    files: Arc<dyn Files + Send + Sync>,
    options: &Options,
) -> Result<Job, Vec<Diagnostic>> {
    let mut program = parse(source, dialect(options.mode))?;
    if options.mode == Mode::Sound {
        detector::complete(&mut program);
    }
    let library = DataFiles::new(files, dialect(options.mode));
    let (plan, initial) = plan(program, &library, options)?;
    let graph = Arc::new(DependencyGraph::new(&plan, options.mode));
    let job = Job {
        plan: Arc::new(plan),
        graph,
        options: options.clone(),
        library,
        given: Arc::new([]),
        initial: initial.into(),
        slips: Arc::new([]),
        renames: false,
    };
    let found = job.find_slips();
    if found.iter().any(Diagnostic::is_error) {
        return Err(found);
    }
    Ok(Job { slips: found.into(), ..job })
}

/// Slots of variables with their values before the first step.
type InitialValues = Vec<(u32, Value)>;

/// The plan of `program`, and the values of its variables before the first step.
fn plan(
    program: Program,
    library: &DataFiles,
    options: &Options,
) -> Result<(Plan, InitialValues), Vec<Diagnostic>> {
    let mut binder = Binder::new(options.mode, library);
    let class = model::class(&program.model, &mut binder);
    let required = variables::required(&program, &mut binder);
    let entries = variables::entries(&program.variables, class, &mut binder);
    let mut faults = Vec::new();
    let constants = early_constants(&required, options.mode);
    let initial = initial_values(
        (&entries, &program.variables),
        (&binder.names, library),
        constants,
        &[],
        |fault| faults.push(fault),
    );
    binder.faults.append(&mut faults);
    let integrals = integrals::integrals(&program.integrals, &mut binder);
    let outputs = outputs::outputs(&program.outputs, &mut binder);
    let errors =
        outputs::errors(&program, (&entries, &initial), (&integrals, &outputs), &mut binder);
    let results: BTreeSet<u32> = integrals
        .iter()
        .map(|integral| integral.slot)
        .chain(outputs.iter().map(|output| output.slot))
        .chain(errors.iter().flat_map(ErrorColumns::slots))
        .collect();
    let scope = LoopScope { variables: &program.variables, entries: &entries, results: &results };
    let loops = loops::loops(&program.loops, scope, &mut binder);
    loops::check_incident_loops(&program, &entries, &loops, &mut binder);
    let format = outputs::format(&program, &mut binder);
    let parts = (&entries[..], &loops[..], &integrals[..], &outputs[..]);
    let colour = colour(&program, parts, options, &mut binder);
    let Binder { names, expressions, mut faults, .. } = binder;
    let (Some(class), Some(format), true) = (class, format, faults.is_empty()) else {
        faults.sort_by_key(|fault| fault.span.start);
        return Err(faults);
    };
    let reads = outputs::reads(&names, &outputs, &loops, colour.as_ref());
    let basis = Basis::from_name(program.files.basis().name()).unwrap_or_default();
    let defaults = ModelParameters::new(class);
    let plan = Plan {
        program,
        class,
        defaults,
        names,
        entries,
        loops,
        required,
        integrals,
        outputs,
        errors,
        format,
        basis,
        colour,
        reads,
        expressions,
    };
    Ok((plan, initial))
}

/// The section COLOR, if there is one; its faults are noted.
fn colour(
    program: &Program,
    (entries, loops, integrals, outputs): (
        &[VariableEntry],
        &[LoopPlan],
        &[IntegralPlan],
        &[OutputPlan],
    ),
    options: &Options,
    binder: &mut Binder<'_>,
) -> Option<ColourSection> {
    let color = program.colour.as_ref()?;
    let context = section::ColourContext {
        names: &mut binder.names,
        mode: options.mode,
        entries,
        variables: &program.variables,
        loops,
        integrals,
        outputs,
        library: binder.library,
        job: &options.job,
        basis: program.files.basis().name(),
    };
    ColourSection::compile(color, context).map_err(|faults| binder.faults.extend(faults)).ok()
}
