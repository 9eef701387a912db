//! The compiled job: an immutable program with its expressions bound to slots.

use std::sync::Arc;

use mist_format::{
    Diagnostic, Program,
    expr::Value,
    program::{ColourKey, SourceText},
};
use scattering::{Class, Mode, ParameterError};

use crate::{
    DataFiles, Limits,
    fault::{Fault, fault},
    graph::DependencyGraph,
    parameters::SetError,
    plan::{ApertureParameter, ColourSection, LoopPlan, Plan},
    region::RegionError,
};

/// Options for compiling and running a program.
#[derive(Clone, Debug)]
pub struct Options {
    /// Sound physics, or NIST's numbers.
    pub mode: Mode,
    /// Name of the job: files that the program does not name are called after it.
    pub job: String,
    /// Seed of the Monte Carlo modes.
    pub seed: u64,
    /// Limits of a run.
    pub limits: Limits,
}

impl Default for Options {
    /// A sound run of a job called `job` with seed 1.
    fn default() -> Self {
        let (job, limits) = ("job".into(), Limits::default());
        Self { mode: Mode::Sound, job, seed: 1, limits }
    }
}

/// A compiled program. Clones are cheap.
#[derive(Clone)]
pub struct Job {
    pub(crate) plan: Arc<Plan>,
    pub(crate) graph: Arc<DependencyGraph>,
    pub(crate) options: Options,
    pub(crate) library: DataFiles,
    /// Entries with other values than the program's.
    pub(crate) given: Arc<[(usize, f64)]>,
    /// The values of the variables before the first step.
    pub(crate) initial: Arc<[(u32, Value)]>,
    /// Warnings of slips in its text.
    pub(crate) slips: Arc<[Diagnostic]>,
    /// True if files that the program names are called after the job, too.
    pub(crate) renames: bool,
}

impl Job {
    /// The program it was compiled from.
    pub fn program(&self) -> &Program {
        &self.plan.program
    }

    /// The class of the model.
    pub fn class(&self) -> &'static Class {
        self.plan.class
    }

    /// The incident light before the first step: I, Q, U, V.
    pub(crate) fn initial_incident(&self) -> [f64; 4] {
        let name = |slot: u32| self.plan.names.name(slot);
        let mut values = self.initial.iter().rev();
        let found = values.find(|(slot, _)| name(*slot).eq_ignore_ascii_case("incidentpol"));
        let light = found.and_then(|(_, value)| value.as_slice().first_chunk().copied());
        light.unwrap_or([1.0, 0.0, 0.0, 0.0])
    }

    /// Name of the results file.
    pub fn results_name(&self) -> String {
        self.name_or(self.plan.program.files.results(), "dat")
    }

    /// Name of the listing file.
    pub fn listing_name(&self) -> String {
        self.name_or(self.plan.program.files.listing(), "lst")
    }

    /// Name of the samples file, if the program wants one.
    pub fn samples_name(&self) -> Option<String> {
        self.plan.program.files.samples().map(|name| self.renamed(name.as_str(), "-samples"))
    }

    /// Name of the file that `key` of COLOR asks for, if it does.
    pub fn colour_name(&self, key: ColourKey) -> Option<String> {
        Some(self.renamed(self.colour()?.file(key)?, ""))
    }

    /// The job with all files called after it, those too that the program names; each keeps its
    /// extension.
    #[must_use]
    pub fn with_files_named_after_it(self) -> Self {
        Self { renames: true, ..self }
    }

    /// The name of a file that the program calls `name`; `kind` goes between the name of the job and
    /// an extension that another file of a run may have, too.
    fn renamed(&self, name: &str, kind: &str) -> String {
        if !self.renames {
            return name.to_owned();
        }
        let extension = name.rsplit_once('.').map_or("dat", |(_, extension)| extension);
        format!("{}{kind}.{extension}", self.options.job)
    }

    /// True if steps must run one after the other, because the program feeds results back.
    pub fn runs_in_order(&self) -> bool {
        self.graph.in_order
    }

    /// Titles of the results' columns: those of the loops, slowest first as they stand there, and
    /// those of the outputs.
    pub fn columns(&self) -> [Vec<&str>; 2] {
        let loops = self.plan.loops.iter().rev().flat_map(LoopPlan::titles).collect();
        [loops, self.plan.outputs.iter().map(|output| output.label.as_str()).collect()]
    }

    /// The titles of the columns of estimated errors, each with the position of the output that it
    /// follows; those that follow no output are the last columns.
    pub fn error_columns(&self) -> Vec<(&str, Option<usize>)> {
        self.plan.error_columns().map(|column| (&*column.title, column.after)).collect()
    }

    /// The colour files the program asks for: (what, name).
    pub fn colour(&self) -> Option<&ColourSection> {
        self.plan.colour.as_ref()
    }

    /// A parameter that the model cannot take, at the place where the program sets it.
    pub(crate) fn parameter_fault(&self, error: &ParameterError) -> Fault {
        let path = error.parameter.as_str();
        let sets = |name: &str| {
            path.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        let set_by = self
            .plan
            .entries
            .iter()
            .filter(|entry| entry.parameter_name().is_some_and(sets))
            .max_by_key(|entry| entry.parameter_name().map_or(0, str::len));
        let place = set_by.map_or(&self.plan.program.model, |entry| {
            &self.plan.program.variables[entry.variable].value
        });
        let fault = fault("model/parameter", place, error.to_string());
        match set_by {
            Some(_) => {
                Box::new(fault.help("`mist models NAME` says what the parameters of a class take"))
            }
            None => Box::new(fault.help(format!("set it in VARIABLES: `#{path} = …`"))),
        }
    }

    /// The fault of a parameter that cannot be set to the value of the entry `at`.
    pub(crate) fn set_fault(&self, at: usize, error: &SetError) -> Fault {
        let variable = &self.plan.program.variables[self.plan.entries[at].variable];
        let place = if error.is_about_the_name() { &variable.name } else { &variable.value };
        Box::new(error.diagnostic(place.span()))
    }

    /// The fault of an integral whose region cannot be sampled, where the program says so.
    pub(crate) fn region_fault(&self, number: usize, error: &RegionError) -> Fault {
        let plan = &self.plan.integrals[number];
        let (place, help) = match error {
            RegionError::Mode(_) => (
                self.plan.variable_text(self.plan.required.integrationmode),
                "write 1 to 6, 11 to 16 for sums without normalization, or 20 for a stated error",
            ),
            RegionError::PolygonSides(_) => {
                (self.plan.variable_text(self.plan.required.polygonsides), "360 is usual")
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

    fn name_or(&self, given: Option<&SourceText>, extension: &str) -> String {
        let own = || format!("{}.{extension}", self.options.job);
        given.map_or_else(own, |name| self.renamed(name.as_str(), ""))
    }
}
