//! Apertures that get hardly any directions, and runs that get far too many.

use std::collections::BTreeSet;

use mist_format::{Diagnostic, program::SourceText};

use crate::{
    Job,
    fault::Fault,
    region::{Region, RegionError},
    sampling::{Layout, LayoutKey, adaptive::Domain},
    step::{Step, StepIntegral},
};

/// Fewer directions than this do not average over an aperture.
const FEW: usize = 4;
/// Directions of one integral that nobody needs: they cost a second of the simplest model.
const MANY: f64 = 2e6;
/// Evaluations of the model in one run that take hours with most models.
const HUGE_RUN: f64 = 2e9;
/// Layouts with more directions are not counted: they are not few.
const COUNTED: f64 = 3e5;
/// Different layouts that are counted for one integral.
const LAYOUTS: usize = 64;

/// Findings about the apertures of a program.
pub(super) struct Apertures<'j> {
    job: &'j Job,
    /// One for each integral.
    seen: Vec<ApertureSizes>,
    /// Directions of all integrals in all steps that were looked at.
    directions: f64,
    steps: f64,
}

#[derive(Default)]
struct ApertureSizes {
    layouts: BTreeSet<LayoutKey>,
    /// The fewest directions, with the solid angle of the cone around the region and what a
    /// direction stands for.
    fewest: Option<Few>,
    most: f64,
    /// True if an adaptive integral had no solid angle.
    is_empty: bool,
}

#[derive(Clone, Copy)]
struct Few {
    directions: usize,
    solid_angle: f64,
    differential: f64,
}

impl<'j> Apertures<'j> {
    pub(super) fn new(job: &'j Job) -> Self {
        let seen = job.plan.integrals.iter().map(|_| ApertureSizes::default()).collect();
        Self { job, seen, directions: 0.0, steps: 0.0 }
    }

    /// Looks at the integrals of one step.
    ///
    /// # Errors
    ///
    /// For an aperture that cannot be laid out.
    pub(super) fn see(&mut self, step: &Step) -> Result<(), Fault> {
        self.steps += 1.0;
        for (at, (integral, seen)) in step.integrals.iter().zip(&mut self.seen).enumerate() {
            // Adaptive integrals are not laid out.
            let Some((plane, _)) = integral.rule.plane() else {
                seen.check(integral).map_err(|error| self.job.region_fault(at, &error))?;
                continue;
            };
            let estimate = Layout::estimate(&integral.region, plane);
            self.directions += estimate;
            seen.most = seen.most.max(estimate);
            seen.count(integral, estimate).map_err(|error| self.job.region_fault(at, &error))?;
        }
        Ok(())
    }

    /// Warnings for a run with this number of steps.
    pub(super) fn warnings(&self, steps: f64) -> Vec<Diagnostic> {
        let mut found: Vec<_> = self
            .seen
            .iter()
            .enumerate()
            .flat_map(|(at, seen)| {
                let few = seen.fewest.filter(|few| few.directions < FEW);
                let few = few.map(|few| self.few(at, few));
                let empty = seen.is_empty.then(|| self.empty(at));
                let many = (seen.most > MANY).then(|| self.many(at, seen.most));
                few.into_iter().chain(empty).chain(many)
            })
            .collect();
        let evaluations = self.directions / self.steps.max(1.0) * steps;
        if found.iter().all(|known| known.code != "sampling/many") && evaluations > HUGE_RUN {
            found.push(self.long_run(evaluations, steps));
        }
        found
    }

    fn few(&self, at: usize, few: Few) -> Diagnostic {
        let name = &self.job.plan.integrals[at].name;
        let message = match few.directions {
            0 => format!("no direction falls into {name}: it has no value"),
            1 => format!("only one direction falls into {name}"),
            count => format!("only {count} directions fall into {name}"),
        };
        let found = Diagnostic::warning("sampling/few", name.span(), message);
        let (size, each) = (few.solid_angle, few.differential);
        let found = if size > 0.0 {
            found.help(format!(
                "make minsamples larger, or differential smaller: {:.2e} gives about a hundred",
                size / 100.0
            ))
        } else {
            found.help("make the aperture larger: its cone has no solid angle")
        };
        found.note(format!("the cone around it has {size:.3e} sr, differential is {each:.3e} sr"))
    }

    fn empty(&self, at: usize) -> Diagnostic {
        let name = &self.job.plan.integrals[at].name;
        let message = format!("{name} has no solid angle: it is 0");
        Diagnostic::warning("sampling/few", name.span(), message).help("make the aperture larger")
    }

    fn many(&self, at: usize, most: f64) -> Diagnostic {
        let name = &self.job.plan.integrals[at].name;
        let limit = self.job.options.limits.directions;
        let help = "make differential larger: 1e5 directions are much already";
        let found = if most > limit {
            let message = format!("{name} has about {most:.1e} directions, more than {limit:.0e}");
            Diagnostic::error("sampling/too-many", name.span(), message)
        } else {
            let message = format!("{name} has about {most:.1e} directions");
            Diagnostic::warning("sampling/many", name.span(), message)
        };
        self.with_differential(found.help(help))
    }

    fn long_run(&self, evaluations: f64, steps: f64) -> Diagnostic {
        let message = format!(
            "the run evaluates the model about {evaluations:.1e} times in {steps:.0} steps"
        );
        let place =
            self.differential().map_or(self.job.plan.program.sections.vary, SourceText::span);
        Diagnostic::warning("sampling/long-run", place, message)
            .help("make differential larger, or the loops shorter")
    }

    /// The text that says how much a direction stands for.
    fn differential(&self) -> Option<&SourceText> {
        self.job.plan.variable_text(self.job.plan.required.differential)
    }

    fn with_differential(&self, found: Diagnostic) -> Diagnostic {
        match self.differential() {
            Some(text) => found.note_at(text.span(), "solid angle of one direction, sr"),
            None => found,
        }
    }
}

impl ApertureSizes {
    /// Looks for regions that do not exist and for those without a solid angle.
    fn check(&mut self, integral: &StepIntegral) -> Result<(), RegionError> {
        let is_area = !matches!(integral.region, Region::Differential { .. });
        let key = LayoutKey::new(&integral.region, &integral.rule);
        if !is_area || self.layouts.len() >= LAYOUTS || !self.layouts.insert(key) {
            return Ok(());
        }
        Domain::region(integral.region.clone())?;
        self.is_empty |= integral.region.projected_solid_angle() == 0.0;
        Ok(())
    }

    /// Counts the directions of a layout that was not seen before.
    fn count(&mut self, integral: &StepIntegral, estimate: f64) -> Result<(), RegionError> {
        let is_area = !matches!(integral.region, Region::Differential { .. });
        if !is_area || estimate > COUNTED || self.layouts.len() >= LAYOUTS {
            return Ok(());
        }
        let Some((plane, seed)) = integral.rule.plane() else { return Ok(()) };
        if !self.layouts.insert(LayoutKey::new(&integral.region, &integral.rule)) {
            return Ok(());
        }
        let layout = Layout::new(&integral.region, plane, seed)?;
        let few = Few {
            directions: layout.directions(),
            solid_angle: integral.region.cone().solid_angle,
            differential: plane.differential,
        };
        if self.fewest.is_none_or(|fewest| few.directions < fewest.directions) {
            self.fewest = Some(few);
        }
        Ok(())
    }
}
