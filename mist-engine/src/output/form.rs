//! The form of a table: that of NIST's program, with tabs, or with commas.

use std::borrow::Cow;

use mist_format::number::PrintfFormat;
use scattering::Mode;

use super::units;
use crate::{Job, plan::Plan};

/// The form of a table: the separators between its columns and at the end of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TableForm {
    /// A tab behind every column, the last one too, as NIST's program writes it.
    Trailing,
    /// Tabs between the columns.
    Tab,
    /// Commas between the columns, and units in the titles: CSV.
    Comma,
}

impl TableForm {
    /// That of the results of `job`: commas if their file ends in `.csv`, unless under compat.
    pub(super) fn of(job: &Job) -> Self {
        let is_csv = || job.results_name().to_ascii_lowercase().ends_with(".csv");
        match job.options.mode {
            Mode::Compat => Self::Trailing,
            Mode::Sound if is_csv() => Self::Comma,
            Mode::Sound => Self::Tab,
        }
    }

    /// The separator.
    pub(super) fn character(self) -> char {
        if self == Self::Comma { ',' } else { '\t' }
    }

    /// The beginning of a header line.
    pub(super) fn comment(self) -> &'static str {
        if self == Self::Comma { "# " } else { "" }
    }

    /// The title of a column; in CSV with its unit if the program tells it, and in quotes if it
    /// needs them.
    pub(super) fn title<'t>(self, title: &'t str, plan: &Plan) -> Cow<'t, str> {
        if self != Self::Comma {
            return title.into();
        }
        let title = match units::unit(title, plan) {
            Some(unit) => Cow::from(format!("{title} ({unit})")),
            None => title.into(),
        };
        let needs_quotes = title.contains([',', '"', '\n']);
        if needs_quotes { format!("\"{}\"", title.replace('"', "\"\"")).into() } else { title }
    }

    /// Appends the number `x` and a separator; outside CSV the separator is that of `format`.
    pub(super) fn push(self, text: &mut String, format: &PrintfFormat, x: f64) {
        let start = text.len();
        format.push(text, x);
        if self == Self::Comma {
            let digits = text[start..].trim_matches([' ', '\t', ',', ';']).to_owned();
            text.truncate(start);
            text.push_str(&digits);
            text.push(',');
        }
    }

    /// Ends a line.
    pub(super) fn end_line(self, text: &mut String) {
        if self != Self::Trailing && text.ends_with(self.character()) {
            text.pop();
        }
        text.push('\n');
    }
}
