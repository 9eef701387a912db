//! Wavelengths that tables do not have.

use mist_format::{Diagnostic, program::SourceText};
use scattering::Mode;

use crate::{
    Job,
    parameters::{TableFinding, TableUses},
};

/// The findings about the tables that a run asks; without `is_whole` some of its wavelengths are
/// not known, and nothing is an error.
pub(super) fn findings(job: &Job, uses: &TableUses, is_whole: bool) -> Vec<Diagnostic> {
    uses.findings().into_iter().map(|finding| diagnostic(job, finding, is_whole)).collect()
}

fn diagnostic(job: &Job, finding: TableFinding, is_whole: bool) -> Diagnostic {
    let TableFinding { paths, is_error, warning } = finding;
    let places = paths.iter().map(|path| place(job, path).span());
    let span = places.min_by_key(|span| span.start).unwrap_or(job.plan.program.model.span());
    let is_error = is_error && is_whole && job.options.mode == Mode::Sound;
    let found = match is_error {
        true => Diagnostic::error(warning.code, span, warning.message),
        false => Diagnostic::warning(warning.code, span, warning.message),
    };
    found.help_if(warning.help)
}

/// The text that sets the parameter at `path`.
fn place<'j>(job: &'j Job, path: &str) -> &'j SourceText {
    let sets = |name: &str| {
        path.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    let entries = job.plan.entries.iter();
    let found = entries
        .filter(|entry| entry.parameter_name().is_some_and(sets))
        .max_by_key(|entry| entry.parameter_name().map_or(0, str::len));
    found.map_or(&job.plan.program.model, |entry| &job.plan.program.variables[entry.variable].value)
}
