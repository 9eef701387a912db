//! The scenes that use the tables.

use std::fmt::Write;

use super::output::{BridgeFiles, MaterialTables};
use crate::{
    export::ExportError,
    rise::{
        material::SceneMaterial,
        scene::{SceneChunk, chunks, replaced},
    },
};

/// Adds the scenes that use the tables.
pub(super) fn add_scenes(
    text: &str,
    stem: &str,
    chunks: &[SceneChunk],
    materials: &[SceneMaterial],
    tables: &[MaterialTables],
    output: &mut BridgeFiles,
) {
    let scene = |tag: &str,
                 output: &BridgeFiles,
                 pick: &dyn Fn(&MaterialTables) -> String,
                 only_exr: bool| {
        let mut pieces: Vec<_> = materials
            .iter()
            .zip(tables)
            .map(|(material, tables)| {
                let file = pick(tables);
                let rho = output.tables[&file].reflectance();
                (chunks[material.chunk].span.clone(), composite(&material.name, &file, rho))
            })
            .collect();
        let rasterized: Vec<&SceneChunk> =
            chunks.iter().filter(|chunk| chunk.keyword == "file_rasterizeroutput").collect();
        for (number, chunk) in rasterized.iter().enumerate() {
            let new = match (only_exr, number) {
                (true, 0) => exr_output(stem, tag),
                (true, _) => String::new(),
                (false, _) => renamed(chunk, tag),
            };
            pieces.push((chunk.span.clone(), new));
        }
        replaced(text, pieces)
    };
    let plain = scene("mist", output, &|tables| tables.plain.clone(), false);
    let add = |output: &mut BridgeFiles, tag: &str, text: String| {
        let file = format!("{stem}_{tag}.RISEscene");
        output.scenes.push(file.clone());
        output.text(&file, text);
    };
    add(output, "mist", plain);
    if tables.iter().any(|tables| tables.filtered.is_some()) {
        let pick = |tables: &MaterialTables| {
            tables.filtered.clone().unwrap_or_else(|| tables.plain.clone())
        };
        let text = scene("mist_pol", output, &pick, false);
        add(output, "mist_pol", text);
    }
    let bands = tables.iter().map(|tables| tables.bands.len()).max().unwrap_or(0);
    for band in 0..bands {
        let tag = format!("b{band:02}");
        let text = scene(&tag, output, &|tables| tables.bands[band].clone(), true);
        add(output, &tag, text);
        output.bands.push(format!("{stem}_{tag}.exr"));
    }
}

/// A material with the BRDF of a table that reflects indirect light as a Lambertian body.
fn composite(name: &str, file: &str, [r, g, b]: [f64; 3]) -> String {
    format!(
        "# the table of {name}, and a diffuse body of its reflectance for indirect light\n\
         uniformcolor_painter\n{{\n\tname\t{name}_rho\n\tcolor\t{r:.6} {g:.6} {b:.6}\n}}\n\n\
         lambertian_material\n{{\n\tname\t{name}_body\n\treflectance\t{name}_rho\n}}\n\n\
         datadriven_material\n{{\n\tname\t{name}_table\n\tfilename\t{file}\n}}\n\n\
         composite_material\n{{\n\tname\t{name}\n\ttop\t{name}_table\n\tbottom\t{name}_body\n}}\n"
    )
}

/// One linear EXR with 32 bits, for pictures that are added.
fn exr_output(stem: &str, tag: &str) -> String {
    format!(
        "file_rasterizeroutput\n{{\n\tpattern\t{stem}_{tag}\n\ttype\tEXR\n\tbpp\t32\n\
         \tcolor_space\tRec709RGB_Linear\n\texr_with_alpha\tFALSE\n}}\n"
    )
}

/// The output with the tag of its scene in its name.
fn renamed(output: &SceneChunk, tag: &str) -> String {
    let mut text = format!("{}\n{{\n", output.keyword);
    for (name, value) in &output.lines {
        let value = if name == "pattern" {
            let last = value.rsplit(['/', '\\']).next().unwrap_or(value);
            format!("{last}_{tag}")
        } else {
            value.clone()
        };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "\t{name}\t{value}");
    }
    text + "}\n"
}

/// The file names of the images that a scene writes, without folder.
///
/// # Errors
///
/// If the text is not a scene.
pub fn images(scene: &str) -> Result<Vec<String>, ExportError> {
    let chunks = chunks(scene)?;
    let outputs = chunks.iter().filter(|chunk| chunk.keyword == "file_rasterizeroutput");
    Ok(outputs
        .map(|output| {
            let extension = output.get("type").unwrap_or("PNG").to_ascii_lowercase();
            format!("{}.{extension}", output.get("pattern").unwrap_or("rendered"))
        })
        .collect())
}
