//! A picture of a colour table as SVG: its spectra as curves, its colours as swatches.
//!
//! Written by hand: two kinds of shape do not need a drawing library. It holds no script and
//! asks for no font file.

mod display;
mod graph;
mod pair;
mod swatch;

use std::fmt::Write as _;

use mist_engine::colour::ColourTable;

use display::Display;
pub use pair::plot_comparisons;

/// Width of the picture, in pixels.
const WIDTH: f64 = 900.0;
/// Space around everything.
const MARGIN: f64 = 24.0;
/// Height of title and subtitle.
const TITLE: f64 = 64.0;

/// The picture of a table.
pub fn plot(table: &ColourTable) -> String {
    let display = Display::new(table);
    let mut body = String::new();
    let mut y = TITLE;
    if table.wavelengths.len() > 1 && table.rows.iter().any(|row| !row.spectra[0].is_empty()) {
        y = graph::draw(table, &display, y, &mut body);
    }
    y = swatch::draw(table, &display, y, &mut body);
    let mut svg = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" \
         width=\"{WIDTH}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>",
        height = y + MARGIN,
    );
    text(&mut svg, (MARGIN, 32.0), "font-size=\"20\"", &table.material);
    let subtitle = format!(
        "{}, {} observer, {}, {} adaptation; colours on the scale on which a perfect diffuser is white",
        table.illuminant, table.observer, table.space, table.adaptation
    );
    text(&mut svg, (MARGIN, 50.0), "fill=\"#555\"", &subtitle);
    svg + &body + "</svg>\n"
}

/// Text at a place; `attributes` are further attributes of the element.
fn text(svg: &mut String, (x, y): (f64, f64), attributes: &str, content: &str) {
    let content = content
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace(|c: char| c.is_control(), " ");
    // Writing to a string cannot fail.
    let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" {attributes}>{content}</text>");
}

/// At most `most` of `0..count`, evenly spread, with the first and the last.
fn spread(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most).map(|i| i * (count - 1) / (most - 1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_keeps_both_ends() {
        assert_eq!(spread(3, 5), [0, 1, 2]);
        assert_eq!(spread(9, 5), [0, 2, 4, 6, 8]);
        assert_eq!(spread(100, 4), [0, 33, 66, 99]);
    }

    #[test]
    fn markup_in_a_name_is_text() {
        let mut svg = String::new();
        text(&mut svg, (0.0, 0.0), "", "<a&b>");
        assert!(svg.contains("&lt;a&amp;b&gt;"), "{svg}");
    }
}
