//! Tables over the wavelength in a tree of parameters, and the wavelengths at which they are asked.

use std::collections::BTreeMap;

use mist_format::number::general;
use scattering::{Parameter, ParameterKind};

use super::{
    ModelParameters,
    state::{ObjectState, ParameterState},
};
use crate::Warning;

/// A wavelength this far outside of a table, as a factor, is no extrapolation of it.
const FAR: f64 = 1.25;
/// Photon energy times wavelength, eV µm.
const EV_UM: f64 = 1.239_841_984;

/// The wavelengths that a file has, and those at which it is asked, µm.
#[derive(Clone, Copy, Debug, PartialEq)]
struct TableUse {
    table: [f64; 2],
    asked: [f64; 2],
}

/// The uses of all tables over the wavelength by the dotted names of their parameters and their
/// files.
#[derive(Clone, Debug, Default)]
pub(crate) struct TableUses(BTreeMap<(String, String), TableUse>);

/// A finding about a table: the dotted name of its parameter and the message.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TableFinding {
    /// The dotted name of the parameter that names the file.
    pub(crate) path: String,
    /// True if the values have nothing to do with the wavelengths that are asked.
    pub(crate) is_error: bool,
    pub(crate) warning: Warning,
}

impl TableUses {
    /// Adds the tables of `parameters` at their wavelength.
    pub(crate) fn see(&mut self, parameters: &ModelParameters) {
        self.see_object(&parameters.root, "", None);
    }

    fn see_object(&mut self, object: &ObjectState, prefix: &str, around: Option<f64>) {
        let lambda = object.wavelength().or(around);
        for (parameter, state) in object.parameters() {
            let path = format!("{prefix}{}", parameter.name);
            match state {
                ParameterState::Member(inner) => {
                    self.see_object(inner, &format!("{path}."), lambda);
                }
                ParameterState::Index(index) => self.add(&path, index.file_range(), lambda),
                ParameterState::Table(table) if is_over_wavelength(parameter) => {
                    self.add(&path, table.file_range(), lambda);
                }
                ParameterState::Films(films) => {
                    films.files().for_each(|(file, range)| {
                        self.add(&path, Some((file, range)), lambda);
                    });
                }
                _ => {}
            }
        }
    }

    fn add(&mut self, path: &str, file: Option<(&str, [f64; 2])>, lambda: Option<f64>) {
        let (Some((file, table)), Some(lambda)) = (file, lambda) else { return };
        let key = (path.to_owned(), file.to_owned());
        let found = self.0.entry(key).or_insert(TableUse { table, asked: [lambda; 2] });
        found.asked = [found.asked[0].min(lambda), found.asked[1].max(lambda)];
    }

    /// Everything that is wrong with the uses.
    pub(crate) fn findings(&self) -> Vec<TableFinding> {
        self.0.iter().filter_map(|((path, file), table)| table.finding(path, file)).collect()
    }
}

/// True if the description of a table says that it is a function of wavelength.
fn is_over_wavelength(parameter: &Parameter) -> bool {
    matches!(parameter.kind, ParameterKind::Table(_)) && parameter.doc.contains("wavelength")
}

impl TableUse {
    fn finding(&self, path: &str, file: &str) -> Option<TableFinding> {
        let Self { table: [low, high], asked: [first, last] } = *self;
        // A table of one row is a constant.
        if low == high || (first >= low * (1.0 - 1e-9) && last <= high * (1.0 + 1e-9)) {
            return None;
        }
        let path = path.to_owned();
        let (table, asked) = (range(low, high), range(first, last));
        let is_apart = last < low / FAR || first > high * FAR;
        if let Some(unit) = self.unit().filter(|_| is_apart) {
            let message = format!(
                "the wavelengths of {file} are read in um and go from {table}, and {asked} um is \
                 asked: the table looks like {}",
                unit.name
            );
            let warning = Warning::new("table/unit", message).help(unit.help);
            return Some(TableFinding { path, is_error: true, warning });
        }
        if is_apart {
            let message = format!(
                "no wavelength that is asked ({asked} um) lies in {file}, which goes from {table} um"
            );
            let help = "give a table of this range; wavelengths of tables are in um";
            let warning = Warning::new("table/range", message).help(help);
            return Some(TableFinding { path, is_error: true, warning });
        }
        let message = format!(
            "{file} goes from {table} um, and {asked} um is asked: outside of the table its end \
             value is held"
        );
        let warning = Warning::new("table/extrapolation", message)
            .help("extend the table, or ask for wavelengths inside of it");
        Some(TableFinding { path, is_error: false, warning })
    }

    /// The unit in which the wavelengths that are asked lie in the table, or near it.
    fn unit(&self) -> Option<&'static TableUnit> {
        let [first, last] = self.asked;
        UNITS.iter().find(|unit| {
            let [a, b] = self.table.map(unit.to_um);
            last >= a.min(b) / FAR && first <= a.max(b) * FAR
        })
    }
}

/// A unit in which tables of optical constants are published.
struct TableUnit {
    name: &'static str,
    help: &'static str,
    to_um: fn(f64) -> f64,
}

static UNITS: [TableUnit; 4] = [
    TableUnit {
        name: "nm",
        help: "divide the first column of the file by 1000",
        to_um: |x| x / 1000.0,
    },
    TableUnit {
        name: "angstrom",
        help: "divide the first column of the file by 10000",
        to_um: |x| x / 10_000.0,
    },
    TableUnit {
        name: "1/cm",
        help: "replace the first column x of the file by 10000/x",
        to_um: |x| 10_000.0 / x,
    },
    TableUnit {
        name: "eV",
        help: "replace the first column x of the file by 1.239842/x",
        to_um: |x| EV_UM / x,
    },
];

fn range(low: f64, high: f64) -> String {
    let [low, high] = [low, high].map(|x| general(x, 7));
    if low == high { low } else { format!("{low} to {high}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(table: [f64; 2], asked: [f64; 2]) -> Option<(bool, String)> {
        let found = TableUse { table, asked }.finding("substrate", "m.txt")?;
        Some((found.is_error, found.warning.to_string()))
    }

    #[test]
    fn tables_in_other_units_are_refused_with_their_unit() {
        for (table, unit) in [
            ([450.0, 650.0], "nm"),
            ([200.0, 2500.0], "nm"),
            ([4500.0, 6500.0], "angstrom"),
            ([12_000.0, 25_000.0], "1/cm"),
            ([0.64, 6.6], "eV"),
        ] {
            let (is_error, message) = told(table, [0.45, 0.5]).unwrap();
            assert!(is_error && message.contains(&format!("looks like {unit};")), "{message}");
        }
    }

    #[test]
    fn extrapolation_is_a_warning_and_no_overlap_an_error() {
        assert_eq!(told([0.4, 0.8], [0.4, 0.8]), None);
        assert_eq!(told([0.4, 0.8], [0.5, 0.5]), None);
        assert_eq!(told([0.4, 0.4], [0.5, 0.5]), None);
        let (is_error, message) = told([0.4, 0.8], [0.36, 0.83]).unwrap();
        assert!(!is_error && message.contains("0.4 to 0.8 um, and 0.36 to 0.83 um"), "{message}");
        let (is_error, message) = told([10.0, 20.0], [0.4, 0.7]).unwrap();
        assert!(is_error && message.contains("no wavelength"), "{message}");
        assert!(!told([0.41, 0.8], [0.4, 0.4]).unwrap().0, "a little outside");
    }
}
