//! Pigmented and layered coatings: energy, limits, and the printed form of the paper's body.

#[path = "coating/energy.rs"]
mod energy;
#[path = "coating/flakes.rs"]
mod flakes;
#[path = "coating/immersion.rs"]
mod immersion;
#[path = "coating/layers.rs"]
mod layers;
#[path = "coating/printed.rs"]
mod printed;
mod reference;
#[path = "coating/walk.rs"]
mod walk;
#[path = "coating/witness.rs"]
mod witness;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use reference::{FILE, list, node, number};
use scattering::{
    Basis, Direction, Geometry, Incidence, Mode, Model, Mueller, models, special::gauss,
};

/// Limits hold to rounding.
const EXACT: f64 = 1e-12;

fn build(class: &str, params: &[(&str, &str)]) -> Model {
    let node = node(class, params, Mode::Sound);
    models::build(&node).unwrap_or_else(|error| panic!("{params:?}: {error}"))
}

fn pigmented(params: &[(&str, &str)]) -> Model {
    build("Pigmented_Coating_BRDF_Model", params)
}

fn layered(params: &[(&str, &str)]) -> Model {
    build("Layered_BRDF_Model", params)
}

fn geometries() -> [Geometry; 4] {
    let at = |theta_i, theta_s, phi_s, rotation| Geometry { theta_i, theta_s, phi_s, rotation };
    [
        at(0.5, 0.6, 0.7, 0.1),
        at(1.1, 0.2, -2.3, 0.9),
        at(1.4, 1.3, 3.0, -1.2),
        at(0.9, 1.0, 0.1, 2.0),
    ]
}

fn assert_same(a: &Model, b: &Model, tolerance: f64, what: &str) {
    for at in geometries() {
        let (a, b) = (a.mueller(&at, Basis::Psps), b.mueller(&at, Basis::Psps));
        // Densities of slopes may underflow on one side.
        let difference = (a - b).largest();
        let bound = tolerance * b.largest() + 1e-30;
        assert!(difference <= bound, "{what} at {at:?}: {difference:e} > {bound:e}");
    }
}

/// ∫ F cos θ dΩ.
fn hemisphere(model: &Model, theta_i: f64, rotation: f64, nodes: usize) -> Mueller {
    let azimuths = 2 * nodes;
    let incidence = Incidence::new(theta_i, rotation);
    let mut out = vec![Mueller::ZERO; azimuths];
    let mut sum = Mueller::ZERO;
    for (theta, weight) in gauss::legendre(nodes, 0.0, FRAC_PI_2) {
        let at = |j: usize| Direction::new(theta, TAU * (j as f64 + 0.5) / azimuths as f64);
        let directions: Vec<_> = (0..azimuths).map(at).collect();
        model.evaluate(&incidence, &directions, Basis::Psps, &mut out);
        for m in &out {
            sum += *m * (weight * theta.sin() * theta.cos() * TAU / azimuths as f64);
        }
    }
    sum
}

/// The most that comes back of any polarization.
fn most(row: &Mueller) -> f64 {
    row[(0, 0)] + (1..4).map(|k| row[(0, k)] * row[(0, k)]).sum::<f64>().sqrt()
}

/// The table of what a rough surface returns is too large by 2·10⁻⁴ of itself at most.
const LOST: f64 = 2.1e-4;

#[test]
fn a_white_body_under_any_rough_coat_returns_all_light() {
    for (n, x, y) in [("1.5", "0.2", "0.2"), ("1.33", "0.4", "0.15"), ("1.8", "0.1", "0.3")] {
        let index = format!("({n},0)");
        let params = [
            ("overcoat", &*index),
            ("surface_sdf.sigmax", x),
            ("surface_sdf.sigmay", y),
            ("flake_density", "0"),
        ];
        let model = pigmented(&params);
        for (theta, rotation) in [(0.0, 0.0), (0.7, 0.4), (1.2, 0.4), (1.4, 1.1)] {
            let all = hemisphere(&model, theta, rotation, 160);
            assert!((all[(0, 0)] - 1.0).abs() < LOST, "{params:?} {theta}: {}", all[(0, 0)]);
            assert!(most(&all) < 1.0 + 1e-6, "{params:?} {theta}: {}", most(&all));
        }
    }
}

#[test]
fn a_rough_lacquer_over_a_white_body_returns_all_light() {
    let model = layered(&[
        ("layer1.sdf", "Gaussian_Slope_Distribution_Function"),
        ("layer1.sdf.s", "0.3"),
        ("layer1.shadow.azimuth", "1"),
    ]);
    for theta in [0.0, 0.8, 1.4] {
        let all = hemisphere(&model, theta, 0.0, 120);
        assert!((all[(0, 0)] - 1.0).abs() < LOST, "{theta}: {}", all[(0, 0)]);
    }
}

#[test]
fn anisotropic_coatings_obey_reciprocity_and_mirror_symmetry() {
    let anisotropic =
        |name: &'static str| (name, "Anisotropic_Gaussian_Slope_Distribution_Function");
    let models = [
        pigmented(&[
            ("substrate", "(1.59,0)"),
            ("stack", "SingleFilm_StackModel"),
            ("stack.material", "(2.4,0.01)"),
            ("stack.thickness", "0.08"),
            ("flake_spread", "0.1"),
            anisotropic("sdf"),
            ("sdf.sigmay", "0.3"),
            ("surface_sdf.sigmax", "0.3"),
            ("surface_shadow.azimuth", "2"),
        ]),
        layered(&[
            ("layers", "2"),
            anisotropic("layer1.sdf"),
            ("layer1.sdf.sigmay", "0.3"),
            anisotropic("layer2.sdf"),
            ("layer2.sdf.sigmax", "0.3"),
            ("layer2.material", "(1.8,0.001)"),
            ("model", "Microroughness_BRDF_Model"),
        ]),
    ];
    let p = Mueller::diagonal([1.0, 1.0, -1.0, 1.0]);
    let q = Mueller::diagonal([1.0, 1.0, -1.0, -1.0]);
    for model in &models {
        for at in geometries() {
            let m = model.mueller(&at, Basis::Psps);
            let back = Geometry {
                theta_i: at.theta_s,
                theta_s: at.theta_i,
                phi_s: -at.phi_s,
                rotation: at.rotation + PI - at.phi_s,
            };
            let image = Geometry { phi_s: -at.phi_s, rotation: -at.rotation, ..at };
            let reversed = model.mueller(&back, Basis::Psps) - p * m.transposed() * p;
            let mirrored = model.mueller(&image, Basis::Psps) - q * m * q;
            // Rounding of steep slopes.
            assert!(reversed.largest() < 1e-10 * m.largest(), "{at:?}");
            assert!(mirrored.largest() < 1e-10 * m.largest(), "{at:?}");
        }
    }
}

#[test]
fn transmitting_flakes_show_the_body_and_spread_only_their_colour() {
    let flakes = |more: &[(&'static str, &'static str)]| {
        let films = [
            ("substrate", "(1.5,0)"),
            ("overcoat", "(1.5,0)"),
            ("stack", "SingleFilm_StackModel"),
            ("stack.material", "(2.5,0)"),
            ("stack.thickness", "0.06"),
            ("flake_density", "1e-3"),
        ];
        let model = pigmented(&[&films[..], more].concat());
        hemisphere(&model, 0.5, 0.0, 100)[(0, 0)]
    };
    let (white, black) = (flakes(&[]), flakes(&[("backing.table", "0")]));
    assert!(white > black + 0.3 && white < 1.0, "{white} {black}");
    let opaque = flakes(&[("substrate", "(1.5,1e-9)")]);
    assert!((opaque - black).abs() < 1e-3, "{opaque} {black}");
    let spread = flakes(&[("flake_spread", "0.1"), ("backing.table", "0")]);
    assert!((spread - black).abs() < 0.05, "{spread} {black}");
}

#[test]
fn without_pigment_and_backing_only_the_surface_is_left() {
    let params = [("flake_density", "0"), ("backing.table", "0"), ("surface_sdf.sigmax", "0.3")];
    let surface = build(
        "Shadowed_Facet_BRDF_Model",
        &[
            ("substrate", "(1.59,0)"),
            ("sdf", "Anisotropic_Gaussian_Slope_Distribution_Function"),
            ("sdf.sigmax", "0.3"),
            ("shadow", "Sancer_Shadow_Function"),
        ],
    );
    assert_same(&pigmented(&params), &surface, EXACT, "no pigment");
}

#[test]
fn opaque_flakes_in_air_are_the_library_s_facets() {
    // With a coat of air nothing else is left; e^{−τ} is below 10⁻³⁹.
    let params = [
        ("overcoat", "(1,0)"),
        ("sdf", "Gaussian_Slope_Distribution_Function"),
        ("flake_density", "0.01"),
    ];
    let facets = build(
        "Shadowed_Facet_BRDF_Model",
        &[("sdf", "Gaussian_Slope_Distribution_Function"), ("shadow", "Sancer_Shadow_Function")],
    );
    assert_same(&pigmented(&params), &facets, EXACT, "opaque flakes");
}

#[test]
fn flakes_that_are_not_there_pass_all_light_to_the_body() {
    // Films of the binder's index do not reflect: the body is seen as if there were no flakes.
    let body = [("overcoat", "(1.5,0)"), ("backing.table", "0.6")];
    let with = |more: &[(&'static str, &'static str)]| pigmented(&[&body[..], more].concat());
    let invisible = with(&[("substrate", "(1.5,0)"), ("flake_density", "1e-4")]);
    let none = with(&[("flake_density", "0")]);
    // Flakes that lie flat pass s and p alone; of the oblique row 10⁻⁴ is at stake.
    assert_same(&invisible, &none, 1e-3, "invisible flakes");
    // A coat without thickness has no flakes and no particles.
    let thin = with(&[("thickness", "0"), ("particle_density", "3")]);
    assert_same(&thin, &none, EXACT, "no thickness");
}

#[test]
fn the_body_as_printed_agrees_with_the_reference() {
    for check in list(&FILE["paper_extensions"]["eq9_literal"]) {
        let (n, alpha) = (format!("({},0)", check["n"]), check["alpha"].to_string());
        let body = pigmented(&[
            ("overcoat", &n),
            ("backing.table", &alpha),
            ("flake_density", "0"),
            ("printed", "1"),
        ]);
        let surface =
            pigmented(&[("overcoat", &n), ("backing.table", "0"), ("flake_density", "0")]);
        let at = Geometry {
            theta_i: number(&check["thetai"]),
            theta_s: number(&check["thetas"]),
            phi_s: 2.0,
            rotation: 0.0,
        };
        let got = body.mueller(&at, Basis::Psps) - surface.mueller(&at, Basis::Psps);
        let elements = [got[(0, 0)], got[(0, 1)], got[(1, 0)], got[(1, 1)]];
        for (got, expected) in elements.iter().zip(list(&check["f00_f01_f10_f11"])) {
            assert!((got - number(expected)).abs() < 1e-10, "{got}: {check}");
        }
    }
}

#[test]
fn a_smooth_coat_over_a_white_body_returns_all_that_it_does_not_mirror() {
    // At normal incidence, with all reflections between the interfaces: T is the product of
    // (1 − r)/(1 − r_above r) from above, and the white body gives back what comes to it.
    let reflected = |a: f64, b: f64| ((a - b) / (a + b)).powi(2);
    for indices in [&[1.5][..], &[1.3, 1.9], &[1.6, 1.4], &[1.9, 1.2, 1.7]] {
        let texts: Vec<_> = indices.iter().map(|n| format!("({n},0)")).collect();
        let count = indices.len().to_string();
        let names = ["layer1.material", "layer2.material", "layer3.material"];
        let mut params = vec![("layers", &*count)];
        params.extend(names.into_iter().zip(texts.iter().map(|text| &**text)));
        // (T, R from below) of the layers down to some depth.
        let (mut passes, mut back, mut n) = (1.0, 0.0, 1.0);
        for &below in indices {
            let r = reflected(n, below);
            let trips = 1.0 / (1.0 - back * r);
            passes *= (1.0 - r) * trips;
            back = r + (1.0 - r).powi(2) * back * trips;
            n = below;
        }
        let white = hemisphere(&layered(&params), 0.0, 0.0, 200)[(0, 0)];
        // Where light of a low index between two high ones grazes, the quadrature sees a kink.
        assert!((white - passes).abs() < 1e-5, "{indices:?}: {white} is not {passes}");
    }
}

#[test]
fn a_coat_over_a_diffuse_body_is_the_library_s_diffuse_subsurface() {
    let params = [("substrate", "(1.5,0)"), ("reflectance.table", "0.7")];
    let body = build("Diffuse_Subsurface_BRDF_Model", &params);
    let coat = layered(&[("model.reflectance.table", "0.7")]);
    assert_same(&coat, &body, EXACT, "one coat");
    let matched = layered(&[
        ("substrate", "(1.5,0)"),
        ("model", "Diffuse_Subsurface_BRDF_Model"),
        ("model.substrate", "(1.5,0)"),
        ("model.reflectance.table", "0.7"),
    ]);
    assert_same(&matched, &body, EXACT, "an index-matched coat");
}

#[test]
fn a_coat_over_flakes_is_the_library_s_subsurface_facet() {
    let flakes = build("Subsurface_Facet_BRDF_Model", &[("overcoat", "(1.5,0)")]);
    let coat = layered(&[("model", "Facet_BRDF_Model")]);
    assert_same(&coat, &flakes, EXACT, "a coat over facets");
}
