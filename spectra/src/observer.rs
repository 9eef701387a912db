//! Observers: the CIE's colour-matching functions.
//!
//! | observer | field | use |
//! | --- | --- | --- |
//! | CIE 1931 | 2° | the definition of the RGB spaces; the default |
//! | CIE 1964 | 10° | surfaces that fill the view; colour difference in industry |
//! | CIE 2015 | 2°, 10° | from cone fundamentals, 390–830 nm; corrects the blue end of 1931 |
//!
//! No standard defines RGB spaces for observers other than the first. With them always adapt, and
//! record the observer.
//!
//! ISO/CIE 11664-1:2019; CIE 170-2:2015.

use std::sync::LazyLock;

use crate::{
    data::{self, CieTable},
    name::{NamedValue, UnknownName},
    wavelength::FINE_COUNT,
};

/// Three functions of wavelength on the 1 nm grid.
pub type FineXyz = [[f64; 3]; FINE_COUNT];

/// A standard observer of the CIE.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Observer {
    /// CIE 1931, 2° field.
    #[default]
    Cie1931_2,
    /// CIE 1964, 10° field.
    Cie1964_10,
    /// CIE 2015, cone-fundamental-based, 2° field.
    Cie2015_2,
    /// CIE 2015, cone-fundamental-based, 10° field.
    Cie2015_10,
}

impl Observer {
    /// All observers, in the order in which users see them.
    pub const ALL: [Self; 4] =
        [Self::Cie1931_2, Self::Cie1964_10, Self::Cie2015_2, Self::Cie2015_10];

    const NAMES: [NamedValue<Self>; 4] = [
        NamedValue("CIE1931_2", Self::Cie1931_2),
        NamedValue("CIE1964_10", Self::Cie1964_10),
        NamedValue("CIE2015_2", Self::Cie2015_2),
        NamedValue("CIE2015_10", Self::Cie2015_10),
    ];

    /// The observer called `CIE1931_2`, `CIE1964_10`, `CIE2015_2` or `CIE2015_10`.
    ///
    /// # Errors
    ///
    /// If it is none of these.
    pub fn parse(text: &str) -> Result<Self, UnknownName> {
        NamedValue::find("observer", text, &Self::NAMES)
    }

    /// The name that [`parse`](Self::parse) reads.
    pub fn name(self) -> &'static str {
        NamedValue::name_of(&Self::NAMES, self)
    }

    /// The functions x̄, ȳ, z̄ on the 1 nm grid; zero where the CIE gives none.
    pub fn functions(self) -> &'static FineXyz {
        static FUNCTIONS: LazyLock<[Box<FineXyz>; 4]> = LazyLock::new(|| {
            [
                fine(&data::OBSERVER_1931_2),
                fine(&data::OBSERVER_1964_10),
                fine(&data::OBSERVER_2015_2),
                fine(&data::OBSERVER_2015_10),
            ]
        });
        &FUNCTIONS[self as usize]
    }
}

fn fine(table: &CieTable) -> Box<FineXyz> {
    let [x, y, z] = [0, 1, 2].map(|column| table.fine(column));
    let mut functions = Box::new([[0.0; 3]; FINE_COUNT]);
    for (i, function) in functions.iter_mut().enumerate() {
        *function = [x[i], y[i], z[i]];
    }
    functions
}
