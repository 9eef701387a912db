//! The spectra as curves over the wavelength, and the lightness over the angle.

use std::collections::BTreeMap;

use mist_engine::colour::ColourTable;
use mist_format::number::general;
use spectra::{Xyz, lab};

use super::{
    curves::{Graph, Mark, Series},
    display::DisplayColours,
    page::evenly_spaced,
};
use crate::column;

/// Maximum number of curves.
const CURVES: usize = 16;

/// The first row of a curve, and its points.
type FlopCurve = (usize, Vec<(f64, f64)>);

/// The spectra, each in the colour of its row; none if the table has no spectra.
pub(super) fn spectra(table: &ColourTable, display: &DisplayColours) -> Option<Graph> {
    let has_spectrum = |&row: &usize| table.rows[row].spectra[0].len() == table.wavelengths.len();
    let shown = evenly_spaced(table.rows.len(), CURVES).into_iter().filter(has_spectrum);
    let shown: Vec<usize> = shown.collect();
    if table.wavelengths.len() < 2 || shown.is_empty() {
        return None;
    }
    let names = varying(table, &shown);
    let series = shown.iter().map(|&row| Series {
        label: label(table, row, &names),
        points: table.wavelengths.iter().copied().zip(table.rows[row].spectra[0].clone()).collect(),
        mark: Mark::Curve,
        colour: Some(display.hex(table, row)),
    });
    let title = match (shown.len(), table.rows.len()) {
        (some, all) if some < all => format!("spectra of {some} of {all} rows"),
        _ => "spectra".to_owned(),
    };
    let names: Vec<String> = names.iter().map(|(_, name)| with_degrees(name)).collect();
    let by = if names.is_empty() { String::new() } else { format!(", by {}", names.join(" / ")) };
    Some(Graph {
        title: title + &by,
        across: "wavelength (nm)".into(),
        up: quantity(table),
        series: series.collect(),
        is_linear: false,
    })
}

/// The lightness over the angle of scattering, one curve for each of the other angles (the flop of a
/// paint); none if a table has fewer than three angles of scattering.
pub(super) fn flop(table: &ColourTable) -> Option<Graph> {
    let mut curves: BTreeMap<Vec<u64>, FlopCurve> = BTreeMap::new();
    let thetas = table.leading.len() + 1;
    for (at, row) in table.rows.iter().enumerate() {
        let mut place = column::patch_values(row);
        // The solid angle of a cone with a given opening goes with the angle.
        place.truncate(table.leading.len() + 3);
        let angle = place.remove(thetas);
        let key = place.into_iter().map(f64::to_bits).collect();
        let points = &mut curves.entry(key).or_insert((at, Vec::new())).1;
        points.push((angle, lightness(table, at)));
    }
    let mut curves: Vec<FlopCurve> =
        curves.into_values().filter(|(_, points)| points.len() > 2).collect();
    curves.sort_by_key(|(first, _)| *first);
    if curves.len() > CURVES {
        // The plane of incidence tells most.
        let in_plane = |(first, _): &(usize, _)| table.rows[*first].phis == 0.0;
        if curves.iter().any(in_plane) {
            curves.retain(in_plane);
        }
    }
    if curves.is_empty() {
        return None;
    }
    let all = curves.len();
    let kept: Vec<_> = evenly_spaced(all, CURVES).into_iter().map(|at| &curves[at]).collect();
    let firsts: Vec<usize> = kept.iter().map(|(first, _)| *first).collect();
    let names: Vec<(usize, String)> =
        varying(table, &firsts).into_iter().filter(|(at, _)| *at != thetas).collect();
    let series = kept.into_iter().map(|(first, points)| Series {
        label: label(table, *first, &names),
        points: points.clone(),
        ..Series::default()
    });
    let shown: Vec<String> = names.iter().map(|(_, name)| with_degrees(name)).collect();
    let by = if shown.is_empty() { String::new() } else { format!(", by {}", shown.join(" / ")) };
    Some(Graph {
        title: format!("flop: lightness over the angle of scattering{by}"),
        across: "thetas (deg)".into(),
        up: "L* (100: perfect diffuser)".into(),
        series: series.collect(),
        is_linear: true,
    })
}

/// CIE lightness of row `at`; above 100 for colours that are brighter than a perfect diffuser.
pub(super) fn lightness(table: &ColourTable, at: usize) -> f64 {
    let scale = DisplayColours::white_scale(table);
    let [x, y, z] = table.rows[at].xyz[0].map(|value| value * scale);
    let white = Xyz::new(table.white[0], table.white[1], table.white[2]);
    lab::from_xyz(Xyz::new(x, y, z), white).l
}

/// The quantity with its unit in parentheses.
fn quantity(table: &ColourTable) -> String {
    match table.quantity.split_once(' ') {
        Some((name, "1")) => name.to_owned(),
        Some((name, unit)) => format!("{name} ({unit})"),
        None => table.quantity.clone(),
    }
}

/// Positions and names of the columns that differ between `rows`, without the solid angle.
pub(super) fn varying(table: &ColourTable, rows: &[usize]) -> Vec<(usize, String)> {
    let value = |row: usize, at: usize| column::patch_values(&table.rows[row])[at];
    let differs = |at: usize| rows.iter().any(|&row| value(row, at) != value(rows[0], at));
    let names = column::patch_names(table).into_iter().enumerate();
    names.filter(|(at, name)| name != "omega" && differs(*at)).collect()
}

/// The values of row `row` in the columns `names`.
pub(super) fn label(table: &ColourTable, row: usize, names: &[(usize, String)]) -> String {
    let values = column::patch_values(&table.rows[row]);
    names.iter().map(|(at, _)| general(values[*at], 4)).collect::<Vec<_>>().join(" / ")
}

/// The name of a column, with its unit if it is an angle.
pub(super) fn with_degrees(name: &str) -> String {
    if matches!(name, "thetai" | "thetas" | "phis") { format!("{name} (deg)") } else { name.into() }
}
