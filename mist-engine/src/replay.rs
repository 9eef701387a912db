//! What the expressions of a program say, step by step.
//!
//! A replay owns the variables, the loops and the model's parameters, and yields one
//! independent [`Step`] per combination of loop values. It never evaluates the model.

pub(crate) mod alone;
mod aperture;
mod due;
mod sending;
mod settings;

use std::{
    collections::{BTreeSet, HashMap},
    sync::Arc,
};

use aperture::{ApertureBuilder, stokes};
use due::Due;
use mist_format::{
    Diagnostic, Program,
    expr::{EvalError, Expr, Stack, Value},
    program::{ApertureShape, SourceText},
};
use scattering::{Mode, Stokes};
use sending::Sent;
use settings::Settings;

use crate::{
    Job,
    fault::{Fault, placed},
    job::{ApertureSetting, IntegralPlan, VariableEntry},
    parameters::ModelParameters,
    quirk::{Quirk, dialect},
    region::RegionError,
    sampling::{
        IntegrationMode, Outlines, PlaneSampling, SamplingRule, adaptive::Accuracy, truncated,
    },
    scope::{Memo, SlotValues},
    step::{Listing, Step, StepIntegral},
    sweep::{EntryContent, LoopContext, Sweep},
};

/// `tolerance`, unless VARIABLES has it.
const TOLERANCE: f64 = 1e-6;

/// `maxevaluations`, unless VARIABLES has it.
const BUDGET: f64 = 1e7;

/// What an entry holds for the rest of the run after a loop has written it.
struct Overwritten {
    content: EntryContent,
    /// The content compiled, if it is an expression that was needed.
    expr: Option<Expr>,
}

/// What an entry gave last.
struct Given {
    known: Memo<Value>,
    /// When it was put into the slot of the entry.
    put: u64,
}

/// A run of the expressions of a job.
pub struct Replay<'j> {
    job: &'j Job,
    pub(crate) scope: SlotValues,
    stack: Stack,
    sweep: Option<Sweep<'j>>,
    overwritten: Vec<Option<Overwritten>>,
    due: Due,
    /// What each entry gave last, unless a loop has written it since.
    entries: Vec<Option<Given>>,
    incident: Option<Memo<Stokes>>,
    /// What the expressions of the integrals' settings gave last.
    settings: Vec<Vec<Option<Memo<Value>>>>,
    /// For each setting an earlier one, by integral and number, with the same expression.
    twins: Vec<Vec<Option<(usize, usize)>>>,
    integrals: Option<Memo<Arc<Vec<StepIntegral>>>>,
    /// The incident light with which they were made.
    incident_before: Option<Stokes>,
    values: Option<Memo<Arc<[Option<Value>]>>>,
    /// The slots that the integrals read.
    integrals_read: Vec<u32>,
    last_sent: Vec<Option<Sent>>,
    known_settings: Settings,
    /// When the predefined variables were given their values.
    predefined: Option<u64>,
    parameters: ModelParameters,
    /// The parameters of the step before: NIST's library remembers optical constants by them.
    previous: Option<ModelParameters>,
    index: u64,
    ended: bool,
}

impl<'j> Replay<'j> {
    /// At the beginning of `job`, before its first step.
    pub fn new(job: &'j Job) -> Self {
        let mut scope = SlotValues::new(job.names.len(), job.library.clone());
        for (slot, value) in &job.initial {
            scope.set(*slot, value);
        }
        let entries = job.entries.len();
        let settings = job.integrals.iter().flat_map(|plan| &plan.settings);
        let integrals_read: BTreeSet<u32> =
            settings.flat_map(|setting| setting.expr.slots()).copied().collect();
        Self {
            job,
            scope,
            stack: Stack::default(),
            sweep: None,
            overwritten: (0..entries).map(|_| None).collect(),
            due: Due::new(job),
            entries: (0..entries).map(|_| None).collect(),
            incident: None,
            settings: job
                .integrals
                .iter()
                .map(|plan| plan.settings.iter().map(|_| None).collect())
                .collect(),
            twins: twins(job),
            integrals: None,
            incident_before: None,
            values: None,
            integrals_read: integrals_read.into_iter().collect(),
            last_sent: (0..entries).map(|_| None).collect(),
            known_settings: Settings::default(),
            predefined: None,
            parameters: ModelParameters::new(job.class),
            previous: None,
            index: 0,
            ended: false,
        }
    }

    /// The next step; none after the last one.
    ///
    /// # Errors
    ///
    /// The first thing that is wrong with the program in this step, and where.
    pub fn next_step(&mut self) -> Result<Option<Step>, Fault> {
        if self.ended || !self.move_loops()? {
            self.ended = true;
            return Ok(None);
        }
        self.write_loops()?;
        let listing = self.evaluate_entries()?;
        let step = self.step(listing)?;
        self.leave_step();
        Ok(Some(step))
    }

    /// Goes on to step `to` without making the steps before it, as far as the loops go. Only for
    /// jobs whose steps stand [`alone`].
    pub(crate) fn skip_to(&mut self, to: u64) -> Result<(), Fault> {
        while self.index < to && !self.ended {
            if !self.move_loops()? {
                self.ended = true;
                return Ok(());
            }
            // The first step sets what does not change, the last one what has changed.
            if self.index == 0 || self.index + 1 == to {
                self.write_loops()?;
                self.evaluate_entries()?;
                self.leave_step();
            } else {
                self.index += 1;
            }
        }
        Ok(())
    }

    /// The parameters of the model as the step before left them.
    pub(crate) fn parameters(&self) -> &ModelParameters {
        &self.parameters
    }

    /// Evaluates all entries; gives their part of the listing.
    fn evaluate_entries(&mut self) -> Result<Listing, Fault> {
        let mut listing = Listing::new();
        self.set_predefined();
        self.due.look_at(&self.scope);
        let mut next = 0;
        while let Some(at) = self.due.take(next) {
            if !self.set_plain_number(at) {
                self.evaluate_entry(at, &mut listing)?;
                self.due.look_at(&self.scope);
            }
            next = at + 1;
        }
        if self.job.options.mode == Mode::Compat {
            self.parameters.forget_other_wavelengths();
        }
        Ok(listing)
    }

    fn leave_step(&mut self) {
        self.previous = Some(self.parameters.clone());
        self.index += 1;
    }

    /// How often each loop was advanced since its reset: the place of the last step.
    pub fn counts(&self) -> Vec<u64> {
        self.sweep.as_ref().map(|sweep| sweep.counts().to_vec()).unwrap_or_default()
    }

    /// Goes to the next combination of loop values; false after the last one.
    fn move_loops(&mut self) -> Result<bool, Fault> {
        let mut context = LoopContext::of(self.job, &mut self.scope, &mut self.stack);
        match &mut self.sweep {
            Some(sweep) => sweep.advance(&mut context),
            None => {
                self.sweep = Some(Sweep::start(&self.job.loops, &mut context)?);
                Ok(true)
            }
        }
    }

    /// Writes what the loops say into their entries.
    fn write_loops(&mut self) -> Result<(), Fault> {
        let mut context = LoopContext::of(self.job, &mut self.scope, &mut self.stack);
        let Some(sweep) = &mut self.sweep else { return Ok(()) };
        for written in sweep.write(&mut context)? {
            self.entries[written.entry] = None;
            self.due.written(written.entry, matches!(written.content, EntryContent::Text(_)));
            self.overwritten[written.entry] =
                Some(Overwritten { content: written.content, expr: None });
        }
        Ok(())
    }

    fn set_predefined(&mut self) {
        let required = &self.job.required;
        let slots = [required.integrationmode, required.polygonsides, required.pi, required.deg];
        if self.predefined.is_some_and(|at| self.scope.is_same_since(at, &slots)) {
            return;
        }
        let pi = 4.0 * 1f64.atan();
        for (slot, value) in slots.into_iter().zip([2.0, 360.0, pi, pi / 180.0]) {
            self.scope.set_number(slot, value);
        }
        self.predefined = Some(self.scope.now());
    }

    /// Evaluates an entry that is a variable for expressions and not a parameter, if it is a number:
    /// what most entries are. Says whether it is.
    fn set_plain_number(&mut self, at: usize) -> bool {
        let entry = &self.job.entries[at];
        let (Some(slot), Some(expr), None) = (entry.slot, &entry.expr, &entry.parameter) else {
            return false;
        };
        if self.overwritten[at].is_some() {
            return false;
        }
        let Some(x) = self.scope.short_number(expr, &mut self.stack) else { return false };
        self.scope.set_number(slot, x);
        self.due.given(&self.scope, at, slot);
        true
    }

    fn evaluate_entry(&mut self, at: usize, listing: &mut Listing) -> Result<(), Fault> {
        let entry = &self.job.entries[at];
        let Some(slot) = entry.slot else { return self.send_text(at, listing) };
        let is_sent = entry.parameter.is_none() || self.last_sent[at].is_some();
        match &self.entries[at] {
            Some(given) if given.known.holds(&self.scope, self.read_by(at)) => {
                if is_sent && self.scope.is_same_since(given.put, &[slot]) {
                    return Ok(());
                }
            }
            _ => self.renew(at, entry)?,
        }
        let given = self.entries[at].as_mut().expect("it was given just now");
        self.scope.set(slot, &given.known.value);
        given.put = self.scope.now();
        if entry.parameter.is_some() {
            let value = given.known.value.clone();
            self.send_number(at, &value, listing)?;
        }
        Ok(())
    }

    /// The slots that an entry reads.
    fn read_by(&self, at: usize) -> &[u32] {
        let expr = match &self.overwritten[at] {
            None => self.job.entries[at].expr.as_ref(),
            Some(overwritten) => overwritten.expr.as_ref(),
        };
        expr.map_or(&[], Expr::slots)
    }

    /// Evaluates an entry.
    fn renew(&mut self, at: usize, entry: &VariableEntry) -> Result<(), Fault> {
        let text = self.text(entry);
        let expr = match &mut self.overwritten[at] {
            None => entry.expr.as_ref().expect("an entry with a slot has an expression"),
            Some(Overwritten { content: EntryContent::Number(x), .. }) => {
                let known = Memo::new(&self.scope, (*x).into());
                self.entries[at] = Some(Given { known, put: 0 });
                return Ok(());
            }
            Some(Overwritten { content: EntryContent::Text(written), expr }) => {
                if expr.is_none() {
                    *expr = Some(written_expr(self.job, written, text)?);
                }
                expr.as_ref().expect("compiled just now")
            }
        };
        let value = self
            .scope
            .value(expr, &mut self.stack)
            .map_err(|error| unknown(self.job, &self.scope, text, &error))?;
        self.entries[at] = Some(Given { known: Memo::new(&self.scope, value), put: 0 });
        Ok(())
    }

    fn text(&self, entry: &VariableEntry) -> &'j SourceText {
        &self.job.program.variables[entry.variable].value
    }

    fn step(&mut self, listing: Listing) -> Result<Step, Fault> {
        let job = self.job;
        let required = &job.required;
        let theta_i = self.required(required.incidentangle)?;
        let differential = self.required(required.differential)?;
        let incident = self.incident()?;
        let min_samples = self.required(required.minsamples)?;
        let rotation = self.required(required.rotation)?;
        let rule = self.rule(differential, min_samples)?;
        let integrals = self.all_integrals(&rule, incident)?;
        let values = self.read_values();
        let sweep = self.sweep.as_ref();
        Ok(Step {
            index: self.index,
            parameters: self.parameters.clone(),
            theta_i,
            rotation,
            integrals,
            rule,
            incident,
            columns: sweep.map(Sweep::cells).unwrap_or_default(),
            values,
            listing,
            fraction: sweep.map_or(0.0, Sweep::fraction),
            counts: sweep
                .filter(|_| job.colour.is_some())
                .map(|sweep| sweep.counts().to_vec())
                .unwrap_or_default(),
        })
    }

    /// The integrals of this step, unless they wait for each other.
    fn all_integrals(
        &mut self,
        rule: &Result<SamplingRule, RegionError>,
        incident: Stokes,
    ) -> Result<Arc<Vec<StepIntegral>>, Fault> {
        let job = self.job;
        if job.chained {
            return Ok(Arc::default());
        }
        if let Some(known) = &self.integrals
            && known.holds(&self.scope, &self.integrals_read)
            && known.value.iter().all(|one| rule.as_ref() == Ok(&one.rule))
            && self.incident_before == Some(incident)
        {
            return Ok(known.value.clone());
        }
        let mut integrals = Vec::with_capacity(job.integrals.len());
        for number in 0..job.integrals.len() {
            integrals.push(self.integral(number, rule, incident)?);
        }
        let value = Arc::new(integrals);
        self.incident_before = Some(incident);
        self.integrals = Some(Memo::new(&self.scope, value.clone()));
        Ok(value)
    }

    /// The variables that outputs read.
    fn read_values(&mut self) -> Arc<[Option<Value>]> {
        let reads = &self.job.reads;
        if let Some(known) = &self.values
            && known.holds(&self.scope, reads)
        {
            return known.value.clone();
        }
        let value: Arc<[_]> = reads.iter().map(|slot| self.scope.get(*slot).cloned()).collect();
        self.values = Some(Memo::new(&self.scope, value.clone()));
        value
    }

    /// Adds the next integral of a chained program to `step`, with what the integrals before it
    /// have given.
    pub(crate) fn add_integral(&mut self, step: &mut Step) -> Result<(), Fault> {
        let number = step.integrals.len();
        let integral = self.integral(number, &step.rule, step.incident)?;
        Arc::make_mut(&mut step.integrals).push(integral);
        Ok(())
    }

    fn required(&self, slot: u32) -> Result<f64, Fault> {
        self.scope
            .get(slot)
            .map(Value::number)
            .ok_or_else(|| missing_required(&self.job.program, self.job.names.name(slot)))
    }

    /// How the directions of the integrals are chosen, by `integrationmode`.
    ///
    /// The inner error is that of an unknown mode.
    fn rule(
        &self,
        differential: f64,
        min_samples: f64,
    ) -> Result<Result<SamplingRule, RegionError>, Fault> {
        let (required, options) = (&self.job.required, &self.job.options);
        let mode = self.required(required.integrationmode)? as i32;
        let (projection, is_random, is_normalized) = match IntegrationMode::decode(mode) {
            Ok(IntegrationMode::Adaptive) => {
                return Ok(Ok(SamplingRule::Adaptive(self.accuracy()?)));
            }
            Ok(IntegrationMode::Plane { projection, is_random, is_normalized }) => {
                (projection, is_random, is_normalized)
            }
            Err(error) => return Ok(Err(error)),
        };
        let sides = self.required(required.polygonsides)? as i32;
        let outlines = if Quirk::PolygonApertures.applies_in(options.mode) {
            Outlines::Polygons { sides }
        } else {
            Outlines::Exact
        };
        let min_samples = truncated(min_samples);
        let plane =
            PlaneSampling { projection, differential, min_samples, is_normalized, outlines };
        Ok(Ok(match is_random {
            true => SamplingRule::MonteCarlo { plane, seed: options.seed },
            false => SamplingRule::Grid(plane),
        }))
    }

    /// The accuracy of adaptive integrals, by `tolerance` and `maxevaluations`.
    fn accuracy(&self) -> Result<Accuracy, Fault> {
        let required = &self.job.required;
        let number = |slot, default| self.scope.get(slot).map_or(default, Value::number);
        let tolerance = number(required.tolerance, TOLERANCE);
        if !(tolerance > 0.0 && tolerance < 1.0) {
            let message = format!("tolerance = {tolerance} is not between 0 and 1");
            let help = "it is the relative error of an integral, such as tolerance = 1e-6";
            return Err(self.about("tolerance", message, help));
        }
        let (budget, most) =
            (number(required.maxevaluations, BUDGET), self.job.options.limits.directions);
        if !(budget >= 1.0 && budget <= most) {
            let message = format!("maxevaluations = {budget:e} is not from 1 to {most:e}");
            let help = "it is for one Mueller integral, which is held in memory";
            return Err(self.about("maxevaluations", message, help));
        }
        Ok(Accuracy { tolerance, budget: budget as u64 })
    }

    /// A fault of the variable `name`.
    fn about(&self, name: &str, message: String, help: &str) -> Fault {
        let program = &self.job.program;
        let entry = program.variables.iter().rev().find(|v| v.name.as_str() == name);
        let span = entry.map_or(program.sections.variables, |v| v.value.span());
        Box::new(Diagnostic::error("program/accuracy", span, message).help(help))
    }

    fn incident(&mut self) -> Result<Stokes, Fault> {
        let job = self.job;
        let Some((text, expr)) = &job.required.incidentpol else {
            return Err(missing_required(&job.program, "incidentpol"));
        };
        if let Some(known) = &self.incident
            && known.holds(&self.scope, expr.slots())
        {
            return Ok(known.value);
        }
        let value = self
            .scope
            .value(expr, &mut self.stack)
            .map_err(|error| unknown(job, &self.scope, text, &error))?;
        let value = stokes(&value, text)?;
        self.incident = Some(Memo::new(&self.scope, value));
        Ok(value)
    }

    fn integral(
        &mut self,
        number: usize,
        rule: &Result<SamplingRule, RegionError>,
        incident: Stokes,
    ) -> Result<StepIntegral, Fault> {
        let plan = &self.job.integrals[number];
        let rule = match rule {
            Ok(rule) => *rule,
            Err(_) if plan.shape == ApertureShape::Differential => {
                SamplingRule::Grid(PlaneSampling::default())
            }
            Err(error) => return Err(self.job.region_fault(number, error)),
        };
        let mut aperture = ApertureBuilder::under(incident);
        for (at, setting) in plan.settings.iter().enumerate() {
            let slots = setting.expr.slots();
            let known = |place: (usize, usize)| self.settings[place.0][place.1].as_ref();
            let holds = |known: &&Memo<Value>| known.holds(&self.scope, slots);
            if !known((number, at)).is_some_and(|known| holds(&known)) {
                let twin = self.twins[number][at].and_then(known).filter(holds);
                let value = match twin {
                    Some(twin) => twin.value.clone(),
                    None => self
                        .scope
                        .value(&setting.expr, &mut self.stack)
                        .map_err(|error| unknown(self.job, &self.scope, &setting.text, &error))?,
                };
                self.settings[number][at] = Some(Memo::new(&self.scope, value));
            }
            let known = self.settings[number][at].as_ref().expect("known by now");
            aperture.set(setting.key, &known.value, &setting.text)?;
        }
        Ok(aperture.integral(plan, rule))
    }
}

/// For each setting of the integrals the first one, by integral and number, that has the same
/// expression, if it is another one.
fn twins(job: &Job) -> Vec<Vec<Option<(usize, usize)>>> {
    let mut first = HashMap::new();
    let mut twin = |place: (usize, usize), setting: &ApertureSetting| {
        let found = *first.entry(setting.expr.text().to_owned()).or_insert(place);
        (found != place).then_some(found)
    };
    let of = |(number, plan): (usize, &IntegralPlan)| {
        let settings = plan.settings.iter().enumerate();
        settings.map(|(at, setting)| twin((number, at), setting)).collect()
    };
    job.integrals.iter().enumerate().map(of).collect()
}

fn missing_required(program: &Program, name: &str) -> Fault {
    let example = match name {
        "incidentangle" => "incidentangle = 30*deg",
        "differential" => "differential = (1*deg)^2",
        "incidentpol" => "incidentpol = (1,0,0,0)",
        "minsamples" => "minsamples = 100",
        "rotation" => "rotation = 0",
        other => other,
    };
    let message = format!("the variable {name} is missing; every program needs it");
    Box::new(
        Diagnostic::error("program/missing-variable", program.sections.variables, message)
            .help(format!("write `{example}` in VARIABLES; the name is written in lower case")),
    )
}

/// An error of an evaluation, with the names that were known.
fn unknown(job: &Job, scope: &SlotValues, text: &SourceText, error: &EvalError) -> Fault {
    let known: Vec<&str> = scope.defined().map(|slot| job.names.name(slot)).collect();
    placed(text, error.diagnostic(known))
}

/// The text that a loop wrote into an entry, compiled.
fn written_expr(job: &Job, written: &str, text: &SourceText) -> Result<Expr, Fault> {
    let mut expr = Expr::compile(written, dialect(job.options.mode)).map_err(|error| {
        let diagnostic = error.diagnostic();
        let message = format!("the loop value {written:?}: {}", diagnostic.message);
        Box::new(Diagnostic { span: text.span(), message, ..diagnostic })
    })?;
    expr.bind(|name| job.names.find(name).unwrap_or(u32::MAX));
    Ok(expr)
}
