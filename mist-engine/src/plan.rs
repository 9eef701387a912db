//! The compiled program: its sections with names resolved to slots, paths and expressions.
//!
//! All types are plain data, made by `compile` and immutable afterwards.

use std::{f64::consts::PI, sync::Arc};

use mist_format::{
    Program,
    expr::Expr,
    number::PrintfFormat,
    program::{ApertureShape, ColourKey, ForLoop, ListLoop, SourceText},
    table::ListTable,
};
use scattering::{Basis, Class};
use spectra::ColourSettings;

use crate::{
    parameters::{ModelParameters, ParameterPath},
    slots::SlotNames,
};

/// A compiled program.
pub(crate) struct Plan {
    pub(crate) program: Program,
    pub(crate) class: &'static Class,
    /// Every parameter of the model at its default.
    pub(crate) defaults: ModelParameters,
    pub(crate) names: SlotNames,
    pub(crate) entries: Vec<VariableEntry>,
    pub(crate) loops: Vec<LoopPlan>,
    pub(crate) required: RequiredVariables,
    pub(crate) integrals: Vec<IntegralPlan>,
    pub(crate) outputs: Vec<OutputPlan>,
    /// The columns of the errors, if the program wants them.
    pub(crate) errors: Option<ErrorColumns>,
    pub(crate) format: PrintfFormat,
    pub(crate) basis: Basis,
    pub(crate) colour: Option<ColourSection>,
    /// Slots of variables that outputs, loop columns and colours read.
    pub(crate) reads: Vec<u32>,
    /// The expressions outside of VARIABLES that a replay evaluates, by their ids.
    pub(crate) expressions: Vec<Expr>,
}

/// The number of an expression in [`Plan::expressions`]; equal expressions share one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ExpressionId(pub(crate) usize);

/// One entry of VARIABLES.
pub(crate) struct VariableEntry {
    /// Its slot; texts for the model have none.
    pub(crate) slot: Option<u32>,
    /// Position in the program's VARIABLES.
    pub(crate) variable: usize,
    /// The expression that gives its value, unless it is a text for the model.
    pub(crate) expr: Option<Expr>,
    /// The model parameter that it sets.
    pub(crate) parameter: Option<ParameterPath>,
}

impl VariableEntry {
    /// The dotted name of the model parameter that it sets.
    pub(crate) fn parameter_name(&self) -> Option<&str> {
        self.parameter.as_ref().map(ParameterPath::as_str)
    }
}

/// The slots of the variables that every step reads.
pub(crate) struct RequiredVariables {
    pub(crate) incidentangle: u32,
    pub(crate) differential: u32,
    pub(crate) incidentpol: Option<(SourceText, ExpressionId)>,
    pub(crate) minsamples: u32,
    pub(crate) rotation: u32,
    pub(crate) integrationmode: u32,
    pub(crate) polygonsides: u32,
    pub(crate) tolerance: u32,
    pub(crate) maxevaluations: u32,
    /// True if VARIABLES or a loop gives `integrationmode`.
    pub(crate) gives_mode: bool,
    pub(crate) pi: u32,
    pub(crate) deg: u32,
}

impl RequiredVariables {
    /// The predefined constants pi and deg with their slots.
    pub(crate) fn constants(&self) -> [(u32, f64); 2] {
        [(self.pi, PI), (self.deg, PI / 180.0)]
    }
}

/// A loop.
pub(crate) enum LoopPlan {
    For(Box<ForPlan>),
    List(ListPlan),
}

impl LoopPlan {
    /// Entries of VARIABLES that the loop writes.
    pub(crate) fn entries(&self) -> Vec<usize> {
        match self {
            Self::For(plan) => vec![plan.entry],
            Self::List(plan) => plan.columns.iter().map(|column| column.entry).collect(),
        }
    }

    /// Names of its columns in the results.
    pub(crate) fn titles(&self) -> Vec<&str> {
        match self {
            Self::For(plan) => vec![plan.title.as_str()],
            Self::List(plan) => plan.columns.iter().map(|c| c.title.as_str()).collect(),
        }
    }
}

/// A FOR loop.
pub(crate) struct ForPlan {
    pub(crate) statement: ForLoop,
    /// The entry of VARIABLES that it writes.
    pub(crate) entry: usize,
    /// Name of its column.
    pub(crate) title: String,
    /// True if the entry is a text for the model, shown as it is written.
    pub(crate) is_text: bool,
    pub(crate) from: ExpressionId,
    pub(crate) to: ExpressionId,
    pub(crate) by: ExpressionId,
    /// True if a bound reads results of earlier steps, so that it may come to an end later.
    pub(crate) fed_back: bool,
}

impl ForPlan {
    /// The expressions of its first value, last value and step.
    pub(crate) fn bounds(&self) -> [ExpressionId; 3] {
        [self.from, self.to, self.by]
    }
}

/// A LIST loop.
pub(crate) struct ListPlan {
    pub(crate) statement: ListLoop,
    pub(crate) file: Arc<ListTable>,
    pub(crate) columns: Vec<ListColumn>,
    /// True if a cell reads results of earlier steps.
    pub(crate) fed_back: bool,
}

/// A column of a LIST file.
pub(crate) struct ListColumn {
    /// The entry of VARIABLES that it writes.
    pub(crate) entry: usize,
    /// The name in the file.
    pub(crate) title: String,
    /// True if the entry is a text for the model.
    pub(crate) is_text: bool,
}

/// One integral.
pub(crate) struct IntegralPlan {
    pub(crate) slot: u32,
    pub(crate) name: SourceText,
    pub(crate) shape: ApertureShape,
    pub(crate) settings: Vec<ApertureSetting>,
}

/// A parameter of an integral with its expression.
pub(crate) struct ApertureSetting {
    pub(crate) key: ApertureParameter,
    pub(crate) text: SourceText,
    pub(crate) expr: ExpressionId,
}

/// The parameters of integrals, of all shapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ApertureParameter {
    Center,
    Alpha,
    OuterCenter,
    InnerCenter,
    OuterAlpha,
    InnerAlpha,
    Vertex,
    PolCenter,
    Pol,
    InPol,
}

impl IntegralPlan {
    /// The text of the last parameter that is one of `keys`.
    pub(crate) fn setting(&self, keys: &[ApertureParameter]) -> Option<&SourceText> {
        let found = self.settings.iter().rev().find(|setting| keys.contains(&setting.key));
        found.map(|setting| &setting.text)
    }

    /// The text of the corner `number` of a polygon, from 1.
    pub(crate) fn vertex(&self, number: usize) -> Option<&SourceText> {
        let is_corner = |setting: &&ApertureSetting| setting.key == ApertureParameter::Vertex;
        let mut corners = self.settings.iter().filter(is_corner);
        corners.nth(number.checked_sub(1)?).map(|setting| &setting.text)
    }
}

/// One output.
pub(crate) struct OutputPlan {
    pub(crate) slot: u32,
    pub(crate) label: String,
    pub(crate) text: SourceText,
    pub(crate) expr: Expr,
}

/// The error of one integral as a column.
pub(crate) struct ErrorColumn {
    /// NAME.error.
    pub(crate) title: String,
    /// Slot in which expressions find it.
    pub(crate) slot: u32,
    /// Position of the integral in the program.
    pub(crate) integral: usize,
    /// The output that it follows.
    pub(crate) after: Option<usize>,
}

/// The columns of the errors of all integrals.
pub(crate) struct ErrorColumns(pub(crate) Vec<ErrorColumn>);

/// The section COLOR of a compiled program.
pub struct ColourSection {
    pub(crate) wavelength: PlacedExpression,
    pub(crate) angles: [Option<PlacedExpression>; 4],
    /// Slots of the output labels of I, Q, U, V.
    pub(crate) spectrum: Vec<u32>,
    /// The first integral that the spectrum is computed from.
    pub(crate) integral: Option<usize>,
    /// Per loop, the first declared first: what it does to the table.
    pub(crate) roles: Vec<LoopRole>,
    pub(crate) settings: ColourSettings,
    pub(crate) frame: String,
    pub(crate) patch: String,
    pub(crate) material: String,
    pub(crate) place: SourceText,
    pub(crate) files: Vec<(ColourKey, String)>,
}

/// An expression with its place.
pub(crate) struct PlacedExpression {
    pub(crate) text: Option<SourceText>,
    pub(crate) expr: Expr,
}

/// Role of a loop in the table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum LoopRole {
    /// Its steps are wavelengths of one spectrum.
    Folded,
    /// Its steps are directions.
    Direction,
    /// Its value leads the row: names and slots.
    Leading(Vec<(String, u32)>),
}

impl Plan {
    /// The expression with this id.
    pub(crate) fn expression(&self, id: ExpressionId) -> &Expr {
        &self.expressions[id.0]
    }

    /// The slots that the expression reads.
    pub(crate) fn slots_of(&self, id: ExpressionId) -> &[u32] {
        self.expression(id).slots()
    }

    /// Slots of the results of a step: integrals, their errors and outputs.
    pub(crate) fn results(&self) -> impl Iterator<Item = u32> + '_ {
        let integrals = self.integrals.iter().map(|plan| plan.slot);
        let errors = self.errors.iter().flat_map(ErrorColumns::slots);
        let outputs = self.outputs.iter().map(|output| output.slot);
        integrals.chain(errors).chain(outputs)
    }

    /// The columns of errors in the order in which they stand: behind their outputs, then the others.
    pub(crate) fn error_columns(&self) -> impl Iterator<Item = &ErrorColumn> {
        let behind = (0..self.outputs.len())
            .flat_map(|at| self.errors.iter().flat_map(move |errors| errors.after(at)));
        behind.chain(self.errors.iter().flat_map(ErrorColumns::last))
    }

    /// The text of the last entry that gives `slot`.
    pub(crate) fn variable_text(&self, slot: u32) -> Option<&SourceText> {
        let entry = self.entries.iter().rev().find(|entry| entry.slot == Some(slot))?;
        Some(&self.program.variables[entry.variable].value)
    }
}
