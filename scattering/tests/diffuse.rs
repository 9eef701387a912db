//! Diffuse bodies, reflectances and phase functions against NIST's library.

mod reference;

use reference::{TOLERANCE, assert_close, component_node, components, number, relative_difference};
use scattering::{
    Mode, phase::Phase, polarized_phase::PolarizedPhase, reflectance::Reflectance, spec,
};

#[test]
fn diffuse_models_agree_with_the_library() {
    reference::check(&[
        "Lambertian_BRDF_Model",
        "Diffuse_Subsurface_BRDF_Model",
        "First_Diffuse_BRDF_Model",
    ]);
}

#[test]
fn reflectances_agree_with_the_library() {
    let checks = components("reflectance");
    assert_eq!(checks.len(), 3);
    for check in checks {
        let node = component_node(check, Mode::Compat);
        let reflectance = spec::build::<dyn Reflectance>(&node).unwrap();
        // Coefficients of these checks do not depend on the wavelength.
        assert_close(reflectance.at(0.55), number(&check["value"]), TOLERANCE, check);
    }
}

#[test]
fn scalar_phase_functions_agree_with_the_library() {
    let checks = components("phase_function");
    assert_eq!(checks.len(), 24);
    for check in checks {
        let phase = spec::build::<dyn Phase>(&component_node(check, Mode::Compat)).unwrap();
        let got = phase.at_cosine(number(&check["theta"]).cos());
        assert_close(got, number(&check["value"]), TOLERANCE, check);
    }
}

#[test]
fn phase_matrices_agree_with_the_library() {
    let checks = components("polarized_phase_function");
    assert_eq!(checks.len(), 12);
    for check in checks {
        let node = component_node(check, Mode::Compat);
        let phase = spec::build::<dyn PolarizedPhase>(&node).unwrap();
        let got = phase.at_cosine(number(&check["scattering_angle"]).cos());
        let difference = relative_difference(&got, &reference::mueller(&check["f_parperp"]));
        assert!(difference < TOLERANCE, "{difference:e}: {check}");
        assert_close(phase.absorption(), number(&check["absorption"]), TOLERANCE, check);
        assert_close(phase.scattering(), number(&check["scattering"]), TOLERANCE, check);
    }
}
