//! The compiled job: an immutable program with its expressions bound to slots.

use mist_format::{
    Diagnostic, Program,
    expr::{Expr, Value},
    number::PrintfFormat,
    program::{ApertureShape, SourceText},
};
use scattering::{Basis, Class, Mode, ParameterError};

use crate::{
    DataFiles, Limits,
    colour::section::ColourSection,
    fault::{Fault, fault},
    region::RegionError,
    scope::SlotNames,
    sweep::LoopPlan,
    uncertainty::ErrorColumns,
};

/// How a program is compiled and run.
#[derive(Clone, Debug)]
pub struct Options {
    /// Sound physics, or NIST's numbers.
    pub mode: Mode,
    /// Name of the job: files that the program does not name are called after it.
    pub job: String,
    /// Seed of the Monte Carlo modes.
    pub seed: u64,
    /// What a run may cost.
    pub limits: Limits,
    /// Variables, as the program writes their names, that have other values than it gives them.
    pub values: Vec<(String, f64)>,
}

impl Default for Options {
    /// A sound run of a job called `job` with seed 1.
    fn default() -> Self {
        let (job, limits) = ("job".into(), Limits::default());
        Self { mode: Mode::Sound, job, seed: 1, limits, values: Vec::new() }
    }
}

/// A compiled program.
pub struct Job {
    pub(crate) program: Program,
    pub(crate) options: Options,
    pub(crate) library: DataFiles,
    pub(crate) class: &'static Class,
    pub(crate) names: SlotNames,
    /// The parse-time values of the variables.
    pub(crate) initial: Vec<(u32, Value)>,
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
    /// Whether variables, loops or apertures read integrals or outputs of earlier steps.
    pub(crate) in_order: bool,
    /// Whether an aperture reads an integral or output, so that integrals are computed one by one.
    pub(crate) chained: bool,
}

/// One entry of VARIABLES.
pub(crate) struct VariableEntry {
    /// Its slot; texts for the model have none.
    pub(crate) slot: Option<u32>,
    /// Position in the program's VARIABLES.
    pub(crate) variable: usize,
    /// What it evaluates, unless it is a text for the model.
    pub(crate) expr: Option<Expr>,
    /// The model parameter it sets.
    pub(crate) parameter: Option<String>,
}

/// The required variables, read in this order at every step.
pub(crate) struct RequiredVariables {
    pub(crate) incidentangle: u32,
    pub(crate) differential: u32,
    pub(crate) incidentpol: Option<(SourceText, Expr)>,
    pub(crate) minsamples: u32,
    pub(crate) rotation: u32,
    pub(crate) integrationmode: u32,
    pub(crate) polygonsides: u32,
    pub(crate) tolerance: u32,
    pub(crate) maxevaluations: u32,
    pub(crate) pi: u32,
    pub(crate) deg: u32,
}

/// A parameter of an integral: which it is, and its expression.
pub(crate) struct ApertureSetting {
    pub(crate) key: ApertureParameter,
    pub(crate) text: SourceText,
    pub(crate) expr: Expr,
}

/// Parameters of integrals, of all shapes.
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

/// One integral.
pub(crate) struct IntegralPlan {
    pub(crate) slot: u32,
    pub(crate) name: SourceText,
    pub(crate) shape: ApertureShape,
    pub(crate) settings: Vec<ApertureSetting>,
}

impl IntegralPlan {
    /// What is written for the last parameter that is one of `keys`.
    fn setting(&self, keys: &[ApertureParameter]) -> Option<&SourceText> {
        let found = self.settings.iter().rev().find(|setting| keys.contains(&setting.key));
        found.map(|setting| &setting.text)
    }

    /// What is written for the corner `number` of a polygon, from 1.
    fn vertex(&self, number: usize) -> Option<&SourceText> {
        let mut corners =
            self.settings.iter().filter(|setting| setting.key == ApertureParameter::Vertex);
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

impl Job {
    /// The program it was compiled from.
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// The class of the model.
    pub fn class(&self) -> &'static Class {
        self.class
    }

    /// Name of the results file.
    pub fn results_name(&self) -> String {
        self.name_or(self.program.files.results(), "dat")
    }

    /// Name of the listing file.
    pub fn listing_name(&self) -> String {
        self.name_or(self.program.files.listing(), "lst")
    }

    /// Name of the samples file, if the program wants one.
    pub fn samples_name(&self) -> Option<&str> {
        self.program.files.samples().map(SourceText::as_str)
    }

    /// Whether steps must run one after the other, because the program feeds results back.
    pub fn runs_in_order(&self) -> bool {
        self.in_order
    }

    /// Titles of the results' columns: those of the loops, slowest first as they stand there, and
    /// those of the outputs.
    pub fn columns(&self) -> [Vec<&str>; 2] {
        let loops = self.loops.iter().rev().flat_map(LoopPlan::titles).collect();
        [loops, self.outputs.iter().map(|output| output.label.as_str()).collect()]
    }

    /// The colour files the program asks for: (what, name).
    pub fn colour(&self) -> Option<&ColourSection> {
        self.colour.as_ref()
    }

    /// A parameter that the model cannot take, at the place where the program sets it.
    pub(crate) fn parameter_fault(&self, error: &ParameterError) -> Fault {
        let path = error.parameter.as_str();
        let sets = |name: &str| {
            path.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        let set_by = self
            .entries
            .iter()
            .filter(|entry| entry.parameter.as_deref().is_some_and(sets))
            .max_by_key(|entry| entry.parameter.as_ref().map_or(0, String::len));
        let place = set_by
            .map_or(&self.program.model, |entry| &self.program.variables[entry.variable].value);
        let fault = fault("model/parameter", place, error.to_string());
        match set_by {
            Some(_) => {
                Box::new(fault.help("`mist models NAME` says what the parameters of a class take"))
            }
            None => Box::new(fault.help(format!("set it in VARIABLES: `#{path} = …`"))),
        }
    }

    /// The fault of an integral whose region cannot be sampled, where the program says so.
    pub(crate) fn region_fault(&self, number: usize, error: &RegionError) -> Fault {
        let plan = &self.integrals[number];
        let (place, help) = match error {
            RegionError::Mode(_) => (
                self.variable_text(self.required.integrationmode),
                "write 1 to 6, 11 to 16 for sums without normalization, or 20 for a stated error",
            ),
            RegionError::PolygonSides(_) => {
                (self.variable_text(self.required.polygonsides), "360 is usual")
            }
            RegionError::BelowHorizon { number, .. } => (
                plan.vertex(*number),
                "the polar angle of a corner is at most pi/2; degrees are written 60*deg",
            ),
            RegionError::Crossing { second, .. } => (
                plan.vertex(*second),
                "give the corners in their order around the polygon; an edge runs to each corner \
                 from the one before it",
            ),
            RegionError::WideOrthographic { .. } => (
                plan.setting(&[ApertureParameter::Alpha, ApertureParameter::OuterAlpha]),
                "ALPHA is in radians; degrees are written 20*deg",
            ),
        };
        let message = format!("{}: {error}", plan.name);
        let place = place.unwrap_or(&plan.name);
        Box::new(Diagnostic::error("integral/region", place.span(), message).help(help))
    }

    /// What is written for the variable in `slot`.
    pub(crate) fn variable_text(&self, slot: u32) -> Option<&SourceText> {
        let entry = self.entries.iter().rev().find(|entry| entry.slot == Some(slot))?;
        Some(&self.program.variables[entry.variable].value)
    }

    fn name_or(&self, given: Option<&SourceText>, extension: &str) -> String {
        given.map_or_else(|| format!("{}.{extension}", self.options.job), |t| t.as_str().to_owned())
    }
}
