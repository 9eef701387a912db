//! Evaluates the cases of a request.

use serde_json::Value;

use super::{
    error::CaseError,
    fields::CaseFields,
    light,
    request::{CaseSpectra, ColourCase, ColourMethod},
    response::{CaseResult, ColourResponse, RgbResult},
};
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

/// Answers a request: one case, or `{"illuminants": {…}, "cases": […]}`.
///
/// # Errors
///
/// At the first case that cannot be computed.
pub fn evaluate(request: &Value) -> Result<ColourResponse, CaseError> {
    let whole = CaseFields::new("", "", request)?;
    let illuminants = light::read_illuminants(whole)?;
    let one = std::slice::from_ref(request);
    let cases = whole.list("cases")?.unwrap_or(one);
    let (mut results, mut warnings) = (Vec::with_capacity(cases.len()), Vec::new());
    for (index, value) in cases.iter().enumerate() {
        let id = case_id(index, value);
        let case = ColourCase::read(CaseFields::new(&id, "", value)?, &illuminants)?;
        results.push(case.evaluate(&id)?);
        warnings.extend(case.warnings(&id));
    }
    Ok(ColourResponse { results, warnings })
}

fn case_id(index: usize, case: &Value) -> String {
    match case.get("id") {
        Some(Value::String(id)) => id.clone(),
        Some(Value::Number(id)) => id.to_string(),
        _ => (index + 1).to_string(),
    }
}

/// The sums of a case.
struct Tristimulus {
    /// XYZ behind the filters.
    xyz: Xyz,
    /// XYZ of the Stokes components before the filters.
    stokes: Option<[Xyz; 4]>,
    white: Option<Xyz>,
}

impl ColourCase {
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
            (CaseSpectra::Values(values), Some(light)) if self.method == ColourMethod::Astm => {
                self.astm(values, light).map_err(|e| CaseError::new(id, "wavelengths", e))
            }
            (CaseSpectra::Values(values), _) => {
                let fine = self.fine(id, values)?;
                let dark = [0.0; FINE_COUNT];
                let passed = self.behind_filters([&fine, &dark, &dark, &dark]);
                Ok(Tristimulus { xyz: self.sum(id, &passed)?, stokes: None, white })
            }
            (CaseSpectra::Stokes(stokes), _) => {
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

    /// The factor on [`bare_sum`](Self::bare_sum), which makes Y = 1 for `relative_Y1`.
    fn scale(&self, id: &str, fine: &Fine) -> Result<f64, CaseError> {
        if self.method != ColourMethod::Relative {
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
