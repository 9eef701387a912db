//! The adding–doubling model of paints: limits in which it is another model, what changes nothing,
//! what is refused, and the balance of light.

mod reference;

use std::f64::consts::PI;

use reference::node;
use scattering::{Basis, Geometry, Mode, Model, models};

const PAINT: &str = "Adding_Doubling_BRDF_Model";

fn build(class: &str, params: &[(&str, &str)]) -> Model {
    let node = node(class, params, Mode::Sound);
    models::build(&node).unwrap_or_else(|error| panic!("{params:?}: {error}"))
}

fn geometries() -> [Geometry; 5] {
    let at = |theta_i, theta_s, phi_s| Geometry { theta_i, theta_s, phi_s, rotation: 0.0 };
    [
        at(0.5, 0.6, 0.7),
        at(1.1, 0.2, -2.3),
        at(1.4, 1.3, 3.0),
        at(0.0, 0.9, 1.0),
        at(-0.7, 0.4, 0.3),
    ]
}

/// The largest difference of two models over the largest element of the second.
fn difference(a: &Model, b: &Model) -> f64 {
    let largest = |at: &Geometry| {
        let (a, b) = (a.mueller(at, Basis::Psps), b.mueller(at, Basis::Psps));
        (a - b).largest() / b.largest()
    };
    geometries().iter().map(largest).fold(0.0, f64::max)
}

fn refusal(params: &[(&str, &str)]) -> String {
    let node = node(PAINT, params, Mode::Sound);
    models::build(&node).err().unwrap_or_else(|| panic!("{params:?} is not refused")).parameter
}

#[test]
fn a_clear_slab_over_a_diffuser_is_diffuse_subsurface_scattering() {
    let paint = build(
        PAINT,
        &[
            ("substrate", "(1.5,0)"),
            ("model.substrate", "(1.5,0)"),
            ("model.reflectance.table", "0.7"),
            ("nodes", "20"),
            ("trapped", "16"),
        ],
    );
    let other = build(
        "Diffuse_Subsurface_BRDF_Model",
        &[("substrate", "(1.5,0)"), ("reflectance.table", "0.7")],
    );
    let off = difference(&paint, &other);
    assert!(off < 1e-6, "{off:e}");
}

#[test]
fn clear_coats_are_those_of_the_layered_model() {
    let body = [("model.reflectance.table", "0.7"), ("layers", "2")];
    let paint: Vec<_> = body
        .into_iter()
        .chain([
            ("layer1.interface.material", "(1.4,0)"),
            ("layer2.interface.material", "(1.6,0.001)"),
            ("layer2.thickness", "5"),
            ("nodes", "20"),
            ("trapped", "16"),
        ])
        .collect();
    let layered: Vec<_> = body
        .into_iter()
        .chain([
            ("layer1.material", "(1.4,0)"),
            ("layer2.material", "(1.6,0.001)"),
            ("layer2.thickness", "5"),
        ])
        .collect();
    let off = difference(&build(PAINT, &paint), &build("Layered_BRDF_Model", &layered));
    assert!(off < 1e-6, "{off:e}");
}

#[test]
fn a_diffuse_body_with_its_interface_is_a_slab_over_a_diffuser() {
    let common = [("substrate", "(1.5,0)"), ("model.substrate", "(1.5,0)")];
    let with = |more: &[(&'static str, &'static str)]| build(PAINT, &[&common[..], more].concat());
    let body = with(&[
        ("layers", "0"),
        ("model", "Diffuse_Subsurface_BRDF_Model"),
        ("model.substrate", "(1.5,0)"),
        ("model.reflectance.table", "0.4"),
    ]);
    let slab = with(&[("model.reflectance.table", "0.4")]);
    let off = difference(&body, &slab);
    assert!(off < 1e-12, "{off:e}");
}

#[test]
fn any_model_may_lie_below() {
    // A Lambertian evaluated like any other model: the sum of one source.
    let own = build(PAINT, &[("model.reflectance.table", "0.6")]);
    let other = build(
        PAINT,
        &[
            ("model", "Two_Source_BRDF_Model"),
            ("model.source1", "Lambertian_BRDF_Model"),
            ("model.source1.reflectance.table", "0.6"),
            ("model.source2", "Lambertian_BRDF_Model"),
            ("model.factor2", "0"),
        ],
    );
    let off = difference(&other, &own);
    assert!(off < 1e-8, "{off:e}");
}

#[test]
fn a_slab_without_thickness_changes_nothing() {
    let spheres = [
        ("layer1.particles", "SphericalScatterer_Phase_Function"),
        ("layer1.particles.volume_density", "0.1"),
    ];
    let plain = build(PAINT, &spheres);
    let more: Vec<_> = spheres
        .into_iter()
        .chain([
            ("layers", "2"),
            ("layer2.thickness", "0"),
            ("layer2.interface.material", "(1.8,0)"),
        ])
        .collect();
    let off = difference(&build(PAINT, &more), &plain);
    assert!(off < 1e-14, "{off:e}");
}

#[test]
fn matrices_of_a_batch_are_those_of_single_pairs() {
    let paint = build(
        PAINT,
        &[
            ("layer1.particles", "SphericalScatterer_Phase_Function"),
            ("layer1.particles.volume_density", "0.1"),
        ],
    );
    let at = geometries()[0];
    let directions: Vec<_> =
        (0..40).map(|k| scattering::Direction::new(0.03 * f64::from(k), f64::from(k))).collect();
    let mut out = vec![scattering::Mueller::ZERO; directions.len()];
    paint.evaluate(&at.incidence(), &directions, Basis::Psps, &mut out);
    for (m, to) in out.iter().zip(&directions) {
        let mut one = [scattering::Mueller::ZERO];
        paint.evaluate(&at.incidence(), &[*to], Basis::Psps, &mut one);
        assert_eq!(*m, one[0]);
    }
}

/// Reflectance of an unpolarized beam.
fn hemisphere(model: &Model, theta_i: f64) -> f64 {
    let incidence = scattering::Incidence::new(theta_i, 0.0);
    let mut sum = 0.0;
    for (mu, w) in scattering::special::gauss::legendre(96, 0.0, 1.0) {
        for k in 0..96 {
            let phi = PI * (f64::from(k) + 0.5) / 96.0;
            let mut out = [scattering::Mueller::ZERO];
            let to = scattering::Direction::new(mu.acos(), phi);
            model.evaluate(&incidence, &[to], Basis::Psps, &mut out);
            sum += out[0][(0, 0)] * mu * w * 2.0 * PI / 96.0;
        }
    }
    sum
}

#[test]
fn a_white_paint_with_a_rough_face_returns_all_light() {
    let paint = build(
        PAINT,
        &[
            ("layer1.interface.sdf", "Gaussian_Slope_Distribution_Function"),
            ("layer1.interface.sdf.s", "0.424264068711929"),
            ("layer1.particles", "Scaled_Phase_Function"),
            ("layer1.particles.phase.scatterer", "RayleighScatterer"),
            ("layer1.particles.phase.scatterer.sphere", "(1.6,0)"),
            ("layer1.particles.scattering", "0.1"),
            ("nodes", "20"),
            ("trapped", "14"),
        ],
    );
    for theta in [0.2, 0.9, 1.3] {
        let all = hemisphere(&paint, theta);
        assert!((all - 1.0).abs() < 2e-4, "{theta}: {all}");
    }
}

#[test]
fn stacks_that_it_cannot_describe_are_refused() {
    let cases: &[(&[(&str, &str)], &str)] = &[
        (&[("type", "1"), ("substrate", "(1.5,0)")], "type"),
        (&[("nodes", "2")], "nodes"),
        (&[("layers", "5")], "layers"),
        (&[("bounces", "2")], "bounces"),
        (&[("tolerance", "0")], "tolerance"),
        (&[("layer1.interface.material", "(0.9,0)")], "layer1.interface.material"),
        (
            &[("layer1.interface.sdf", "Exponential_Slope_Distribution_Function")],
            "layer1.interface.sdf",
        ),
        (
            &[
                ("layers", "2"),
                ("layer2.interface.sdf", "Gaussian_Slope_Distribution_Function"),
                ("layer2.interface.sdf.s", "0.05"),
            ],
            "layer2.interface.sdf",
        ),
        (&[("layer1.thickness", "-1")], "layer1.thickness"),
        (&[("model", "Layered_BRDF_Model")], "model"),
        (
            &[
                ("model", "Facet_BRDF_Model"),
                ("model.sdf", "Anisotropic_Gaussian_Slope_Distribution_Function"),
                ("model.sdf.sigmax", "0.3"),
                ("model.sdf.sigmay", "0.2"),
            ],
            "model",
        ),
        (
            &[
                ("layer1.flakes", "Plate_Flakes"),
                ("layer1.flakes.sdf", "Exponential_Slope_Distribution_Function"),
            ],
            "layer1.flakes.sdf",
        ),
    ];
    for (params, parameter) in cases {
        assert_eq!(refusal(params), *parameter, "{params:?}");
    }
}

#[test]
fn a_pigmented_coating_with_doubling_is_a_paint_of_one_slab() {
    let gaussian = "Gaussian_Slope_Distribution_Function";
    let coating = [
        ("lambda", "0.5"),
        ("overcoat", "(1.5,0)"),
        ("surface_sdf", "Unit_Slope_Distribution_Function"),
        ("thickness", "20"),
        ("particle.sphere", "(2.6,0)"),
        ("particle_radius", "0.05"),
        ("particle_density", "5"),
        ("flake_density", "2e-4"),
        ("substrate", "(1.2,7)"),
        ("sdf", gaussian),
        ("sdf.s", "0.3"),
        ("backing.table", "0.4"),
        ("body", "doubling"),
    ];
    let paint = [
        ("lambda", "0.5"),
        ("layer1.interface.material", "(1.5,0)"),
        ("layer1.thickness", "20"),
        ("layer1.particles", "SphericalScatterer_Phase_Function"),
        ("layer1.particles.scatterer.sphere", "(2.6,0)"),
        ("layer1.particles.scatterer.radius", "0.05"),
        ("layer1.particles.volume_density", "5"),
        ("layer1.flakes", "Plate_Flakes"),
        ("layer1.flakes.density", "2e-4"),
        ("layer1.flakes.substrate", "(1.2,7)"),
        ("layer1.flakes.sdf", gaussian),
        ("layer1.flakes.sdf.s", "0.3"),
        ("model.lambda", "0.5"),
        ("model.reflectance.table", "0.4"),
    ];
    let class = "Pigmented_Coating_BRDF_Model";
    assert_eq!(difference(&build(class, &coating), &build(PAINT, &paint)), 0.0);
    // Fine pigments polarize light across the plane of scattering; a scalar body cannot.
    let fine = |body| {
        let mut params = coating.to_vec();
        params.retain(|(name, _)| !["flake_density", "surface_sdf", "body"].contains(name));
        let slopes = [("surface_sdf.sigmax", "0.02"), ("surface_sdf.sigmay", "0.02")];
        params.extend([("flake_density", "0"), ("backing.table", "0"), ("body", body)]);
        params.extend(slopes);
        let at = Geometry { theta_i: 0.79, theta_s: 1.22, phi_s: 0.0, rotation: 0.0 };
        let matrix = build(class, &params).mueller(&at, Basis::Psps);
        matrix[(1, 0)] / matrix[(0, 0)]
    };
    let (scalar, polarized) = (fine("scalar"), fine("doubling"));
    assert!(scalar < -0.1 && polarized > 0.05, "{scalar} {polarized}");
}

#[test]
fn parameters_of_the_scalar_body_are_refused_beside_doubling() {
    let refused = |name: &str, value: &str| {
        let params = [("body", "doubling"), (name, value)];
        let node = node("Pigmented_Coating_BRDF_Model", &params, Mode::Sound);
        let error = models::build(&node).err().unwrap();
        (error.parameter.clone(), error.to_string())
    };
    assert_eq!(refused("surface_shadow", "Unit_Shadow_Function").0, "surface_shadow");
    for (name, value) in [("correlation", "0.5"), ("exchange", "1"), ("flake_spread", "0.1")] {
        let (parameter, told) = refused(name, value);
        assert_eq!(parameter, name);
        assert!(told.contains("body = scalar"), "{told}");
    }
    assert_eq!(refused("sdf", "Exponential_Slope_Distribution_Function").0, "sdf");
    let without = [("body", "doubling"), ("flake_density", "0"), ("overcoat", "(0.5,0)")];
    let node = reference::node("Pigmented_Coating_BRDF_Model", &without, Mode::Sound);
    assert_eq!(models::build(&node).err().unwrap().parameter, "overcoat");
    let params = [("body", "vector")];
    let node = reference::node("Pigmented_Coating_BRDF_Model", &params, Mode::Sound);
    assert_eq!(models::build(&node).err().unwrap().parameter, "body");
}
