//! Layers over any model.

use super::*;

#[test]
fn layers_that_are_not_there_change_nothing() {
    let at_bottom = [("model", "Microroughness_BRDF_Model")];
    let bare = build("Microroughness_BRDF_Model", &[]);
    for none in [
        &[("layers", "0")][..],
        &[("layer1.thickness", "0")],
        &[("layer1.material", "(1,0)")],
        &[("layer1.material", "(1,0)"), ("layer1.sdf", "Gaussian_Slope_Distribution_Function")],
    ] {
        assert_same(&layered(&[&at_bottom[..], none].concat()), &bare, EXACT, "no layer");
    }
}

#[test]
fn a_split_coat_is_one_coat() {
    for model in ["Facet_BRDF_Model", "Lambertian_BRDF_Model"] {
        let one = layered(&[
            ("model", model),
            ("layer1.material", "(1.6,0.001)"),
            ("layer1.thickness", "30"),
            ("layer1.sdf", "Gaussian_Slope_Distribution_Function"),
        ]);
        let two = layered(&[
            ("model", model),
            ("layers", "2"),
            ("layer1.material", "(1.6,0.001)"),
            ("layer1.thickness", "12"),
            ("layer1.sdf", "Gaussian_Slope_Distribution_Function"),
            ("layer2.material", "(1.6,0.001)"),
            ("layer2.thickness", "18"),
        ]);
        assert_same(&two, &one, EXACT, model);
        // Layers of a layered model lie below those around it.
        let nested = layered(&[
            ("layer1.material", "(1.6,0.001)"),
            ("layer1.thickness", "12"),
            ("layer1.sdf", "Gaussian_Slope_Distribution_Function"),
            ("model", "Layered_BRDF_Model"),
            ("model.model", model),
            ("model.layer1.material", "(1.6,0.001)"),
            ("model.layer1.thickness", "18"),
        ]);
        assert_same(&nested, &one, EXACT, model);
    }
}

#[test]
fn a_lossy_half_absorbs_as_its_own_thickness() {
    let clear = [("layers", "2"), ("layer1.material", "(1.5,0)"), ("layer2.thickness", "20")];
    let lossy = [("layer2.material", "(1.5,0.002)"), ("model", "Facet_BRDF_Model")];
    let one = [
        ("layer1.material", "(1.5,0.002)"),
        ("layer1.thickness", "20"),
        ("model", "Facet_BRDF_Model"),
    ];
    assert_same(&layered(&[&clear[..], &lossy].concat()), &layered(&one), EXACT, "lossy half");
}

#[test]
fn smooth_layers_reflect_between_each_other() {
    // Three media over a body that returns little: T of two interfaces at normal incidence with
    // all reflections between them, (1 − r₁)(1 − r₂)/(1 − r₁ r₂).
    let reflected = |a: f64, b: f64| ((a - b) / (a + b)).powi(2);
    let (r1, r2) = (reflected(1.0, 1.5), reflected(1.5, 2.5));
    let through = (1.0 - r1) * (1.0 - r2) / (1.0 - r1 * r2);
    let tiny = 1e-9;
    let model = layered(&[
        ("layers", "2"),
        ("layer2.material", "(2.5,0)"),
        ("model.reflectance.table", "1e-9"),
    ]);
    let at = Geometry::default();
    let expected = tiny / PI * through * through / (2.5 * 2.5);
    let got = model.mueller(&at, Basis::Psps)[(0, 0)];
    // ρR of the body is below 10⁻⁹.
    assert!((got / expected - 1.0).abs() < 2e-9, "{got} {expected}");
}

#[test]
fn a_pigmented_coating_may_lie_below_a_lacquer() {
    let params = [
        ("model", "Pigmented_Coating_BRDF_Model"),
        ("model.overcoat", "(1.5,0)"),
        ("model.flake_density", "0"),
    ];
    let model = layered(&params);
    for at in geometries() {
        let m = model.mueller(&at, Basis::Psps);
        assert!(m.0.iter().flatten().all(|x| x.is_finite()) && m[(0, 0)] > 0.0);
    }
}

#[test]
fn what_has_no_meaning_is_refused_by_name() {
    for (class, params, parameter) in [
        ("Layered_BRDF_Model", ("model", "ZernikeExpansion_BRDF_Model"), "model"),
        ("Layered_BRDF_Model", ("layers", "5"), "layers"),
        ("Layered_BRDF_Model", ("layer1.thickness", "-1"), "layer1.thickness"),
        ("Layered_BRDF_Model", ("layer1.material", "(0.9,0)"), "layer1.material"),
        ("Layered_BRDF_Model", ("model.lambda", "0.6"), "model.lambda"),
        ("Pigmented_Coating_BRDF_Model", ("correlation", "1.1"), "correlation"),
        ("Pigmented_Coating_BRDF_Model", ("flake_density", "-1"), "flake_density"),
        ("Pigmented_Coating_BRDF_Model", ("particle_density", "1000"), "particle_density"),
        ("Pigmented_Coating_BRDF_Model", ("printed", "3"), "printed"),
        ("Pigmented_Coating_BRDF_Model", ("surface_sdf.sigmax", "0"), "surface_sdf.sigmax"),
        ("Pigmented_Coating_BRDF_Model", ("sdf.s", "0"), "sdf.s"),
    ] {
        let error = models::build(&node(class, &[params], Mode::Sound)).err().unwrap();
        assert_eq!(error.parameter, parameter, "{error}");
    }
}
#[test]
fn anisotropic_layers_over_a_white_body_return_all_light_of_any_polarization() {
    let anisotropic = |name| (name, "Anisotropic_Gaussian_Slope_Distribution_Function");
    let one =
        vec![anisotropic("layer1.sdf"), ("layer1.sdf.sigmax", "0.3"), ("layer1.sdf.sigmay", "0.1")];
    let second = vec![
        ("layers", "2"),
        anisotropic("layer2.sdf"),
        ("layer2.sdf.sigmax", "0.1"),
        ("layer2.sdf.sigmay", "0.3"),
        ("layer2.material", "(1.8,0)"),
    ];
    for params in [one.clone(), [one, second].concat()] {
        let model = layered(&params);
        for (theta, rotation) in [(0.0, 0.4), (0.3, 1.0), (0.7, 0.0), (1.2, 1.0)] {
            let all = hemisphere(&model, theta, rotation, 100);
            // The margin of the tables is 2·10⁻⁴ of what facets return.
            let (least, most) = (2.0 * all[(0, 0)] - most(&all), most(&all));
            assert!(least > 1.0 - 1e-4, "{params:?} {theta} {rotation}: {least}");
            assert!(most < 1.0 + 1e-5, "{params:?} {theta} {rotation}: {most}");
        }
    }
}
