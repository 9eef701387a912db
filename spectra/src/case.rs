//! Colour cases in JSON: spectra in, XYZ, Lab and RGB out.
//!
//! A request is one case or `{"illuminants": {…}, "cases": […]}`. Fields of a case:
//!
//! | field | meaning | default |
//! | --- | --- | --- |
//! | `id` | name in the answer and in errors | its number, from 1 |
//! | `wavelengths` | nm, in any order | required |
//! | `values` or `stokes` | a list, or four lists I, Q, U, V | one is required |
//! | `value_factor` | factor on the values (π: BRDF → radiance factor) | 1 |
//! | `interpolation` | `none`, `sprague`, `cubic`, `linear` | by the grid |
//! | `extrapolation` | `hold`, `zero` | `hold`; `zero` for emission |
//! | `illuminant` | name in `illuminants`, CIE name, K, `D(K)`, `custom`, null: emission | required |
//! | `custom_illuminant` | `wavelengths`, `values`, `interpolation`, `extrapolation` | linear, zero |
//! | `observer` | `CIE1931_2`, `CIE1964_10`, `CIE2015_2`, `CIE2015_10` | `CIE1931_2` |
//! | `method` | `sum_1nm`, `absolute_683`, `relative_Y1`, `astm_e308` | `sum_1nm`, `absolute_683` |
//! | `rgb_exposure` | factor on XYZ before the RGB matrix | 1 |
//! | `filters` | `linear_polariser`, `linear_retarder`, `circular_analyser`, or text | none |
//! | `rgb` (or `expected.rgb`) | list of objects with `space` and `adaptation`, or of such pairs | all spaces × none, Bradford, CAT02, CAT16 |
//!
//! Other fields are notes and ignored, unless they look like a slip for one of these.

mod fields;
mod light;
mod request;

use std::fmt::Display;

use serde::Serialize;
use serde_json::Value;
use thiserror::Error;

use crate::{
    Adaptation, Illuminant, Interpolation, RgbSpace, Spectrum, astm,
    filter::{self, stack_mueller},
    lab,
    matrix::apply,
    plan::rgb_matrix,
    rgb::in_gamut,
    wavelength::{FINE_COUNT, Fine, fine_wavelengths},
    xyz::{self, Xyz, to_array},
};
use fields::Fields;
use request::{Case, Method, Spectra};

/// Why a request cannot be answered: which case, which field, what is wrong.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{}{}{problem}", place("case", case), place("field", field))]
pub struct CaseError {
    /// The `id` of the case or its number from 1; empty for the request itself.
    pub case: String,
    /// Path of the field, such as `filters[1].angle_deg`; empty for the case itself.
    pub field: String,
    /// What is wrong and what would have been accepted.
    pub problem: String,
}

fn place(what: &str, name: &str) -> String {
    if name.is_empty() { String::new() } else { format!("{what} `{name}`: ") }
}

impl CaseError {
    fn new(case: &str, field: &str, problem: impl Display) -> Self {
        Self { case: case.to_owned(), field: field.to_owned(), problem: problem.to_string() }
    }
}

/// The answer to a request.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Response {
    /// One per case, in order.
    pub results: Vec<CaseResult>,
}

/// The colour of one case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CaseResult {
    /// The `id` of the case.
    pub id: String,
    /// XYZ of the Stokes components before the filters, where Stokes spectra were given.
    #[serde(rename = "XYZ_stokes", skip_serializing_if = "Option::is_none")]
    pub xyz_stokes: Option<[[f64; 3]; 4]>,
    /// XYZ behind the filters.
    #[serde(rename = "XYZ")]
    pub xyz: [f64; 3],
    /// XYZ of a perfect diffuser; null for emission.
    #[serde(rename = "white_XYZ")]
    pub white_xyz: Option<[f64; 3]>,
    /// Chromaticity; null for black.
    pub xy: Option<[f64; 2]>,
    /// L\*a\*b\* relative to the white; null for emission.
    #[serde(rename = "Lab")]
    pub lab: Option<[f64; 3]>,
    /// The wanted RGB.
    pub rgb: Vec<RgbResult>,
}

/// RGB in one space by one adaptation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RgbResult {
    /// Name of the space.
    pub space: String,
    /// Name of the adaptation.
    pub adaptation: String,
    /// Linear, signed, unclipped.
    pub linear: [f64; 3],
    /// Encoded, signed, unclipped.
    pub encoded: [f64; 3],
    /// Encoded from linear values clipped to 0…1.
    pub encoded_clipped: [f64; 3],
    /// The same as bytes.
    pub u8: [u8; 3],
    /// Whether the linear values are in 0…1, give or take 1e-9.
    pub in_gamut: bool,
}

/// Answers a request: one case, or `{"illuminants": {…}, "cases": […]}`.
///
/// # Errors
///
/// At the first case that cannot be computed.
pub fn evaluate(request: &Value) -> Result<Response, CaseError> {
    let whole = Fields::new("", "", request)?;
    let illuminants = light::read_illuminants(whole)?;
    let one = std::slice::from_ref(request);
    let cases = whole.list("cases")?.unwrap_or(one);
    let results = cases.iter().enumerate().map(|(index, value)| {
        let id = case_id(index, value);
        let case = Case::read(Fields::new(&id, "", value)?, &illuminants)?;
        case.evaluate(&id)
    });
    Ok(Response { results: results.collect::<Result<_, _>>()? })
}

fn case_id(index: usize, case: &Value) -> String {
    match case.get("id") {
        Some(Value::String(id)) => id.clone(),
        Some(Value::Number(id)) => id.to_string(),
        _ => (index + 1).to_string(),
    }
}

/// What the sums give.
struct Tristimulus {
    /// Behind the filters.
    xyz: Xyz,
    /// Of the Stokes components before the filters.
    stokes: Option<[Xyz; 4]>,
    white: Option<Xyz>,
}

impl Case {
    fn evaluate(&self, id: &str) -> Result<CaseResult, CaseError> {
        let Tristimulus { xyz, stokes, white } = self.tristimulus(id)?;
        let exposed = xyz * self.exposure;
        let result = CaseResult {
            id: id.to_owned(),
            xyz_stokes: stokes.map(|components| components.map(to_array)),
            xyz: to_array(xyz),
            white_xyz: white.map(to_array),
            xy: xyz::chromaticity(xyz),
            lab: white.map(|white| {
                let lab = lab::from_xyz(xyz, white);
                [lab.l, lab.a, lab.b]
            }),
            rgb: self
                .rgb
                .iter()
                .enumerate()
                .map(|(i, (space, adaptation))| {
                    rgb(space, *adaptation, exposed, white)
                        .map_err(|problem| CaseError::new(id, &format!("rgb[{i}]"), problem))
                })
                .collect::<Result<_, _>>()?,
        };
        if result.is_finite() {
            Ok(result)
        } else {
            Err(CaseError::new(id, "values", "too large: the colour is not finite"))
        }
    }

    fn tristimulus(&self, id: &str) -> Result<Tristimulus, CaseError> {
        let white = self.illuminant.as_ref().map(|light| light.white(self.observer));
        match (&self.spectra, &self.illuminant) {
            (Spectra::Values(values), Some(light)) if self.method == Method::Astm => {
                self.astm(values, light).map_err(|e| CaseError::new(id, "wavelengths", e))
            }
            (Spectra::Values(values), _) => {
                let fine = self.fine(id, values)?;
                let dark = [0.0; FINE_COUNT];
                let passed = self.behind_filters([&fine, &dark, &dark, &dark]);
                Ok(Tristimulus { xyz: self.sum(id, &passed)?, stokes: None, white })
            }
            (Spectra::Stokes(stokes), _) => {
                let [i, q, u, v] = stokes.as_ref();
                let fine =
                    [self.fine(id, i)?, self.fine(id, q)?, self.fine(id, u)?, self.fine(id, v)?];
                let passed = self.behind_filters(fine.each_ref().map(|f| &**f));
                let scale = self.scale(id, &fine[0])?;
                let components = fine.each_ref().map(|fine| self.bare_sum(fine) * scale);
                Ok(Tristimulus { xyz: self.sum(id, &passed)?, stokes: Some(components), white })
            }
        }
    }

    fn fine(&self, id: &str, spectrum: &Spectrum) -> Result<Box<Fine>, CaseError> {
        let suggested = Interpolation::for_grid(spectrum.grid());
        spectrum
            .fine_by(self.interpolation.unwrap_or(suggested), self.extrapolation)
            .map_err(|e| CaseError::new(id, "interpolation", e))
    }

    /// The intensity behind the filters, on the 1 nm grid.
    fn behind_filters(&self, stokes: [&Fine; 4]) -> Box<Fine> {
        let mut passed = Box::new(*stokes[0]);
        if !self.filters.is_empty() {
            for (i, nm) in fine_wavelengths().enumerate() {
                let before = stokes.map(|component| component[i]);
                passed[i] = filter::apply(&stack_mueller(&self.filters, nm), before)[0];
            }
        }
        passed
    }

    fn sum(&self, id: &str, fine: &Fine) -> Result<Xyz, CaseError> {
        Ok(self.bare_sum(fine) * self.scale(id, fine)?)
    }

    fn bare_sum(&self, fine: &Fine) -> Xyz {
        match &self.illuminant {
            Some(light) => xyz::reflected(fine, light, self.observer),
            None => xyz::emitted(fine, self.observer),
        }
    }

    /// What [`bare_sum`](Self::bare_sum) is multiplied by: brings Y to 1 for `relative_Y1`.
    fn scale(&self, id: &str, fine: &Fine) -> Result<f64, CaseError> {
        if self.method != Method::Relative {
            return Ok(1.0);
        }
        let luminance = self.bare_sum(fine).y;
        if luminance > 0.0 {
            Ok(1.0 / luminance)
        } else {
            Err(CaseError::new(id, "values", "relative_Y1 needs a positive luminance"))
        }
    }

    fn astm(&self, values: &Spectrum, light: &Illuminant) -> Result<Tristimulus, astm::AstmError> {
        let white = astm::reflected(&values.map(|_| 1.0), light, self.observer)?;
        let xyz = astm::reflected(values, light, self.observer)?;
        Ok(Tristimulus { xyz, stokes: None, white: Some(white) })
    }
}

impl CaseResult {
    fn is_finite(&self) -> bool {
        let numbers = self.xyz.iter().chain(self.lab.iter().flatten());
        let stokes = self.xyz_stokes.iter().flatten().flatten();
        let rgb = self.rgb.iter().flat_map(|rgb| rgb.linear.iter().chain(&rgb.encoded));
        numbers.chain(stokes).chain(rgb).all(|number| number.is_finite())
    }
}

fn rgb(
    space: &RgbSpace,
    adaptation: Adaptation,
    xyz: Xyz,
    white: Option<Xyz>,
) -> Result<RgbResult, String> {
    let matrix = match (adaptation, white) {
        (Adaptation::None, _) => *space.from_xyz_matrix(),
        (_, Some(white)) => rgb_matrix(space, adaptation, white).map_err(|e| e.to_string())?,
        (_, None) => {
            let name = adaptation.name();
            return Err(format!("emission has no white for {name} adaptation, use none"));
        }
    };
    let linear = apply(&matrix, to_array(xyz));
    Ok(RgbResult {
        space: space.name().to_owned(),
        adaptation: adaptation.name().to_owned(),
        linear,
        encoded: space.encode(linear),
        encoded_clipped: space.encode_clipped(linear),
        u8: space.encode_u8(linear),
        in_gamut: in_gamut(linear),
    })
}
