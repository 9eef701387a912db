//! Models for RISE's own materials.

use std::{collections::BTreeMap, f64::consts::FRAC_1_PI, fmt::Write};

use mist_engine::{Files, material::Material};

use super::{
    super::scene::Chunk,
    painter::{Values, colour, scalar},
};
use crate::export::ExportError;

/// What a model is made of while it is derived.
#[derive(Default)]
struct Draft {
    parameters: Vec<(String, String)>,
    files: BTreeMap<String, String>,
}

impl Draft {
    fn set(&mut self, name: &str, value: impl ToString) {
        self.parameters.push((name.to_owned(), value.to_string()));
    }

    /// The text of an index; over wavelength it is a file of its own.
    fn index(&mut self, file: &str, n: &Values, k: &Values) -> String {
        if let (Values::Flat(n), Values::Flat(k)) = (n, k) {
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

    /// The text of a table over wavelength.
    fn table(&mut self, file: &str, values: &Values) -> String {
        let points = match values {
            Values::Flat(value) => return value.to_string(),
            Values::Over(points) => points,
        };
        let mut text = String::from("; lambda_um value\n");
        for (nm, value) in points {
            let _ = writeln!(text, "{} {value}", nm / 1000.0);
        }
        self.files.insert(file.to_owned(), text);
        file.to_owned()
    }

    fn reflectance(&mut self, prefix: &str, file: &str, values: &Values) {
        self.set(&format!("{prefix}reflectance"), "Table_Reflectance");
        let table = self.table(file, values);
        self.set(&format!("{prefix}reflectance.table"), table);
    }

    fn model(self, model: &str) -> Material {
        Material { model: model.to_owned(), parameters: self.parameters, files: self.files }
    }
}

/// The model of `chunk`, or why there is none.
pub(super) fn material(
    chunk: &Chunk,
    chunks: &[Chunk],
    files: &dyn Files,
) -> Result<Material, ExportError> {
    match chunk.keyword.as_str() {
        "lambertian_material" => {
            let mut draft = Draft::default();
            let values = colour(chunk, "reflectance", chunks, files)?.unwrap_or(Values::Flat(1.0));
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
                let problem = "alphax and alphay differ: the table has no azimuth";
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
            let problem = "dielectric_material is left as it is: it reflects as a mirror does, in one \
                           direction, and lets light through; a rough face of the same index and \
                           films is a ggx_material, or a model in comments with a stack";
            Err(ExportError::refused("material", problem))
        }
        other => {
            let problem = format!("{other} is left as it is: no model of it has a table of rings");
            Err(ExportError::refused("material", problem))
        }
    }
}

fn roughness(
    chunk: &Chunk,
    name: &str,
    chunks: &[Chunk],
    files: &dyn Files,
) -> Result<f64, ExportError> {
    match scalar(chunk, name, chunks, files)? {
        Some(Values::Flat(x)) if x > 0.0 => Ok(x),
        _ => Err(ExportError::refused(name, "expected a positive number for all wavelengths")),
    }
}

/// Facets of the given shape, with a film if the chunk has one, and a diffuse part beside them.
fn facets(
    chunk: &Chunk,
    chunks: &[Chunk],
    files: &dyn Files,
    shape: &[(&str, String)],
) -> Result<Material, ExportError> {
    let name = chunk.name();
    let value = |slot: &str| scalar(chunk, slot, chunks, files);
    if chunk.get("fresnel_mode").is_some_and(|mode| mode == "schlick_f0") {
        let problem = "schlick_f0 is no index: give ior and extinction, fresnel_mode conductor";
        return Err(ExportError::refused("fresnel_mode", problem));
    }
    let missing = || ExportError::refused("ior", "the material has no index");
    let (n, k) = (value("ior")?.ok_or_else(missing)?, value("extinction")?);
    let weight = match colour(chunk, "rs", chunks, files)? {
        None => 1.0,
        Some(Values::Flat(weight)) => weight,
        Some(Values::Over(points)) if points.iter().all(|p| p.1 == points[0].1) => points[0].1,
        Some(Values::Over(_)) => {
            let problem = "it varies over wavelength: put the colour of the lobe into ior and \
                           extinction";
            return Err(ExportError::refused("rs", problem));
        }
    };
    let mut draft = Draft::default();
    let k = k.unwrap_or(Values::Flat(0.0));
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
    let diffuse = colour(chunk, "rd", chunks, files)?.unwrap_or(Values::Flat(0.0));
    draft.set("factor2", 1);
    draft.set("source2", "Lambertian_BRDF_Model");
    draft.set("source2.substrate", &substrate);
    draft.reflectance("source2.", &format!("{name}_rd.txt"), &diffuse);
    Ok(draft.model("Two_Source_BRDF_Model"))
}

/// A film of `film_thickness` (nm) on the facets.
fn film(
    draft: &mut Draft,
    chunk: &Chunk,
    chunks: &[Chunk],
    files: &dyn Files,
) -> Result<(), ExportError> {
    let value = |slot: &str| scalar(chunk, slot, chunks, files);
    let missing = |slot: &str| ExportError::refused(slot, "the film has none");
    let n = value("film_ior")?.ok_or_else(|| missing("film_ior"))?;
    let k = value("film_extinction")?.unwrap_or(Values::Flat(0.0));
    let Some(Values::Flat(nm)) = value("film_thickness")? else {
        return Err(missing("film_thickness"));
    };
    let index = draft.index(&format!("{}_film_nk.txt", chunk.name()), &n, &k);
    draft.set("source1.stack", "SingleFilm_StackModel");
    draft.set("source1.stack.material", index);
    draft.set("source1.stack.thickness", nm / 1000.0);
    Ok(())
}
