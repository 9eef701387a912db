//! The state of a parameter that holds a function of one variable.

use std::{
    fmt,
    hash::{Hash, Hasher},
    sync::Arc,
};

use mist_format::number::number_prefix;
use scattering::{
    optics::{AbscissaScale, RealFunction, TableInterpolation},
    spec::ParameterKind,
};

use super::{
    error::SetError,
    input::{ParameterContext, ParameterInput},
    source::{ColumnInterpolation, TableSource},
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
