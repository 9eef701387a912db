//! INTEGRALS: the apertures.

use mist_format::{
    program::{ApertureShape, Integral, SourceText},
    suggestion::did_you_mean,
};

use super::binder::Binder;
use crate::{
    fault::fault,
    plan::{ApertureParameter, ApertureSetting, IntegralPlan},
};

/// The integrals; parameters that are wrong are noted.
pub(super) fn integrals(all: &[Integral], binder: &mut Binder<'_>) -> Vec<IntegralPlan> {
    all.iter().map(|integral| plan(integral, binder)).collect()
}

fn plan(integral: &Integral, binder: &mut Binder<'_>) -> IntegralPlan {
    let slot = binder.names.slot(integral.name.as_str());
    let mut settings = Vec::new();
    for parameter in &integral.parameters {
        let key = parameter.key();
        if !integral.shape.parameters().contains(&key.as_str()) {
            note_unknown(integral, &parameter.name, binder);
            continue;
        }
        if let Some(expr) = binder.expression_or_note(&parameter.value) {
            settings.push(ApertureSetting {
                key: ApertureParameter::of(&key),
                text: parameter.value.clone(),
                expr,
            });
        }
    }
    IntegralPlan { slot, name: integral.name.clone(), shape: integral.shape, settings }
}

fn note_unknown(integral: &Integral, name: &SourceText, binder: &mut Binder<'_>) {
    let known = integral.shape.parameters();
    let message = format!("{} has no parameter {name}", integral.shape.name());
    let help = if ApertureShape::find(name.as_str()).is_some() || integral_starts(integral, name) {
        "the integral before it lacks its END".to_owned()
    } else {
        did_you_mean(&name.as_str().to_ascii_uppercase(), known.to_vec())
            .unwrap_or_else(|| format!("it has {}", known.join(", ")))
    };
    binder.note(fault("integral/unknown-parameter", name, message).help(help));
}

/// True if `name = value` looks like the beginning of another integral: its value is a shape.
fn integral_starts(integral: &Integral, name: &SourceText) -> bool {
    integral
        .parameters
        .iter()
        .any(|p| p.name.span() == name.span() && ApertureShape::find(p.value.as_str()).is_some())
}

impl ApertureParameter {
    fn of(name: &str) -> Self {
        match name {
            "CENTER" => Self::Center,
            "ALPHA" => Self::Alpha,
            "OUTERCENTER" => Self::OuterCenter,
            "INNERCENTER" => Self::InnerCenter,
            "OUTERALPHA" => Self::OuterAlpha,
            "INNERALPHA" => Self::InnerAlpha,
            "VERTEX" => Self::Vertex,
            "POLCENTER" => Self::PolCenter,
            "POL" => Self::Pol,
            "INPOL" => Self::InPol,
            other => unreachable!("{other} is not a parameter of any shape"),
        }
    }
}
