//! Models asked by vectors give what they give by angles, and NIST's numbers under compat.

mod reference;

use std::f64::consts::PI;

use glam::{DMat3, DVec3};
use reference::{FILE, TOLERANCE, list, mueller, node, number, relative_difference};
use scattering::{
    Basis, Geometry, Mode, Model, Mueller, ParameterNode, ParameterValue, Surface, SurfaceError,
    models, optics::RefractiveIndex, registry::find_class,
};
use serde_json::Value as Json;

const BASES: [Basis; 3] = [Basis::Psps, Basis::Xyxy, Basis::Plane];

/// Facets with a direction on glass, for light of NIST's `type` number `side`.
fn brushed(side: i32) -> Model {
    let class = find_class("Anisotropic_Exponential_Slope_Distribution_Function").unwrap();
    let slopes = ParameterNode::with_defaults(class, Mode::Sound)
        .with("sx", ParameterValue::Number(0.4))
        .and_then(|node| node.with("sy", ParameterValue::Number(0.15)))
        .unwrap();
    let class = &models::find("Facet_BRDF_Model").unwrap().class;
    let node = ParameterNode::with_defaults(class, Mode::Sound)
        .with("substrate", ParameterValue::Index(RefractiveIndex::constant(1.5, 0.0)))
        .and_then(|node| node.with("type", ParameterValue::Integer(side)))
        .and_then(|node| node.with("sdf", ParameterValue::Member(slopes.into())))
        .unwrap();
    models::build(&node).unwrap()
}

fn geometries() -> [Geometry; 5] {
    let at = |theta_i, theta_s, phi_s, rotation| Geometry { theta_i, theta_s, phi_s, rotation };
    [
        at(0.5, 0.6, 0.7, 0.1),
        at(1.1, 0.2, -2.3, 0.9),
        at(0.05, 1.3, 3.0, -1.2),
        at(1.2, 1.0, 0.1, 2.0),
        at(0.3, 0.0, 0.0, 0.4),
    ]
}

/// Vectors to the source and to the viewer as a sample turned by `at.rotation` sees them.
fn vectors(at: &Geometry, side: i32) -> (DVec3, DVec3) {
    let polar = |theta: f64, azimuth: f64, z: f64| {
        let (x, y) = (theta.sin() * azimuth.cos(), theta.sin() * azimuth.sin());
        DVec3::new(x, y, z * theta.cos())
    };
    let (up, down) = (1.0, -1.0);
    let source = polar(at.theta_i, PI - at.rotation, if side >= 2 { down } else { up });
    let below = side == 1 || side == 2;
    (source, polar(at.theta_s, at.phi_s - at.rotation, if below { down } else { up }))
}

#[test]
fn vectors_give_the_matrices_of_their_angles() {
    // A surface that lies anywhere, its vectors of any length, the axis not in the surface.
    let turn = DMat3::from_rotation_z(0.4) * DMat3::from_rotation_x(1.9);
    let surface = Surface::new(turn * DVec3::Z * 3.0, turn * DVec3::new(2.0, 0.0, 0.7)).unwrap();
    for side in 0..4 {
        let model = brushed(side);
        for at in geometries() {
            let (source, viewer) = vectors(&at, side);
            for basis in BASES {
                let expected = model.mueller(&at, basis);
                let got = model.mueller_between(
                    &surface,
                    turn * source * 0.2,
                    turn * viewer * 7.0,
                    basis,
                    Mode::Sound,
                );
                // Rounding of the vectors, which a narrow lobe multiplies by its slope.
                let off = relative_difference(&got, &expected);
                assert!(off < 1e-12, "type {side}, {basis:?}, {at:?}: {off:e}");
            }
        }
    }
}

#[test]
fn compat_gives_the_matrices_of_nists_vector_interface() {
    let cases = list(&FILE["components"]["vector_interface"]);
    assert_eq!(cases.len(), 9);
    for case in cases {
        let params: Vec<(&str, &str)> = list(&case["params"])
            .iter()
            .map(|pair| (pair[0].as_str().unwrap(), pair[1].as_str().unwrap()))
            .collect();
        let model = node(case["model"].as_str().unwrap(), &params, Mode::Compat);
        let model = models::build(&model).unwrap();
        let surface = Surface::new(vector(&case["normal"]), vector(&case["xaxis"])).unwrap();
        let (source, viewer) = (vector(&case["source"]), vector(&case["viewer"]));
        let basis = Basis::from_name(case["basis"].as_str().unwrap()).unwrap();
        let got = model.mueller_between(&surface, source, viewer, basis, Mode::Compat);
        let off = relative_difference(&got, &mueller(&case["mueller"]));
        assert!(off < TOLERANCE, "{case}: {off:e}");
    }
}

fn vector(json: &Json) -> DVec3 {
    let v: Vec<f64> = json.as_array().unwrap().iter().map(number).collect();
    DVec3::from_slice(&v)
}

#[test]
fn exchanging_source_and_viewer_keeps_the_intensity_but_not_under_compat() {
    let model = brushed(0);
    let (a, b) = (DVec3::new(-0.3, 0.1, 0.9), DVec3::new(0.4, 0.3, 0.8));
    let intensity = |source, viewer, mode| {
        model.mueller_between(&Surface::LOCAL, source, viewer, Basis::Psps, mode)[(0, 0)]
    };
    let sound = intensity(a, b, Mode::Sound);
    assert!((intensity(b, a, Mode::Sound) - sound).abs() < 1e-13 * sound);
    let compat = intensity(a, b, Mode::Compat);
    assert!((intensity(b, a, Mode::Compat) - compat).abs() > 0.01 * compat);
}

#[test]
fn normal_incidence_is_that_of_the_fiducial_axis_and_nan_under_compat() {
    let model = brushed(0);
    let at = Geometry { theta_i: 0.0, theta_s: 0.6, phi_s: 0.7, rotation: 0.0 };
    let (_, viewer) = vectors(&at, 0);
    for basis in BASES {
        let ask =
            |source, mode| model.mueller_between(&Surface::LOCAL, source, viewer, basis, mode);
        let (got, expected) = (ask(DVec3::Z, Mode::Sound), model.mueller(&at, basis));
        assert!(relative_difference(&got, &expected) < 1e-13, "{basis:?}");
        assert!(ask(DVec3::Z, Mode::Compat).0.iter().flatten().all(|x| x.is_nan()));
        // It is the limit of light from −x.
        let near = ask(DVec3::new(-1e-9, 0.0, 1.0), Mode::Sound);
        assert!(relative_difference(&near, &expected) < 1e-7, "{basis:?}");
    }
}

#[test]
fn light_on_another_side_of_the_surface_is_dark() {
    let at = geometries()[0];
    for side in 0..4 {
        let model = brushed(side);
        for other in 0..4 {
            let (source, viewer) = vectors(&at, other);
            let got = model.evaluate_local(&[(source, viewer)], Basis::Psps)[0];
            assert_eq!(got == Mueller::ZERO, side != other, "type {side}, light of type {other}");
        }
    }
}

#[test]
fn vectors_without_a_direction_are_dark_and_make_no_surface() {
    let nan = DVec3::splat(f64::NAN);
    for bad in [DVec3::ZERO, nan, DVec3::new(f64::INFINITY, 0.0, 1.0)] {
        let pairs = [(bad, DVec3::Z), (DVec3::Z, bad), (DVec3::X, DVec3::Z), (DVec3::Z, DVec3::Y)];
        for m in brushed(0).evaluate_local(&pairs, Basis::Plane) {
            assert_eq!(m, Mueller::ZERO);
        }
        assert!(matches!(Surface::new(bad, DVec3::X), Err(SurfaceError::Normal(_))));
        assert!(matches!(Surface::new(DVec3::Z, bad), Err(SurfaceError::Fiducial(_))));
    }
    let along = Surface::new(DVec3::new(0.1, 0.2, 0.3), DVec3::new(1.0, 2.0, 3.0));
    assert!(matches!(along, Err(SurfaceError::Fiducial(_))));
}

#[test]
fn a_batch_has_the_bits_of_its_pairs() {
    let model = brushed(0);
    let (source, _) = vectors(&geometries()[0], 0);
    let mut pairs: Vec<_> = geometries().iter().map(|at| vectors(at, 0)).collect();
    pairs.extend(geometries().iter().map(|at| (source, vectors(at, 0).1)));
    pairs.insert(2, (DVec3::NEG_Z, DVec3::Z));
    pairs.push((source, DVec3::NEG_Z));
    for basis in BASES {
        let batch = model.evaluate_local(&pairs, basis);
        assert_eq!(batch.len(), pairs.len());
        for (pair, m) in pairs.iter().zip(batch) {
            assert_eq!(model.evaluate_local(&[*pair], basis)[0], m);
            let single = model.mueller_between(&Surface::LOCAL, pair.0, pair.1, basis, Mode::Sound);
            assert_eq!(single, m);
        }
    }
}
