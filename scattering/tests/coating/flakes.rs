//! Light at flakes: between them and the surface, through them, in a binder that absorbs, and the
//! limits of what the model holds.

use std::f64::consts::{FRAC_1_PI, PI};

use scattering::{Basis, Geometry, Mode, ModelLimit, Mueller, models};

use super::{LOST, build, geometries, hemisphere, most, pigmented, reference::node};

/// Lossless transparent flakes under a rough coat.
const PEARL: [(&str, &str); 8] = [
    ("substrate", "(1.5,0)"),
    ("overcoat", "(1.5,0)"),
    ("stack", "SingleFilm_StackModel"),
    ("stack.material", "(2.5,0)"),
    ("stack.thickness", "0.06"),
    ("flake_density", "1e-3"),
    ("surface_sdf.sigmax", "0.15"),
    ("surface_sdf.sigmay", "0.15"),
];

#[test]
fn pearl_over_white_returns_all_light_with_its_exchange() {
    for more in [
        &[("sdf", "Gaussian_Slope_Distribution_Function"), ("sdf.s", "0.3")][..],
        &[
            ("sdf", "Anisotropic_Gaussian_Slope_Distribution_Function"),
            ("sdf.sigmax", "0.3"),
            ("overcoat_films", "SingleFilm_StackModel"),
            ("overcoat_films.material", "(1.8,0)"),
        ],
    ] {
        let params = [&PEARL[..], more, &[("exchange", "1")]].concat();
        let model = pigmented(&params);
        for (theta, rotation) in [(0.0, 0.0), (0.6, 0.4), (1.2, 1.1)] {
            let all = hemisphere(&model, theta, rotation, 120);
            // The tables are off by a few 10⁻⁴ on the side of loss.
            assert!((all[(0, 0)] - 1.0).abs() < 1e-3, "{more:?} {theta}: {}", all[(0, 0)]);
            assert!(most(&all) < 1.0 + 1e-6, "{more:?} {theta}: {}", most(&all));
        }
    }
}

#[test]
fn exchange_adds_light_and_keeps_reciprocity() {
    let metal = [
        ("substrate", "(0.9,6)"),
        ("sdf", "Anisotropic_Gaussian_Slope_Distribution_Function"),
        ("sdf.sigmay", "0.25"),
        ("flake_density", "2e-4"),
        ("backing.table", "0.5"),
    ];
    let without = pigmented(&metal);
    let with = pigmented(&[&metal[..], &[("exchange", "1")]].concat());
    let pearl = pigmented(&[&PEARL[..], &[("exchange", "1"), ("backing.table", "0.5")]].concat());
    let p = Mueller::diagonal([1.0, 1.0, -1.0, 1.0]);
    for at in geometries() {
        let (more, less) = (with.mueller(&at, Basis::Psps), without.mueller(&at, Basis::Psps));
        assert!(more[(0, 0)] > less[(0, 0)], "{at:?}");
        for model in [&with, &pearl] {
            let m = model.mueller(&at, Basis::Psps);
            let back = Geometry {
                theta_i: at.theta_s,
                theta_s: at.theta_i,
                phi_s: -at.phi_s,
                rotation: at.rotation + PI - at.phi_s,
            };
            let reversed = model.mueller(&back, Basis::Psps) - p * m.transposed() * p;
            assert!(reversed.largest() < 1e-10 * m.largest(), "{at:?}");
        }
    }
}

#[test]
fn a_binder_that_absorbs_dims_body_and_flakes_as_beer_has_it() {
    // Without a surface, in air that absorbs: κL = 0.3.
    let k = 0.3 * 0.532 / (4.0 * PI * 30.0);
    let air = format!("(1,{k})");
    let at = Geometry { theta_i: 0.5, theta_s: 0.9, phi_s: 0.4, rotation: 0.0 };
    let ways = 1.0 / at.theta_i.cos() + 1.0 / at.theta_s.cos();
    let body = pigmented(&[("overcoat", &air), ("flake_density", "0"), ("backing.table", "0.4")]);
    let seen = body.mueller(&at, Basis::Psps)[(0, 0)];
    assert!((seen / (0.4 * FRAC_1_PI * (-0.3 * ways).exp()) - 1.0).abs() < 1e-9, "{seen}");
    // ω_s = τ(1 − e^{−E})/E with E = τ + κL(1/cos θ_i + 1/cos θ_s), τ = 0.9.
    let sdf = ("sdf", "Gaussian_Slope_Distribution_Function");
    let flakes = |air: &str| {
        pigmented(&[("overcoat", air), ("backing.table", "0"), sdf, ("flake_density", "1e-4")])
    };
    let ratio = flakes(&air).mueller(&at, Basis::Psps)[(0, 0)]
        / flakes("(1,0)").mueller(&at, Basis::Psps)[(0, 0)];
    let e: f64 = 0.9 + 0.3 * ways;
    let expected = 0.9 * (1.0 - (-e).exp()) / e / (1.0 - (-0.9f64).exp());
    assert!((ratio / expected - 1.0).abs() < 1e-9, "{ratio} {expected}");
}

#[test]
fn few_flakes_under_a_nearly_smooth_coat_are_the_library_s_with_their_weight() {
    // τ = 40 covers all; the rough surface lets pass what a smooth one does but for 10⁻³.
    let shared = [
        ("overcoat", "(1.5,0)"),
        ("sdf", "Gaussian_Slope_Distribution_Function"),
        ("sdf.s", "0.3"),
    ];
    let library = build(
        "Shadowed_Subsurface_Facet_BRDF_Model",
        &[&shared[..], &[("shadow", "Sancer_Shadow_Function")]].concat(),
    );
    let own = [
        ("surface_sdf.sigmax", "0.002"),
        ("surface_sdf.sigmay", "0.002"),
        ("flake_density", "0.00444"),
        ("backing.table", "0"),
    ];
    let coating = pigmented(&[&shared[..], &own].concat());
    for at in geometries() {
        let (a, b) = (coating.mueller(&at, Basis::Psps), library.mueller(&at, Basis::Psps));
        assert!((a - b).largest() < 3e-3 * b.largest(), "{at:?}");
    }
}

#[test]
fn a_model_beyond_its_limits_says_so() {
    let noted = |params: &[(&str, &str)]| {
        let node = node("Pigmented_Coating_BRDF_Model", params, Mode::Sound);
        models::build(&node).unwrap();
        let met = node.notices.lock().unwrap();
        met.iter().copied().collect::<Vec<_>>()
    };
    assert!(noted(&[]).is_empty());
    // 30 spheres of radius 0.1 µm in a µm³ fill an eighth of it.
    assert_eq!(noted(&[("particle_density", "30")]), [ModelLimit::ParticlesTooDense.into()]);
    let tilted = [
        ("sdf", "Gaussian_Slope_Distribution_Function"),
        ("sdf.s", "0.3"),
        ("flake_density", "0.001"),
    ];
    assert_eq!(noted(&tilted), [ModelLimit::FlakesTooDense.into()]);
    assert_eq!(noted(&[("correlation", "0")]), [ModelLimit::LostBetweenFlakes.into()]);
}

#[test]
fn the_margin_of_the_tables_is_what_a_white_body_lacks() {
    let all = hemisphere(&pigmented(&[("flake_density", "0")]), 0.5, 0.0, 160)[(0, 0)];
    assert!(all < 1.0 && all > 1.0 - LOST, "{all}");
}
