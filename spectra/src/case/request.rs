//! A case of a request: spectra, light, observer, method, filters and RGB spaces from JSON.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::{error::CaseError, fields::CaseFields, light::read_illuminant};
use crate::{
    Adaptation, Extrapolation, Filter, Illuminant, Interpolation, Observer, RgbSpace, Spectrum,
    name::NamedValue, wavelength::Grid,
};

/// The method of computing XYZ.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) enum ColourMethod {
    /// Σ R S c̄ / Σ S ȳ at 1 nm.
    Sum,
    /// 683 Σ L c̄ at 1 nm.
    Absolute,
    /// Σ L c̄ / Σ L ȳ at 1 nm.
    Relative,
    /// ASTM E308.
    Astm,
}

const METHODS: [NamedValue<ColourMethod>; 4] = [
    NamedValue("sum_1nm", ColourMethod::Sum),
    NamedValue("absolute_683", ColourMethod::Absolute),
    NamedValue("relative_Y1", ColourMethod::Relative),
    NamedValue("astm_e308", ColourMethod::Astm),
];

/// The spectra of a case, with `value_factor` applied.
#[derive(Clone, Debug)]
pub(super) enum CaseSpectra {
    /// Unpolarized light.
    Values(Spectrum),
    /// I, Q, U, V.
    Stokes(Box<[Spectrum; 4]>),
}

/// A case of a request.
#[derive(Clone, Debug)]
pub(super) struct ColourCase {
    pub(super) spectra: CaseSpectra,
    /// `None`: the interpolation that suits the grid.
    pub(super) interpolation: Option<Interpolation>,
    pub(super) extrapolation: Extrapolation,
    /// `None`: emission.
    pub(super) illuminant: Option<Illuminant>,
    pub(super) observer: Observer,
    pub(super) method: ColourMethod,
    pub(super) exposure: f64,
    pub(super) filters: Vec<Filter>,
    pub(super) rgb: Vec<(RgbSpace, Adaptation)>,
    /// True if the request has a `value_factor`.
    pub(super) is_scaled: bool,
}

const KNOWN: [&str; 20] = [
    "id",
    "group",
    "optional",
    "quantity",
    "note",
    "expected",
    "wavelengths",
    "values",
    "stokes",
    "value_factor",
    "interpolation",
    "extrapolation",
    "illuminant",
    "custom_illuminant",
    "observer",
    "domain_nm",
    "method",
    "rgb_exposure",
    "filters",
    "rgb",
];

impl ColourCase {
    /// Reads a case; `illuminants` are those that came with the request.
    pub(super) fn read(
        fields: CaseFields<'_>,
        illuminants: &BTreeMap<String, Illuminant>,
    ) -> Result<Self, CaseError> {
        fields.refuse_misspelt(&KNOWN)?;
        let spectra = read_spectra(fields)?;
        let illuminant = read_illuminant(fields, illuminants)?;
        let method = read_method(fields, illuminant.is_some(), &spectra)?;
        check_domain(fields, method)?;
        let extrapolation = match fields.text("extrapolation")? {
            Some(text) => {
                Extrapolation::parse(text).map_err(|e| fields.error("extrapolation", e))?
            }
            None if illuminant.is_some() => Extrapolation::Hold,
            None => Extrapolation::Zero,
        };
        Ok(Self {
            interpolation: read_interpolation(fields, method)?,
            extrapolation,
            observer: match fields.text("observer")? {
                Some(text) => Observer::parse(text).map_err(|e| fields.error("observer", e))?,
                None => Observer::default(),
            },
            exposure: fields.number("rgb_exposure")?.unwrap_or(1.0),
            filters: read_filters(fields)?,
            rgb: read_rgb(fields, illuminant.is_some())?,
            is_scaled: fields.get("value_factor").is_some(),
            spectra,
            illuminant,
            method,
        })
    }
}

fn read_spectra(fields: CaseFields<'_>) -> Result<CaseSpectra, CaseError> {
    let wavelengths = fields.required_numbers("wavelengths")?;
    Grid::new(&wavelengths).map_err(|e| fields.error("wavelengths", e))?;
    let factor = fields.number("value_factor")?.unwrap_or(1.0);
    let spectrum = |name: &str, value: &Value| {
        let values = fields.as_numbers(name, value)?.iter().map(|v| v * factor).collect::<Vec<_>>();
        Spectrum::new(&wavelengths, &values).map_err(|e| fields.error(name, e))
    };
    match (fields.get("values"), fields.list("stokes")?) {
        (Some(_), Some(_)) => Err(fields.error("stokes", "given together with values")),
        (Some(values), None) => Ok(CaseSpectra::Values(spectrum("values", values)?)),
        (None, Some([i, q, u, v])) => Ok(CaseSpectra::Stokes(Box::new([
            spectrum("stokes[0]", i)?,
            spectrum("stokes[1]", q)?,
            spectrum("stokes[2]", u)?,
            spectrum("stokes[3]", v)?,
        ]))),
        (None, Some(other)) => {
            let found = format!("expected four lists (I, Q, U, V), got {}", other.len());
            Err(fields.error("stokes", found))
        }
        (None, None) => Err(fields.error("values", "missing")),
    }
}

fn read_method(
    fields: CaseFields<'_>,
    lit: bool,
    spectra: &CaseSpectra,
) -> Result<ColourMethod, CaseError> {
    let method = match fields.text("method")? {
        Some(text) => {
            NamedValue::find("method", text, &METHODS).map_err(|e| fields.error("method", e))?
        }
        None if lit => ColourMethod::Sum,
        None => ColourMethod::Absolute,
    };
    let problem = match method {
        ColourMethod::Sum | ColourMethod::Astm if !lit => "needs an illuminant",
        ColourMethod::Absolute | ColourMethod::Relative if lit => {
            "is for emission, where illuminant is null"
        }
        ColourMethod::Astm if matches!(spectra, CaseSpectra::Stokes(_)) => {
            "takes values, not stokes"
        }
        ColourMethod::Astm if fields.get("filters").is_some() => "takes no filters",
        _ => return Ok(method),
    };
    Err(fields.error("method", format!("{} {problem}", NamedValue::name_of(&METHODS, method))))
}

/// Checks the stated domain, which is fixed for every method.
fn check_domain(fields: CaseFields<'_>, method: ColourMethod) -> Result<(), CaseError> {
    let fixed =
        if method == ColourMethod::Astm { [360.0, 780.0, 1.0] } else { [360.0, 830.0, 1.0] };
    match fields.get("domain_nm") {
        Some(value) if fields.as_numbers("domain_nm", value)? != fixed => {
            Err(fields.error("domain_nm", format!("only {fixed:?} is computed")))
        }
        _ => Ok(()),
    }
}

fn read_interpolation(
    fields: CaseFields<'_>,
    method: ColourMethod,
) -> Result<Option<Interpolation>, CaseError> {
    match (fields.text("interpolation")?, method) {
        (Some("e308") | None, _) if method == ColourMethod::Astm => Ok(None),
        (Some(text), _) => match Interpolation::parse(text) {
            Ok(interpolation) => Ok(Some(interpolation)),
            Err(unknown) => Err(fields.error("interpolation", unknown)),
        },
        (None, _) => Ok(None),
    }
}

fn read_filters(fields: CaseFields<'_>) -> Result<Vec<Filter>, CaseError> {
    let filters = fields.list("filters")?.unwrap_or_default();
    filters
        .iter()
        .enumerate()
        .map(|(i, value)| {
            let path = fields.path_to(&format!("filters[{i}]"));
            if let Some(text) = value.as_str() {
                return Filter::parse(text).map_err(|e| CaseError::new(fields.case(), &path, e));
            }
            read_filter(CaseFields::new(fields.case(), &path, value)?)
        })
        .collect()
}

fn read_filter(fields: CaseFields<'_>) -> Result<Filter, CaseError> {
    #[derive(Clone, Copy, PartialEq)]
    enum FilterKind {
        Linear,
        Retarder,
        Circular,
    }
    const KINDS: [NamedValue<FilterKind>; 3] = [
        NamedValue("linear_polariser", FilterKind::Linear),
        NamedValue("linear_retarder", FilterKind::Retarder),
        NamedValue("circular_analyser", FilterKind::Circular),
    ];
    fields.refuse_misspelt(&[
        "type",
        "angle_deg",
        "k1",
        "k2",
        "fast_axis_deg",
        "retardance_nm",
        "handedness",
    ])?;
    let text = fields.text("type")?.ok_or_else(|| fields.error("type", "missing"))?;
    match NamedValue::find("filter", text, &KINDS).map_err(|e| fields.error("type", e))? {
        FilterKind::Linear => {
            let angle = fields.required_number("angle_deg")?.to_radians();
            let k1 = fields.number("k1")?.unwrap_or(1.0);
            Filter::linear(angle, k1, fields.number("k2")?.unwrap_or(0.0))
        }
        FilterKind::Retarder => Filter::retarder(
            fields.required_number("fast_axis_deg")?.to_radians(),
            fields.required_number("retardance_nm")?,
        ),
        FilterKind::Circular => Filter::circular(fields.required_number("handedness")?),
    }
    .map_err(|e| fields.error("type", e))
}

/// The requested spaces and adaptations: `rgb`, else `expected.rgb`, else all.
fn read_rgb(fields: CaseFields<'_>, lit: bool) -> Result<Vec<(RgbSpace, Adaptation)>, CaseError> {
    if let Some(list) = fields.list("rgb")? {
        return read_pairs(fields, "rgb", list);
    }
    if let Some(expected) = fields.get("expected") {
        let path = fields.path_to("expected");
        let expected = CaseFields::new(fields.case(), &path, expected)?;
        if let Some(list) = expected.list("rgb")? {
            return read_pairs(expected, "rgb", list);
        }
    }
    // Emission has no white to adapt from.
    let adaptations: &[Adaptation] = if lit {
        &[Adaptation::None, Adaptation::Bradford, Adaptation::Cat02, Adaptation::Cat16]
    } else {
        &[Adaptation::None]
    };
    let spaces = RgbSpace::names().filter_map(|name| RgbSpace::named(name).ok());
    Ok(spaces.flat_map(|space| adaptations.iter().map(move |a| (space.clone(), *a))).collect())
}

fn read_pairs(
    fields: CaseFields<'_>,
    name: &str,
    list: &[Value],
) -> Result<Vec<(RgbSpace, Adaptation)>, CaseError> {
    list.iter()
        .enumerate()
        .map(|(i, value)| {
            let path = fields.path_to(&format!("{name}[{i}]"));
            // ["sRGB", "none"] is short for {"space": "sRGB", "adaptation": "none"}.
            let long = match value.as_array().map(Vec::as_slice) {
                Some([space, adaptation]) => json!({ "space": space, "adaptation": adaptation }),
                _ => value.clone(),
            };
            read_pair(CaseFields::new(fields.case(), &path, &long)?)
        })
        .collect()
}

fn read_pair(pair: CaseFields<'_>) -> Result<(RgbSpace, Adaptation), CaseError> {
    let space = pair.text("space")?.ok_or_else(|| pair.error("space", "missing"))?;
    let adaptation = match pair.text("adaptation")? {
        Some(text) => Adaptation::parse(text).map_err(|e| pair.error("adaptation", e))?,
        None => Adaptation::None,
    };
    Ok((RgbSpace::parse(space).map_err(|e| pair.error("space", e))?, adaptation))
}
