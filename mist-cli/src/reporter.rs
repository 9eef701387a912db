//! The one place through which commands tell warnings and diagnostics.

use std::{collections::BTreeSet, sync::Mutex};

use mist_engine::Warning;
use mist_format::{Diagnostic, LineIndex};

use super::{
    error::{CommandError, ExitStatus},
    input::InputText,
    output::print,
    report::{self, MessageFormat},
};

/// Prints warnings, each cause once, and counts them.
#[derive(Debug, Default)]
pub(super) struct Reporter {
    /// True if a warning is a reason to fail.
    denies: bool,
    /// True if only errors, warnings and what was asked for are printed.
    is_quiet: bool,
    printed: Mutex<Printed>,
}

/// The warnings that were printed.
#[derive(Debug, Default)]
struct Printed {
    /// The lines, or other texts that tell one cause from another.
    causes: BTreeSet<String>,
    warnings: Vec<Warning>,
}

impl Reporter {
    /// A reporter; with `denies` commands that have warned fail, with `is_quiet` they print no notes
    /// and no messages about files that were written.
    pub(super) fn new(denies: bool, is_quiet: bool) -> Self {
        Self { denies, is_quiet, printed: Mutex::default() }
    }

    /// Prints a message about work that is done, unless quiet.
    pub(super) fn say(&self, text: &str) -> Result<(), CommandError> {
        if self.is_quiet { Ok(()) } else { print(text) }
    }

    /// Prints a note on standard error, unless quiet.
    pub(super) fn note(&self, line: &str) {
        if !self.is_quiet {
            report::print_line(line);
        }
    }

    /// Prints warnings about the file or request called `subject`, one line each.
    pub(super) fn warn(&self, subject: &str, warnings: &[Warning]) {
        for warning in warnings {
            let line = one_line(subject, warning);
            if self.is_new(line.clone(), warning) {
                report::print_line(&line);
            }
        }
    }

    /// Prints the warnings of a program, one line or one JSON object each.
    pub(super) fn warn_of_program(
        &self,
        warnings: &[Diagnostic],
        source: &InputText,
        format: MessageFormat,
    ) {
        let lines = LineIndex::new(&source.text);
        for found in warnings {
            let at = lines.location(&source.text, found.span.start);
            let place = format!("{}:{}:{}", source.name(), at.line, at.column);
            let line = one_line(&place, &found.into());
            if self.is_new(line.clone(), &found.into()) {
                match format {
                    MessageFormat::Human => report::print_line(&line),
                    MessageFormat::Json => {
                        report::print_diagnostics([found], &source.name(), &source.text, format);
                    }
                }
            }
        }
    }

    /// Prints errors and warnings of a program with excerpts.
    pub(super) fn diagnostics(
        &self,
        found: &[Diagnostic],
        source: &InputText,
        format: MessageFormat,
    ) {
        for warning in found.iter().filter(|each| !each.is_error()) {
            self.is_new(
                format!("{}: {:?} {warning}", source.name(), warning.span),
                &warning.into(),
            );
        }
        report::print_diagnostics(found, &source.name(), &source.text, format);
    }

    /// The warnings that were printed.
    pub(super) fn warnings(&self) -> Vec<Warning> {
        self.printed().warnings.clone()
    }

    /// Fails if warnings were printed and are denied.
    pub(super) fn check(&self) -> Result<(), CommandError> {
        match self.printed().warnings.len() {
            warnings if warnings > 0 && self.denies => {
                let message = match warnings {
                    1 => "1 warning, and --deny-warnings is given".to_owned(),
                    many => format!("{many} warnings, and --deny-warnings is given"),
                };
                Err(CommandError::Refused(message))
            }
            _ => Ok(()),
        }
    }

    /// The status of work on one of several inputs: refused if its warnings are denied.
    pub(super) fn status(&self) -> ExitStatus {
        if self.check().is_err() { ExitStatus::Refused } else { ExitStatus::Success }
    }

    /// True if this cause was not printed before; keeps its warning.
    fn is_new(&self, cause: String, warning: &Warning) -> bool {
        let mut printed = self.printed();
        let is_new = printed.causes.insert(cause);
        if is_new {
            printed.warnings.push(warning.clone());
        }
        is_new
    }

    fn printed(&self) -> std::sync::MutexGuard<'_, Printed> {
        self.printed.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}

/// A warning at `place` on one line.
fn one_line(place: &str, Warning { code, message, help }: &Warning) -> String {
    let help = help.as_deref().map_or_else(String::new, |help| format!("; {help}"));
    format!("warning[{code}]: {place}: {message}{help}").replace('\n', " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cause_is_printed_once_and_denied_if_asked() {
        let warning = Warning::new("angle/degrees", "theta_i = 45 looks like degrees").help("x");
        let line = one_line("request", &warning);
        assert_eq!(line, "warning[angle/degrees]: request: theta_i = 45 looks like degrees; x");
        for (denies, refused) in [(false, false), (true, true)] {
            let reporter = Reporter::new(denies, false);
            assert!(reporter.check().is_ok());
            reporter.warn("request", &[warning.clone(), warning.clone()]);
            assert_eq!(reporter.warnings().len(), 1);
            assert_eq!(reporter.check().is_err(), refused);
        }
    }
}
