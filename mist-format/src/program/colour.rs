//! The section COLOR: the colour table of a program's spectra.

use super::text::SourceText;
use crate::span::Span;

/// The names that COLOR knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColourKey {
    /// Expression for the wavelength in µm.
    Wavelength,
    /// One output label, or four `a,b,c,d` for the Stokes components I, Q, U, V.
    Spectrum,
    /// `brdf`, `factor`, `reflectance` or `radiance`.
    Quantity,
    /// CIE name, a number (Planck, K), `D(number)` (daylight, K) or a file.
    Illuminant,
    /// Colour-matching functions.
    Observer,
    /// RGB space: a name, primaries with a white, or a matrix.
    Space,
    /// `none`, `Bradford`, `CAT02`, `CAT16` or `VonKries`.
    Adaptation,
    /// A polarization element before the eye; repeatable, in order.
    Filter,
    /// Expression for the polar angle of incidence in degrees.
    Thetai,
    /// Expression for the polar angle of scattering in degrees.
    Thetas,
    /// Expression for the azimuth of scattering in degrees.
    Phis,
    /// Expression for the projected solid angle in sr.
    Omega,
    /// SourceText for the header line `patch`.
    Patch,
    /// SourceText for the header line `material`.
    Material,
    /// Name of the colour table to write.
    Table,
    /// Name of the spectra to write.
    Spectra,
    /// Name of the JSON twin to write.
    Json,
    /// Name of the SVG plot to write.
    Plot,
}

impl ColourKey {
    /// Every key, in the order of the manual.
    pub const ALL: &'static [Self] = &[
        Self::Wavelength,
        Self::Spectrum,
        Self::Quantity,
        Self::Illuminant,
        Self::Observer,
        Self::Space,
        Self::Adaptation,
        Self::Filter,
        Self::Thetai,
        Self::Thetas,
        Self::Phis,
        Self::Omega,
        Self::Patch,
        Self::Material,
        Self::Table,
        Self::Spectra,
        Self::Json,
        Self::Plot,
    ];

    /// The word in a program.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wavelength => "wavelength",
            Self::Spectrum => "spectrum",
            Self::Quantity => "quantity",
            Self::Illuminant => "illuminant",
            Self::Observer => "observer",
            Self::Space => "space",
            Self::Adaptation => "adaptation",
            Self::Filter => "filter",
            Self::Thetai => "thetai",
            Self::Thetas => "thetas",
            Self::Phis => "phis",
            Self::Omega => "omega",
            Self::Patch => "patch",
            Self::Material => "material",
            Self::Table => "table",
            Self::Spectra => "spectra",
            Self::Json => "json",
            Self::Plot => "plot",
        }
    }

    /// Finds a key by its word in any case.
    pub fn find(word: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|key| key.name().eq_ignore_ascii_case(word))
    }

    /// True if its value may be several words without quotes, as in `patch = circle 2`; names with
    /// blanks need quotes.
    pub(super) fn takes_words(self) -> bool {
        match self {
            Self::Wavelength
            | Self::Spectrum
            | Self::Space
            | Self::Filter
            | Self::Thetai
            | Self::Thetas
            | Self::Phis
            | Self::Omega
            | Self::Patch
            | Self::Material => true,
            Self::Quantity
            | Self::Illuminant
            | Self::Observer
            | Self::Adaptation
            | Self::Table
            | Self::Spectra
            | Self::Json
            | Self::Plot => false,
        }
    }
}

/// One assignment in COLOR.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourEntry {
    /// The key, given by the name.
    pub key: ColourKey,
    /// The name as written.
    pub name: SourceText,
    /// The value.
    pub value: SourceText,
}

/// The section COLOR.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ColourStatements {
    /// Every assignment in the order written.
    pub entries: Vec<ColourEntry>,
    /// From `COLOR:` to END.
    pub span: Span,
}

impl ColourStatements {
    /// The last value given for `key`, unless it is empty.
    pub fn last(&self, key: ColourKey) -> Option<&SourceText> {
        let found = self.entries.iter().rev().find(|entry| entry.key == key);
        found.map(|entry| &entry.value).filter(|value| !value.as_str().is_empty())
    }

    /// The filters, first met by the light first.
    pub fn filters(&self) -> impl Iterator<Item = &SourceText> {
        self.entries.iter().filter(|entry| entry.key == ColourKey::Filter).map(|entry| &entry.value)
    }

    /// The labels of `spectrum`: one, or four for I, Q, U, V; each with its place.
    pub fn spectrum(&self) -> Vec<SourceText> {
        let Some(list) = self.last(ColourKey::Spectrum) else { return Vec::new() };
        let mut at = 0;
        let mut labels = Vec::new();
        for word in list.as_str().split(',') {
            let trimmed = word.trim();
            let start = at + (word.len() - word.trim_start().len());
            labels.push(list.part(start..start + trimmed.len()));
            at += word.len() + 1;
        }
        labels
    }
}

impl ColourStatements {
    pub(super) fn without_locations(self) -> Self {
        let plain = |entry: ColourEntry| ColourEntry {
            key: entry.key,
            name: entry.name.without_location(),
            value: entry.value.without_location(),
        };
        Self { entries: self.entries.into_iter().map(plain).collect(), span: Span::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Dialect, program};

    const SIX: &str = "MODEL = M VARIABLES: minsamples=1 differential=1 incidentangle=0 rotation=0 \
                       incidentpol=(1,0,0,0) END VARY: END INTEGRALS: END OUTPUTS: END FILES: END";

    #[test]
    fn color_is_read_behind_files_and_its_labels_have_places() {
        let text =
            format!("{SIX}\ncolor:\n spectrum = \"f0, f1,f2 ,f3\" filter = linear(0)\nEND x");
        for dialect in [Dialect::Sound, Dialect::Compat] {
            let program = program::parse(&text, dialect).unwrap();
            let colour = program.colour.unwrap();
            let labels = colour.spectrum();
            let places: Vec<_> = labels.iter().map(|label| label.span().of(&text)).collect();
            assert_eq!(places, ["f0", "f1", "f2", "f3"]);
            assert_eq!(colour.filters().count(), 1);
            assert_eq!(colour.last(ColourKey::Table), None);
            assert_eq!(program.trailing.as_str(), " x");
        }
    }

    #[test]
    fn words_of_a_value_need_no_quotes_in_color() {
        let text = format!(
            "{SIX}\nCOLOR: patch = circle 2 ; degrees\n spectrum = f0, f1,f2 ,f3\r\n \
             wavelength = wl / 1000 material = red  paint END"
        );
        for dialect in [Dialect::Sound, Dialect::Compat] {
            let program = program::parse(&text, dialect).unwrap();
            let colour = program.colour.clone().unwrap();
            let value = |key| colour.last(key).unwrap().as_str();
            assert_eq!(value(ColourKey::Patch), "circle 2");
            assert_eq!(value(ColourKey::Wavelength), "wl / 1000");
            assert_eq!(value(ColourKey::Material), "red  paint");
            let labels = colour.spectrum();
            let places: Vec<_> = labels.iter().map(|label| label.span().of(&text)).collect();
            assert_eq!(places, ["f0", "f1", "f2", "f3"]);
            assert_eq!(program.comments[0].text, " degrees");
            let printed = program.to_string();
            assert!(printed.contains("    patch = circle 2 ; degrees\n"), "{printed}");
            assert_eq!(program::parse(&printed, dialect).unwrap().to_string(), printed);
        }
    }

    #[test]
    fn names_of_files_in_color_are_one_word() {
        let text = format!("{SIX}\nCOLOR: table = red paint.mtab END");
        assert!(program::parse(&text, Dialect::Sound).is_err());
    }

    #[test]
    fn without_color_the_rest_is_never_read() {
        let text = format!("{SIX} this is \"never read ; COLOR:");
        let program = program::parse(&text, Dialect::Sound).unwrap();
        assert_eq!(program.colour, None);
        assert_eq!(program.trailing.as_str(), " this is \"never read ; COLOR:");
    }
}
