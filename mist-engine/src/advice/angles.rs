//! Angles that look like degrees where radians are read.

use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use mist_format::{
    Diagnostic,
    program::{ApertureShape, SourceText, VariableKind},
};

use super::{
    origin::Element,
    reading::{Reading, ReadingSource, Unit},
    words::{Kind, Word, words},
};
use crate::{
    Job,
    plan::{ApertureParameter, ApertureSetting, IntegralPlan, Plan},
};

/// Room for numbers with a few digits: π/2 is also 1.5708, 2π is also 6.2832.
const ROUNDED: f64 = 1.0001;

/// Every angle that the program hands over: polar ones up to π/2 or π, azimuths up to 2π.
pub(super) fn readings(job: &Job) -> Vec<Reading<'_>> {
    let required = [
        ("incidentangle", job.plan.required.incidentangle, FRAC_PI_2),
        ("rotation", job.plan.required.rotation, TAU),
    ];
    let mut found = Vec::new();
    for (name, slot, most) in required {
        let entry = job.plan.entries.iter().rev().find(|entry| entry.slot == Some(slot));
        if let Some(entry) = entry {
            let text = &job.plan.program.variables[entry.variable].value;
            found.push(angle(name.into(), text, ReadingSource::Slot(slot), Element::Last, most));
        }
    }
    let settings = |plan| settings_of(&job.plan, plan);
    found.extend(job.plan.integrals.iter().flat_map(settings));
    found.extend(parameters(job));
    found
}

fn angle<'j>(
    what: String,
    text: &'j SourceText,
    source: ReadingSource<'j>,
    element: Element,
    most: f64,
) -> Reading<'j> {
    Reading { what, unit: Unit::Radians, text, source, element, most: most * ROUNDED, extreme: 0.0 }
}

fn settings_of<'j>(all: &'j Plan, plan: &'j IntegralPlan) -> Vec<Reading<'j>> {
    let angles = |setting| setting_angles(all, plan, setting);
    plan.settings.iter().flat_map(angles).collect()
}

fn setting_angles<'j>(
    all: &'j Plan,
    plan: &'j IntegralPlan,
    setting: &'j ApertureSetting,
) -> Vec<Reading<'j>> {
    let reading = |what: &str, element, most| {
        let what = format!("{what} of {}", plan.name);
        angle(what, &setting.text, ReadingSource::Expr(all.expression(setting.expr)), element, most)
    };
    // A cone may stand below the horizon in part; a direction or a corner may not.
    let polar = if matches!(plan.shape, ApertureShape::Circle | ApertureShape::Annulus) {
        PI
    } else {
        FRAC_PI_2
    };
    let direction = |what: &str| {
        vec![
            reading(&format!("the polar angle of {what}"), Element::At(0), polar),
            reading(&format!("the azimuth of {what}"), Element::At(1), TAU),
        ]
    };
    match setting.key {
        ApertureParameter::Center => direction("CENTER"),
        ApertureParameter::OuterCenter => direction("OUTERCENTER"),
        ApertureParameter::InnerCenter => direction("INNERCENTER"),
        ApertureParameter::Vertex => direction("VERTEX"),
        ApertureParameter::PolCenter => direction("POLCENTER"),
        ApertureParameter::Alpha => vec![reading("ALPHA", Element::Last, PI)],
        ApertureParameter::OuterAlpha => vec![reading("OUTERALPHA", Element::Last, PI)],
        ApertureParameter::InnerAlpha => vec![reading("INNERALPHA", Element::Last, PI)],
        ApertureParameter::Pol | ApertureParameter::InPol => Vec::new(),
    }
}

/// Parameters of the model that are angles in radians.
fn parameters(job: &Job) -> impl Iterator<Item = Reading<'_>> {
    let all = || job.plan.class.params.iter().flat_map(|group| group.iter());
    job.plan.entries.iter().filter_map(move |entry| {
        let name = entry.parameter_name()?;
        all().find(|parameter| parameter.name == name && parameter.unit == "rad")?;
        let text = &job.plan.program.variables[entry.variable].value;
        let source = ReadingSource::Slot(entry.slot?);
        Some(angle(format!("the parameter {name}"), text, source, Element::Last, TAU))
    })
}

/// Trigonometric functions whose argument is in the other unit.
///
/// A number is taken for degrees when it is more than a turn in radians; a variable, when the
/// program multiplies it by `deg` elsewhere.
pub(super) fn functions(job: &Job) -> Vec<Diagnostic> {
    let texts = expressions(job);
    let degrees: BTreeSet<&str> = texts.iter().flat_map(|text| in_degrees(text.as_str())).collect();
    let mut found = Vec::new();
    for text in &texts {
        let all = words(text.as_str());
        for window in all.windows(4) {
            if let [function, open, argument, close] = window
                && open.is("(")
                && close.is(")")
            {
                found.extend(of_degrees(text, function, argument, &degrees));
            }
        }
        for window in all.windows(6) {
            if let [function, open, argument, times, deg, close] = window
                && open.is("(")
                && times.is("*")
                && deg.is("deg")
                && close.is(")")
            {
                found.extend(of_radians(text, function, argument));
            }
        }
    }
    found
}

/// `sin(45)`, or `sin(t)` where t is in degrees.
fn of_degrees(
    text: &SourceText,
    function: &Word<'_>,
    argument: &Word<'_>,
    degrees: &BTreeSet<&str>,
) -> Option<Diagnostic> {
    let function = function.text;
    if !matches!(function, "sin" | "cos" | "tan") {
        return None;
    }
    let why = match argument.kind {
        Kind::Number(x) if x > TAU * ROUNDED => "looks like degrees".to_owned(),
        Kind::Name if degrees.contains(argument.text) => {
            format!("is in degrees elsewhere, as in {}*deg", argument.text)
        }
        _ => return None,
    };
    let span = text.part(argument.range.clone()).span();
    let argument = argument.text;
    let message = format!("{function} reads radians, and {argument} {why}");
    let help = format!("write {function}d({argument})");
    Some(Diagnostic::warning("angle/degrees", span, message).help(help))
}

/// `sind(t*deg)`.
fn of_radians(text: &SourceText, function: &Word<'_>, argument: &Word<'_>) -> Option<Diagnostic> {
    let plain = function.text.strip_suffix('d').filter(|f| matches!(*f, "sin" | "cos" | "tan"))?;
    let span = text.part(argument.range.clone()).span();
    let (function, argument) = (function.text, argument.text);
    let message = format!("{function} reads degrees, and {argument}*deg is in radians");
    let help = format!("write {function}({argument}), or {plain}({argument}*deg)");
    Some(Diagnostic::warning("angle/radians", span, message).help(help))
}

/// Names that are multiplied by `deg`.
fn in_degrees(text: &str) -> Vec<&str> {
    let all = words(text);
    let mut found = Vec::new();
    for window in all.windows(3) {
        match window {
            [name, times, deg] if times.is("*") && deg.is("deg") && name.kind == Kind::Name => {
                found.push(name.text);
            }
            [deg, times, name] if times.is("*") && deg.is("deg") && name.kind == Kind::Name => {
                found.push(name.text);
            }
            _ => {}
        }
    }
    found
}

/// Every expression of the program.
fn expressions(job: &Job) -> Vec<&SourceText> {
    let program = &job.plan.program;
    let variables = program.variables.iter().filter(|v| v.kind != VariableKind::Literal);
    let settings = job.plan.integrals.iter().flat_map(|integral| &integral.settings);
    let outputs = job.plan.outputs.iter().map(|output| &output.text);
    variables.map(|v| &v.value).chain(settings.map(|s| &s.text)).chain(outputs).collect()
}
