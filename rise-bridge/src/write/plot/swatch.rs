//! The colours of the rows as squares, one line of squares per slow axis.

use std::fmt::Write as _;

use mist_engine::colour::{ColourTable, RowOrder};
use mist_format::number::general;

use super::{
    display::DisplayColours,
    graph::{label as values, lightness, varying, with_degrees},
    page::{MARGIN, WIDTH, evenly_spaced, text},
};
use crate::column;

/// Height that all lines take, if their squares are not smaller than the least.
const HIGH: f64 = 700.0;
/// Minimum side of a square, if the width allows it.
const LEAST: f64 = 14.0;
/// Maximum side of a square.
const SIDE: f64 = 72.0;
/// Minimum side of a square with its intensity as text.
const LABELLED: f64 = 40.0;
/// Maximum number of squares in a line, and of lines.
const MOST: usize = 48;
/// Width of a value above a column.
const LABEL: f64 = 26.0;
/// Width of the values left of the lines.
const NAMES: f64 = 120.0;
/// Height of the strip of lightness below a line.
const STRIP: f64 = 16.0;
/// Squares per line of a table without axes.
const WRAP: usize = 12;

/// Draws the swatches below `top`, with the values of their lines and columns and a strip of their
/// lightness, and returns their lower edge.
pub(super) fn draw(
    table: &ColourTable,
    display: &DisplayColours,
    top: f64,
    svg: &mut String,
) -> f64 {
    let across = across(table);
    let columns = evenly_spaced(across, MOST);
    let lines = evenly_spaced(table.rows.len().div_ceil(across), MOST);
    let room = WIDTH - 2.0 * MARGIN - NAMES;
    let fits = |room: f64, count: usize| room / count.max(1) as f64;
    let high = (fits(HIGH, lines.len()) - STRIP).max(LEAST);
    let side = fits(room, columns.len()).min(high).min(SIDE);
    text(svg, (MARGIN, top + 10.0), "fill=\"#555\"", &caption(table, side));
    let bright = brighter(table, display);
    text(svg, (MARGIN, top + 25.0), "fill=\"#555\"", &bright);
    let top = top + if bright.is_empty() { 50.0 } else { 65.0 };
    titles(table, across, (&columns, side), top, svg);
    let strip = Strip::new(table);
    let height = side + STRIP;
    for (j, &line) in lines.iter().enumerate() {
        let y = top + height * j as f64;
        let name = line_name(table, across, line * across);
        text(svg, (MARGIN + NAMES - 8.0, y + side / 2.0 + 4.0), "text-anchor=\"end\"", &name);
        for (i, &column) in columns.iter().enumerate() {
            let row = line * across + column;
            if column < across && row < table.rows.len() {
                let at = (MARGIN + NAMES + side * i as f64, y);
                square(table, display, row, at, side, svg);
                strip.draw(row, (at.0, y + side), side, svg);
            }
        }
    }
    top + height * lines.len() as f64
}

/// The lightness of the rows, the brightest one white.
struct Strip {
    lightness: Vec<f64>,
    white: f64,
}

impl Strip {
    fn new(table: &ColourTable) -> Self {
        let lightness: Vec<f64> = (0..table.rows.len()).map(|at| lightness(table, at)).collect();
        let white = lightness.iter().copied().fold(100.0, f64::max);
        Self { lightness, white }
    }

    fn draw(&self, row: usize, (x, y): (f64, f64), side: f64, svg: &mut String) {
        // Encoded sRGB is nearly proportional to the lightness.
        let grey = (255.0 * (self.lightness[row] / self.white).clamp(0.0, 1.0)).round() as u8;
        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{side:.1}\" height=\"{:.1}\" \
             fill=\"#{grey:02x}{grey:02x}{grey:02x}\" stroke=\"#ccc\" stroke-width=\"0.5\"/>",
            STRIP - 6.0
        );
    }
}

/// The names of the columns' and the lines' values, and the values of the columns.
fn titles(
    table: &ColourTable,
    across: usize,
    (columns, side): (&[usize], f64),
    top: f64,
    svg: &mut String,
) {
    let [fast, slow] = names(table, across);
    let joined = |names: &[(usize, String)]| {
        names.iter().map(|(_, name)| with_degrees(name)).collect::<Vec<_>>().join(" / ")
    };
    let is_regular = is_regular(table, across);
    let columns_are = format!("; columns: {}", joined(&fast));
    let columns_are = if is_regular && !fast.is_empty() { columns_are.as_str() } else { "" };
    let legend = format!("lines: {}{columns_are}", joined(&slow));
    text(svg, (MARGIN, top - 22.0), "fill=\"#555\"", &legend);
    let step = (LABEL * fast.len() as f64 / side).ceil().max(1.0) as usize;
    for (i, &column) in columns.iter().enumerate().step_by(step).filter(|_| is_regular) {
        let at = (MARGIN + NAMES + side * (i as f64 + 0.5), top - 5.0);
        text(svg, at, "text-anchor=\"middle\" font-size=\"11\"", &values(table, column, &fast));
    }
}

/// The columns of the table that differ within a line, and those that differ between lines.
fn names(table: &ColourTable, across: usize) -> [Vec<(usize, String)>; 2] {
    let starts: Vec<usize> = (0..table.rows.len()).step_by(across.max(1)).collect();
    let line: Vec<usize> = (0..across.min(table.rows.len())).collect();
    let slow = if is_regular(table, across) { &starts } else { &(0..table.rows.len()).collect() };
    [varying(table, &line), varying(table, slow)]
}

/// True if the columns of the squares have the same values in every line.
fn is_regular(table: &ColourTable, across: usize) -> bool {
    let line: Vec<usize> = (0..across.min(table.rows.len())).collect();
    let fast = varying(table, &line);
    (0..table.rows.len()).all(|row| values(table, row, &fast) == values(table, row % across, &fast))
}

/// The values that the squares of the line beginning with `row` share.
fn line_name(table: &ColourTable, across: usize, row: usize) -> String {
    let [_, slow] = names(table, across);
    values(table, row, &slow)
}

/// The number of squares in a line: the fastest axis of a grid, or the rows of a list before its
/// slowest column changes.
fn across(table: &ColourTable) -> usize {
    if let RowOrder::Grid { axes, .. } = &table.layout {
        // As many of the fastest axes as fit into a line, but not all.
        let mut across = 1;
        for axis in axes.iter().skip(1).rev() {
            if across > 1 && across * axis.nodes.len() > MOST {
                break;
            }
            across *= axis.nodes.len().max(1);
        }
        return across;
    }
    let slowest = |at: usize| column::patch_values(&table.rows[at])[0];
    let count = table.rows.len();
    let run = (1..count).find(|&at| slowest(at) != slowest(0)).unwrap_or(count);
    if run > 1 && count.is_multiple_of(run) && run < count { run } else { count.clamp(1, WRAP) }
}

fn caption(table: &ColourTable, side: f64) -> String {
    let order = "in the order of the rows";
    let hint = if side >= LABELLED { "; numbers are the intensity I" } else { "" };
    format!(
        "{} colours {order}{hint}; the grey strip is their lightness, the brightest one white",
        table.rows.len()
    )
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
        "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{side:.1}\" height=\"{side:.1}\" fill=\"{}\" \
         stroke=\"#ccc\" stroke-width=\"0.5\"><title>{}I {} exposure {}</title></rect>",
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
