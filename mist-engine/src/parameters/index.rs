//! The state of a parameter that holds an index of refraction.

use std::{
    hash::{Hash, Hasher},
    sync::Arc,
};

use mist_format::{Dialect, optics::IndexText};
use scattering::{
    optics::{RealFunction, RefractiveIndex},
    spec::ParameterKind,
};

use super::{
    error::SetError,
    input::{ParameterContext, ParameterInput},
    source::TableSource,
    table::TableState,
};
use crate::deviation::EngineDeviation;

/// An index of refraction: one table for n, one for k.
#[derive(Clone, Debug)]
pub(crate) struct IndexState {
    n: TableState,
    k: TableState,
    /// Value that NIST's library remembers for its last wavelength.
    held: Option<Held>,
    /// True if NIST's library reads another index or file in the text.
    misread: bool,
}

/// A value that outlives a change of interpolation, as long as the wavelength stays.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Held {
    lambda: f64,
    n: f64,
    k: f64,
}

impl Held {
    fn bits(self) -> [u64; 3] {
        [self.lambda, self.n, self.k].map(f64::to_bits)
    }
}

impl Hash for IndexState {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.n.hash(state);
        self.k.hash(state);
        self.held.map(Held::bits).hash(state);
    }
}

impl PartialEq for IndexState {
    fn eq(&self, other: &Self) -> bool {
        self.n == other.n
            && self.k == other.k
            && self.held.map(Held::bits) == other.held.map(Held::bits)
            && self.misread == other.misread
    }
}

impl Eq for IndexState {}

impl IndexState {
    /// The default that the registry declares: a number or `(n,k)`.
    pub(crate) fn constant(n: f64, k: f64) -> Self {
        let text = ParameterKind::Index { n, k }.default_text();
        Self {
            n: TableState::of_values(&text, vec![n, k], 2),
            k: TableState::of_values(&text, vec![n, k], 3),
            held: None,
            misread: false,
        }
    }

    /// The same n + ik at every wavelength.
    pub(crate) fn of_numbers(n: f64, k: f64) -> Self {
        Self {
            n: TableState::of_numbers(&[n, k], 2),
            k: TableState::of_numbers(&[n, k], 3),
            held: None,
            misread: false,
        }
    }

    /// Reads the text of optical constants.
    pub(crate) fn read(text: &str, context: &ParameterContext<'_>) -> Result<Self, SetError> {
        let (source, column) = TableSource::of_index(text, context)?;
        let misread = is_misread(text);
        Ok(Self { misread, ..Self::of_source(text, source, column, context)? })
    }

    pub(crate) fn of_source(
        text: &str,
        source: TableSource,
        column: usize,
        context: &ParameterContext<'_>,
    ) -> Result<Self, SetError> {
        let n = TableState::new(text, source.clone(), column, context)?;
        let k = TableState::new(text, source, column + 1, context)?;
        Ok(Self { n, k, held: None, misread: false })
    }

    /// Sets a sub-parameter: `n`, `k`, or one that both tables have.
    pub(crate) fn set(
        &mut self,
        path: &str,
        input: ParameterInput<'_>,
        context: &ParameterContext<'_>,
    ) -> Result<(), SetError> {
        let (name, rest) = path.split_once('.').map_or((path, None), |(n, r)| (n, Some(r)));
        let part = match name {
            "n" => Some(&mut self.n),
            "k" => Some(&mut self.k),
            _ => None,
        };
        match (part, rest) {
            (Some(part), None) => {
                part.replace(input, context)?;
                self.held = None;
                Ok(())
            }
            (Some(part), Some(rest)) => part.set(rest, input, context),
            (None, _) => {
                self.hold(context);
                self.n.set(path, input, context)?;
                self.k.set(path, input, context)
            }
        }
    }

    /// Keeps the value of the last evaluation, as NIST's library does.
    fn hold(&mut self, context: &ParameterContext<'_>) {
        let Some(lambda) = context.evaluated_at else { return };
        if EngineDeviation::StaleInterpolation.applies_in(context.mode) {
            let value = self.value().at(lambda);
            self.held = Some(Held { lambda, n: value.re, k: value.im });
        }
    }

    /// The text of its source, and the sub-parameters with their texts that make the rest.
    pub(crate) fn texts(&self, default: String) -> (String, Vec<(String, String)>) {
        let (text, replaced): (String, &[&str]) = if self.n.shares_origin(&self.k) {
            (self.n.text(), &[])
        } else if self.k.is_formula() && self.k.column() != 2 {
            (self.k.text(), &["n"])
        } else {
            (default, &["n", "k"])
        };
        let mut settings = Vec::new();
        for (name, part) in [("n", &self.n), ("k", &self.k)] {
            if replaced.contains(&name) {
                settings.push((name.to_owned(), part.column_text()));
            }
            let own = part.settings().into_iter();
            settings.extend(own.map(|(setting, text)| (format!("{name}.{setting}"), text)));
        }
        (text, settings)
    }

    pub(crate) fn remembers(&self) -> bool {
        self.held.is_some()
    }

    /// True if a value is kept for another wavelength than `lambda`.
    pub(crate) fn holds_other_than(&self, lambda: Option<f64>) -> bool {
        self.held.is_some_and(|held| Some(held.lambda) != lambda)
    }

    /// Forgets the value that was kept.
    pub(crate) fn forget(&mut self) {
        self.held = None;
    }

    /// The file of n, and its least and largest wavelength.
    pub(crate) fn file_range(&self) -> Option<(&str, [f64; 2])> {
        self.n.file_range()
    }

    /// True if NIST's library reads another index or file in the text.
    pub(crate) fn is_misread(&self) -> bool {
        self.misread
    }

    pub(crate) fn value(&self) -> RefractiveIndex {
        let (n, k) = (self.n.value(), self.k.value());
        match self.held {
            None => RefractiveIndex { n, k },
            Some(held) => RefractiveIndex {
                n: still(n, held.lambda, held.n),
                k: still(k, held.lambda, held.k),
            },
        }
    }
}

/// True if NIST's library reads another number or file name than is written.
fn is_misread(text: &str) -> bool {
    let read = |dialect| IndexText::parse(text, dialect).ok();
    match (read(Dialect::Sound), read(Dialect::Compat)) {
        (Some(IndexText::Formula { .. }), Some(IndexText::Formula { .. })) => false,
        (sound, nists) => sound != nists,
    }
}

/// `table`, but `value` at the abscissa `at`.
fn still(table: RealFunction, at: f64, value: f64) -> RealFunction {
    RealFunction::Formula(Arc::new(move |x| if x == at { value } else { table.at(x) }))
}
