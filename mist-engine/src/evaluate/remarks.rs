//! Warnings of integrals that are less accurate than they should be.

use std::collections::BTreeMap;

use mist_format::Diagnostic;

use crate::{
    integrate::{MissedLobe, contract},
    plan::IntegralPlan,
    sampling::adaptive::{Estimate, contracted_error},
    step::StepIntegral,
};

/// Reason to doubt a Mueller integral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum AccuracyRemark {
    /// The budget did not suffice for the tolerance, or the integral is not finite.
    Unmet {
        /// The integral with the error that was reached.
        estimate: Estimate,
        /// The relative error that was wanted.
        tolerance: f64,
    },
    /// A lobe falls between the directions of a grid.
    Missed(MissedLobe),
}

/// The first remark about each integral, by the number of the integral.
#[derive(Debug, Default)]
pub(super) struct AccuracyRemarks {
    found: BTreeMap<usize, (u64, AccuracyRemark, StepIntegral)>,
}

impl AccuracyRemarks {
    /// True if there is a remark about the integral already.
    pub(super) fn has(&self, number: usize) -> bool {
        self.found.contains_key(&number)
    }

    /// Notes a remark about the integral `number` in `step`, unless there is one of a step before.
    pub(super) fn note(
        &mut self,
        (number, step): (usize, u64),
        remark: AccuracyRemark,
        integral: &StepIntegral,
    ) {
        self.found.entry(number).or_insert_with(|| (step, remark, integral.clone()));
    }

    /// One warning per integral, in their order.
    pub(super) fn warnings(&self, plans: &[IntegralPlan]) -> Vec<Diagnostic> {
        let each = self.found.iter().map(|(number, (step, remark, integral))| {
            let plan = &plans[*number];
            let (code, message, help) = remark.text(integral);
            let message = format!("{}: {message} (first in step {step})", plan.name);
            Diagnostic::warning(code, plan.name.span(), message).help(help)
        });
        each.collect()
    }
}

impl AccuracyRemark {
    /// The code, the message without the name of the integral, and the remedy.
    fn text(&self, integral: &StepIntegral) -> (&'static str, String, String) {
        let (pol, inpol) = (&integral.pol, &integral.inpol);
        match self {
            Self::Unmet { estimate, .. } if !estimate.relative_error().is_finite() => (
                "integral/not-finite",
                "the model is infinite or not a number in the aperture".to_owned(),
                "leave the direction of the mirror out with an ANNULUS, or check the parameters"
                    .to_owned(),
            ),
            Self::Unmet { estimate, tolerance } => (
                "integral/accuracy",
                format!(
                    "the relative error is {:.1e} after {} evaluations of the model, more than \
                     {tolerance:e}; the value stands",
                    estimate.relative_error(),
                    estimate.evaluations
                ),
                "make maxevaluations larger; with a variable tolerance a larger error is refused"
                    .to_owned(),
            ),
            Self::Missed(MissedLobe { width, spacing, grid, adaptive }) => (
                "integral/missed-lobe",
                format!(
                    "a lobe {width:.2e} rad wide falls between the directions of the grid, \
                     {spacing:.2e} rad apart: the grid gives {:.5e}, an adaptive integral \
                     {:.5e} with an error of {:.1e}",
                    contract(grid, pol, inpol),
                    contract(&adaptive.matrix, pol, inpol),
                    contracted_error(&adaptive.error, pol, inpol)
                ),
                format!(
                    "leave integrationmode out for an adaptive integral, or make differential \
                     smaller than {:.0e}",
                    (0.25 * width).powi(2)
                ),
            ),
        }
    }
}
