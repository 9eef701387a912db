//! Spheres and bodies of revolution on a substrate: the tables of conformance programs, computed
//! by NIST's library, and what the sound models do in place of its defects.

use std::sync::Arc;

use scattering::{
    Basis, Geometry, Mode, ParameterNode, ParameterValue, models, optics::RefractiveIndex,
};

const PROGRAMS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/conformance/programs");

/// The tables carry sixteen digits; matrix inversion and the sums of large terms of alternating
/// signs lose three of them, the library's own as well as ours.
const TOLERANCE: f64 = 1e-11;

type StokesVector = [f64; 4];

const U: StokesVector = [1.0, 0.0, 0.0, 0.0];
const S: StokesVector = [1.0, 1.0, 0.0, 0.0];
const P: StokesVector = [1.0, -1.0, 0.0, 0.0];
const D: StokesVector = [1.0, 0.0, 1.0, 0.0];
const L: StokesVector = [1.0, 0.0, 0.0, 1.0];
const R: StokesVector = [1.0, 0.0, 0.0, -1.0];
const E: StokesVector = [1.0, 0.48, -0.6, 0.64];
const W: StokesVector = [0.5, 0.1, -0.35, 0.2];

/// The numbers of the table of a program, row by row.
fn table(program: &str) -> Vec<Vec<f64>> {
    let path = format!("{PROGRAMS}/{program}/expected/{program}.dat");
    let text = std::fs::read_to_string(path).unwrap();
    text.lines()
        .filter_map(|line| line.split_whitespace().map(|word| word.parse().ok()).collect())
        .filter(|row: &Vec<f64>| !row.is_empty())
        .collect()
}

fn index(n: f64, k: f64) -> ParameterValue {
    ParameterValue::Index(RefractiveIndex::constant(n, k))
}

fn node(class: &str, mode: Mode, values: &[(&str, ParameterValue)]) -> ParameterNode {
    let class = scattering::registry::find_class(class).unwrap();
    values.iter().fold(ParameterNode::with_defaults(class, mode), |node, (name, value)| {
        node.with(name, value.clone()).unwrap()
    })
}

fn film(n: f64, k: f64, thickness: f64) -> ParameterValue {
    let values = [("material", index(n, k)), ("thickness", ParameterValue::Number(thickness))];
    ParameterValue::Member(Arc::new(node("SingleFilm_StackModel", Mode::Compat, &values)))
}

/// Detected part per steradian for the polarization of the beam and the detector.
fn detected(m: &scattering::Mueller, input: StokesVector, output: StokesVector) -> f64 {
    (0..4).map(|i| (0..4).map(|j| output[i] * m[(i, j)] * input[j]).sum::<f64>()).sum()
}

/// Largest difference over largest element of the columns of a table that hold Stokes products.
fn difference(
    node: &ParameterNode,
    program: &str,
    columns: &[(StokesVector, StokesVector)],
    at: impl Fn(&[f64]) -> Geometry,
) -> f64 {
    let model = models::build(node).unwrap_or_else(|e| panic!("{program}: {e}"));
    let rows = table(program);
    assert!(rows.len() > 2, "{program}");
    let mut worst = 0.0f64;
    for row in rows {
        let m = model.mueller(&at(&row), Basis::Psps);
        let expected = &row[row.len() - columns.len()..];
        let scale = m[(0, 0)];
        for ((input, output), expected) in columns.iter().zip(expected) {
            let scaled: StokesVector =
                output.map(|x| if *output == U || *output == W { x } else { 0.5 * x });
            let got = detected(&m, *input, scaled);
            worst = worst.max((got - expected).abs() / scale);
        }
    }
    worst
}

fn degrees(theta_i: f64, theta_s: f64, phi_s: f64) -> Geometry {
    let [theta_i, theta_s, phi_s] = [theta_i, theta_s, phi_s].map(f64::to_radians);
    Geometry { theta_i, theta_s, phi_s, rotation: 0.0 }
}

fn assert_small(difference: f64, program: &str) {
    assert!(difference < TOLERANCE, "{program}: {difference:e}");
}

#[test]
fn a_sphere_on_a_bare_substrate_is_the_librarys() {
    let values = [
        ("lambda", ParameterValue::Number(0.615)),
        ("substrate", index(4.034, 0.218)),
        ("radius", ParameterValue::Number(0.052)),
        ("sphere", index(1.542, 0.0)),
    ];
    let node = node("Bobbert_Vlieger_BRDF_Model", Mode::Compat, &values);
    let columns = [(E, W), (U, S), (L, S), (D, D)];
    let at = |row: &[f64]| degrees(22.5, row[0], 0.0);
    assert_small(difference(&node, "v_bv_basic", &columns, at), "v_bv_basic");
}

#[test]
fn a_sphere_on_a_film_is_the_librarys_in_all_elements() {
    let values = [
        ("lambda", ParameterValue::Number(0.486)),
        ("substrate", index(4.283, 0.306)),
        ("radius", ParameterValue::Number(0.076)),
        ("sphere", index(1.755, 0.0)),
        ("stack", film(1.419, 0.02, 0.145)),
    ];
    let node = node("Bobbert_Vlieger_BRDF_Model", Mode::Compat, &values);
    let model = models::build(&node).unwrap();
    for row in table("v_bv_film") {
        let m = model.mueller(&degrees(row[0], row[1], row[2]), Basis::Psps);
        for (at, expected) in row[3..].iter().enumerate() {
            assert!((m[(at / 4, at % 4)] - expected).abs() < TOLERANCE * m[(0, 0)], "{at}");
        }
    }
}

#[test]
fn a_coated_sphere_on_a_metal_is_the_librarys() {
    let values = [
        ("lambda", ParameterValue::Number(0.572)),
        ("substrate", index(0.384, 5.607)),
        ("radius", ParameterValue::Number(0.112)),
        ("sphere", index(1.955, 0.0)),
        ("spherecoat", film(1.8, 0.1, 0.005)),
    ];
    let node = node("Bobbert_Vlieger_BRDF_Model", Mode::Compat, &values);
    let columns = [(E, W), (L, L), (L, R), (D, D), (P, P)];
    let at = |row: &[f64]| degrees(62.1, 26.4, row[0]);
    assert_small(difference(&node, "v_bv_coated", &columns, at), "v_bv_coated");
}

#[test]
fn light_of_a_sphere_into_the_substrate_is_the_librarys() {
    let values = [
        ("lambda", ParameterValue::Number(0.6)),
        ("substrate", index(1.5, 0.0)),
        ("type", ParameterValue::Integer(1)),
        ("radius", ParameterValue::Number(0.103)),
        ("sphere", index(1.6, 0.0)),
    ];
    let node = node("Bobbert_Vlieger_BRDF_Model", Mode::Compat, &values);
    let columns = [(D, D), (U, U), (P, P), (P, S)];
    let at = |row: &[f64]| degrees(46.2, row[0], 0.0);
    assert_small(difference(&node, "v_bv_trans", &columns, at), "v_bv_trans");
}

#[test]
fn a_hole_in_the_substrate_is_the_librarys() {
    let values = [
        ("lambda", ParameterValue::Number(0.6)),
        ("substrate", index(1.5, 0.0)),
        ("radius", ParameterValue::Number(0.055)),
        ("sphere", index(1.0, 0.0)),
        ("delta", ParameterValue::Number(0.026)),
    ];
    let node = node("Subsurface_Bobbert_Vlieger_BRDF_Model", Mode::Compat, &values);
    let columns = [(U, P), (L, S), (P, S), (U, U)];
    let at = |row: &[f64]| degrees(35.3, row[0], 0.0);
    assert_small(difference(&node, "v_subbv", &columns, at), "v_subbv");
}

fn shape(class: &str, values: &[(&str, ParameterValue)]) -> ParameterValue {
    ParameterValue::Member(Arc::new(node(class, Mode::Compat, values)))
}

fn numbers<'a>(values: &[(&'a str, f64)]) -> Vec<(&'a str, ParameterValue)> {
    values.iter().map(|&(name, x)| (name, ParameterValue::Number(x))).collect()
}

fn ellipsoid_on_silicon(mode: Mode, mmax: i32) -> ParameterNode {
    let outline = numbers(&[("vertical", 0.065), ("horizontal", 0.051)]);
    let values = [
        ("lambda", ParameterValue::Number(0.55)),
        ("substrate", index(3.884, 0.285)),
        ("particle", index(1.6, 0.0)),
        ("Shape", shape("Ellipsoid_Axisymmetric_Shape", &outline)),
        ("lmax", ParameterValue::Integer(6)),
        ("mmax", ParameterValue::Integer(mmax)),
    ];
    node("Axisymmetric_Particle_BRDF_Model", mode, &values)
}

#[test]
fn an_ellipsoid_on_a_substrate_is_the_librarys() {
    let node = ellipsoid_on_silicon(Mode::Compat, 4);
    let columns = [(L, R), (P, P), (D, D), (E, W)];
    let at = |row: &[f64]| degrees(62.9, row[0], 0.0);
    assert_small(difference(&node, "v_axi_ellipsoid", &columns, at), "v_axi_ellipsoid");
}

#[test]
fn a_rounded_cylinder_on_a_substrate_is_the_librarys() {
    let outline = numbers(&[("radius", 0.04), ("length", 0.081), ("corner", 0.01)]);
    let values = [
        ("lambda", ParameterValue::Number(0.6)),
        ("substrate", index(4.113, 0.266)),
        ("particle", index(1.815, 0.053)),
        ("Shape", shape("Cylinder_Axisymmetric_Shape", &outline)),
        ("lmax", ParameterValue::Integer(6)),
        ("mmax", ParameterValue::Integer(4)),
    ];
    let node = node("Axisymmetric_Particle_BRDF_Model", Mode::Compat, &values);
    let columns = [(L, L), (S, P), (P, P), (P, S), (P, L)];
    let at = |row: &[f64]| degrees(36.5, 54.2, row[0]);
    let difference = difference(&node, "v_axi_shapes", &columns, at);
    // The library's slopes of the outline are differences of 1e-6 rad, good to 1e-10.
    assert!(difference < 1e-9, "{difference:e}");
}

#[test]
fn a_chebyshev_particle_on_a_substrate_is_the_librarys() {
    let mut outline = numbers(&[("amplitude", 0.05)]);
    outline.extend([("n", ParameterValue::Integer(4)), ("npoints", ParameterValue::Integer(60))]);
    let values = [
        ("lambda", ParameterValue::Number(0.6)),
        ("substrate", index(4.053, 0.277)),
        ("particle", index(1.5, 0.0)),
        ("Shape", shape("Chebyshev_Axisymmetric_Shape", &outline)),
        ("lmax", ParameterValue::Integer(5)),
        ("mmax", ParameterValue::Integer(3)),
    ];
    let node = node("Axisymmetric_Particle_BRDF_Model", Mode::Compat, &values);
    let columns = [(L, S), (S, S), (P, P), (S, P)];
    let at = |row: &[f64]| degrees(57.8, row[0], 0.0);
    let difference = difference(&node, "v_axi_more", &columns, at);
    // The library's slopes of the outline are differences of 1e-6 rad, good to 1e-10.
    assert!(difference < 1e-9, "{difference:e}");
}

#[test]
fn harmonics_are_paired_wrongly_in_compat_with_few_orders_only() {
    let at = degrees(60.0, 40.0, 70.0);
    let m = |mode, mmax| {
        let node = ellipsoid_on_silicon(mode, mmax);
        let m = models::build(&node).unwrap().mueller(&at, Basis::Psps);
        let met =
            node.notices.lock().unwrap().contains(&scattering::Defect::AxisymmetricIndex.into());
        (m, met)
    };
    let difference = |mmax| {
        let ((compat, _), (sound, met)) = (m(Mode::Compat, mmax), m(Mode::Sound, mmax));
        ((compat - sound).largest() / sound.largest(), met)
    };
    let (few, met) = difference(4);
    assert!(few > 1e-6 && few < 1e-1 && met, "{few:e}");
    let (all, met) = difference(0);
    // What is left is that of the nodes of the image and of the orders.
    assert!(all < 1e-4 && !met, "{all:e}");
    // Orders beyond the fourth hardly count for this particle.
    let ((four, _), (six, _)) = (m(Mode::Sound, 4), m(Mode::Sound, 6));
    assert!((four - six).largest() < 1e-6 * six.largest());
}

#[test]
fn a_round_body_is_the_sphere_of_bobbert_and_vlieger() {
    for (body, sphere) in [
        ("Axisymmetric_Particle_BRDF_Model", "Bobbert_Vlieger_BRDF_Model"),
        ("Subsurface_Axisymmetric_Particle_BRDF_Model", "Subsurface_Bobbert_Vlieger_BRDF_Model"),
    ] {
        for side in 0..4 {
            let values = [
                ("substrate", index(1.5, 0.0)),
                ("type", ParameterValue::Integer(side)),
                ("lmax", ParameterValue::Integer(6)),
                ("delta", ParameterValue::Number(0.01)),
            ];
            let m = |class| {
                let model = models::build(&node(class, Mode::Sound, &values)).unwrap();
                model.mueller(&degrees(50.0, 30.0, 80.0), Basis::Psps)
            };
            // The body's lowest node lies 3e-4 rad from the pole; the sphere's sum stops at l = 5.
            let (a, b) = (m(body), m(sphere));
            assert!((a - b).largest() < 1e-5 * b.largest(), "{body} {side}");
        }
    }
}

#[test]
fn light_in_and_light_out_of_a_particle_change_places() {
    // M₁(θ_i,θ_s,φ) = n² P M₃(θ_s,θ_i,−φ)ᵀ P, up to the truncation of the image's integral.
    let n = 1.5;
    let build = |side| {
        let values = [("substrate", index(n, 0.0)), ("type", ParameterValue::Integer(side))];
        models::build(&node("Bobbert_Vlieger_BRDF_Model", Mode::Sound, &values)).unwrap()
    };
    let p = scattering::Mueller::diagonal([1.0, 1.0, -1.0, 1.0]);
    for (i, s, phi) in [(30.0, 20.0, 40.0), (60.0, 70.0, -100.0)] {
        let forth = build(1).mueller(&degrees(i, s, phi), Basis::Psps);
        let back = build(3).mueller(&degrees(s, i, -phi), Basis::Psps);
        let back = p * back.transposed() * p * (n * n);
        assert!((forth - back).largest() < 1e-4 * forth.largest(), "{i} {s} {phi}");
    }
}

#[test]
fn models_far_from_the_usual_are_refused_or_finite() {
    let classes = models::all().map(|spec| &spec.class);
    for class in classes.filter(|class| class.parameter("improve").is_some()) {
        for (name, value) in [
            ("radius", ParameterValue::Number(0.0)),
            ("radius", ParameterValue::Number(1e-9)),
            ("radius", ParameterValue::Number(1e3)),
            ("radius", ParameterValue::Number(f64::NAN)),
            ("delta", ParameterValue::Number(1e9)),
            ("delta", ParameterValue::Number(-1.0)),
            ("lmax", ParameterValue::Integer(i32::MIN)),
            ("lmax", ParameterValue::Integer(90)),
            ("lmax", ParameterValue::Integer(1)),
            ("order", ParameterValue::Integer(3)),
            ("spherecoat", film(1.5, 0.0, 0.06)),
            ("order", ParameterValue::Integer(i32::MAX)),
            ("Norm_Inc_Approx", ParameterValue::Integer(7)),
            ("sphere", index(0.0, 0.0)),
            ("particle", index(0.0, 0.0)),
            ("particle", index(0.1, 2000.0)),
            ("mmax", ParameterValue::Integer(-1)),
            ("mmax", ParameterValue::Integer(1)),
            ("substrate", index(0.0, 0.0)),
            ("density", ParameterValue::Number(-1.0)),
        ] {
            if class.parameter(name).is_none() {
                continue;
            }
            let node = node(class.name, Mode::Sound, &[(name, value.clone())]);
            match models::build(&node) {
                Err(error) => assert!(!error.problem.is_empty(), "{name}"),
                Ok(model) => {
                    for at in [degrees(0.0, 0.0, 30.0), degrees(60.0, 89.9, 170.0)] {
                        let m = model.mueller(&at, Basis::Psps);
                        assert!(m.largest().is_finite(), "{} {name} {value:?}", class.name);
                    }
                }
            }
        }
    }
}
