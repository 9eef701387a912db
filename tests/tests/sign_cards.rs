//! The sign cards of `docs/conventions.md`: every number of its table, computed.
//!
//! The expected numbers are read from the document.

use std::f64::consts::FRAC_1_PI;

use scattering::{
    Basis, Geometry, Mode, Mueller, ParameterNode, ParameterValue, models, optics::RefractiveIndex,
};

const DOCUMENT: &str = include_str!("../../docs/conventions.md");

/// The model `class` on a substrate of index n + ik.
fn model(class: &str, (n, k): (f64, f64)) -> models::Model {
    let class = &models::find(class).expect("the class is in the registry").class;
    let node = ParameterNode::with_defaults(class, Mode::Sound);
    let node =
        node.with("substrate", ParameterValue::Index(RefractiveIndex::constant(n, k))).unwrap();
    models::build(&node).unwrap()
}

/// The matrix of the specular direction at `degrees`, divided by its first element.
fn specular(class: &str, index: (f64, f64), degrees: f64) -> Mueller {
    let theta = degrees.to_radians();
    let at = Geometry { theta_i: theta, theta_s: theta, ..Geometry::default() };
    let m = model(class, index).mueller(&at, Basis::Psps);
    Mueller::from_row_major(m.to_row_major().map(|element| element / m[(0, 0)]))
}

/// The computed value of a card, named as in the first column of the table.
fn card(name: &str) -> f64 {
    const FACET: &str = "Facet_BRDF_Model";
    let glass = || specular(FACET, (1.5, 0.0), 1.5f64.atan().to_degrees());
    let metal = || specular(FACET, (1.2, 7.0), 60.0);
    let mirror = || specular(FACET, (1.2, 7.0), 0.0);
    let body = || specular("Diffuse_Subsurface_BRDF_Model", (1.5, 0.0), 60.0);
    match name {
        "glass Q/I" => glass()[(1, 0)],
        "body Q/I" => body()[(1, 0)],
        "metal V/I" => {
            let m = metal();
            (m[(3, 0)] + m[(3, 2)]) / (m[(0, 0)] + m[(0, 2)])
        }
        "metal M22/M00" => metal()[(2, 2)],
        "metal M33/M00" => metal()[(3, 3)],
        "mirror M11/M00" => mirror()[(1, 1)],
        "mirror M22/M00" => mirror()[(2, 2)],
        "mirror M33/M00" => mirror()[(3, 3)],
        "white M00 pi" => {
            model("Lambertian_BRDF_Model", (1.5, 0.0)).mueller(&Geometry::default(), Basis::Psps)
                [(0, 0)]
                / FRAC_1_PI
        }
        other => panic!("nobody computes the card {other:?}"),
    }
}

/// The rows of the table: name and number as written.
fn rows() -> Vec<(&'static str, &'static str)> {
    let (_, section) = DOCUMENT.split_once("## Sign cards").expect("the section is there");
    let cells = |line: &'static str| line.split('|').map(str::trim).collect::<Vec<_>>();
    section
        .lines()
        .skip_while(|line| !line.starts_with("| ---"))
        .skip(1)
        .take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells = cells(line);
            (cells[1].trim_matches('`'), cells[cells.len() - 2])
        })
        .collect()
}

#[test]
fn every_sign_card_of_the_document_is_what_the_models_give() {
    let rows = rows();
    assert_eq!(rows.len(), 9, "{rows:?}");
    for (name, written) in rows {
        let value: f64 = written.replace('−', "-").parse().expect("a card ends with its number");
        let digits = written.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        // Half a unit of the last digit written, and the rounding of a sum of a few terms.
        let allowed = 0.5 * 10f64.powi(-i32::try_from(digits).unwrap()) + 1e-12;
        let computed = card(name);
        assert!((computed - value).abs() <= allowed, "{name}: {computed}, not {written}");
    }
}

#[test]
fn a_mirror_at_normal_incidence_mixes_nothing() {
    let m = specular("Facet_BRDF_Model", (1.2, 7.0), 0.0);
    for row in 0..4 {
        for column in (0..4).filter(|column| *column != row) {
            assert!(m[(row, column)].abs() < 1e-12, "{row} {column}");
        }
    }
}
