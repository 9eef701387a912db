//! The picture of a colour table.

use std::fmt::Write as _;

use mist_engine::colour::ColourTable;

use super::{
    display::DisplayColours,
    graph,
    page::{MARGIN, TITLE, WIDTH, text},
    swatch,
};

/// The picture of a table.
pub fn plot(table: &ColourTable) -> String {
    let display = DisplayColours::new(table);
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
        "{}, {} observer, {}, {} adaptation; {}",
        table.illuminant,
        table.observer,
        table.space,
        table.adaptation,
        display.white()
    );
    text(&mut svg, (MARGIN, 50.0), "fill=\"#555\"", &subtitle);
    svg + &body + "</svg>\n"
}
