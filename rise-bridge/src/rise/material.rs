//! What a scene says about its materials: in comments for us, or in RISE's own parameters.
//!
//! Inside a material's chunk, where RISE reads over comments:
//!
//! ```text
//! # mist: model = Shadowed_Facet_BRDF_Model      or   # mist: material = gold.json
//! # mist: substrate = gold.nk                    any parameter of the model
//! # mist: filter = p                             s or p: the light behind a filter too
//! ```
//!
//! Without them three of RISE's materials become models, with these changes of definition:
//!
//! | RISE | model |
//! | --- | --- |
//! | `lambertian_material` | `Lambertian_BRDF_Model`, reflectance over wavelength |
//! | `cooktorrance_material` | facets with Gaussian slopes, s = `facets` (Beckmann's m), shadowed by Torrance and Sparrow; a diffuse part `rd` beside it |
//! | `ggx_material` | facets with the slopes of ellipsoids, rz/rx = α; with `fresnel_mode thinfilm` a film on them; a diffuse part `rd` beside it |

mod derived;
mod painter;

use std::collections::BTreeMap;

use mist_engine::{Files, material::Material};

use super::scene::Chunk;
use crate::export::ExportError;

/// A filter that follows the s and p directions of every ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// Lets s-polarized light through.
    S,
    /// Lets p-polarized light through.
    P,
}

/// A material of a scene as a model with parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Described {
    /// Its name in the scene.
    pub name: String,
    /// Which chunk it is.
    pub chunk: usize,
    /// The model with its parameters and the data files that were made for it.
    pub material: Material,
    /// The filter of a second table.
    pub filter: Option<Filter>,
}

/// The materials of `chunks` that have comments for us; with `derive`, also those that RISE's own
/// parameters describe. What is left as it is comes back with the reason.
///
/// # Errors
///
/// For comments that say nothing usable, and files that are missing.
pub fn described(
    chunks: &[Chunk],
    files: &dyn Files,
    derive: bool,
) -> Result<(Vec<Described>, Vec<String>), ExportError> {
    let (mut found, mut left) = (Vec::new(), Vec::new());
    for (number, chunk) in chunks.iter().enumerate() {
        if !chunk.keyword.ends_with("_material") {
            continue;
        }
        if !chunk.notes.is_empty() {
            found.push(noted(chunk, number, files)?);
        } else if derive {
            match derived::material(chunk, chunks, files) {
                Ok(material) => found.push(Described {
                    name: safe_name(chunk)?,
                    chunk: number,
                    material,
                    filter: None,
                }),
                Err(error) => left.push(format!("{}: {error}", chunk.name())),
            }
        }
    }
    Ok((found, left))
}

/// The name of a chunk, which becomes the name of files.
fn safe_name(chunk: &Chunk) -> Result<String, ExportError> {
    let name = chunk.name();
    let good = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
    if !name.is_empty() && !name.starts_with('.') && name.chars().all(good) {
        return Ok(name.to_owned());
    }
    let problem = format!("the name {name:?} cannot be the name of files: use letters and digits");
    Err(ExportError::refused(&format!("scene, line {}", chunk.line), problem))
}

fn noted(chunk: &Chunk, number: usize, files: &dyn Files) -> Result<Described, ExportError> {
    let wrong = |problem: String| {
        ExportError::refused(&format!("scene, line {}, mist:", chunk.line), problem)
    };
    let (mut material, mut filter, mut parameters) = (None, None, Vec::new());
    for (name, value) in &chunk.notes {
        match (name.as_str(), value.as_str()) {
            ("material", file) => {
                let text = files.read(file).map_err(|error| wrong(error.to_string()))?;
                material = Some(Material::from_json(&text)?);
            }
            ("model", model) => {
                material = Some(Material {
                    model: model.to_owned(),
                    parameters: Vec::new(),
                    files: BTreeMap::new(),
                });
            }
            ("filter", "s") => filter = Some(Filter::S),
            ("filter", "p") => filter = Some(Filter::P),
            ("filter", other) => return Err(wrong(format!("filter {other:?} is none of s and p"))),
            (name, value) => parameters.push((name.to_owned(), value.to_owned())),
        }
    }
    let mut material =
        material.ok_or_else(|| wrong("neither model = NAME nor material = FILE.json".into()))?;
    material.parameters.extend(parameters);
    Ok(Described { name: safe_name(chunk)?, chunk: number, material, filter })
}
