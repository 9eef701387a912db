//! Models of RISE's own materials.

use std::{collections::BTreeMap, f64::consts::FRAC_1_PI, fmt::Write};

use mist_engine::{Files, material::Material};

use super::{
    super::scene::SceneChunk,
    colour::colour,
    painter::{SpectralValue, scalar},
};
use crate::export::ExportError;

/// A model under construction.
#[derive(Default)]
struct MaterialDraft {
    parameters: Vec<(String, String)>,
    files: BTreeMap<String, String>,
    invented: Vec<String>,
}

/// A model with the values that were invented for it.
pub(super) struct DerivedMaterial {
    pub(super) material: Material,
    pub(super) invented: Vec<String>,
}

impl MaterialDraft {
    fn set(&mut self, name: &str, value: impl ToString) {
        self.parameters.push((name.to_owned(), value.to_string()));
    }

    /// The text of an index; values over wavelength become a file.
    fn index(&mut self, file: &str, n: &SpectralValue, k: &SpectralValue) -> String {
        if let (SpectralValue::Flat(n), SpectralValue::Flat(k)) = (n, k) {
            return format!("({n},{k})");
        }
        let mut nm = [n.nm(), k.nm()].concat();
        nm.sort_by(f64::total_cmp);
        nm.dedup();
        let mut text = String::from("; lambda_um n k\n");
        for nm in nm {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{} {} {}", nm / 1000.0, n.at(nm), k.at(nm));
        }
        self.files.insert(file.to_owned(), text);
        file.to_owned()
    }

    /// The text of a number; values over wavelength become a file.
    fn table(&mut self, file: &str, values: &SpectralValue) -> String {
        let mut text = String::new();
        let points = match values {
            SpectralValue::Flat(value) => return value.to_string(),
            SpectralValue::Over(points) => points,
            SpectralValue::Invented { rgb: [r, g, b], points } => {
                let note = format!("{file}: a smooth reflectance for the colour {r} {g} {b}");
                let _ = writeln!(text, "; invented: {note} (linear Rec.709)");
                self.invented.push(note);
                points
            }
        };
        text += "; lambda_um value\n";
        for (nm, value) in points {
            let _ = writeln!(text, "{} {value}", nm / 1000.0);
        }
        self.files.insert(file.to_owned(), text);
        file.to_owned()
    }

    fn reflectance(&mut self, prefix: &str, file: &str, values: &SpectralValue) {
        self.set(&format!("{prefix}reflectance"), "Table_Reflectance");
        let table = self.table(file, values);
        self.set(&format!("{prefix}reflectance.table"), table);
    }

    fn model(self, model: &str) -> DerivedMaterial {
        let Self { parameters, files, invented } = self;
        let material = Material { model: model.to_owned(), parameters, files };
        DerivedMaterial { material, invented }
    }
}

/// The model of `chunk`.
///
/// # Errors
///
/// If no model describes the material.
pub(super) fn material(
    chunk: &SceneChunk,
    chunks: &[SceneChunk],
    files: &dyn Files,
) -> Result<DerivedMaterial, ExportError> {
    match chunk.keyword.as_str() {
        "lambertian_material" => {
            let mut draft = MaterialDraft::default();
            let values =
                colour(chunk, "reflectance", chunks, files)?.unwrap_or(SpectralValue::Flat(1.0));
            draft.reflectance("", &format!("{}_rd.txt", chunk.name()), &values);
            Ok(draft.model("Lambertian_BRDF_Model"))
        }
        "cooktorrance_material" => {
            let m = roughness(chunk, "facets", chunks, files)?;
            let shape = [
                ("sdf", "Gaussian_Slope_Distribution_Function".to_owned()),
                ("sdf.s", m.to_string()),
                ("shadow", "Torrance_Sparrow_Shadow_Function".to_owned()),
            ];
            facets(chunk, chunks, files, &shape)
        }
        "ggx_material" => {
            let x = roughness(chunk, "alphax", chunks, files)?;
            if roughness(chunk, "alphay", chunks, files)? != x {
                let problem = "alphax and alphay differ, and the table has no azimuth";
                return Err(ExportError::refused("alphay", problem));
            }
            let shape = [
                ("sdf", "Ellipsoid_Slope_Distribution_Function".to_owned()),
                ("sdf.rx", "1".to_owned()),
                ("sdf.ry", "1".to_owned()),
                ("sdf.rz", x.to_string()),
                // The whole area is covered: π rx ry density = 1.
                ("sdf.density", FRAC_1_PI.to_string()),
                ("shadow", "Torrance_Sparrow_Shadow_Function".to_owned()),
            ];
            facets(chunk, chunks, files, &shape)
        }
        "dielectric_material" => {
            let problem = "dielectric_material is not converted: it is a mirror that transmits light. For a \
                           rough surface of the same index and films use ggx_material, or a model \
                           with a stack in comments";
            Err(ExportError::refused("material", problem))
        }
        other => {
            let problem = format!("{other} is not converted: it has no equivalent model");
            Err(ExportError::refused("material", problem))
        }
    }
}

fn roughness(
    chunk: &SceneChunk,
    name: &str,
    chunks: &[SceneChunk],
    files: &dyn Files,
) -> Result<f64, ExportError> {
    match scalar(chunk, name, chunks, files)? {
        Some(SpectralValue::Flat(x)) if x > 0.0 => Ok(x),
        _ => Err(ExportError::refused(name, "expected a positive number for all wavelengths")),
    }
}

/// Facets of the given shape, with a film if the chunk has one, plus a diffuse part.
fn facets(
    chunk: &SceneChunk,
    chunks: &[SceneChunk],
    files: &dyn Files,
    shape: &[(&str, String)],
) -> Result<DerivedMaterial, ExportError> {
    let name = chunk.name();
    let value = |slot: &str| scalar(chunk, slot, chunks, files);
    if chunk.get("fresnel_mode").is_some_and(|mode| mode == "schlick_f0") {
        let problem =
            "schlick_f0 is not an index: give ior and extinction with fresnel_mode conductor";
        return Err(ExportError::refused("fresnel_mode", problem));
    }
    let missing = || ExportError::refused("ior", "the material has no index");
    let (n, k) = (value("ior")?.ok_or_else(missing)?, value("extinction")?);
    let weight = match colour(chunk, "rs", chunks, files)? {
        None => 1.0,
        Some(SpectralValue::Flat(weight)) => weight,
        Some(SpectralValue::Over(points)) if points.iter().all(|p| p.1 == points[0].1) => {
            points[0].1
        }
        Some(_) => {
            let problem = "it varies over wavelength: express the colour of the lobe by ior and \
                           extinction";
            return Err(ExportError::refused("rs", problem));
        }
    };
    let mut draft = MaterialDraft::default();
    let k = k.unwrap_or(SpectralValue::Flat(0.0));
    let substrate = draft.index(&format!("{name}_nk.txt"), &n, &k);
    draft.set("substrate", &substrate);
    draft.set("factor1", weight);
    draft.set("source1", "Shadowed_Facet_BRDF_Model");
    draft.set("source1.substrate", &substrate);
    for (parameter, value) in shape {
        draft.set(&format!("source1.{parameter}"), value);
    }
    if chunk.get("fresnel_mode").is_some_and(|mode| mode == "thinfilm") {
        film(&mut draft, chunk, chunks, files)?;
    }
    let diffuse = colour(chunk, "rd", chunks, files)?.unwrap_or(SpectralValue::Flat(0.0));
    draft.set("factor2", 1);
    draft.set("source2", "Lambertian_BRDF_Model");
    draft.set("source2.substrate", &substrate);
    draft.reflectance("source2.", &format!("{name}_rd.txt"), &diffuse);
    Ok(draft.model("Two_Source_BRDF_Model"))
}

/// A film of `film_thickness` (nm) on the facets.
fn film(
    draft: &mut MaterialDraft,
    chunk: &SceneChunk,
    chunks: &[SceneChunk],
    files: &dyn Files,
) -> Result<(), ExportError> {
    let value = |slot: &str| scalar(chunk, slot, chunks, files);
    let missing = |slot: &str| ExportError::refused(slot, "the film has none");
    let n = value("film_ior")?.ok_or_else(|| missing("film_ior"))?;
    let k = value("film_extinction")?.unwrap_or(SpectralValue::Flat(0.0));
    let Some(SpectralValue::Flat(nm)) = value("film_thickness")? else {
        return Err(missing("film_thickness"));
    };
    let index = draft.index(&format!("{}_film_nk.txt", chunk.name()), &n, &k);
    draft.set("source1.stack", "SingleFilm_StackModel");
    draft.set("source1.stack.material", index);
    draft.set("source1.stack.thickness", nm / 1000.0);
    Ok(())
}
