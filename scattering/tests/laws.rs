//! Every model obeys the laws that its class claims, with its defaults and a few variants of them.

#[path = "laws/long.rs"]
mod long;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use num_complex::Complex64;
use scattering::{
    Basis, Brdf, Geometry, Mode, Model, Mueller, ParameterKind, ParameterNode, ParameterValue,
    Spec, models, optics::RefractiveIndex, registry::find_class, spec::Laws,
};

/// Reciprocity and symmetry of the closed forms hold to rounding, those of sums over Bessel
/// functions or quadratures to about 10⁻¹⁰ of the largest element.
const SYMMETRY: f64 = 1e-9;

/// Rounding of a coherency matrix relative to the intensity.
const REALIZABLE: f64 = 1e-12;

fn geometries() -> Vec<Geometry> {
    let at = |theta_i, theta_s, phi_s, rotation| Geometry { theta_i, theta_s, phi_s, rotation };
    vec![
        at(0.5, 0.6, 0.7, 0.1),
        at(1.1, 0.2, -2.3, 0.9),
        at(0.05, 1.3, 3.0, -1.2),
        at(1.2, 1.0, 0.1, 2.0),
        // Along the normal, back to the source, to the specular side, close to the horizon.
        at(0.0, 0.6, 0.7, 0.3),
        at(0.7, 0.0, -1.2, 0.4),
        at(0.0, 0.0, 0.0, 0.0),
        at(0.6, 0.6, PI, 0.2),
        at(0.5, 0.5, 0.0, 1.1),
        at(1.55, 1.5, 0.4, 0.1),
    ]
}

/// The model with its defaults, and what its parameters allow of: every type over a transparent
/// substrate, elliptic slopes, a film.
fn variants(defaults: &ParameterNode) -> Vec<(String, Model)> {
    let name = defaults.class.name;
    // Some refuse the absorbing default substrate.
    let mut found: Vec<_> =
        models::build(defaults).into_iter().map(|model| (name.to_owned(), model)).collect();
    for n in [1.5, 1.0] {
        let substrate = ParameterValue::Index(RefractiveIndex::constant(n, 0.0));
        for side in 0..4 {
            let node = defaults.clone().with("substrate", substrate.clone());
            let node = node.and_then(|node| node.with("type", ParameterValue::Integer(side)));
            // Models that lack a type refuse it, particles in a substrate one that is not theirs.
            if let Ok(model) = node.and_then(|node| models::build(&node)) {
                found.push((format!("{name}, substrate {n}, type {side}"), model));
            }
        }
        if !found.is_empty() {
            break;
        }
    }
    for (parameter, class) in [
        ("sdf", "Anisotropic_Exponential_Slope_Distribution_Function"),
        ("sdf", "Anisotropic_Gaussian_Slope_Distribution_Function"),
        ("stack", "SingleFilm_StackModel"),
    ] {
        let has = defaults
            .class
            .parameter(parameter)
            .is_some_and(|(_, p)| matches!(p.kind, ParameterKind::Member { .. }));
        if !has {
            continue;
        }
        let member = ParameterNode::with_defaults(find_class(class).unwrap(), Mode::Sound);
        let node = defaults.clone().with(parameter, ParameterValue::Member(member.into())).unwrap();
        found.extend(models::build(&node).into_iter().map(|m| (format!("{name}, {class}"), m)));
    }
    found
}

/// Every variant of every class that claims a law.
fn claimed(law: fn(&Laws) -> bool) -> Vec<(String, Model)> {
    models::all().filter(|spec| law(&spec.class.laws)).flat_map(|s| variants(&node(s))).collect()
}

/// The class with its defaults; a class that reads a file gets one.
fn node(spec: &'static Spec<dyn Brdf>) -> ParameterNode {
    let node = ParameterNode::with_defaults(&spec.class, Mode::Sound);
    match spec.class.parameter("coefficientfile") {
        Some(_) => {
            node.with("coefficientfile", ParameterValue::Text("1 1 0 0 0 0 0 1.0".into())).unwrap()
        }
        None => node,
    }
}

fn compare(name: &str, at: &Geometry, got: Mueller, expected: Mueller) -> Option<String> {
    let difference = (got - expected).largest();
    let bad = difference.is_nan() || difference > SYMMETRY * expected.largest();
    bad.then(|| format!("{name} at {at:?}: {:e}", difference / expected.largest()))
}

fn assert_none(wrong: &[String]) {
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_reversed_path_has_the_transposed_matrix() {
    let p = Mueller::diagonal([1.0, 1.0, -1.0, 1.0]);
    let mut wrong = Vec::new();
    for (name, model) in claimed(|laws| laws.reciprocal) {
        let side = model.common().side;
        if side.from_below() != side.to_below() {
            // The reversed path of a transmission is one of the other type.
            continue;
        }
        for at in geometries() {
            let back = Geometry {
                theta_i: at.theta_s,
                theta_s: at.theta_i,
                phi_s: -at.phi_s,
                rotation: at.rotation + PI - at.phi_s,
            };
            let expected = p * model.mueller(&at, Basis::Psps).transposed() * p;
            wrong.extend(compare(&name, &at, model.mueller(&back, Basis::Psps), expected));
        }
    }
    assert_none(&wrong);
}

/// The class with its defaults on a transparent substrate, for light of NIST's `type` number `side`.
fn through(defaults: &ParameterNode, n: f64, side: i32) -> Option<Model> {
    let node = defaults
        .clone()
        .with("substrate", ParameterValue::Index(RefractiveIndex::constant(n, 0.0)));
    let node = node.and_then(|node| node.with("type", ParameterValue::Integer(side)));
    node.and_then(|node| models::build(&node)).ok()
}

#[test]
fn light_in_and_light_out_change_places_with_the_square_of_the_index() {
    // M₁(θ_i, θ_s, φ; r) = n²·P·M₃(θ_s, θ_i, −φ; r+π−φ)ᵀ·P.
    let p = Mueller::diagonal([1.0, 1.0, -1.0, 1.0]);
    let (mut wrong, mut compared) = (Vec::new(), 0);
    for spec in models::all().filter(|spec| spec.class.laws.reciprocal) {
        if spec.class.name == "Lambertian_BRDF_Model" {
            // Every type has the same value: it does not model the substrate.
            continue;
        }
        let pair = |n| Some((n, through(&node(spec), n, 1)?, through(&node(spec), n, 3)?));
        // Particles in a substrate refuse one that is not their medium.
        let Some((n, inwards, outwards)) = pair(1.5).or_else(|| pair(1.0)) else { continue };
        compared += 1;
        for at in geometries() {
            let back = Geometry {
                theta_i: at.theta_s,
                theta_s: at.theta_i,
                phi_s: -at.phi_s,
                rotation: at.rotation + PI - at.phi_s,
            };
            let expected = p * outwards.mueller(&back, Basis::Psps).transposed() * p * (n * n);
            let name = format!("{}, substrate {n}", spec.class.name);
            wrong.extend(compare(&name, &at, inwards.mueller(&at, Basis::Psps), expected));
        }
    }
    assert_none(&wrong);
    assert!(compared >= 10, "only {compared} classes transmit");
}

#[test]
fn every_direction_has_finite_numbers() {
    let mut wrong = Vec::new();
    for spec in models::all() {
        let variants = variants(&node(spec));
        assert!(!variants.is_empty(), "no variant of {} can be built", spec.class.name);
        for (name, model) in variants {
            for at in everywhere() {
                for basis in [Basis::Psps, Basis::Plane] {
                    let m = model.mueller(&at, basis);
                    if !m.0.iter().flatten().all(|x| x.is_finite()) {
                        wrong.push(format!("{name} at {at:?}, {basis:?}"));
                    }
                }
            }
        }
    }
    assert_none(&wrong);
}

/// Normal, specular, backwards, grazing, at and below the horizon, negative, at critical angles.
fn everywhere() -> Vec<Geometry> {
    let thetas = [0.0, 1e-12, 0.5, (1.0f64 / 1.5).asin(), FRAC_PI_2 - 1e-7, FRAC_PI_2, -0.5];
    let mut all = Vec::new();
    for theta_i in thetas {
        for theta_s in thetas {
            for phi_s in [0.0, 1e-9, FRAC_PI_2, PI] {
                all.push(Geometry { theta_i, theta_s, phi_s, rotation: 0.3 });
            }
        }
    }
    all
}

#[test]
fn along_the_normal_every_basis_is_the_limit_of_its_azimuth_but_not_under_compat() {
    let at = |theta_s| Geometry { theta_i: 0.4, theta_s, phi_s: 0.7, rotation: 0.1 };
    let step = |model: &Model, basis| {
        let (m, near) = (model.mueller(&at(0.0), basis), model.mueller(&at(1e-8), basis));
        // Some models scatter nothing.
        (m - near).largest() / m.largest().max(f64::MIN_POSITIVE)
    };
    for spec in models::all() {
        let name = spec.class.name;
        if name.contains("RCW") {
            // Light in a few directions only.
            continue;
        }
        let model = models::build(&node(spec)).ok();
        let model = model.or_else(|| through(&node(spec), 1.5, 0));
        let model = model.or_else(|| through(&node(spec), 1.0, 0)).expect("one of them is built");
        for basis in [Basis::Psps, Basis::Xyxy, Basis::Plane] {
            // 10⁻⁸ rad times the slope of a narrow lobe.
            let jump = step(&model, basis);
            assert!(jump < 1e-5, "{name}, {basis:?}: {jump:e}");
        }
    }
    let class = &models::find("Microroughness_BRDF_Model").unwrap().class;
    let compat = models::build(&ParameterNode::with_defaults(class, Mode::Compat)).unwrap();
    assert!(step(&compat, Basis::Psps) < 1e-5 && step(&compat, Basis::Xyxy) > 0.1);
}

#[test]
fn the_mirror_image_has_the_mirrored_matrix() {
    let q = Mueller::diagonal([1.0, 1.0, -1.0, -1.0]);
    let mut wrong = Vec::new();
    for (name, model) in claimed(|laws| laws.mirror) {
        for at in geometries() {
            let image = Geometry { phi_s: -at.phi_s, rotation: -at.rotation, ..at };
            let expected = q * model.mueller(&at, Basis::Psps) * q;
            wrong.extend(compare(&name, &at, model.mueller(&image, Basis::Psps), expected));
        }
    }
    assert_none(&wrong);
}

#[test]
fn matrices_can_be_realized() {
    let mut wrong = Vec::new();
    for (name, model) in claimed(|laws| laws.realizable) {
        for at in geometries() {
            if !is_realizable(&model.mueller(&at, Basis::Psps)) {
                wrong.push(format!("{name} at {at:?}"));
            }
        }
    }
    assert_none(&wrong);
}

#[test]
fn passive_models_return_no_more_light_than_came() {
    for (name, model) in claimed(|laws| laws.passive) {
        for theta_i in [0.0, 0.7, 1.4] {
            let returned = most_returned(&model, theta_i);
            assert!(returned < 1.0 + 1e-6, "{name} at {theta_i}: {returned}");
        }
    }
}

/// The fraction that returns of the incident polarization of which most returns.
fn most_returned(model: &Model, theta_i: f64) -> f64 {
    let (steps, azimuths) = (200, 48);
    let mut sum = Mueller::ZERO;
    for i in 0..steps {
        // The midpoint rule in sin²θ, in which a constant is exact.
        let sin2 = (f64::from(i) + 0.5) / f64::from(steps);
        for j in 0..azimuths {
            let phi_s = TAU * f64::from(j) / f64::from(azimuths);
            let at = Geometry { theta_i, theta_s: sin2.sqrt().asin(), phi_s, rotation: 0.3 };
            let weight = FRAC_PI_2 * 2.0 / f64::from(steps * azimuths);
            sum += model.mueller(&at, Basis::Psps) * weight;
        }
    }
    let polarized = (1..4).map(|k| sum[(0, k)] * sum[(0, k)]).sum::<f64>().sqrt();
    sum[(0, 0)] + polarized
}

/// True if the coherency matrix H = ¼ Σ m_ij σ_i ⊗ σ_j* has no eigenvalue below
/// −[`REALIZABLE`]·M00: whether H plus that much of the unit matrix has a Cholesky factor.
fn is_realizable(m: &Mueller) -> bool {
    let shift = REALIZABLE * m[(0, 0)];
    let mut l = [[Complex64::ZERO; 4]; 4];
    for column in 0..4 {
        for row in column..4 {
            let known: Complex64 = (0..column).map(|k| l[row][k] * l[column][k].conj()).sum();
            let rest = coherency(m, row, column) - known;
            if row > column {
                l[row][column] = rest / l[column][column];
                continue;
            }
            let pivot = rest.re + shift;
            if pivot <= 0.0 {
                return m[(0, 0)] == 0.0 && m.largest() == 0.0;
            }
            l[row][row] = pivot.sqrt().into();
        }
    }
    true
}

/// The element (row, column) of H; both indices count the pairs (out, in).
fn coherency(m: &Mueller, row: usize, column: usize) -> Complex64 {
    let mut sum = Complex64::ZERO;
    for i in 0..4 {
        for j in 0..4 {
            let out = pauli(i, row / 2, column / 2);
            let into = pauli(j, row % 2, column % 2).conj();
            sum += 0.25 * m[(i, j)] * out * into;
        }
    }
    sum
}

/// The matrices of I, Q, U and V = 2 Im(E_s* E_p).
fn pauli(k: usize, row: usize, column: usize) -> Complex64 {
    let i = Complex64::I;
    let (one, zero) = (Complex64::ONE, Complex64::ZERO);
    let matrices = [
        [[one, zero], [zero, one]],
        [[one, zero], [zero, -one]],
        [[zero, one], [one, zero]],
        [[zero, -i], [i, zero]],
    ];
    matrices[k][row][column]
}

#[test]
fn the_test_of_realizability_knows_good_matrices_from_bad_ones() {
    let jones = scattering::Jones {
        ss: Complex64::new(0.3, 0.1),
        ps: Complex64::new(-0.2, 0.7),
        sp: Complex64::new(0.1, 0.4),
        pp: Complex64::new(0.9, -0.5),
    };
    assert!(is_realizable(&jones.mueller()));
    assert!(is_realizable(&Mueller::diagonal([1.0, 0.0, 0.0, 0.0])));
    assert!(is_realizable(&Mueller::diagonal([1.0, 1.0, -1.0, -1.0])));
    // A mirror that keeps the handedness of all light.
    assert!(!is_realizable(&Mueller::diagonal([1.0, 1.0, 1.0, -1.0])));
    assert!(!is_realizable(&Mueller::diagonal([1.0, 1.1, 1.0, 1.0])));
}
