//! Power spectral densities, roughness models and small spheres against NIST's library.

mod reference;

use reference::{TOLERANCE, assert_close, check, component_node, components, number};
use scattering::{Mode, psd::Psd, spec};

#[test]
fn spectral_densities_agree_with_the_library() {
    let checks = components("psd");
    assert_eq!(checks.len(), 45);
    for check in checks {
        let psd = spec::build::<dyn Psd>(&component_node(check, Mode::Compat)).unwrap();
        let got = psd.density(number(&check["f"][0]), number(&check["f"][1]));
        let expected = number(&check["value"]);
        if expected.is_infinite() {
            assert_eq!(got, expected, "{check}");
        } else {
            assert_close(got, expected, TOLERANCE, check);
        }
    }
}

#[test]
fn bare_surfaces_agree_with_the_library() {
    check(&["Microroughness_BRDF_Model"]);
}

#[test]
fn rough_films_agree_with_the_library() {
    check(&[
        "Roughness_Stack_BRDF_Model",
        "Correlated_Roughness_Stack_BRDF_Model",
        "Uncorrelated_Roughness_Stack_BRDF_Model",
        "Growth_Roughness_Stack_BRDF_Model",
        "Correlated_Roughness_BRDF_Model",
        "Two_Face_BRDF_Model",
    ]);
}

#[test]
fn small_spheres_agree_with_the_library() {
    check(&["Rayleigh_Defect_BRDF_Model", "Rayleigh_Stack_BRDF_Model", "OneLayer_BRDF_Model"]);
}
