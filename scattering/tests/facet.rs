//! Films, slope distributions, shadow functions and facet models against NIST's library.

mod reference;

use num_complex::Complex64;
use reference::{TOLERANCE, assert_close, component_node, components, number};
use scattering::{
    Direction, Incidence, Mode,
    optics::film::{Films, SpAmplitudes},
    shadow::Shadow,
    slope::SlopeDistribution,
    spec,
    stack::Stack,
};
use serde_json::Value as Json;

fn complex(text: &Json) -> Complex64 {
    let inner = text.as_str().unwrap().trim_matches(['(', ')']);
    let (re, im) = inner.split_once(',').unwrap();
    Complex64::new(re.parse().unwrap(), im.parse().unwrap())
}

/// (index, thickness) of the stack that a check describes.
fn films(check: &Json) -> Vec<(Complex64, f64)> {
    let lambda = number(&check["lambda"]);
    let text = check["stack"].as_str().unwrap();
    if text.starts_with("GradedFilm") {
        let params =
            [("start", "(2.3,0.01)"), ("end", "(1.2,0)"), ("thickness", "0.25"), ("steps", "4")];
        let node = reference::node("GradedFilm_StackModel", &params, Mode::Compat);
        return spec::build::<Stack>(&node).unwrap().at(lambda);
    }
    reference::films(text).iter().map(|f| (f.index.at(lambda), f.thickness)).collect()
}

fn coefficient(check: &Json) -> Complex64 {
    let (n0, nt) = (complex(&check["n0"]), complex(&check["nt"]));
    let name = check["coefficient"].as_str().unwrap();
    let (outer, substrate) = if name.contains("12") { (n0, nt) } else { (nt, n0) };
    let films =
        Films::new(&films(check), outer, substrate, number(&check["lambda"])).with_tiny_loss();
    let kappa = match check.get("internal_angle") {
        Some(angle) => films.kappa_inside(number(angle).sin()),
        None => number(&check["vacuum_angle"]).sin().into(),
    };
    let pair: SpAmplitudes = match (&name[..1], &name[2..4]) {
        ("r", "12") => films.r12(kappa),
        ("r", "21") => films.r21(kappa),
        ("t", "12") => films.t12(kappa),
        ("t", "21") => films.t21(kappa),
        _ => panic!("{name}"),
    };
    if &name[1..2] == "s" { pair.s } else { pair.p }
}

#[test]
fn coefficients_of_stacks_agree_with_the_library() {
    let checks = components("stack");
    assert_eq!(checks.len(), 38);
    for check in checks {
        let value = &check["value"];
        let expected = Complex64::new(number(&value[0]), number(&value[1]));
        assert!((coefficient(check) - expected).norm() < TOLERANCE, "{check}");
    }
}

#[test]
fn slope_distributions_agree_with_the_library() {
    let checks = components("slope_distribution");
    assert_eq!(checks.len(), 24);
    for check in checks {
        let slopes = spec::build::<dyn SlopeDistribution>(&component_node(check, Mode::Compat));
        let (x, y) = (number(&check["zeta"][0]), number(&check["zeta"][1]));
        let got = slopes.unwrap().density(x, y);
        assert_close(got, number(&check["value"]), TOLERANCE, check);
    }
}

#[test]
fn shadow_functions_agree_with_the_library() {
    let checks = components("shadow");
    assert_eq!(checks.len(), 12);
    for check in checks {
        let shadow = spec::build::<dyn Shadow>(&component_node(check, Mode::Compat)).unwrap();
        let [theta_i, theta_s, phi] = [0, 1, 2].map(|k| number(&check["angles"][k]));
        let got = shadow.fraction(&Incidence::new(theta_i, 0.0), &Direction::new(theta_s, phi));
        assert_close(got, number(&check["value"]), TOLERANCE, check);
    }
}

#[test]
fn facet_models_agree_with_the_library() {
    reference::check(&[
        "Facet_BRDF_Model",
        "Shadowed_Facet_BRDF_Model",
        "Subsurface_Facet_BRDF_Model",
    ]);
}
