//! Formats whose numbers run together.

use mist_format::Diagnostic;

use crate::Job;

/// A warning if the format of the results has nothing between two numbers.
pub(super) fn separators(job: &Job) -> Option<Diagnostic> {
    let place = job.plan.program.files.format()?;
    if job.plan.outputs.len() < 2 || job.plan.format.separates() {
        return None;
    }
    let message = format!("the format `{place}` has nothing between the numbers of a row");
    let help = format!("write `{place}\\t`");
    Some(Diagnostic::warning("files/separator", place.span(), message).help(help))
}
