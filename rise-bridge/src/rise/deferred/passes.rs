//! The scenes that RISE renders for product D: one material white, all others black, one light.

use std::f64::consts::PI;

use glam::DVec3;
use pictures::image::MOST_PIXELS;

use super::lamp::DirectionalLamp;
use crate::{
    export::ExportError,
    rise::scene::{SceneChunk, replaced},
};

/// Painters for the bodies, and settings for direct light; inserted before the scene.
const HEAD: &str = "\n# written by mist bridge\n\
    standard_shader\n{\n\tname\tglobal\n\tshaderop\tDefaultDirectLighting\n}\n\n\
    pixelpel_rasterizer\n{\n\tsamples\t1\n\tmax_recursion\t1\n\tpixel_filter\tbox\n\
    \toidn_denoise\tFALSE\n}\n\n\
    uniformcolor_painter\n{\n\tname\tmist_white\n\tcolor\t1 1 1\n}\n\n\
    uniformcolor_painter\n{\n\tname\tmist_black\n\tcolor\t0 0 0\n}\n";

/// A scene from which the passes are made.
pub(super) struct Passes<'a> {
    text: &'a str,
    chunks: &'a [SceneChunk],
    film: &'a SceneChunk,
    supersampling: usize,
    /// Columns and rows of the picture.
    pub(super) size: [usize; 2],
}

impl<'a> Passes<'a> {
    pub(super) fn new(
        text: &'a str,
        chunks: &'a [SceneChunk],
        supersampling: usize,
    ) -> Result<Self, ExportError> {
        let film = chunks.iter().find(|chunk| chunk.keyword == "film");
        let film = film.ok_or_else(|| {
            ExportError::refused("scene", "it has no chunk film with width and height")
        })?;
        let side = |name: &str| {
            let number = film.get(name).and_then(|text| text.parse::<usize>().ok());
            number.filter(|n| (1..=8192).contains(n)).ok_or_else(|| {
                let part = format!("scene, line {}", film.line);
                ExportError::refused(&part, format!("{name} of the film is not 1 to 8192"))
            })
        };
        let size = [side("width")?, side("height")?];
        if size[0] * size[1] * supersampling * supersampling > MOST_PIXELS {
            let problem =
                format!("{supersampling} times its pixels in each direction exceed {MOST_PIXELS}");
            return Err(ExportError::refused("film", problem));
        }
        Ok(Self { text, chunks, film, supersampling, size })
    }

    /// The lamps of the scene.
    pub(super) fn lamps(&self) -> Result<Vec<DirectionalLamp>, ExportError> {
        let lights = self.chunks.iter().filter(|chunk| chunk.keyword.ends_with("_light"));
        let lamps: Vec<DirectionalLamp> =
            lights.map(DirectionalLamp::of).collect::<Result<_, _>>()?;
        if lamps.is_empty() {
            return Err(ExportError::refused("scene", "it has no directional_light"));
        }
        Ok(lamps)
    }

    /// The scene with the material of chunk `shown` in white, lit from `toward`.
    pub(super) fn scene(
        &self,
        name: &str,
        shown: usize,
        toward: DVec3,
        has_shadows: bool,
    ) -> String {
        let first_line = self.text.find('\n').unwrap_or(self.text.len());
        let DVec3 { x, y, z } = toward;
        let head = format!(
            "{HEAD}\nfile_rasterizeroutput\n{{\n\tpattern\t{name}\n\ttype\tEXR\n\tbpp\t32\n\
             \tcolor_space\tRec709RGB_Linear\n\texr_with_alpha\tFALSE\n}}\n\n\
             directional_light\n{{\n\tname\tmist_lamp\n\tpower\t{PI}\n\tcolor\t1 1 1\n\
             \tdirection\t{x} {y} {z}\n}}\n"
        );
        let mut pieces = vec![(first_line..first_line, head)];
        for (number, chunk) in self.chunks.iter().enumerate() {
            let keyword = chunk.keyword.as_str();
            let removed = ["_rasterizer", "_shader", "_light", "file_rasterizeroutput"];
            let new = if keyword.ends_with("_material") {
                body(chunk.name(), if number == shown { "mist_white" } else { "mist_black" })
            } else if removed.iter().any(|end| keyword.ends_with(end)) {
                String::new()
            } else if chunk == self.film {
                let [width, height] = self.size.map(|n| n * self.supersampling);
                rewritten(chunk, &[("width", width.to_string()), ("height", height.to_string())])
            } else if keyword.ends_with("_object") && !has_shadows {
                rewritten(chunk, &[("receives_shadows", "FALSE".to_owned())])
            } else {
                continue;
            };
            pieces.push((chunk.span.clone(), new));
        }
        replaced(self.text, pieces)
    }
}

/// A Lambertian material with the name of another material.
fn body(name: &str, painter: &str) -> String {
    format!("lambertian_material\n{{\n\tname\t{name}\n\treflectance\t{painter}\n}}\n")
}

/// The chunk with values replaced or added.
fn rewritten(chunk: &SceneChunk, values: &[(&str, String)]) -> String {
    let kept = chunk.lines.iter().filter(|(name, _)| values.iter().all(|new| new.0 != name));
    let mut text = format!("{}\n{{\n", chunk.keyword);
    for (name, value) in kept {
        text += &format!("\t{name}\t{value}\n");
    }
    for (name, value) in values {
        text += &format!("\t{name}\t{value}\n");
    }
    text + "}\n"
}
