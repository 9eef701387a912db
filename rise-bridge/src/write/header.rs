//! The common header lines of `.mtab` and `.mspd`.

use std::fmt::Write as _;

use mist_engine::colour::{ColourTable, RowOrder, RowPatch, Symmetry};
use mist_format::number::general;

use super::rows::number;

/// First line of every text table, without `# `.
pub(crate) const MAGIC: &str = "MIST-TABLE 1";

/// The program that writes the table.
pub(super) const GENERATOR: &str = concat!("mist ", env!("CARGO_PKG_VERSION"));

/// Digits of wavelengths and grid nodes; rounding errors do not appear.
const NODE_DIGITS: usize = 12;

/// Tolerance of a uniform spacing, nm.
const UNIFORM: f64 = 1e-6;

/// All lines before `# columns`; `extra` are keys of one format alone.
pub(super) fn header(table: &ColourTable, digits: usize, extra: &[(&str, String)]) -> String {
    let mut text = format!("# {MAGIC}\n");
    let mut line = |key: &str, value: &str| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "# {key} {}", one_line(value));
    };
    line("generator", GENERATOR);
    line("material", &table.material);
    line("quantity", &table.quantity);
    line("incident", &numbers(&table.incident, digits));
    line("frame", &table.frame);
    line("wavelengths", &wavelengths(&table.wavelengths));
    line("interpolation", &table.interpolation);
    line("illuminant", &table.illuminant);
    line("observer", &table.observer);
    line("space", &format!("{} linear", table.space));
    line("adaptation", &table.adaptation);
    line("white", &numbers(&table.white, digits));
    layout_lines(table, &mut line);
    line("patch", &patch(&table.patch));
    for (key, value) in extra {
        line(key, value);
    }
    for a in &table.albedo {
        let [r, g, b] = a.rgb;
        line("albedo", &numbers(&[a.thetai, r, g, b, a.intensity], digits));
    }
    text
}

/// The last header line.
pub(super) fn columns(names: &[String]) -> String {
    let names: Vec<String> =
        names.iter().map(|name| name.replace(char::is_whitespace, "_")).collect();
    format!("# columns {}\n", names.join(" "))
}

/// The patch as the header writes it.
pub(super) fn patch(patch: &RowPatch) -> String {
    match patch {
        RowPatch::Point => "point".to_owned(),
        RowPatch::Circle(alpha) => format!("circle {}", general(*alpha, NODE_DIGITS)),
        RowPatch::Cell => "cell".to_owned(),
        RowPatch::Ring => "ring".to_owned(),
        RowPatch::Other(text) => text.clone(),
    }
}

/// `mirror` or `none`.
pub(super) fn symmetry(symmetry: Symmetry) -> &'static str {
    match symmetry {
        Symmetry::Mirror => "mirror",
        Symmetry::None => "none",
    }
}

/// A wavelength or a node of an axis.
pub(super) fn node(x: f64) -> String {
    general(x, NODE_DIGITS)
}

fn layout_lines(table: &ColourTable, line: &mut impl FnMut(&str, &str)) {
    match &table.layout {
        RowOrder::List => line("layout", &format!("list {}", table.rows.len())),
        RowOrder::Grid { axes, symmetry: half } => {
            line("layout", "grid");
            line("symmetry", symmetry(*half));
            for axis in axes {
                let nodes: Vec<String> = axis.nodes.iter().copied().map(node).collect();
                line("axis", &format!("{} {} {}", axis.name, nodes.len(), nodes.join(" ")));
            }
        }
    }
}

/// `FIRST STEP LAST nm` where the spacing is even, else `list W1 … WN nm`.
fn wavelengths(list: &[f64]) -> String {
    if let [first, second, .., last] = list {
        let step = second - first;
        let even = |(i, w): (usize, &f64)| (first + i as f64 * step - w).abs() < UNIFORM;
        if list.iter().enumerate().all(even) {
            return format!("{} {} {} nm", node(*first), node(step), node(*last));
        }
    }
    let all: Vec<String> = list.iter().copied().map(node).collect();
    format!("list {} nm", all.join(" "))
}

fn numbers(list: &[f64], digits: usize) -> String {
    let texts: Vec<String> = list.iter().map(|x| number(*x, digits)).collect();
    texts.join(" ")
}

/// A value cannot end its line.
fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_wavelengths_are_three_numbers_and_others_a_list() {
        assert_eq!(wavelengths(&[360.0, 370.0, 380.0]), "360 10 380 nm");
        assert_eq!(wavelengths(&[360.0, 375.5]), "list 360 375.5 nm");
        assert_eq!(wavelengths(&[400.0, 410.0, 430.0]), "list 400 410 430 nm");
        assert_eq!(wavelengths(&[550.0]), "list 550 nm");
    }

    #[test]
    fn a_line_break_in_a_name_stays_inside_its_line() {
        assert_eq!(one_line("a\nb"), "a b");
    }
}
