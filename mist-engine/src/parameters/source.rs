//! Sources of the values of a table: constants, formulas, columns of files.

use std::{
    hash::{Hash, Hasher},
    sync::Arc,
};

use mist_format::{
    expr::Expr,
    optics::{IndexText, TableText},
    table::{ColumnTable, FormulaFile},
};
use scattering::optics::{AbscissaScale, RealFunction, TableInterpolation};

use super::{error::SetError, formula::columns, input::ParameterContext};
use crate::DataFiles;

/// A function of one variable with several columns; column 2 is the first of them.
#[derive(Clone, Debug)]
pub(crate) enum TableSource {
    /// The same values everywhere; behind the last one follow zeros.
    Constant(Vec<f64>),
    /// Expressions of a variable.
    Formula { variable: String, columns: Expr },
    /// Columns of a file.
    Rows { file: String, table: Arc<ColumnTable> },
    /// Expressions, or a loop that makes rows, with parameters of their own.
    Parametric { file: String, formula: Arc<FormulaFile> },
}

/// Settings for reading a source.
#[derive(Clone, Debug, Default)]
pub(crate) struct ColumnInterpolation {
    pub(crate) axis: AbscissaScale,
    pub(crate) rise: TableInterpolation,
    /// Parameters of a formula file that differ from the file's own values.
    pub(crate) parameters: Vec<(String, f64)>,
}

impl ColumnInterpolation {
    /// The parameters with the bits of their values.
    fn bits(&self) -> impl Iterator<Item = (&str, u64)> {
        self.parameters.iter().map(|(name, value)| (name.as_str(), value.to_bits()))
    }
}

impl Hash for ColumnInterpolation {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.axis as u8, self.rise as u8).hash(state);
        self.bits().for_each(|parameter| parameter.hash(state));
    }
}

impl PartialEq for ColumnInterpolation {
    fn eq(&self, other: &Self) -> bool {
        self.axis == other.axis && self.rise == other.rise && self.bits().eq(other.bits())
    }
}

impl Eq for ColumnInterpolation {}

impl TableSource {
    /// The source that a table's text names, and the column it asks for.
    pub(crate) fn of_table(
        text: &str,
        context: &ParameterContext<'_>,
    ) -> Result<(Self, Option<usize>), SetError> {
        let read = TableText::parse(text, context.library.dialect());
        match read.map_err(|error| SetError::value(error.to_string()).help(error.help()))? {
            TableText::Constant(value) => Ok((Self::Constant(value.as_slice().to_vec()), None)),
            TableText::Formula { variable, columns } => {
                Ok((Self::Formula { variable, columns }, None))
            }
            TableText::File { name, column } => Ok((Self::file(&name, context.library)?, column)),
        }
    }

    /// The source that an optical constant's text names, and the column of n.
    pub(crate) fn of_index(
        text: &str,
        context: &ParameterContext<'_>,
    ) -> Result<(Self, usize), SetError> {
        let read = IndexText::parse(text, context.library.dialect())
            .map_err(|error| SetError::value(error.to_string()).help(error.help()))?;
        Self::of_index_text(read, context.library)
    }

    pub(crate) fn of_index_text(
        read: IndexText,
        library: &DataFiles,
    ) -> Result<(Self, usize), SetError> {
        Ok(match read {
            IndexText::Constant { n, k } => (Self::Constant(vec![n, k]), 2),
            IndexText::Formula { variable, columns } => (Self::Formula { variable, columns }, 2),
            IndexText::File { name, column } => (Self::file(&name, library)?, column),
        })
    }

    fn file(name: &str, library: &DataFiles) -> Result<Self, SetError> {
        let text = library.text(name).map_err(|error| SetError::value(error.to_string()))?;
        let wrong =
            |error: mist_format::table::TableError| SetError::value(format!("{name}: {error}"));
        if FormulaFile::is_formula(&text) {
            let formula = FormulaFile::parse(&text).map_err(wrong)?;
            return Ok(Self::Parametric { file: name.into(), formula: Arc::new(formula) });
        }
        let table = library.columns(name).map_err(wrong)?;
        Ok(Self::Rows { file: name.into(), table })
    }

    /// Column `column` (2 is the first behind the abscissa) as a function.
    pub(crate) fn table(
        &self,
        column: usize,
        reading: &ColumnInterpolation,
        library: &DataFiles,
    ) -> Result<RealFunction, SetError> {
        let element = column.checked_sub(2).ok_or_else(|| {
            SetError::value("column 1 holds the abscissa; values stand in column 2 and beyond")
        })?;
        match self {
            Self::Constant(values) => {
                Ok(RealFunction::constant(values.get(element).copied().unwrap_or(0.0)))
            }
            Self::Formula { variable, columns: expr } => {
                Ok(RealFunction::Formula(columns(expr, variable, element, library)?))
            }
            Self::Rows { file, table } => points(file, table, element, reading),
            Self::Parametric { file, formula } => {
                let parameters = reading.parameters.clone();
                let value = move |name: &str| {
                    parameters.iter().rev().find(|(known, _)| known == name).map(|(_, v)| *v)
                };
                let wrong = |error: mist_format::table::TableError| {
                    SetError::value(format!("{file}: {error}"))
                };
                if let Some(table) = formula.table(&value).map_err(wrong)? {
                    return points(file, &table, element, reading);
                }
                formula.columns_at(0.5, &value).map_err(wrong)?;
                let formula = formula.clone();
                Ok(RealFunction::Formula(Arc::new(move |x| {
                    let columns = formula.columns_at(x, &value).ok().flatten();
                    columns
                        .map_or(f64::NAN, |all| all.as_slice().get(element).copied().unwrap_or(0.0))
                })))
            }
        }
    }

    /// The file of rows, and its least and largest abscissa.
    pub(crate) fn file_range(&self) -> Option<(&str, [f64; 2])> {
        let Self::Rows { file, table } = self else { return None };
        let abscissae = || table.rows().map(|row| row[0]);
        let low = abscissae().fold(f64::INFINITY, f64::min);
        let high = abscissae().fold(f64::NEG_INFINITY, f64::max);
        Some((file, [low, high]))
    }

    /// Names of the parameters of a formula file.
    pub(crate) fn parameters(&self) -> Vec<&str> {
        match self {
            Self::Parametric { formula, .. } => {
                formula.parameters.iter().map(|(name, _)| name.as_str()).collect()
            }
            _ => Vec::new(),
        }
    }
}

fn points(
    file: &str,
    table: &ColumnTable,
    element: usize,
    reading: &ColumnInterpolation,
) -> Result<RealFunction, SetError> {
    let column = element + 1;
    if column >= table.columns() {
        let mut problem = format!("{file} has {} columns, not {}", table.columns(), column + 1);
        if (table.columns(), column) == (2, 2) {
            problem += ": add a column with k, which is 0 for a material that does not absorb";
        }
        return Err(SetError::value(problem));
    }
    let rows: Vec<(f64, f64)> = table.rows().map(|row| (row[0], row[column])).collect();
    Ok(RealFunction::points(&rows, reading.axis, reading.rise))
}
