//! Warnings of cases whose spectra are probably not what was meant.

use serde::Serialize;

use super::request::{CaseSpectra, ColourCase};
use crate::{
    Spectrum,
    compare::NEEDED_NM,
    spectrum::{VISIBLE_NM, WavelengthUnit},
};

/// A remark on a case whose colour is probably not what was meant.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CaseWarning {
    /// The `id` of the case.
    pub id: String,
    /// Stable code, such as `wavelength/unit`.
    pub code: &'static str,
    /// The problem, in lower case without full stop.
    pub message: String,
    /// The remedy.
    pub help: String,
}

/// Reflectances above this are rather percentages; measured white plates have up to 1.01.
const LARGEST_REFLECTANCE: f64 = 1.02;

impl ColourCase {
    /// Warnings about the spectra of the case called `id`.
    pub(super) fn warnings(&self, id: &str) -> Vec<CaseWarning> {
        let (spectrum, is_signed) = match &self.spectra {
            CaseSpectra::Values(values) => (values, false),
            CaseSpectra::Stokes(stokes) => (&stokes[0], true),
        };
        let found = [
            coverage(spectrum),
            (self.illuminant.is_some() && !self.is_scaled && !is_signed)
                .then(|| percent(spectrum))
                .flatten(),
            negative(spectrum),
        ];
        let warning =
            |(code, message, help)| CaseWarning { id: id.to_owned(), code, message, help };
        found.into_iter().flatten().map(warning).collect()
    }
}

type Finding = Option<(&'static str, String, String)>;

/// A spectrum of which an observer sees nothing or a part.
fn coverage(spectrum: &Spectrum) -> Finding {
    let nm = spectrum.grid().nm();
    let range = [nm[0], nm[nm.len() - 1]];
    let [first, last] = range;
    if last < VISIBLE_NM[0] || first > VISIBLE_NM[1] {
        let unit = WavelengthUnit::of_range(range).map(WavelengthUnit::name);
        let looks = unit.map_or_else(
            || "and no observer sees them".to_owned(),
            |unit| format!("and look like {unit}"),
        );
        let message = format!("wavelengths are read in nm, {looks}: {first} to {last}");
        return Some(("wavelength/unit", message, "give wavelengths in nm, 360 to 830".into()));
    }
    (first > NEEDED_NM[0] || last < NEEDED_NM[1]).then(|| {
        let message = format!(
            "the spectrum covers {first} to {last} nm only: the colour depends on its extrapolation"
        );
        ("spectrum/coverage", message, "give values from 380 to 780 nm".into())
    })
}

fn percent(spectrum: &Spectrum) -> Finding {
    let largest = spectrum.values().iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (largest > LARGEST_REFLECTANCE).then(|| {
        let message = format!("the largest reflectance is {largest}, which looks like percent");
        ("spectrum/percent", message, "write \"value_factor\": 0.01".into())
    })
}

fn negative(spectrum: &Spectrum) -> Finding {
    let least = spectrum.values().iter().copied().fold(f64::INFINITY, f64::min);
    (least < 0.0).then(|| {
        let message = format!("the least value is {least}: no reflectance or power is negative");
        ("spectrum/negative", message, "subtract the dark signal of the detector".into())
    })
}
