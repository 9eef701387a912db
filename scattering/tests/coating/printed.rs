//! The equations of the paper as they are printed, beside what is sound.

use std::f64::consts::FRAC_PI_2;

use scattering::{
    Basis, Direction, Geometry, Incidence, Mode, Mueller, slope::SlopeDistribution, spec,
};

use super::{build, hemisphere, pigmented, reference::node};

fn slopes(class: &str, params: &[(&str, &str)]) -> Box<dyn SlopeDistribution> {
    spec::build(&node(class, params, Mode::Sound)).unwrap()
}

#[test]
fn equation_1_as_printed_is_the_elliptic_exponential() {
    let printed = slopes(
        "Anisotropic_Gaussian_Slope_Distribution_Function",
        &[("sigmax", "0.2"), ("sigmay", "0.1"), ("printed", "1")],
    );
    let root = 6f64.sqrt();
    let (x, y) = ((0.2 * root).to_string(), (0.1 * root).to_string());
    let exponential =
        slopes("Anisotropic_Exponential_Slope_Distribution_Function", &[("sx", &x), ("sy", &y)]);
    for (x, y) in [(0.0, 0.0), (0.1, -0.2), (0.5, 0.3)] {
        let (a, b) = (printed.density(x, y), exponential.density(x, y));
        assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    }
    let (x, y) = printed.deviations().unwrap();
    // Not the σ that it is named for: √3 times as wide.
    assert!((x / (0.2 * 3f64.sqrt()) - 1.0).abs() < 1e-12);
    assert!((y / (0.1 * 3f64.sqrt()) - 1.0).abs() < 1e-12);
}

/// The surface alone.
fn surface(printed: &'static str) -> scattering::Model {
    pigmented(&[
        ("flake_density", "0"),
        ("backing.table", "0"),
        ("surface_sdf.sigmax", "0.3"),
        ("printed_surface", printed),
    ])
}

#[test]
fn equation_6_as_printed_is_the_reversed_path_out_of_the_plane_of_incidence() {
    let (printed, sound) = (surface("1"), surface("0"));
    let d = Mueller::diagonal([1.0, 1.0, 1.0, -1.0]);
    for (theta_s, phi_s) in [(0.6, 0.7), (0.4, -0.5), (0.9, 0.3)] {
        let at = Geometry { theta_i: 0.7, theta_s, phi_s, rotation: 0.1 };
        let (a, b) = (printed.mueller(&at, Basis::Psps), sound.mueller(&at, Basis::Psps));
        assert!((a - d * b.transposed() * d).largest() < 1e-14 * b.largest());
        assert!((a - b).largest() > 1e-3 * b.largest(), "out of the plane both differ");
    }
    let in_plane = Geometry { theta_i: 0.5, theta_s: 0.9, phi_s: 0.0, rotation: 0.0 };
    let (a, b) = (printed.mueller(&in_plane, Basis::Psps), sound.mueller(&in_plane, Basis::Psps));
    assert!((a - b).largest() < 1e-12 * b.largest());
}

#[test]
fn equation_8_as_printed_is_brighter_than_what_came() {
    // Flakes of an imaginary index with narrow slopes under n = 1.5: T_i T_s = 0.92133; with the
    // printed n² it is 2.07, and (1 + ζ)² adds to that.
    let flakes = |printed: &'static str| {
        let model = pigmented(&[
            ("overcoat", "(1.5,0)"),
            ("substrate", "(0,3)"),
            ("sdf", "Gaussian_Slope_Distribution_Function"),
            ("sdf.s", "0.02"),
            ("flake_density", "0.01"),
            ("backing.table", "0"),
            ("surface_sdf.sigmax", "0.02"),
            ("surface_sdf.sigmay", "0.02"),
            ("printed_flakes", printed),
        ]);
        let surface = build(
            "Shadowed_Facet_BRDF_Model",
            &[
                ("substrate", "(1.5,0)"),
                ("sdf", "Anisotropic_Gaussian_Slope_Distribution_Function"),
                ("sdf.sigmax", "0.02"),
                ("sdf.sigmay", "0.02"),
                ("shadow", "Sancer_Shadow_Function"),
            ],
        );
        around_the_mirror(&model) - around_the_mirror(&surface)
    };
    let (sound, printed) = (flakes("0"), flakes("1"));
    assert!((sound - 0.92133).abs() < 3e-3, "{sound}");
    let ratio = printed / sound;
    assert!(ratio > 2.25 && ratio < 2.4, "{ratio}");
}

/// ∫M00 cos θ dΩ over 0.35 rad around the mirror direction of θ_i = 0.3.
fn around_the_mirror(model: &scattering::Model) -> f64 {
    let (theta, half) = (0.3, 0.29);
    let (nodes, azimuths) = (96, 96);
    let incidence = Incidence::new(theta, 0.0);
    let mut sum = 0.0;
    for (a, weight) in scattering::special::gauss::legendre(nodes, 0.0, half) {
        for j in 0..azimuths {
            let psi = std::f64::consts::TAU * (f64::from(j) + 0.5) / f64::from(azimuths);
            let local = glam::DVec3::new(a.sin() * psi.cos(), a.sin() * psi.sin(), a.cos());
            let k = glam::DVec3::new(
                local.x * theta.cos() + local.z * theta.sin(),
                local.y,
                local.z * theta.cos() - local.x * theta.sin(),
            );
            let direction = Direction::new(k.z.acos().min(FRAC_PI_2), k.y.atan2(k.x));
            let mut out = [Mueller::ZERO];
            model.evaluate(&incidence, &[direction], Basis::Psps, &mut out);
            let area = a.sin() * std::f64::consts::TAU / f64::from(azimuths);
            sum += out[0][(0, 0)] * k.z * weight * area;
        }
    }
    sum
}

#[test]
fn equation_9_as_printed_is_too_bright_for_coloured_bodies() {
    // Hemispherical reflectance without the surface, literal and complete, for n = 1.5 at 0.3 rad.
    for (alpha, literal, complete) in
        [("1", 0.872, 0.960), ("0.5", 0.436, 0.276), ("0.2", 0.174, 0.088)]
    {
        let body = |printed: &'static str| {
            let shared = [("overcoat", "(1.5,0)"), ("flake_density", "0"), ("printed", printed)];
            let with = pigmented(&[&shared[..], &[("backing.table", alpha)]].concat());
            let without = pigmented(&[&shared[..], &[("backing.table", "0")]].concat());
            let [a, b] = [with, without].map(|m| hemisphere(&m, 0.3, 0.0, 60)[(0, 0)]);
            a - b
        };
        // The rough surface lets a little less pass than a smooth one.
        assert!((body("1") - literal).abs() < 2e-3, "{alpha}: {}", body("1"));
        assert!((body("0") - complete).abs() < 5e-3, "{alpha}: {}", body("0"));
    }
}

#[test]
fn the_weight_of_equation_11_falls_as_flakes_grow_more() {
    let seen = |printed: &'static str, density: &'static str| {
        let model = pigmented(&[
            ("overcoat", "(1,0)"),
            ("backing.table", "0"),
            ("sdf", "Gaussian_Slope_Distribution_Function"),
            ("flake_density", density),
            ("printed", printed),
        ]);
        let at = Geometry { theta_i: 0.3, theta_s: 0.3, phi_s: 0.0, rotation: 0.0 };
        model.mueller(&at, Basis::Psps)[(0, 0)]
    };
    assert!(seen("2", "2e-4") < seen("2", "1e-4"));
    assert!(seen("0", "2e-4") > seen("0", "1e-4"));
}
