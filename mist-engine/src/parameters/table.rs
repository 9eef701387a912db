//! The state of a parameter that holds a function of one variable.

use std::{
    hash::{Hash, Hasher},
    sync::Arc,
};

use mist_format::number::{number_prefix, whole_number};
use scattering::optics::{AbscissaScale, RealFunction, TableInterpolation};

use super::{
    ParameterContext, SetError,
    source::{Interpolation, TableSource},
};

/// A table, its source, and how it is interpolated.
#[derive(Clone, Debug)]
pub(crate) struct TableState {
    text: Arc<str>,
    source: TableSource,
    column: usize,
    reading: Interpolation,
    table: RealFunction,
}

impl Hash for TableState {
    fn hash<H: Hasher>(&self, state: &mut H) {
        // The text names the source: files do not change during a run.
        self.text.hash(state);
        self.column.hash(state);
        (self.reading.axis as u8, self.reading.rise as u8).hash(state);
        for (name, value) in &self.reading.parameters {
            (name, value.to_bits()).hash(state);
        }
    }
}

impl TableState {
    /// The default that the registry declares: a number.
    pub(crate) fn constant(text: &str) -> Self {
        let value = whole_number(text).unwrap_or(f64::NAN);
        Self::of_values(text, vec![value], 2)
    }

    /// A constant with several columns.
    pub(crate) fn of_values(text: &str, values: Vec<f64>, column: usize) -> Self {
        let value = values.get(column - 2).copied().unwrap_or(0.0);
        Self {
            text: text.into(),
            source: TableSource::Constant(values),
            column,
            reading: Interpolation::default(),
            table: RealFunction::constant(value),
        }
    }

    pub(crate) fn new(
        text: &str,
        source: TableSource,
        column: usize,
        context: &ParameterContext<'_>,
    ) -> Result<Self, SetError> {
        let reading = Interpolation::default();
        let table = source.table(column, &reading, context.library)?;
        Ok(Self { text: text.into(), source, column, reading, table })
    }

    /// Replaces the source; the interpolation stays, as in NIST's library.
    pub(crate) fn replace(
        &mut self,
        text: &str,
        context: &ParameterContext<'_>,
    ) -> Result<(), SetError> {
        let (source, asked) = TableSource::of_table(text, context)?;
        let (axis, rise) = (self.reading.axis, self.reading.rise);
        let reading = Interpolation { axis, rise, parameters: Vec::new() };
        let column = asked.unwrap_or(2);
        let table = source.table(column, &reading, context.library)?;
        *self = Self { text: text.into(), source, column, reading, table };
        Ok(())
    }

    pub(crate) fn value(&self) -> RealFunction {
        self.table.clone()
    }

    /// Sets a sub-parameter: an interpolation, or a parameter of the formula file.
    pub(crate) fn set(
        &mut self,
        name: &str,
        text: &str,
        context: &ParameterContext<'_>,
    ) -> Result<(), SetError> {
        if name.eq_ignore_ascii_case("interpolationx") {
            self.reading.axis = axis(text)?;
        } else if name.eq_ignore_ascii_case("interpolationy") {
            self.reading.rise = rise(text)?;
        } else if self.source.parameters().contains(&name) {
            let value = number_prefix(text.as_bytes())
                .value
                .ok_or_else(|| SetError::value(format!("{text:?} is not a number")))?;
            self.reading.parameters.retain(|(known, _)| known != name);
            self.reading.parameters.push((name.to_owned(), value));
        } else {
            let own = self.source.parameters().join(", ");
            let own = if own.is_empty() { String::new() } else { format!(", {own}") };
            return Err(SetError::name(format!("the table {} has no parameter {name}", self.text))
                .help(format!("it has interpolationx, interpolationy{own}")));
        }
        self.table = self.source.table(self.column, &self.reading, context.library)?;
        Ok(())
    }
}

fn axis(text: &str) -> Result<AbscissaScale, SetError> {
    match text {
        "lin" => Ok(AbscissaScale::Linear),
        "log" => Ok(AbscissaScale::Log),
        _ => Err(SetError::value(format!("{text:?} is not an interpolation: write lin or log"))),
    }
}

fn rise(text: &str) -> Result<TableInterpolation, SetError> {
    match text {
        "lin" => Ok(TableInterpolation::Linear),
        "log" => Ok(TableInterpolation::Log),
        "spline" => Ok(TableInterpolation::Spline),
        "logspline" => Ok(TableInterpolation::LogSpline),
        _ => Err(SetError::value(format!(
            "{text:?} is not an interpolation: write lin, log, spline or logspline"
        ))),
    }
}
