//! A step, assembled from the values of its variables.

use std::sync::Arc;

use mist_format::{Diagnostic, Program, expr::Value, program::ApertureShape};
use scattering::Stokes;

use super::{
    Replay,
    aperture::{ApertureBuilder, stokes},
};
use crate::{
    deviation::EngineDeviation,
    fault::Fault,
    plan::RequiredVariables,
    region::RegionError,
    sampling::{
        IntegrationMode, Outlines, PlaneSampling, SamplingRule, adaptive::Accuracy, truncated,
    },
    step::{Listing, Step, StepIntegral},
    sweep::Sweep,
};

/// The accuracy under `integrationmode = 20`, unless VARIABLES has `tolerance` or `maxevaluations`.
const REQUIRED: Accuracy = Accuracy::required(1e-6, 10_000_000);

impl<'j> Replay<'j> {
    /// The step with the present values.
    pub(super) fn assemble(&mut self, listing: Listing) -> Result<Step, Fault> {
        let job = self.job;
        let required = &job.plan.required;
        let theta_i = self.required(required.incidentangle)?;
        let incident = self.incident()?;
        let rotation = self.required(required.rotation)?;
        let rule = self.rule()?;
        let integrals = self.all_integrals(&rule, incident)?;
        let values = self.output_values();
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
                .filter(|_| job.plan.colour.is_some())
                .map(|sweep| sweep.counts().to_vec())
                .unwrap_or_default(),
        })
    }

    /// The integrals of this step, unless they are computed one by one.
    fn all_integrals(
        &mut self,
        rule: &Result<SamplingRule, RegionError>,
        incident: Stokes,
    ) -> Result<Arc<Vec<StepIntegral>>, Fault> {
        let job = self.job;
        if job.graph.chained {
            return Ok(Arc::default());
        }
        if self.values.take(job.graph.apertures()) {
            let count = job.plan.integrals.len();
            let integrals = (0..count).map(|number| self.integral(number, rule, incident));
            match integrals.collect::<Result<Vec<_>, _>>() {
                Ok(integrals) => self.integrals = Arc::new(integrals),
                Err(fault) => {
                    self.values.mark(job.graph.apertures());
                    return Err(fault);
                }
            }
        }
        Ok(self.integrals.clone())
    }

    /// The variables that outputs read.
    fn output_values(&mut self) -> Arc<[Option<Value>]> {
        if self.values.take(self.job.graph.output_values()) {
            let reads = self.job.plan.reads.iter();
            self.output_values = reads.map(|slot| self.values.get(*slot).cloned()).collect();
        }
        self.output_values.clone()
    }

    /// Adds the next integral of a chained program to `step`, with the results of the integrals
    /// before it.
    pub(crate) fn add_integral(&mut self, step: &mut Step) -> Result<(), Fault> {
        let integral = self.integral(step.integrals.len(), &step.rule, step.incident)?;
        Arc::make_mut(&mut step.integrals).push(integral);
        Ok(())
    }

    fn integral(
        &mut self,
        number: usize,
        rule: &Result<SamplingRule, RegionError>,
        incident: Stokes,
    ) -> Result<StepIntegral, Fault> {
        let plan = &self.job.plan.integrals[number];
        let rule = match rule {
            Ok(rule) => *rule,
            Err(_) if plan.shape == ApertureShape::Differential => {
                SamplingRule::Grid(PlaneSampling::default())
            }
            Err(error) => return Err(self.job.region_fault(number, error)),
        };
        let mut aperture = ApertureBuilder::under(incident);
        for setting in &plan.settings {
            let value = self.values.expression(setting.expr, &setting.text)?;
            aperture.set(setting.key, value, &setting.text)?;
        }
        Ok(aperture.integral(plan, rule))
    }

    fn required(&self, slot: u32) -> Result<f64, Fault> {
        let plan = &self.job.plan;
        let found = self.values.get(slot).map(Value::number);
        found.ok_or_else(|| missing_required(&plan.program, plan.names.name(slot)))
    }

    fn incident(&mut self) -> Result<Stokes, Fault> {
        let plan = &self.job.plan;
        let Some((text, expr)) = &plan.required.incidentpol else {
            return Err(missing_required(&plan.program, "incidentpol"));
        };
        stokes(self.values.expression(*expr, text)?, text)
    }

    /// Sampling rule of the integrals, by `integrationmode`.
    ///
    /// The inner error is that of an unknown mode.
    fn rule(&self) -> Result<Result<SamplingRule, RegionError>, Fault> {
        let (required, options) = (&self.job.plan.required, &self.job.options);
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
        let differential = self.required(required.differential)?;
        let min_samples = self.required(required.minsamples)?;
        let sides = self.required(required.polygonsides)? as i32;
        let outlines = if EngineDeviation::PolygonApertures.applies_in(options.mode) {
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
        let RequiredVariables { tolerance, maxevaluations, gives_mode, .. } =
            self.job.plan.required;
        let number = |slot, default| self.values.get(slot).map_or(default, Value::number);
        let is_required = gives_mode || self.values.get(tolerance).is_some();
        let usual = if is_required { REQUIRED } else { Accuracy::DEFAULT };
        let tolerance = number(tolerance, usual.tolerance);
        if !(tolerance > 0.0 && tolerance < 1.0) {
            let message = format!("tolerance = {tolerance} is not between 0 and 1");
            let help = "it is the relative error of an integral, such as tolerance = 1e-6";
            return Err(self.about("tolerance", message, help));
        }
        let budget = number(maxevaluations, usual.budget as f64);
        let most = self.job.options.limits.directions;
        if !(budget >= 1.0 && budget <= most) {
            let message = format!("maxevaluations = {budget:e} is not from 1 to {most:e}");
            let help = "it is for one Mueller integral, which is held in memory";
            return Err(self.about("maxevaluations", message, help));
        }
        Ok(Accuracy { tolerance, budget: budget as u64, is_required })
    }

    /// A fault of the variable `name`.
    fn about(&self, name: &str, message: String, help: &str) -> Fault {
        let program = &self.job.plan.program;
        let entry = program.variables.iter().rev().find(|v| v.name.as_str() == name);
        let span = entry.map_or(program.sections.variables, |v| v.value.span());
        Box::new(Diagnostic::error("program/accuracy", span, message).help(help))
    }
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
    let message = match name {
        "differential" | "minsamples" => {
            format!("the variable {name} is missing; a grid (integrationmode) needs it")
        }
        _ => format!("the variable {name} is missing; every program needs it"),
    };
    Box::new(
        Diagnostic::error("program/missing-variable", program.sections.variables, message)
            .help(format!("write `{example}` in VARIABLES; the name is written in lower case")),
    )
}
