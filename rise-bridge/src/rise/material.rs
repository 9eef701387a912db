//! The materials of a scene, from comments for mist or from RISE's own parameters.
//!
//! Comments inside a material's chunk, which RISE ignores:
//!
//! ```text
//! # mist: model = Shadowed_Facet_BRDF_Model      or   # mist: material = gold.json
//! # mist: substrate = gold.nk                    any parameter of the model
//! # mist: filter = p                             s or p: a second table behind a polarizer
//! ```
//!
//! Without comments three of RISE's materials become models, with these definitions:
//!
//! | RISE | model |
//! | --- | --- |
//! | `lambertian_material` | `Lambertian_BRDF_Model`, reflectance over wavelength |
//! | `cooktorrance_material` | facets with Gaussian slopes, s = `facets` (Beckmann's m), shadowed by Torrance and Sparrow; a diffuse part `rd` beside it |
//! | `ggx_material` | facets with the slopes of ellipsoids, rz/rx = α; with `fresnel_mode thinfilm` a film on them; a diffuse part `rd` beside it |
//!
//! A diffuse colour in RGB becomes a smooth reflectance with this colour, which is invented.

mod colour;
mod derived;
mod painter;

use std::collections::BTreeMap;

use mist_engine::{
    Files,
    material::{Material, MaterialError},
    request::MaterialDescription,
};

use super::scene::SceneChunk;
use crate::export::ExportError;

/// A polarizer along the s or p direction of every ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfacePolarizer {
    /// Transmits s-polarized light.
    S,
    /// Transmits p-polarized light.
    P,
}

/// A material of a scene as a model with parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneMaterial {
    /// Its name in the scene.
    pub name: String,
    /// The index of its chunk.
    pub chunk: usize,
    /// The model with its parameters and generated data files.
    pub material: Material,
    /// The polarizer of a second table.
    pub filter: Option<SurfacePolarizer>,
    /// Values that the scene does not contain and that were invented.
    pub invented: Vec<String>,
}

/// The materials of `chunks` with comments for mist; with `derive`, also those that RISE's own
/// parameters describe. The second list has the skipped materials with the reason.
///
/// # Errors
///
/// If a comment is invalid or a file is missing.
pub fn scene_materials(
    chunks: &[SceneChunk],
    files: &dyn Files,
    derive: bool,
) -> Result<(Vec<SceneMaterial>, Vec<String>), ExportError> {
    let (mut found, mut skipped) = (Vec::new(), Vec::new());
    for (number, chunk) in chunks.iter().enumerate() {
        if !chunk.keyword.ends_with("_material") {
            continue;
        }
        if !chunk.notes.is_empty() {
            found.push(commented(chunk, number, files)?);
        } else if derive {
            match derived::material(chunk, chunks, files) {
                Ok(derived) => found.push(SceneMaterial {
                    name: safe_name(chunk)?,
                    chunk: number,
                    material: derived.material,
                    filter: None,
                    invented: derived.invented,
                }),
                Err(error) => skipped.push(format!("{}: {error}", chunk.name())),
            }
        }
    }
    Ok((found, skipped))
}

/// The name of a chunk as a part of file names.
fn safe_name(chunk: &SceneChunk) -> Result<String, ExportError> {
    let name = chunk.name();
    let good = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
    if !name.is_empty() && !name.starts_with('.') && name.chars().all(good) {
        return Ok(name.to_owned());
    }
    let problem = format!("the name {name:?} cannot be the name of files: use letters and digits");
    Err(ExportError::refused(&format!("scene, line {}", chunk.line), problem))
}

/// The material that the comments of a chunk describe.
fn commented(
    chunk: &SceneChunk,
    number: usize,
    files: &dyn Files,
) -> Result<SceneMaterial, ExportError> {
    let wrong = |problem: String| {
        ExportError::refused(&format!("scene, line {}, mist:", chunk.line), problem)
    };
    let (mut material, mut filter, mut parameters) = (None, None, Vec::new());
    for (name, value) in &chunk.notes {
        match (name.as_str(), value.as_str()) {
            ("material", file) => {
                let text = files.read(file).map_err(|error| wrong(error.to_string()))?;
                let described = MaterialDescription::parse(&text).map_err(MaterialError::Json)?;
                let MaterialDescription::Model(model) = described else {
                    return Err(wrong(format!(
                        "{file} is a program; a scene needs a model with parameters: \
                         {{\"model\": …, \"parameters\": {{…}}}}"
                    )));
                };
                material = Some(model);
            }
            ("model", model) => {
                material = Some(Material {
                    model: model.to_owned(),
                    parameters: Vec::new(),
                    files: BTreeMap::new(),
                });
            }
            ("filter", "s") => filter = Some(SurfacePolarizer::S),
            ("filter", "p") => filter = Some(SurfacePolarizer::P),
            ("filter", other) => return Err(wrong(format!("filter {other:?} is neither s nor p"))),
            (name, value) => parameters.push((name.to_owned(), value.to_owned())),
        }
    }
    let mut material =
        material.ok_or_else(|| wrong("expected model = NAME or material = FILE.json".into()))?;
    material.parameters.extend(parameters);
    Ok(SceneMaterial {
        name: safe_name(chunk)?,
        chunk: number,
        material,
        filter,
        invented: Vec::new(),
    })
}
