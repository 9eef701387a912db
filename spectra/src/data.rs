//! The tables of the CIE, read once from the texts in `data/cie`.
//!
//! The numbers stay in files of their own, under their own licence (CC BY-SA 4.0).

use std::sync::LazyLock;

use crate::{
    interpolate::{Extrapolation, Interpolation, Resampler},
    wavelength::{Fine, Grid},
};

/// A table of the CIE: wavelengths and one column per function.
#[derive(Debug)]
pub(crate) struct CieTable {
    grid: Grid,
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
}

impl CieTable {
    /// Reads a table: comment lines with `#`, a line of names, lines of numbers.
    ///
    /// # Panics
    ///
    /// If the text is not such a table. The texts are ours, and a test reads them all.
    fn read(text: &str) -> Self {
        let mut lines = text.lines().filter(|line| !line.starts_with('#'));
        let heading = lines.next().expect("a table has a line of names");
        let names: Vec<String> = heading.split(',').skip(1).map(str::to_owned).collect();
        let mut nm = Vec::new();
        let mut columns = vec![Vec::new(); names.len()];
        for line in lines {
            let mut numbers = line.split(',').map(|n| n.parse().expect("a table holds numbers"));
            nm.push(numbers.next().expect("a row begins with its wavelength"));
            for column in &mut columns {
                column.push(numbers.next().expect("a row has a number per name"));
            }
        }
        let grid = Grid::new(&nm).expect("the wavelengths of a table are a grid");
        Self { grid, names, columns }
    }

    /// The names of the columns, in order.
    pub(crate) fn names(&self) -> &[String] {
        &self.names
    }

    /// A column by position, as tabulated.
    pub(crate) fn column(&self, index: usize) -> &[f64] {
        &self.columns[index]
    }

    /// A column on the 1 nm grid: straight lines between entries, zero outside the table.
    pub(crate) fn fine(&self, index: usize) -> Box<Fine> {
        Resampler::new(&self.grid, Interpolation::Linear, Extrapolation::Zero)
            .expect("straight lines are possible on every grid")
            .fine(self.column(index))
    }
}

macro_rules! tables {
    ($($(#[$doc:meta])* $name:ident = $file:literal;)*) => {
        $(
            $(#[$doc])*
            pub(crate) static $name: LazyLock<CieTable> =
                LazyLock::new(|| CieTable::read(include_str!(concat!("../data/cie/", $file))));
        )*
    };
}

tables! {
    /// Colour-matching functions of CIE 1931, 2°.
    OBSERVER_1931_2 = "observer_1931_2deg.csv";
    /// Colour-matching functions of CIE 1964, 10°.
    OBSERVER_1964_10 = "observer_1964_10deg.csv";
    /// Cone-fundamental-based functions of CIE 2015, 2°.
    OBSERVER_2015_2 = "observer_2015_2deg.csv";
    /// Cone-fundamental-based functions of CIE 2015, 10°.
    OBSERVER_2015_10 = "observer_2015_10deg.csv";
    /// The components S0, S1, S2 of daylight.
    DAYLIGHT_COMPONENTS = "daylight_components.csv";
    ILLUMINANT_A = "illuminant_a.csv";
    ILLUMINANT_C = "illuminant_c.csv";
    ILLUMINANT_D50 = "illuminant_d50.csv";
    ILLUMINANT_D55 = "illuminant_d55.csv";
    ILLUMINANT_D65 = "illuminant_d65.csv";
    ILLUMINANT_D75 = "illuminant_d75.csv";
    ILLUMINANT_ID50 = "illuminant_id50.csv";
    ILLUMINANT_ID65 = "illuminant_id65.csv";
    /// Fluorescent lamps, from the 1 nm file: the lines of a 5 nm table are too wide.
    ILLUMINANT_FL = "illuminant_fl.csv";
    /// LED lamps, from the 1 nm file.
    ILLUMINANT_LED = "illuminant_led.csv";
    /// High-pressure discharge lamps.
    ILLUMINANT_HP = "illuminant_hp.csv";
}

/// The tables of illuminants, in the order in which users see their names.
pub(crate) static ILLUMINANTS: [&LazyLock<CieTable>; 11] = [
    &ILLUMINANT_A,
    &ILLUMINANT_C,
    &ILLUMINANT_D50,
    &ILLUMINANT_D55,
    &ILLUMINANT_D65,
    &ILLUMINANT_D75,
    &ILLUMINANT_ID50,
    &ILLUMINANT_ID65,
    &ILLUMINANT_FL,
    &ILLUMINANT_LED,
    &ILLUMINANT_HP,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_can_be_read() {
        let mut names = Vec::new();
        for table in ILLUMINANTS {
            names.extend_from_slice(table.names());
        }
        assert_eq!(names.len(), 49);
        let observers = [&OBSERVER_1931_2, &OBSERVER_1964_10, &OBSERVER_2015_2, &OBSERVER_2015_10];
        for table in observers {
            assert_eq!(table.names(), ["x", "y", "z"]);
            assert!(table.grid.is_one_nanometre());
        }
        assert_eq!(DAYLIGHT_COMPONENTS.names(), ["S0", "S1", "S2"]);
    }
}
