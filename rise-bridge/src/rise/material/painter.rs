//! Painters and scalar slots of a scene as values over wavelength.

use mist_engine::Files;

use super::super::scene::SceneChunk;
use crate::export::ExportError;

/// A number, or numbers over the wavelength in nm.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum SpectralValue {
    /// The same at every wavelength.
    Flat(f64),
    /// Linear between these points, constant beyond them.
    Over(Vec<(f64, f64)>),
    /// A smooth reflectance that was invented for a colour; otherwise as `Over`.
    Invented {
        /// The colour, linear Rec.709.
        rgb: [f64; 3],
        /// The reflectance.
        points: Vec<(f64, f64)>,
    },
}

impl SpectralValue {
    /// The value at `nm`.
    pub(super) fn at(&self, nm: f64) -> f64 {
        let points = match self {
            Self::Flat(value) => return *value,
            Self::Over(points) | Self::Invented { points, .. } => points,
        };
        let high = points.partition_point(|point| point.0 < nm);
        match (high.checked_sub(1).and_then(|k| points.get(k)), points.get(high)) {
            (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (nm - a.0) / (b.0 - a.0),
            (Some(only), None) | (None, Some(only)) => only.1,
            (None, None) => 0.0,
        }
    }

    /// The wavelengths at which it is given, nm.
    pub(super) fn nm(&self) -> Vec<f64> {
        match self {
            Self::Flat(_) => Vec::new(),
            Self::Over(points) | Self::Invented { points, .. } => {
                points.iter().map(|point| point.0).collect()
            }
        }
    }
}

/// The scalar in the slot `name` of `chunk`: a number or a `scalar_painter`.
pub(super) fn scalar(
    chunk: &SceneChunk,
    name: &str,
    chunks: &[SceneChunk],
    files: &dyn Files,
) -> Result<Option<SpectralValue>, ExportError> {
    let Some(slot) = chunk.get(name) else { return Ok(None) };
    if let Ok(number) = slot.parse() {
        return Ok(Some(SpectralValue::Flat(number)));
    }
    let painter = painter(slot, "scalar_painter", name, chunks)?;
    if let Some(value) = painter.get("value") {
        return Ok(Some(SpectralValue::Flat(number(name, value)?)));
    }
    if let Some(file) = painter.get("file") {
        return Ok(Some(SpectralValue::Over(samples(name, &read(file, files)?)?)));
    }
    if let Some(terms) = painter.get("sellmeier") {
        return Ok(Some(sellmeier(name, terms)?));
    }
    let problem = format!("{slot} has none of value, file and sellmeier");
    Err(ExportError::refused(name, problem))
}

pub(super) fn painter<'c>(
    slot: &str,
    keyword: &str,
    name: &str,
    chunks: &'c [SceneChunk],
) -> Result<&'c SceneChunk, ExportError> {
    let found = chunks.iter().find(|chunk| chunk.keyword == keyword && chunk.name() == slot);
    found.ok_or_else(|| {
        ExportError::refused(
            name,
            format!("{slot:?} is neither a number nor a {keyword} of the scene"),
        )
    })
}

pub(super) fn number(name: &str, text: &str) -> Result<f64, ExportError> {
    let parsed = text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    parsed.ok_or_else(|| ExportError::refused(name, format!("{text:?} is not a number")))
}

pub(super) fn read(file: &str, files: &dyn Files) -> Result<String, ExportError> {
    let text = files.read(file).map_err(|error| ExportError::refused(file, error.to_string()))?;
    Ok(text.to_string())
}

/// Lines `nm value`, sorted; `#` begins a comment.
pub(super) fn samples(name: &str, text: &str) -> Result<Vec<(f64, f64)>, ExportError> {
    let mut points = Vec::new();
    for line in text.lines() {
        let line = line.split('#').next().unwrap_or_default();
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            [] => {}
            [nm, value, ..] => points.push((number(name, nm)?, number(name, value)?)),
            _ => return Err(ExportError::refused(name, format!("{line:?} is not nm and value"))),
        }
    }
    points.sort_by(|a: &(f64, f64), b| a.0.total_cmp(&b.0));
    points.dedup_by(|b, a| a.0 == b.0);
    if points.is_empty() {
        return Err(ExportError::refused(name, "it has no samples"));
    }
    Ok(points)
}

/// n = √(1 + Σ B λ²/(λ² − C)), λ in µm, sampled over the visible.
fn sellmeier(name: &str, terms: &str) -> Result<SpectralValue, ExportError> {
    let terms: Result<Vec<f64>, _> =
        terms.split_whitespace().map(|word| number(name, word)).collect();
    let [b1, b2, b3, c1, c2, c3] = terms?[..] else {
        return Err(ExportError::refused(name, "sellmeier has six numbers: B1 B2 B3 C1 C2 C3"));
    };
    let index = |nm: f64| {
        let l2 = nm * nm * 1e-6;
        let sum =
            [(b1, c1), (b2, c2), (b3, c3)].map(|(b, c)| b * l2 / (l2 - c)).iter().sum::<f64>();
        (1.0 + sum).sqrt()
    };
    Ok(SpectralValue::Over(
        (36..=83).map(|k| (10.0 * f64::from(k), index(10.0 * f64::from(k)))).collect(),
    ))
}
