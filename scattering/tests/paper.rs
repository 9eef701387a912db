//! The anisotropic Gaussian slopes and the Sancer shadow function of pigmented coatings: reference
//! values, furnace tests and energy.

mod reference;

use std::f64::consts::{FRAC_PI_2, TAU};

use reference::{FILE, geometry, list, mueller, node, number, relative_difference};
use scattering::{
    Basis, Direction, Geometry, Incidence, Mode, Model, ParameterNode, models,
    shadow::{Shadow, sancer::lambda},
    slope::SlopeDistribution,
    spec,
    special::gauss,
};
use serde_json::Value as Json;

/// The reference values come from formulas evaluated with many digits.
const TOLERANCE: f64 = 1e-10;

fn section(name: &str) -> &'static [Json] {
    list(&FILE["paper_extensions"][name])
}

fn sigmas(check: &Json) -> (String, String) {
    (check["sigma_x"].to_string(), check["sigma_y"].to_string())
}

fn slopes(sigma_x: &str, sigma_y: &str) -> Box<dyn SlopeDistribution> {
    let params = [("sigmax", sigma_x), ("sigmay", sigma_y)];
    let node = node("Anisotropic_Gaussian_Slope_Distribution_Function", &params, Mode::Sound);
    spec::build(&node).unwrap()
}

/// The facet model `class` with anisotropic Gaussian slopes and the Sancer function if `shadow`.
fn facets(class: &str, check: &Json, more: &[(&str, &str)], shadow: bool) -> ParameterNode {
    let (sigma_x, sigma_y) = sigmas(check);
    let mut params = vec![
        ("sdf", "Anisotropic_Gaussian_Slope_Distribution_Function"),
        ("sdf.sigmax", &sigma_x),
        ("sdf.sigmay", &sigma_y),
        ("shadow", if shadow { "Sancer_Shadow_Function" } else { "Unit_Shadow_Function" }),
    ];
    params.extend(more);
    node(class, &params, Mode::Sound)
}

#[test]
fn lambda_agrees_with_the_reference() {
    for check in section("lambda_gaussian") {
        let (theta, sigma) = (number(&check["theta"]), number(&check["sigma"]));
        let expected = number(&check["Lambda"]);
        let got = lambda(1.0 / theta.tan() / (2f64.sqrt() * sigma));
        assert!((got - expected).abs() <= TOLERANCE * expected, "{got:e}: {check}");
    }
}

#[test]
fn the_shadow_function_agrees_with_the_reference() {
    for check in section("sancer_shadow") {
        let (x, y) = sigmas(check);
        let params = [("sigmax", &*x), ("sigmay", &y), ("azimuth", "0")];
        let node = node("Sancer_Shadow_Function", &params, Mode::Sound);
        let at = geometry(check);
        let got =
            spec::build::<dyn Shadow>(&node).unwrap().fraction(&at.incidence(), &at.direction());
        assert!((got - number(&check["S"])).abs() < TOLERANCE, "{got}: {check}");
    }
}

#[test]
fn the_density_of_slopes_agrees_with_the_reference() {
    for check in section("sdf_aniso_gauss") {
        let (x, y) = sigmas(check);
        let zeta = &check["zeta"];
        let got = slopes(&x, &y).density(number(&zeta[0]), number(&zeta[1]));
        let expected = number(&check["value"]);
        assert!((got - expected).abs() < TOLERANCE * expected, "{got}: {check}");
    }
}

fn assert_matrix(node: &ParameterNode, check: &Json) {
    let got = models::build(node).unwrap().mueller(&geometry(check), Basis::Psps);
    let difference = relative_difference(&got, &mueller(&check["mueller"]));
    assert!(difference < TOLERANCE, "{difference:e}: {check}");
}

#[test]
fn the_surface_of_the_paper_agrees_with_the_reference() {
    for check in section("eq6_surface") {
        let params = [("lambda", "0.55"), ("substrate", "(1.3,1.2)")];
        let shadow = check["shadow"].as_bool().unwrap();
        assert_matrix(&facets("Shadowed_Facet_BRDF_Model", check, &params, shadow), check);
    }
}

#[test]
fn the_flakes_of_the_paper_agree_with_the_reference() {
    for check in section("eq8_flake") {
        let params = [("lambda", "0.55"), ("substrate", "(1.3,1.2)"), ("overcoat", "(1.6,0)")];
        let shadow = check["shadow_internal_angles"].as_bool().unwrap();
        let class = "Shadowed_Subsurface_Facet_BRDF_Model";
        assert_matrix(&facets(class, check, &params, shadow), check);
    }
}

/// ∫ M00 cos θ dΩ over the hemisphere.
fn hemisphere(model: &Model, incidence: &Incidence) -> f64 {
    let azimuths = 256;
    let mut sum = 0.0;
    let mut out = vec![scattering::Mueller::ZERO; azimuths];
    for (theta, weight) in gauss::legendre(120, 0.0, FRAC_PI_2) {
        let at = |j: usize| Direction::new(theta, TAU * j as f64 / azimuths as f64);
        let directions: Vec<_> = (0..azimuths).map(at).collect();
        model.evaluate(incidence, &directions, Basis::Psps, &mut out);
        let mean = out.iter().map(|m| m[(0, 0)]).sum::<f64>() / azimuths as f64;
        sum += weight * theta.sin() * theta.cos() * TAU * mean;
    }
    sum
}

#[test]
fn mirror_facets_reflect_what_the_furnace_test_of_the_reference_finds() {
    let check = serde_json::json!({"sigma_x": 0.4, "sigma_y": 0.15});
    // With an imaginary index every facet reflects all light. The jump at equal azimuths has no
    // area, but a quadrature would hit it.
    let mirror = ("substrate", "(0,3)");
    let bare = facets("Shadowed_Facet_BRDF_Model", &check, &[mirror], false);
    let general = [mirror, ("shadow.azimuth", "1")];
    let shadowed = facets("Shadowed_Facet_BRDF_Model", &check, &general, true);
    let (bare, shadowed) = (models::build(&bare).unwrap(), models::build(&shadowed).unwrap());
    for (theta, rotation, without, with) in [
        (0.8, 0.0, 0.9401102, 0.8978018),
        (1.2, 0.0, 1.0461893, 0.9130381),
        (1.45, 0.0, 1.8590610, 0.9618272),
        (1.2, FRAC_PI_2, 0.9328562, 0.8750826),
        (1.45, FRAC_PI_2, 1.0958710, 0.8916091),
    ] {
        let incidence = Incidence::new(theta, rotation);
        let (a, b) = (hemisphere(&bare, &incidence), hemisphere(&shadowed, &incidence));
        assert!((a - without).abs() < 1e-6, "{theta} {rotation}: {a}");
        assert!((b - with).abs() < 1e-6, "{theta} {rotation}: {b}");
    }
}

#[test]
fn facets_in_view_project_to_one_plus_lambda() {
    // The weak furnace: with 1/(1 + Λ_i) alone, mirrors send all the light somewhere.
    let (sigma_x, sigma_y) = (0.4, 0.15);
    let density = slopes("0.4", "0.15");
    for (theta, rotation) in [(0.5f64, 0.3f64), (1.2, 1.0), (1.5, 2.0), (0.9, -0.4)] {
        let (sin_r, cos_r) = rotation.sin_cos();
        let cot = 1.0 / theta.tan();
        let mut seen = 0.0;
        // u along the plane of incidence, v across; facets with u > cot θ face away.
        for (u, weight_u) in gauss::legendre(400, -12.0 * sigma_x, cot.min(12.0 * sigma_x)) {
            for (v, weight_v) in gauss::legendre(200, -12.0 * sigma_x, 12.0 * sigma_x) {
                let s = density.density(u * cos_r + v * sin_r, v * cos_r - u * sin_r);
                seen += weight_u * weight_v * s * (1.0 - u / cot);
            }
        }
        let sigma = (sigma_x * cos_r).hypot(sigma_y * sin_r);
        let expected = 1.0 + lambda(cot / (2f64.sqrt() * sigma));
        assert!((seen / expected - 1.0).abs() < 1e-9, "{theta} {rotation}: {}", seen / expected);
    }
}

#[test]
fn the_jump_at_equal_azimuths_is_made_only_when_asked_for() {
    let fraction = |azimuth: &str, delta: f64| {
        let params = [("sigmax", "0.4"), ("sigmay", "0.4"), ("azimuth", azimuth)];
        let node = node("Sancer_Shadow_Function", &params, Mode::Sound);
        let at = Geometry {
            theta_i: 1.4,
            theta_s: 1.4,
            phi_s: std::f64::consts::PI - delta,
            rotation: 0.0,
        };
        spec::build::<dyn Shadow>(&node).unwrap().fraction(&at.incidence(), &at.direction())
    };
    assert!(
        (fraction("0", 0.0) - 0.662).abs() < 5e-4 && (fraction("0", 1e-6) - 0.495).abs() < 5e-4
    );
    assert_eq!(fraction("1", 0.0), fraction("1", 1e-6));
    assert!((fraction("2", 0.0) - fraction("2", 1e-6)).abs() < 1e-5);
}
