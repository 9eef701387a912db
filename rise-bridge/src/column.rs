//! The columns of a text table: names and values.

use mist_engine::colour::{ColourRow, ColourTable};

/// Letter that ends the names of a Stokes component's columns; none for I.
pub(crate) const STOKES: [&str; 4] = ["", "Q", "U", "V"];

/// The angles and the solid angle of the patch: columns of every table.
pub(crate) const PATCH: [&str; 4] = ["thetai", "thetas", "phis", "omega"];

/// The tristimulus values of the unfiltered colour.
pub(crate) const XYZ: [&str; 3] = ["X", "Y", "Z"];

/// The last column of a colour table.
pub(crate) const FLAGS: &str = "flags";

/// Red, green, blue and intensity of the Stokes component `at`: `R G B I` or `RQ GQ BQ IQ`.
pub(crate) fn colour_names(at: usize) -> [String; 4] {
    ["R", "G", "B", "I"].map(|channel| format!("{channel}{}", STOKES[at]))
}

/// Names of the columns of a colour table.
pub(crate) fn names(table: &ColourTable, with_xyz: bool) -> Vec<String> {
    let mut names = patch_names(table);
    names.extend((0..table.stokes).flat_map(colour_names));
    if with_xyz {
        names.extend(XYZ.map(str::to_owned));
    }
    names.push(FLAGS.to_owned());
    names
}

/// The numbers of one row of a colour table, without the flags.
pub(crate) fn values(table: &ColourTable, row: &ColourRow, with_xyz: bool) -> Vec<f64> {
    let mut values = patch_values(row);
    for (rgb, xyz) in row.rgb.iter().zip(&row.xyz).take(table.stokes) {
        values.extend(rgb);
        values.push(xyz[1]);
    }
    if with_xyz {
        values.extend(row.xyz[0]);
    }
    values
}

/// Names of the leading columns, the angles and the solid angle.
pub(crate) fn patch_names(table: &ColourTable) -> Vec<String> {
    table.leading.iter().cloned().chain(PATCH.map(str::to_owned)).collect()
}

/// The numbers under [`patch_names`].
pub(crate) fn patch_values(row: &ColourRow) -> Vec<f64> {
    let mut values = row.leading.clone();
    values.extend([row.thetai, row.thetas, row.phis, row.omega]);
    values
}
