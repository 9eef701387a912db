//! Tables over the wavelength in a tree of parameters, and the wavelengths at which they are asked.

use std::collections::BTreeMap;

use mist_format::number::general;
use scattering::{Parameter, ParameterKind};

use super::{
    ModelParameters,
    state::{ObjectState, ParameterState},
};
use crate::Warning;

/// A wavelength this far outside of a table, as a factor, is not an extrapolation of it.
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

/// A finding about a table: the dotted names of its parameters and the message.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TableFinding {
    /// The dotted names of the parameters that name the file, at least one.
    pub(crate) paths: Vec<String>,
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

    /// Everything that is wrong with the uses: an error for each parameter, a warning for each
    /// file, with all the wavelengths at which its parameters ask it outside of its range.
    pub(crate) fn findings(&self) -> Vec<TableFinding> {
        let mut errors = Vec::new();
        let mut extrapolated: BTreeMap<&str, (TableUse, Vec<String>)> = BTreeMap::new();
        for ((path, file), table) in &self.0 {
            match table.coverage() {
                Coverage::Whole => {}
                Coverage::Part => {
                    let (whole, paths) =
                        extrapolated.entry(file.as_str()).or_insert((*table, Vec::new()));
                    whole.join(table);
                    paths.push(path.clone());
                }
                Coverage::Nothing => errors.push(TableFinding {
                    paths: vec![path.clone()],
                    is_error: true,
                    warning: table.disjoint(file),
                }),
            }
        }
        errors.extend(extrapolated.into_iter().map(|(file, (whole, paths))| TableFinding {
            paths,
            is_error: false,
            warning: whole.extrapolation(file),
        }));
        errors
    }
}

/// True if the description of a table says that it is a function of wavelength.
fn is_over_wavelength(parameter: &Parameter) -> bool {
    matches!(parameter.kind, ParameterKind::Table(_)) && parameter.doc.contains("wavelength")
}

/// The part of the wavelengths that are asked which a table has.
enum Coverage {
    Whole,
    Part,
    Nothing,
}

impl TableUse {
    fn coverage(&self) -> Coverage {
        let Self { table: [low, high], asked: [first, last] } = *self;
        // A table of one row is a constant.
        if low == high || (first >= low * (1.0 - 1e-9) && last <= high * (1.0 + 1e-9)) {
            Coverage::Whole
        } else if last < low / FAR || first > high * FAR {
            Coverage::Nothing
        } else {
            Coverage::Part
        }
    }

    /// Adds the wavelengths of another use of the same file.
    fn join(&mut self, other: &Self) {
        let [first, last] = other.asked;
        self.asked = [self.asked[0].min(first), self.asked[1].max(last)];
    }

    /// The message about a table that has none of the wavelengths.
    fn disjoint(&self, file: &str) -> Warning {
        let [table, asked] = [self.table, self.asked].map(range);
        match self.unit() {
            Some(unit) => {
                let message = format!(
                    "the wavelengths of {file} are read in um and go from {table}, and {asked} um \
                     is asked: the table looks like {}",
                    unit.name
                );
                Warning::new("table/unit", message).help(unit.help)
            }
            None => {
                let message = format!(
                    "no wavelength that is asked ({asked} um) lies in {file}, which goes from \
                     {table} um"
                );
                let help = "give a table of this range; wavelengths of tables are in um";
                Warning::new("table/range", message).help(help)
            }
        }
    }

    /// The message about a table that lacks some of the wavelengths.
    fn extrapolation(&self, file: &str) -> Warning {
        let [table, asked] = [self.table, self.asked].map(range);
        let message = format!(
            "{file} goes from {table} um, and {asked} um is asked: outside of the table its end \
             value is held"
        );
        Warning::new("table/extrapolation", message)
            .help("extend the table, or ask for wavelengths inside of it")
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

fn range(ends: [f64; 2]) -> String {
    let [low, high] = ends.map(|x| general(x, 7));
    if low == high { low } else { format!("{low} to {high}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(table: [f64; 2], asked: [f64; 2]) -> Option<(bool, String)> {
        let mut uses = TableUses::default();
        asked.iter().for_each(|&x| uses.add("substrate", Some(("m.txt", table)), Some(x)));
        let found = uses.findings().pop()?;
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

    #[test]
    fn a_file_of_several_parameters_has_one_warning_with_the_total_range() {
        let mut uses = TableUses::default();
        for (path, lambda) in [("a", 0.36), ("b", 0.83), ("c", 0.5)] {
            uses.add(path, Some(("m.txt", [0.4, 0.8])), Some(lambda));
        }
        let [found] = &uses.findings()[..] else { panic!() };
        assert_eq!(found.paths, ["a", "b"]);
        let message = &found.warning.message;
        assert!(message.contains("0.4 to 0.8 um, and 0.36 to 0.83 um"), "{message}");
    }
}
