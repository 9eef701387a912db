//! SVG pictures of tables as PNG and PDF, with a font of their own: they are the same on every machine.

use std::sync::Arc;

use resvg::{
    tiny_skia::{Pixmap, Transform},
    usvg::{Options, Tree, fontdb::Database},
};

use super::error::WriteError;

/// Letters of Latin and Greek of DejaVu Sans.
const FONT: &[u8] = include_bytes!("../../data/DejaVuSans-subset.ttf");

/// Pixels per unit of the SVG picture.
const SCALE: f32 = 2.0;

/// The picture as PNG, two pixels per unit.
///
/// # Errors
///
/// If `svg` is not a picture, or is too large.
pub fn png(svg: String) -> Result<Vec<u8>, WriteError> {
    let tree = tree(&svg)?;
    let size = tree.size();
    let side = |length: f32| (length * SCALE).ceil() as u32;
    let mut pixels = Pixmap::new(side(size.width()), side(size.height()))
        .ok_or_else(|| WriteError::Picture("it has no size".into()))?;
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| WriteError::Picture(error.to_string()))
}

/// The picture as PDF, with text that can be searched.
///
/// # Errors
///
/// If `svg` is not a picture.
pub fn pdf(svg: String) -> Result<Vec<u8>, WriteError> {
    svg2pdf::to_pdf(
        &tree(&svg)?,
        svg2pdf::ConversionOptions::default(),
        svg2pdf::PageOptions::default(),
    )
    .map_err(|error| WriteError::Picture(error.to_string()))
}

fn tree(svg: &str) -> Result<Tree, WriteError> {
    let mut fonts = Database::new();
    fonts.load_font_data(FONT.to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    let options = Options { fontdb: Arc::new(fonts), ..Options::default() };
    Tree::from_str(svg, &options).map_err(|error| WriteError::Picture(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SVG: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"90\" height=\"20\" \
        font-family=\"sans-serif\"><text x=\"5\" y=\"15\">θ = 1 µm</text></svg>";

    #[test]
    fn text_is_drawn() {
        let bytes = png(SVG.into()).unwrap();
        let pixels = Pixmap::decode_png(&bytes).unwrap();
        assert_eq!((pixels.width(), pixels.height()), (180, 40));
        assert!(pixels.pixels().iter().filter(|pixel| pixel.alpha() > 0).count() > 200);
    }

    #[test]
    fn a_pdf_is_made() {
        assert!(pdf(SVG.into()).unwrap().starts_with(b"%PDF"));
    }
}
