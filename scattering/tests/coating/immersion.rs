//! Models below a coat: index-matched coats vanish, media that are not there change nothing, and
//! rough coats over each other keep the light of a white body.

use scattering::{Basis, Mode, models};

use super::{EXACT, assert_same, build, geometries, hemisphere, layered, most, reference::node};

/// Every model that has a meaning below a coat and is built quickly.
const BELOW: [&str; 12] = [
    "First_Diffuse_BRDF_Model",
    "Facet_BRDF_Model",
    "Microroughness_BRDF_Model",
    "Roughness_Stack_BRDF_Model",
    "Rayleigh_Defect_BRDF_Model",
    "Double_Interaction_BRDF_Model",
    "Polydisperse_Sphere_BRDF_Model",
    "Bobbert_Vlieger_BRDF_Model",
    "RCW_BRDF_Model",
    "Pigmented_Coating_BRDF_Model",
    "Shadowed_Facet_BRDF_Model",
    "OneLayer_BRDF_Model",
];

#[test]
fn a_coat_of_vacuum_changes_no_model() {
    for name in BELOW {
        let bare = build(name, &[]);
        let coated = layered(&[("model", name), ("layer1.material", "(1,0)")]);
        assert_same(&coated, &bare, EXACT, name);
    }
}

#[test]
fn models_below_a_lacquer_scatter_light() {
    for name in BELOW {
        let coated = layered(&[("model", name)]);
        for at in geometries() {
            let m = coated.mueller(&at, Basis::Psps);
            assert!(m.0.iter().flatten().all(|x| x.is_finite()), "{name} at {at:?}");
        }
    }
}

#[test]
fn an_index_matched_coat_on_a_body_that_scatters_once_vanishes() {
    let phase = [
        ("phase_function", "CodeWhitney_Phase_Function"),
        ("phase_function.pcmax", "0.2"),
        ("phase_function.log_absorption", "-2"),
    ];
    let bare = [&[("substrate", "(1.5,0)")], &phase[..]].concat();
    let bare = build("First_Diffuse_BRDF_Model", &bare);
    let coated = layered(&[
        ("substrate", "(1.5,0)"),
        ("model", "First_Diffuse_BRDF_Model"),
        ("model.substrate", "(1.5,0)"),
        ("model.phase_function", "CodeWhitney_Phase_Function"),
        ("model.phase_function.pcmax", "0.2"),
        ("model.phase_function.log_absorption", "-2"),
    ]);
    assert_same(&coated, &bare, EXACT, "an index-matched coat");
}

#[test]
fn a_lacquer_of_the_binder_s_index_leaves_the_body_of_a_pigmented_coating() {
    // The surface of the coating below vanishes in its own index; the lacquer's is smooth.
    let body = layered(&[
        ("model", "Pigmented_Coating_BRDF_Model"),
        ("model.overcoat", "(1.5,0)"),
        ("model.flake_density", "0"),
        ("model.backing.table", "0.001"),
    ]);
    let library = layered(&[("model.reflectance.table", "0.001")]);
    // A dark body: light that comes back to it counts 10⁻³.
    assert_same(&body, &library, 1e-3, "matched lacquer");
}

#[test]
fn rough_coats_over_each_other_lose_no_light_of_a_white_body() {
    let rough = |name: &'static str| (name, "Gaussian_Slope_Distribution_Function");
    for params in [
        &[
            ("layers", "2"),
            rough("layer1.sdf"),
            ("layer1.sdf.s", "0.2"),
            rough("layer2.sdf"),
            ("layer2.sdf.s", "0.3"),
            ("layer2.material", "(1.8,0)"),
        ][..],
        &[
            ("layers", "3"),
            rough("layer1.sdf"),
            ("layer1.material", "(1.8,0)"),
            rough("layer2.sdf"),
            ("layer2.material", "(1.3,0)"),
            rough("layer3.sdf"),
            ("layer3.sdf.s", "0.25"),
            ("layer3.material", "(1.6,0)"),
        ],
    ] {
        let model = layered(params);
        for theta in [0.0, 0.7, 1.3] {
            let all = hemisphere(&model, theta, 0.4, 140);
            assert!((all[(0, 0)] - 1.0).abs() < 1e-3, "{params:?} {theta}: {}", all[(0, 0)]);
            assert!(most(&all) < 1.0 + 1e-3, "{params:?} {theta}: {}", most(&all));
        }
    }
}

#[test]
fn a_rough_coat_split_under_its_surface_is_one_coat() {
    let one = layered(&[
        ("layer1.material", "(1.6,0.001)"),
        ("layer1.thickness", "30"),
        ("layer1.sdf", "Anisotropic_Gaussian_Slope_Distribution_Function"),
        ("layer1.sdf.sigmax", "0.3"),
    ]);
    let three = layered(&[
        ("layers", "3"),
        ("layer1.material", "(1.6,0.001)"),
        ("layer1.thickness", "10"),
        ("layer1.sdf", "Anisotropic_Gaussian_Slope_Distribution_Function"),
        ("layer1.sdf.sigmax", "0.3"),
        ("layer2.material", "(1.6,0.001)"),
        ("layer2.thickness", "15"),
        ("layer3.material", "(1.6,0.001)"),
        ("layer3.thickness", "5"),
    ]);
    assert_same(&three, &one, EXACT, "split");
}

#[test]
fn what_has_no_meaning_below_a_coat_is_refused_where_it_stands() {
    for (params, parameter) in [
        (&[("model", "Rayleigh_Instrument_BRDF_Model")][..], "model"),
        (&[("model", "Transmit_BRDF_Model")], "model"),
        (
            &[("model", "Two_Source_BRDF_Model"), ("model.source2", "ZernikeExpansion_BRDF_Model")],
            "model.source2",
        ),
        (
            &[("model", "RCW_BRDF_Model"), ("model.grating.medium_i", "(1.5,0)")],
            "model.grating.medium_i",
        ),
        (&[("model", "RCW_BRDF_Model"), ("model.grating", "Generic_Grating")], "model.grating"),
    ] {
        let error = models::build(&node("Layered_BRDF_Model", params, Mode::Sound)).err().unwrap();
        assert_eq!(error.parameter, parameter, "{error}");
    }
}

#[test]
fn pigmented_coatings_of_low_index_lie_below_lacquers_of_high_index() {
    let params = [
        ("layer1.material", "(1.7,0)"),
        ("model", "Pigmented_Coating_BRDF_Model"),
        ("model.overcoat", "(1.4,0)"),
        ("model.flake_density", "1e-4"),
    ];
    let model = layered(&params);
    let all = hemisphere(&model, 0.5, 0.0, 60);
    assert!(all[(0, 0)] > 0.2 && all[(0, 0)] < 1.0, "{}", all[(0, 0)]);
}
