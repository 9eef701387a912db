//! OUTPUTS: the columns of the results, and the variables that they read.

use std::collections::BTreeSet;

use mist_format::{
    Program,
    expr::{Expr, Value},
    number::PrintfFormat,
    program::{Loop, Output, SourceText},
};

use super::binder::Binder;
use crate::{
    DataFiles,
    deviation::EngineDeviation,
    fault::fault,
    plan::{ColourSection, ErrorColumns, IntegralPlan, LoopPlan, OutputPlan, VariableEntry},
    sampling::IntegrationMode,
    slots::SlotNames,
};

/// The outputs; expressions that are wrong are noted.
pub(super) fn outputs(all: &[Output], binder: &mut Binder<'_>) -> Vec<OutputPlan> {
    all.iter().map(|output| plan(output, binder)).collect()
}

fn plan(output: &Output, binder: &mut Binder<'_>) -> OutputPlan {
    let expr = binder.expr_or_note(&output.expression).unwrap_or_else(zero);
    let label = output.label.as_str().to_owned();
    OutputPlan { slot: binder.names.slot(&label), label, text: output.expression.clone(), expr }
}

/// The format of the results; a wrong one is noted.
pub(super) fn format(program: &Program, binder: &mut Binder<'_>) -> Option<PrintfFormat> {
    let given = program.files.format();
    let text = given.map_or("%10g\\t", SourceText::as_str);
    PrintfFormat::parse(text)
        .map_err(|error| {
            let place = given.expect("the default format is sound");
            binder.note(*fault("files/format", place, error.to_string()));
        })
        .ok()
}

/// The columns of the errors, if the variable `uncertainty` asks for them.
pub(super) fn errors(
    program: &Program,
    (entries, initial): (&[VariableEntry], &[(u32, Value)]),
    (integrals, outputs): (&[IntegralPlan], &[OutputPlan]),
    binder: &mut Binder<'_>,
) -> Option<ErrorColumns> {
    let name = |e: &VariableEntry| program.variables[e.variable].name.as_str();
    let number = |slot| {
        let found = initial.iter().rev().find(|(other, _)| Some(*other) == slot);
        found.map(|(_, value)| value.number())
    };
    let numbers = || entries.iter().rev().filter(|entry| entry.slot.is_some());
    let is_adaptive = match numbers().find(|entry| name(entry) == "integrationmode") {
        Some(mode) => number(mode.slot).is_some_and(|mode| {
            IntegrationMode::decode(mode as i32) == Ok(IntegrationMode::Adaptive)
        }),
        None => !EngineDeviation::GridIntegrals.applies_in(binder.mode),
    };
    let entry = numbers().find(|entry| name(entry) == "uncertainty")?;
    let value = number(entry.slot)?;
    if value == 0.0 || !(is_adaptive || varies(program, binder.library, "integrationmode")) {
        return None;
    }
    if value != 1.0 {
        let message = format!("uncertainty = {value} is neither 0 nor 1");
        let text = &program.variables[entry.variable].value;
        let help = "1 adds the column NAME.error of every integral NAME";
        binder.note(fault("program/accuracy", text, message).help(help));
        return None;
    }
    if varies(program, binder.library, "uncertainty") {
        let message = "uncertainty decides the columns of the table: no loop can change it";
        let text = &program.variables[entry.variable].value;
        binder.note(*fault("program/accuracy", text, message));
    }
    let names = &mut binder.names;
    Some(ErrorColumns::new(integrals, outputs, |name| names.slot(name)))
}

/// True if a loop changes the variable `name`.
pub(super) fn varies(program: &Program, library: &DataFiles, name: &str) -> bool {
    program.loops.iter().any(|each| match each {
        Loop::For(statement) => statement.variable.as_str().eq_ignore_ascii_case(name),
        Loop::List(statement) => {
            let file = library.list(statement.file.as_str());
            file.is_ok_and(|file| file.names().any(|title| title.eq_ignore_ascii_case(name)))
        }
    })
}

/// Slots of variables that are read after the model was evaluated.
pub(super) fn reads(
    names: &SlotNames,
    outputs: &[OutputPlan],
    loops: &[LoopPlan],
    colour: Option<&ColourSection>,
) -> Vec<u32> {
    let has_list = loops.iter().any(|each| matches!(each, LoopPlan::List(_)));
    if has_list {
        // A cell may name any variable.
        return (0..names.len() as u32).collect();
    }
    let mut slots: BTreeSet<u32> =
        outputs.iter().flat_map(|output| output.expr.slots().iter().copied()).collect();
    slots.extend(colour.into_iter().flat_map(ColourSection::reads));
    slots.into_iter().collect()
}

fn zero() -> Expr {
    Expr::compile("0", mist_format::Dialect::Sound).expect("0 is an expression")
}
