//! Colours of a scene as reflectances over wavelength.

use mist_engine::Files;
use spectra::{Illuminant, Observer, ReflectanceUplift, RgbSpace};

use super::{
    super::scene::SceneChunk,
    painter::{self, SpectralValue, number},
};
use crate::export::ExportError;

/// The reflectance in the slot `name` of `chunk`: a number, three numbers (linear Rec.709), a
/// `uniformcolor_painter` or a `spectral_painter`.
///
/// A colour that is not grey becomes a smooth reflectance ([`ReflectanceUplift`]).
///
/// # Errors
///
/// If the slot is none of these, or the colour is not one of a reflectance.
pub(super) fn colour(
    chunk: &SceneChunk,
    name: &str,
    chunks: &[SceneChunk],
    files: &dyn Files,
) -> Result<Option<SpectralValue>, ExportError> {
    let Some(slot) = chunk.get(name).filter(|slot| *slot != "none") else { return Ok(None) };
    let words: Vec<&str> = slot.split_whitespace().collect();
    match words[..] {
        [r, g, b] => {
            return linear(name, [r, g, b]).and_then(|rgb| reflectance(name, rgb)).map(Some);
        }
        [grey] if grey.parse::<f64>().is_ok() => {
            let grey = number(name, grey)?;
            return reflectance(name, [grey; 3]).map(Some);
        }
        _ => {}
    }
    if let Ok(painter) = painter::painter(slot, "uniformcolor_painter", name, chunks) {
        return uniform(painter, name).map(Some);
    }
    let painter = painter::painter(slot, "spectral_painter", name, chunks)?;
    if let Some(file) = painter.get("file") {
        let text = painter::read(file, files)?;
        return Ok(Some(SpectralValue::Over(painter::samples(name, &text)?)));
    }
    let points = painter.lines.iter().filter(|(key, _)| key == "cp").map(|(_, cp)| cp.as_str());
    let points: Vec<&str> = points.collect();
    Ok(Some(SpectralValue::Over(painter::samples(name, &points.join("\n"))?)))
}

/// The colour of a `uniformcolor_painter`.
fn uniform(painter: &SceneChunk, name: &str) -> Result<SpectralValue, ExportError> {
    let words: Vec<&str> = painter.get("color").unwrap_or("1 1 1").split_whitespace().collect();
    let [r, g, b] = words[..] else {
        return Err(ExportError::refused(name, "the color of its painter has not three numbers"));
    };
    let values = linear(name, [r, g, b])?;
    let rgb = match painter.get("colorspace").unwrap_or("Rec709RGB_Linear") {
        "Rec709RGB_Linear" => values,
        "sRGB" => {
            let space = RgbSpace::srgb();
            values.map(|x| space.curve().decode(x))
        }
        other => {
            let problem = format!(
                "the colorspace {other} is not converted: give Rec709RGB_Linear or sRGB values"
            );
            return Err(ExportError::refused(name, problem));
        }
    };
    reflectance(name, rgb)
}

/// Three numbers.
fn linear(name: &str, words: [&str; 3]) -> Result<[f64; 3], ExportError> {
    let mut values = [0.0; 3];
    for (value, word) in values.iter_mut().zip(words) {
        *value = number(name, word)?;
    }
    Ok(values)
}

/// The reflectance of a colour in linear Rec.709.
fn reflectance(name: &str, rgb: [f64; 3]) -> Result<SpectralValue, ExportError> {
    if let Some(x) = rgb.iter().find(|x| !(0.0..=1.0).contains(*x)) {
        let problem = format!("{x} is not a reflectance: values lie between 0 and 1");
        return Err(ExportError::refused(name, problem));
    }
    if rgb[0] == rgb[1] && rgb[1] == rgb[2] {
        return Ok(SpectralValue::Flat(rgb[0]));
    }
    let found = uplift(name)?.reflectance(rgb);
    let points = (0..=80).map(|k| 380.0 + 5.0 * f64::from(k)).map(|nm| (nm, found.at(nm)));
    Ok(SpectralValue::Invented { rgb, points: points.collect() })
}

/// Reflectances of Rec.709 colours under D65, its white.
fn uplift(name: &str) -> Result<ReflectanceUplift, ExportError> {
    let d65 = Illuminant::named("D65");
    let d65 = d65.map_err(|error| ExportError::refused(name, error.to_string()))?;
    Ok(ReflectanceUplift::new(&RgbSpace::srgb(), &d65, Observer::Cie1931_2))
}
