//! The settings of colours, by names.

use serde::{Deserialize, Serialize};
use spectra::{
    Adaptation, ColourSettings, Extrapolation, Filter, Illuminant, Observer, Quantity, RgbSpace,
    Spectrum,
};

use super::error::{RequestError, read};
use crate::Files;

/// The settings of colours, by names; the defaults are those of the section COLOR.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct ColourQuery {
    /// A CIE name, a temperature, `D(temperature)` or a file; D65.
    pub illuminant: Option<String>,
    /// Colour-matching functions; CIE1931_2.
    pub observer: Option<String>,
    /// RGB space; sRGB.
    pub space: Option<String>,
    /// Chromatic adaptation; Bradford.
    pub adaptation: Option<String>,
    /// The quantity of the values; brdf.
    pub quantity: Option<String>,
    /// Filters before the eye, in the order in which light meets them; none.
    pub filters: Vec<String>,
}

impl ColourQuery {
    /// The settings for reflectance and radiance factors: a grey one of 1 is white under the
    /// `illuminant`.
    pub fn of_factors(illuminant: &str) -> Self {
        Self {
            illuminant: Some(illuminant.to_owned()),
            quantity: Some("factor".to_owned()),
            ..Self::default()
        }
    }

    /// The settings; an illuminant that is not a name is looked for in `files`.
    ///
    /// # Errors
    ///
    /// For unknown names.
    pub fn settings(&self, files: Option<&dyn Files>) -> Result<ColourSettings, RequestError> {
        fn text<'a>(given: &'a Option<String>, default: &'a str) -> &'a str {
            given.as_deref().unwrap_or(default)
        }
        let filters = self.filters.iter().map(|filter| read::<Filter>("filter", filter));
        Ok(ColourSettings {
            quantity: read::<Quantity>("quantity", text(&self.quantity, "brdf"))?,
            illuminant: illuminant(text(&self.illuminant, "D65"), files)?,
            observer: read::<Observer>("observer", text(&self.observer, "CIE1931_2"))?,
            space: read::<RgbSpace>("space", text(&self.space, "sRGB"))?,
            adaptation: read::<Adaptation>("adaptation", text(&self.adaptation, "Bradford"))?,
            filters: filters.collect::<Result<_, _>>()?,
            outside: Extrapolation::Hold,
        })
    }
}

fn illuminant(text: &str, files: Option<&dyn Files>) -> Result<Illuminant, RequestError> {
    let error = match read("illuminant", text) {
        Ok(illuminant) => return Ok(illuminant),
        Err(error) => error,
    };
    let Some(file) = files.and_then(|files| files.read(text).ok()) else { return Err(error) };
    let (spectrum, _) =
        Spectrum::parse(&file).map_err(|error| RequestError::new("illuminant", error))?;
    spectrum.illuminant(text).map_err(|error| RequestError::new("illuminant", error))
}

/// The canonical JSON of colour settings: the names that tables show.
#[derive(Serialize)]
pub(super) struct SettingsJson<'a> {
    quantity: &'a Quantity,
    illuminant: &'a Illuminant,
    observer: &'a Observer,
    space: &'a RgbSpace,
    adaptation: &'a Adaptation,
    filters: &'a [Filter],
    outside: &'static str,
}

impl<'a> SettingsJson<'a> {
    /// The JSON of `settings`.
    pub(super) fn new(settings: &'a ColourSettings) -> Self {
        let ColourSettings { quantity, illuminant, observer, space, adaptation, filters, outside } =
            settings;
        let outside = outside.name();
        Self { quantity, illuminant, observer, space, adaptation, filters, outside }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_name_is_told_with_its_key_and_the_accepted_ones() {
        let query = ColourQuery { observer: Some("CIE1913_2".into()), ..ColourQuery::default() };
        let error = query.settings(None).unwrap_err();
        assert_eq!(error.key, "observer");
        assert!(error.problem.contains("CIE1931_2"), "{error}");
    }

    #[test]
    fn equal_settings_have_equal_json() {
        let json = |filter: &str, illuminant: &str| {
            let query = ColourQuery {
                filters: vec![filter.into()],
                illuminant: Some(illuminant.into()),
                ..ColourQuery::default()
            };
            let settings = query.settings(None).unwrap();
            serde_json::to_string(&SettingsJson::new(&settings)).unwrap()
        };
        assert_eq!(json("linear(0)", "d65"), json("Linear(0.0, 1, 0)", "D65"));
        assert_ne!(json("linear(0)", "D65"), json("linear(0)", "D50"));
    }
}
