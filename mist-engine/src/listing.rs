//! The listing: what was run, with which parameters, and how long it took.

use mist_format::number::{TEXT_DIGITS, push_list};
use scattering::Mode;

use crate::{
    Job,
    step::{ListingLine, SentInput},
};

/// The line of names of a samples file.
pub(crate) const SAMPLES_HEAD: &str = "order\tthetas\tphis\tx\ty\tz\tBRDF\n";

/// Our name and the seed of the random numbers, then what NIST's program writes.
pub(crate) fn head(job: &Job) -> String {
    let mut text =
        format!("mist {}\r\nRandom seed: {}\r\n\n", env!("CARGO_PKG_VERSION"), job.options.seed);
    let mut line = |key: &str, value: &str| text.push_str(&format!("{key}: {value}\n"));
    line("Integrating model", job.plan.class.name);
    line("Listing file", &job.listing_name());
    line("Samples file", job.samples_name().as_deref().unwrap_or("none"));
    line("Results file", &job.results_name());
    for header in job.plan.program.files.headers() {
        line("Header", header.as_str());
    }
    if job.options.mode == Mode::Sound && !job.plan.loops.is_empty() {
        for each in &job.plan.program.loops {
            line("Loop", &each.to_string());
        }
        line("Parameters", "those of the first step");
    }
    text
}

/// True if the parameters that the step number `step` sends are listed: in sound runs those of the
/// first step, for the loops tell the others.
pub(crate) fn lists(job: &Job, step: u64) -> bool {
    step == 0 || job.options.mode == Mode::Compat
}

/// The last line.
pub(crate) fn tail(seconds: f64) -> String {
    let whole = seconds as u64;
    let (hours, minutes, rest) = (whole / 3600, whole / 60 % 60, whole % 60);
    format!("Elapsed time: {whole} s ({hours} hrs. {minutes} min. {rest} s)\n")
}

/// Appends the line of a parameter that was sent to the model.
pub(crate) fn push_parameter(text: &mut String, job: &Job, line: &ListingLine) {
    let name = job.plan.entries[line.entry].parameter_name().unwrap_or_default();
    text.push_str("Setting parameter ");
    text.push_str(name);
    text.push_str(" to ");
    match &line.input {
        _ if line.text.is_some() => text.push_str(line.text.as_deref().unwrap_or_default()),
        SentInput::Text(input) => text.push_str(input),
        SentInput::Value(value) => push_list(text, value.as_slice(), TEXT_DIGITS),
    }
    text.push('\n');
}
