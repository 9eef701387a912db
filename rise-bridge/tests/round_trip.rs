//! Written tables are read again; truncated tables are refused.

mod laws;

use mist_engine::colour::{
    Albedo, ColourRow, ColourTable, RowOrder, RowPatch, Symmetry, TableAxis,
};
use rise_bridge::{
    read::{self, ReadError},
    write::{self, Style, WriteError},
};

const ORANGE: &str = include_str!("data/orange_paint.mtab");

const EXACT: Style = Style { digits: 17, xyz: true };

/// A grid of 1 × 2 × 3 nodes with all that a table can have; numbers need all their digits.
fn full() -> ColourTable {
    let row = |i: usize| {
        let x = |k: usize| (i * 31 + k) as f64 / 7.0 - 3.0;
        ColourRow {
            leading: vec![0.1 * i as f64],
            thetai: 30.0,
            thetas: [0.0, 45.0][i / 3],
            phis: [0.0, 90.0, 180.0][i % 3],
            omega: 1e-3 / 3.0,
            rgb: [0, 3, 6, 9].map(|k| [x(k), x(k + 1), x(k + 2)]),
            xyz: [[x(20), x(21), x(22)], [0.0, x(24), 0.0], [0.0, x(27), 0.0], [0.0, x(30), 0.0]],
            spectra: [40, 50, 60, 70].map(|k| vec![x(k), x(k + 1), x(k + 2)]),
            flags: (i % 8) as u8,
        }
    };
    let axis = |name: &str, nodes: &[f64]| TableAxis { name: name.into(), nodes: nodes.to_vec() };
    ColourTable {
        material: "a b µ".into(),
        quantity: "brdf 1/sr".into(),
        incident: [1.0, 0.0, -0.5, 0.1],
        frame: "psps".into(),
        wavelengths: vec![450.0, 550.5, 700.0],
        interpolation: "spline hold".into(),
        illuminant: "A".into(),
        observer: "CIE1964_10".into(),
        space: "Rec2020".into(),
        adaptation: "CAT16".into(),
        white: [1.1, 1.0, 1.0 / 3.0],
        layout: RowOrder::Grid {
            axes: vec![
                axis("thetai", &[30.0]),
                axis("thetas", &[0.0, 45.0]),
                axis("phis", &[0.0, 90.0, 180.0]),
            ],
            symmetry: Symmetry::Mirror,
        },
        patch: RowPatch::Cell,
        leading: vec!["thickness".into()],
        stokes: 4,
        rows: (0..6).map(row).collect(),
        albedo: vec![Albedo { thetai: 30.0, rgb: [0.5, 0.25, 1.0 / 3.0], intensity: 0.3 }],
        warnings: Vec::new(),
    }
}

fn without_spectra(mut table: ColourTable) -> ColourTable {
    for row in &mut table.rows {
        row.spectra = Default::default();
    }
    table
}

#[test]
fn the_orange_paint_reads_and_writes_back_byte_for_byte() {
    let table = read::mtab(ORANGE).unwrap();
    assert_eq!(table.wavelengths.len(), 40);
    assert_eq!(table.patch, RowPatch::Circle(2.0));
    assert_eq!((table.stokes, table.rows.len()), (3, 4));
    assert_eq!(table.rows[2].flags, ColourRow::OUT_OF_GAMUT);
    assert_eq!(write::mtab(&table, Style::default()).unwrap(), ORANGE);
}

#[test]
fn a_polarizer_that_removes_s_brings_the_colour_back() {
    let table = read::mtab(ORANGE).unwrap();
    let specular = &table.rows[0];
    let behind = |k: usize| (specular.rgb[0][k] - specular.rgb[1][k]) / 2.0;
    // R : G as the table's nine digits give them, to the digits stated here.
    assert!((specular.rgb[0][0] / specular.rgb[0][1] - 1.80).abs() < 5e-3);
    assert!((behind(0) / behind(1) - 3.95).abs() < 5e-3);
}

#[test]
fn seventeen_digits_bring_every_bit_back() {
    let table = full();
    let back = read::mtab(&write::mtab(&table, EXACT).unwrap()).unwrap();
    assert_eq!(back, without_spectra(table));
}

#[test]
fn spectra_come_back_to_the_bit_for_every_component() {
    let table = full();
    for component in 0..4 {
        let text = write::mspd(&table, component, EXACT).unwrap();
        let back = read::mspd(&text).unwrap();
        assert_eq!(back.component, ['I', 'Q', 'U', 'V'][component]);
        assert_eq!(back.table.wavelengths, table.wavelengths);
        for (row, original) in back.rows.iter().zip(&table.rows) {
            assert_eq!(row.values, original.spectra[component]);
            assert_eq!(row.leading, original.leading);
        }
    }
}

#[test]
fn json_has_the_keys_of_the_text_and_the_same_bits() {
    let table = full();
    let text = write::mtab(&table, EXACT).unwrap();
    let json: serde_json::Value =
        serde_json::from_str(&write::json(&table, true).unwrap()).unwrap();
    for line in text.lines().filter_map(|line| line.strip_prefix("# ")).skip(1) {
        let key = line.split(' ').next().unwrap();
        assert!(json.get(key).is_some(), "{key}");
    }
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    for (row, values) in rows.zip(json["rows"].as_array().unwrap()) {
        let row: Vec<f64> = row.split(' ').map(|word| word.parse().unwrap()).collect();
        let values: Vec<f64> =
            values.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
        assert_eq!(row, values);
    }
}

#[test]
fn every_cut_is_found() {
    // All but the last line break, without which the table is still whole.
    for end in 0..ORANGE.len() - 1 {
        assert!(read::mtab(&ORANGE[..end]).is_err(), "cut at {end}");
    }
    let cut = ORANGE.split_inclusive('\n').take(18).collect::<String>();
    assert_eq!(read::mtab(&cut), Err(ReadError::Truncated(2)));
}

#[test]
fn a_changed_digit_is_found() {
    let changed = ORANGE.replace("0.265840164", "0.265840165");
    assert!(matches!(read::mtab(&changed), Err(ReadError::Checksum { .. })));
}

#[test]
fn defects_are_named_with_their_line() {
    let cases = [
        ("# MIST-TABLE 1\n", "# MIST-TABLE 2\n", "line 1: the first line"),
        ("# white 0.950470559 1", "# white 0.950470559", "line 13: white: 3 numbers are expected"),
        ("# space sRGB linear", "# space sRGB", "line 11: space: only linear values"),
        ("# illuminant D65\n", "", "the header has no line \"# illuminant\""),
        ("360 10 750 nm", "360 -10 750 nm", "line 7: wavelengths: the steps"),
        ("layout list 4", "layout list 5", "4 rows where \"# layout\" says 5"),
        ("# columns", "# column", "the header has no line \"# columns\""),
        ("45 60 0 ", "45 sixty 0 ", "line 18, column thetas: \"sixty\""),
        ("45 60 0 ", "45 nan 0 ", "line 18, column thetas: \"nan\""),
        ("45 60 0 ", "60 0 ", "line 18: 16 numbers for 17 columns"),
        ("space sRGB linear", "space \0\0 linear", "line 11, column 9: the control character"),
        ("45 60 0 ", "45\u{c}60 0 ", "line 18, column 3: the control character"),
        ("# end 4", "# end 5", "4 rows where \"# end\" says 5"),
        ("f0\n", "f0\n1 2 3\n", "line 22: text after"),
    ];
    for (from, to, expected) in cases {
        assert!(ORANGE.contains(from), "{from:?}");
        let error = read::mtab(&ORANGE.replace(from, to)).unwrap_err().to_string();
        assert!(error.starts_with(expected), "{error:?} for {to:?}");
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused_with_their_place() {
    let mut table = full();
    table.rows[1].rgb[0][1] = f64::NAN;
    let error = write::mtab(&table, Style::default()).unwrap_err();
    assert_eq!(error.to_string(), "row 2 has NaN in column G: tables hold finite numbers only");
    assert!(write::json(&table, false).is_err());
}

#[test]
fn a_missing_spectrum_is_refused() {
    let mut table = full();
    table.rows[4].spectra[1].clear();
    assert!(write::mspd(&table, 0, Style::default()).is_ok());
    let error = write::mspd(&table, 1, Style::default()).unwrap_err();
    assert_eq!(error, WriteError::NoSpectrum { row: 5, component: 'Q' });
}

#[test]
fn the_picture_shows_every_swatch_and_every_curve() {
    let svg = write::plot(&full());
    assert_eq!(svg.matches("<title>").count(), 6);
    assert_eq!(svg.matches("<polyline").count(), 12);
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    assert!(!svg.contains("NaN"), "{svg}");
}

#[test]
fn a_reflectance_of_one_is_white_and_brighter_colours_state_their_exposure() {
    let mut table = full();
    (table.quantity, table.space) = ("reflectance 1".into(), "sRGB".into());
    for (row, value) in table.rows.iter_mut().zip([0.25, 0.5, 1.0, 0.1, 0.1, 0.1]) {
        row.rgb[0] = [value; 3];
        row.xyz[0] = [0.9505 * value, value, 1.0888 * value];
    }
    let svg = write::plot(&table);
    // In the line of swatches and in the strip of lightness.
    assert_eq!(svg.matches("fill=\"#ffffff\"").count(), 2);
    // sRGB of 0.25 and 0.5.
    assert!(svg.contains("fill=\"#898989\"") && svg.contains("fill=\"#bcbcbc\""), "{svg}");
    assert!(svg.contains("white is a perfect diffuser") && !svg.contains("brighter"));
    table.rows[0].rgb[0] = [4.0, 2.0, 0.0];
    let svg = write::plot(&table);
    assert!(svg.contains("fill=\"#ffbc00\"") && svg.contains("exposure 0.25"), "{svg}");
    assert!(svg.contains("1 are brighter than white"), "{svg}");
}

#[test]
fn whatever_is_read_is_written_and_read_again() {
    let table = full();
    let grid = write::mtab(&table, EXACT).unwrap();
    for text in [ORANGE, &grid] {
        laws::mtab(text);
        // Every line left out, doubled, or with its first number changed.
        for line in text.split_inclusive('\n') {
            laws::mtab(&text.replacen(line, "", 1));
            laws::mtab(&text.replacen(line, &line.repeat(2), 1));
            for word in ["-1e300", "nan", "inf", "1e-320", "0"] {
                let changed = line.replacen(|c: char| c.is_ascii_digit(), word, 1);
                laws::mtab(&text.replacen(line, &changed, 1));
            }
        }
    }
    // Tabs in a header become blanks.
    laws::mtab(&ORANGE.replace("sprague hold", "sprague\thold"));
    laws::mspd(&write::mspd(&table, 0, EXACT).unwrap());
}
