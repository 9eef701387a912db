//! The state of a parameter that holds a function of one variable.

use std::{
    fmt,
    hash::{Hash, Hasher},
    sync::Arc,
};

use mist_format::number::number_prefix;
use scattering::{
    optics::{AbscissaScale, RealFunction, TableInterpolation},
    spec::{ParameterKind, number_text},
};

use super::{
    error::SetError,
    input::{ParameterContext, ParameterInput},
    source::{ColumnInterpolation, TableSource},
    text::vector,
};

/// Inputs from which a table was made.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum TableOrigin {
    /// A text; it names the source, for files do not change during a run.
    Text(Arc<str>),
    /// The bits of numbers.
    Numbers(Vec<u64>),
}

/// A table, its source, and how it is interpolated.
#[derive(Clone, Debug)]
pub(crate) struct TableState {
    origin: TableOrigin,
    source: TableSource,
    column: usize,
    reading: ColumnInterpolation,
    table: RealFunction,
}

impl Hash for TableState {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.origin.hash(state);
        self.column.hash(state);
        self.reading.hash(state);
    }
}

impl PartialEq for TableState {
    fn eq(&self, other: &Self) -> bool {
        self.origin == other.origin && self.column == other.column && self.reading == other.reading
    }
}

impl Eq for TableState {}

impl TableState {
    /// The default that the registry declares: a number.
    pub(crate) fn constant(value: f64) -> Self {
        Self::of_values(&ParameterKind::Table(value).default_text(), vec![value], 2)
    }

    /// A constant with several columns.
    pub(crate) fn of_values(text: &str, values: Vec<f64>, column: usize) -> Self {
        Self { origin: TableOrigin::Text(text.into()), ..Self::of_numbers(&values, column) }
    }

    /// A constant with several columns, from numbers; a missing column is zero.
    pub(crate) fn of_numbers(values: &[f64], column: usize) -> Self {
        let value = values.get(column - 2).copied().unwrap_or(0.0);
        Self {
            origin: TableOrigin::Numbers(values.iter().map(|x| x.to_bits()).collect()),
            source: TableSource::Constant(values.to_vec()),
            column,
            reading: ColumnInterpolation::default(),
            table: RealFunction::constant(value),
        }
    }

    pub(crate) fn new(
        text: &str,
        source: TableSource,
        column: usize,
        context: &ParameterContext<'_>,
    ) -> Result<Self, SetError> {
        let reading = ColumnInterpolation::default();
        let table = source.table(column, &reading, context.library)?;
        Ok(Self { origin: TableOrigin::Text(text.into()), source, column, reading, table })
    }

    /// Replaces the source; the interpolation stays, as in NIST's library.
    pub(crate) fn replace(
        &mut self,
        input: ParameterInput<'_>,
        context: &ParameterContext<'_>,
    ) -> Result<(), SetError> {
        let (axis, rise) = (self.reading.axis, self.reading.rise);
        let reading = ColumnInterpolation { axis, rise, parameters: Vec::new() };
        let text = match input {
            ParameterInput::Numbers(values) if context.keeps_bits(values) => {
                *self = Self { reading, ..Self::of_numbers(values, 2) };
                return Ok(());
            }
            input => input.to_text(),
        };
        let (source, asked) = TableSource::of_table(&text, context)?;
        let column = asked.unwrap_or(2);
        let table = source.table(column, &reading, context.library)?;
        *self = Self { origin: TableOrigin::Text((*text).into()), source, column, reading, table };
        Ok(())
    }

    /// The file that it is read from, and its least and largest abscissa.
    pub(crate) fn file_range(&self) -> Option<(&str, [f64; 2])> {
        self.source.file_range()
    }

    /// The text of its source, from which [`TableState::replace`] or a new table reads it.
    pub(crate) fn text(&self) -> String {
        match (&self.source, &self.origin) {
            (TableSource::Constant(values), _) => vector(values),
            (_, origin) => origin.to_string(),
        }
    }

    /// The text of the column that it takes from its source.
    pub(crate) fn column_text(&self) -> String {
        match &self.source {
            TableSource::Constant(values) => {
                number_text(values.get(self.column - 2).copied().unwrap_or(0.0))
            }
            TableSource::Rows { file, .. } | TableSource::Parametric { file, .. } => {
                format!("{file}!{}", self.column)
            }
            TableSource::Formula { .. } => self.text(),
        }
    }

    /// The column of its source, from 2.
    pub(crate) fn column(&self) -> usize {
        self.column
    }

    /// True if its source are expressions.
    pub(crate) fn is_formula(&self) -> bool {
        matches!(self.source, TableSource::Formula { .. })
    }

    /// True if both are columns of the same source.
    pub(crate) fn shares_origin(&self, other: &Self) -> bool {
        self.origin == other.origin && self.column + 1 == other.column
    }

    /// The sub-parameters that are not defaults, with their texts.
    pub(crate) fn settings(&self) -> Vec<(String, String)> {
        let ColumnInterpolation { axis, rise, parameters } = &self.reading;
        let mut settings = Vec::new();
        let mut push = |name: &str, text: &str| settings.push((name.to_owned(), text.to_owned()));
        if *axis != AbscissaScale::default() {
            push("interpolationx", axis_name(*axis));
        }
        if *rise != TableInterpolation::default() {
            push("interpolationy", rise_name(*rise));
        }
        for (name, value) in parameters {
            push(name, &number_text(*value));
        }
        settings
    }

    pub(crate) fn value(&self) -> RealFunction {
        self.table.clone()
    }

    /// Sets a sub-parameter: an interpolation, or a parameter of the formula file.
    pub(crate) fn set(
        &mut self,
        name: &str,
        input: ParameterInput<'_>,
        context: &ParameterContext<'_>,
    ) -> Result<(), SetError> {
        let text = &*input.to_text();
        if name.eq_ignore_ascii_case("interpolationx") {
            self.reading.axis = axis(text)?;
        } else if name.eq_ignore_ascii_case("interpolationy") {
            self.reading.rise = rise(text)?;
        } else if self.source.parameters().contains(&name) {
            let value = match input {
                ParameterInput::Numbers([x]) if context.keeps_bits(&[*x]) => Some(*x),
                _ => number_prefix(text.as_bytes()).value,
            };
            let value =
                value.ok_or_else(|| SetError::value(format!("{text:?} is not a number")))?;
            self.reading.parameters.retain(|(known, _)| known != name);
            self.reading.parameters.push((name.to_owned(), value));
        } else {
            let own = self.source.parameters().join(", ");
            let own = if own.is_empty() { String::new() } else { format!(", {own}") };
            let problem = format!("the table {} has no parameter {name}", self.origin);
            return Err(
                SetError::name(problem).help(format!("it has interpolationx, interpolationy{own}"))
            );
        }
        self.table = self.source.table(self.column, &self.reading, context.library)?;
        Ok(())
    }
}

impl fmt::Display for TableOrigin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(text) => f.write_str(text),
            Self::Numbers(bits) => {
                let values: Vec<f64> = bits.iter().copied().map(f64::from_bits).collect();
                f.write_str(&ParameterInput::Numbers(&values).to_text())
            }
        }
    }
}

fn axis(text: &str) -> Result<AbscissaScale, SetError> {
    match text {
        "lin" => Ok(AbscissaScale::Linear),
        "log" => Ok(AbscissaScale::Log),
        _ => Err(SetError::value(format!("{text:?} is not an interpolation: write lin or log"))),
    }
}

fn axis_name(axis: AbscissaScale) -> &'static str {
    match axis {
        AbscissaScale::Linear => "lin",
        AbscissaScale::Log => "log",
    }
}

fn rise_name(rise: TableInterpolation) -> &'static str {
    match rise {
        TableInterpolation::Linear => "lin",
        TableInterpolation::Log => "log",
        TableInterpolation::Spline => "spline",
        TableInterpolation::LogSpline => "logspline",
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
