//! The sign cards of `docs/conventions.md`.

use scattering::{Basis, Class, Geometry, Mode, Mueller, Node, models, optics::Index, spec::Value};

fn class(name: &str) -> &'static Class {
    &models::find(name).expect("the model is there").class
}

/// Facets of index n + ik in the specular direction at `degrees`.
fn facet(n: f64, k: f64, degrees: f64) -> Mueller {
    let node = Node::with_defaults(class("Facet_BRDF_Model"), Mode::Sound)
        .with("substrate", Value::Index(Index::constant(n, k)))
        .unwrap();
    let theta = degrees.to_radians();
    let at = Geometry { theta_i: theta, theta_s: theta, phi_s: 0.0, rotation: 0.0 };
    models::build(&node).unwrap().mueller(&at, Basis::Psps)
}

/// The cards have four digits.
const DIGITS: f64 = 5e-5;

#[test]
fn light_from_glass_at_brewsters_angle_is_s_polarized() {
    let m = facet(1.5, 0.0, 1.5_f64.atan().to_degrees());
    assert!((m[(1, 0)] / m[(0, 0)] - 1.0).abs() < 1e-12);
}

#[test]
fn light_from_a_body_under_a_coat_is_p_polarized() {
    let node = Node::with_defaults(class("Diffuse_Subsurface_BRDF_Model"), Mode::Sound)
        .with("substrate", Value::Index(Index::constant(1.5, 0.0)))
        .unwrap();
    let at = Geometry { theta_s: 60_f64.to_radians(), ..Geometry::default() };
    let m = models::build(&node).unwrap().mueller(&at, Basis::Psps);
    assert!((m[(1, 0)] / m[(0, 0)] + 0.09594).abs() < 5e-6, "{}", m[(1, 0)] / m[(0, 0)]);
}

#[test]
fn a_metal_turns_diagonal_light_right_circular() {
    let m = facet(1.2, 7.0, 60.0);
    // U = +1 in: I = M00 + M02 with M02 = 0 in the plane of incidence.
    let v = m[(3, 2)] / m[(0, 0)];
    assert!((v + 0.3962).abs() < DIGITS, "{v}");
    for k in [2, 3] {
        let element = m[(k, k)] / m[(0, 0)];
        assert!((element + 0.9157).abs() < DIGITS, "{element}");
    }
}

#[test]
fn a_mirror_at_normal_incidence_is_diag_1_1_minus_1_minus_1() {
    let m = facet(1.2, 7.0, 0.0);
    let expected = Mueller::diagonal([1.0, 1.0, -1.0, -1.0]);
    assert!((m * (1.0 / m[(0, 0)]) - expected).largest() < 1e-12);
}

#[test]
fn the_cards_of_the_document_are_these() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/conventions.md");
    let text = std::fs::read_to_string(path).unwrap();
    for card in ["Q/I = +1", "−0.09594", "−0.3962", "−0.9157", "diag(1, 1, −1, −1)"] {
        assert!(text.contains(card), "{card} is missing in docs/conventions.md");
    }
}
