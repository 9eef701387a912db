//! The colours of the rows as squares, one line of squares per slow axis.

use std::fmt::Write as _;

use mist_engine::colour::{ColourTable, RowOrder};
use mist_format::number::general;

use super::{
    display::DisplayColours,
    page::{MARGIN, WIDTH, evenly_spaced, text},
};
use crate::column;

/// Maximum side of a square.
const SIDE: f64 = 72.0;
/// Minimum side of a square with its intensity as text.
const LABELLED: f64 = 40.0;
/// Maximum number of squares in a line, and of lines.
const MOST: usize = 48;
/// Squares per line of a table without axes.
const WRAP: usize = 12;

/// Draws the swatches below `top` and returns their lower edge.
pub(super) fn draw(
    table: &ColourTable,
    display: &DisplayColours,
    top: f64,
    svg: &mut String,
) -> f64 {
    let across = across(table);
    let down = table.rows.len().div_ceil(across);
    let columns = evenly_spaced(across, MOST);
    let side = ((WIDTH - 2.0 * MARGIN) / columns.len().max(1) as f64).min(SIDE);
    text(svg, (MARGIN, top + 10.0), "fill=\"#555\"", &caption(table, side));
    let bright = brighter(table, display);
    text(svg, (MARGIN, top + 25.0), "fill=\"#555\"", &bright);
    let top = top + if bright.is_empty() { 20.0 } else { 35.0 };
    let lines = evenly_spaced(down, MOST);
    for (j, &line) in lines.iter().enumerate() {
        for (i, &column) in columns.iter().enumerate() {
            let row = line * across + column;
            if row < table.rows.len() {
                let at = (MARGIN + side * i as f64, top + side * j as f64);
                square(table, display, row, at, side, svg);
            }
        }
    }
    top + side * lines.len() as f64
}

/// The number of squares in a line: the fastest axis of a grid, or the rows of a list before its
/// slowest column changes.
fn across(table: &ColourTable) -> usize {
    if let RowOrder::Grid { axes, .. } = &table.layout {
        return axes.last().map_or(1, |axis| axis.nodes.len()).max(1);
    }
    let slowest = |at: usize| column::patch_values(&table.rows[at])[0];
    let count = table.rows.len();
    let run = (1..count).find(|&at| slowest(at) != slowest(0)).unwrap_or(count);
    if run > 1 && count.is_multiple_of(run) && run < count { run } else { count.clamp(1, WRAP) }
}

fn caption(table: &ColourTable, side: f64) -> String {
    let order = "in the order of the rows";
    let hint = if side >= LABELLED { "; numbers are the intensity I" } else { "" };
    format!("{} colours {order}, point at one for its angles{hint}", table.rows.len())
}

/// The line about colours that are brighter than white; empty if there are none.
fn brighter(table: &ColourTable, display: &DisplayColours) -> String {
    let exposures = (0..table.rows.len()).map(|at| display.exposure(table, at));
    let (count, least) = exposures
        .filter(|exposure| *exposure < 1.0)
        .fold((0, 1.0_f64), |(count, least), exposure| (count + 1, least.min(exposure)));
    if count == 0 {
        return String::new();
    }
    format!(
        "{count} are brighter than white: shown with their hue at a lower exposure (the number \
         behind the cross), down to × {}",
        general(least, 3)
    )
}

fn square(
    table: &ColourTable,
    display: &DisplayColours,
    at: usize,
    (x, y): (f64, f64),
    side: f64,
    svg: &mut String,
) {
    let row = &table.rows[at];
    let intensity = row.xyz[0][1];
    let names = column::patch_names(table);
    let places = names.iter().zip(column::patch_values(row));
    let title: String = places.map(|(name, v)| format!("{name} {} ", general(v, 6))).collect();
    // Writing to a string cannot fail.
    let _ = writeln!(
        svg,
        "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{side:.1}\" height=\"{side:.1}\" fill=\"{}\">\
         <title>{}I {} exposure {}</title></rect>",
        display.hex(table, at),
        title.replace('&', "&amp;").replace('<', "&lt;"),
        general(intensity, 4),
        general(display.exposure(table, at), 3),
    );
    if side >= LABELLED {
        let ink = if display.is_dark(table, at) { "#fff" } else { "#000" };
        let place = (x + 5.0, y + side - 6.0);
        let style = format!("font-size=\"10\" fill=\"{ink}\"");
        text(svg, place, &style, &general(intensity, 3));
        let exposure = display.exposure(table, at);
        if exposure < 1.0 {
            text(svg, (x + 5.0, y + 13.0), &style, &format!("× {}", general(exposure, 2)));
        }
    }
}
