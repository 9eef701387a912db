//! Laws of every grating, for any number of harmonics.

use std::f64::consts::PI;

use scattering::{Basis, Geometry, Model, Mueller, ParameterValue, cross_grating, grating, models};

use super::parts::{ALPHA, LineStack, efficiency, index, integer, member, model, node, number};

/// Rounding of some tens of matrix products of elements up to 100.
const ROUNDING: f64 = 1e-11;

fn triangular() -> [(&'static str, ParameterValue); 4] {
    [
        ("material", index(1.5, 0.0)),
        ("amplitude", number(0.3)),
        ("aspect", number(0.2)),
        ("nlevels", integer(4)),
    ]
}

const GLASS: LineStack = LineStack { lambda: 0.5, period: 0.7, order: 6, substrate: (1.5, 0.0) };

/// Efficiency of the order that goes straight on.
fn specular(model: &Model, theta: f64, rotation: f64) -> Mueller {
    let at = Geometry { theta_i: theta, theta_s: theta, phi_s: 0.0, rotation };
    model.mueller(&at, Basis::Psps) * (theta.cos() * PI * ALPHA * ALPHA)
}

fn assert_same(got: Mueller, want: Mueller, tolerance: f64, what: &str) {
    let error = (got - want).largest();
    assert!(error < tolerance * want.largest().max(1e-3), "{what}: {got:?} is not {want:?}");
}

/// P Mᵀ P with P = diag(1, 1, −1, 1).
fn reversed(m: Mueller) -> Mueller {
    let p = Mueller::diagonal([1.0, 1.0, -1.0, 1.0]);
    p * m.transposed() * p
}

/// (s, p) light sent to all the orders of a line grating.
fn total(model: &Model, theta: f64, rotation: f64, step: f64, exit: f64) -> (f64, f64) {
    let mut sum = Mueller::ZERO;
    for order in -6..=6 {
        let order = f64::from(order);
        let x = (theta.sin() + order * step * rotation.cos()) / exit;
        let y = order * step * rotation.sin() / exit;
        if x.hypot(y) < 1.0 {
            sum += efficiency(model, theta, rotation, x, y);
        }
    }
    (sum[(0, 0)] + sum[(0, 1)], sum[(0, 0)] - sum[(0, 1)])
}

#[test]
fn transparent_gratings_lose_nothing() {
    for (theta, rotation) in [(0.0, 0.0), (0.4, 0.0), (0.7, 1.1), (-0.3, 2.9)] {
        let step = GLASS.lambda / GLASS.period;
        let (rs, rp) =
            total(&GLASS.model(0, "Triangular_Grating", &triangular()), theta, rotation, step, 1.0);
        let (ts, tp) =
            total(&GLASS.model(1, "Triangular_Grating", &triangular()), theta, rotation, step, 1.5);
        assert!((rs + ts - 1.0).abs() < ROUNDING, "s at {theta}, {rotation}: {rs} + {ts}");
        assert!((rp + tp - 1.0).abs() < ROUNDING, "p at {theta}, {rotation}: {rp} + {tp}");
    }
}

#[test]
fn grating_without_height_reflects_as_fresnel() {
    let lines = LineStack { lambda: 0.5, period: 0.7, order: 3, substrate: (4.05, 0.05) };
    let model = lines.model(0, "Single_Line_Grating", &[("height", number(0.0))]);
    let (n, theta) = (num_complex::Complex64::new(4.05, 0.05), 0.9_f64);
    let epsilon = n * n;
    let q = (epsilon - theta.sin().powi(2)).sqrt();
    let (rs, rp) = (
        (theta.cos() - q) / (theta.cos() + q),
        (epsilon * theta.cos() - q) / (epsilon * theta.cos() + q),
    );
    let fresnel = scattering::Jones::diagonal(rs, rp).mueller();
    for rotation in [0.0, 0.8] {
        assert_same(specular(&model, theta, rotation), fresnel, ROUNDING, "Fresnel");
    }
}

#[test]
fn blazed_grating_is_reciprocal() {
    for kind in [0, 2] {
        let model = GLASS.model(kind, "Triangular_Grating", &triangular());
        for rotation in [0.0, 0.9] {
            // The order that goes straight on keeps the harmonics of the reversed beam.
            let (m, back) = (specular(&model, 0.5, rotation), specular(&model, 0.5, rotation + PI));
            assert_same(back, reversed(m), ROUNDING, "reversed beam");
        }
    }
}

#[test]
fn light_through_a_grating_and_back_is_reciprocal() {
    let into = GLASS.model(1, "Triangular_Grating", &triangular());
    let out = GLASS.model(3, "Triangular_Grating", &triangular());
    let (outside, inside): (f64, f64) = (0.6, (0.6_f64.sin() / 1.5).asin());
    let ask = |model: &Model, theta_i: f64, theta_s: f64, rotation: f64| {
        let at = Geometry { theta_i, theta_s, phi_s: 0.0, rotation };
        model.mueller(&at, Basis::Psps) * (theta_s.cos() * PI * ALPHA * ALPHA)
    };
    for rotation in [0.0, 0.9] {
        let m1 = ask(&into, outside, inside, rotation);
        let m3 = ask(&out, inside, outside, rotation + PI);
        // The factor n² of radiance is absent: these are fluxes.
        assert_same(m1, reversed(m3), ROUNDING, "transmitted beam");
    }
}

#[test]
fn symmetric_lines_have_the_mirror_symmetry() {
    let model = GLASS.model(0, "Sinusoidal_Relief_Grating", &[("nlevels", integer(3))]);
    let q = Mueller::diagonal([1.0, 1.0, -1.0, -1.0]);
    let (theta, rotation, step) = (0.4_f64, 0.7_f64, -GLASS.lambda / GLASS.period);
    let (x, y) = (theta.sin() + step * rotation.cos(), step * rotation.sin());
    let right = efficiency(&model, theta, rotation, x, y);
    let left = efficiency(&model, theta, -rotation, x, -y);
    assert!(right.largest() > 1e-3);
    assert_same(left, q * right * q, ROUNDING, "mirror image");
}

#[test]
fn conical_formulation_joins_the_one_across_the_lines() {
    let model = GLASS.model(0, "Triangular_Grating", &triangular());
    // A rotation too small to change anything but the formulation.
    let (across, conical) = (specular(&model, 0.5, 0.0), specular(&model, 0.5, 1e-13));
    assert_same(conical, across, ROUNDING, "conical");
}

fn crossed(
    lambda: f64,
    order: i32,
    kind: i32,
    class: &str,
    values: &[(&str, ParameterValue)],
) -> Model {
    let mut all = vec![("medium_t", index(1.5, 0.0))];
    all.extend(values.iter().map(|(name, value)| (*name, value.clone())));
    model(
        "CrossRCW_BRDF_Model",
        &[
            ("lambda", number(lambda)),
            ("alpha", number(ALPHA)),
            ("order1", integer(order)),
            ("order2", integer(order)),
            ("substrate", index(1.5, 0.0)),
            ("type", integer(kind)),
            ("grating", member(class, &all)),
        ],
    )
}

fn lines(period: f64) -> ParameterValue {
    let mut all = vec![("period", number(period)), ("medium_t", index(1.5, 0.0))];
    all.extend(triangular());
    member("Triangular_Grating", &all)
}

#[test]
fn crossed_model_of_lines_is_the_line_model_for_every_angle_of_the_axes() {
    let line = GLASS.model(0, "Triangular_Grating", &triangular());
    for zeta in [0.0, 25.0] {
        let values = [("zeta", number(zeta)), ("grating", lines(GLASS.period))];
        let one = crossed(GLASS.lambda, GLASS.order, 0, "OneD_CrossGrating", &values);
        // Lines across axis 1 lean with axis 2: they are at −ζ against x.
        let turn = zeta * PI / 180.0;
        for rotation in [0.0, 0.4] {
            let (a, b) = (specular(&one, 0.5, rotation), specular(&line, 0.5, rotation - turn));
            assert_same(a, b, ROUNDING, "line grating");
        }
    }
}

#[test]
fn two_dimensional_harmonics_of_leaning_lines_change_nothing() {
    // A flat second grating makes the model keep both axes; with the lines alone the harmonics of
    // the other axis must stay empty. The upper lines vary along axis 1, which is at −25° against
    // x, the lower ones along axis 2, which is at 90°.
    let flat = |medium: f64| {
        member(
            "Sinusoidal_Relief_Grating",
            &[
                ("period", number(0.6)),
                ("medium_i", index(medium, 0.0)),
                ("medium_t", index(medium, 0.0)),
                ("material", index(medium, 0.0)),
                ("amplitude", number(0.1)),
                ("nlevels", integer(1)),
            ],
        )
    };
    let line = LineStack { order: 2, ..GLASS }.model(0, "Triangular_Grating", &triangular());
    let upper = [("top", lines(GLASS.period)), ("bottom", flat(1.5)), ("angle", number(65.0))];
    let lower = [("top", flat(1.0)), ("bottom", lines(GLASS.period)), ("angle", number(65.0))];
    for (values, degrees, what) in [(upper, -25.0_f64, "upper lines"), (lower, 90.0, "lower lines")]
    {
        let both = crossed(GLASS.lambda, 2, 0, "Overlaid_1D_CrossGrating", &values);
        let want = specular(&line, 0.5, 0.4 + degrees.to_radians());
        assert_same(specular(&both, 0.5, 0.4), want, ROUNDING, what);
    }
}

#[test]
fn transparent_crossed_gratings_lose_nothing() {
    let (lambda, d1, d2, theta, rotation) = (0.6, 0.5, 0.45, 0.5_f64, 0.3_f64);
    for zeta in [0.0_f64, 20.0] {
        let values = [
            ("zeta", number(zeta)),
            ("d1", number(d1)),
            ("d2", number(d2)),
            ("grid1", integer(40)),
            ("grid2", integer(40)),
            ("length1", number(0.25)),
            ("length2", number(0.2)),
            ("inside", index(2.2, 0.0)),
            ("outside", index(1.0, 0.0)),
            ("thickness", number(0.2)),
        ];
        let mut sum = Mueller::ZERO;
        for (kind, exit) in [(0, 1.0), (1, 1.5)] {
            let model = crossed(lambda, 2, kind, "Rectangle_CrossGrating", &values);
            for (i, j) in (-2..=2).flat_map(|i| (-2..=2).map(move |j| (f64::from(i), f64::from(j))))
            {
                let (gx, lean) = (i * lambda / d1, zeta.to_radians());
                let gy = (j * lambda / d2 - gx * lean.sin()) / lean.cos();
                let x = theta.sin() + gx * rotation.cos() - gy * rotation.sin();
                let y = gx * rotation.sin() + gy * rotation.cos();
                if x.hypot(y) < exit {
                    sum += efficiency(&model, theta, rotation, x / exit, y / exit);
                }
            }
        }
        assert!((sum[(0, 0)] - 1.0).abs() < ROUNDING, "zeta {zeta}: {}", sum[(0, 0)]);
        assert!(sum[(0, 1)].abs() < ROUNDING, "zeta {zeta}: {}", sum[(0, 1)]);
    }
}

#[test]
fn grating_turned_by_a_right_angle_with_its_axes_exchanged_is_the_same() {
    let of = |length1: f64, length2: f64| {
        let values = [
            ("d1", number(0.5)),
            ("d2", number(0.5)),
            ("grid1", integer(20)),
            ("grid2", integer(20)),
            ("length1", number(length1)),
            ("length2", number(length2)),
            ("inside", index(2.2, 0.1)),
            ("outside", index(1.0, 0.0)),
            ("thickness", number(0.2)),
        ];
        crossed(0.6, 2, 0, "Rectangle_CrossGrating", &values)
    };
    let (a, b) = (specular(&of(0.3, 0.1), 0.6, 0.2), specular(&of(0.1, 0.3), 0.6, 0.2 + PI / 2.0));
    assert_same(a, b, ROUNDING, "turned grating");
}

#[test]
fn square_lattice_described_with_oblique_axes_converges_to_the_same() {
    let of = |d2: f64, zeta: f64, order: i32| {
        let values = [
            ("d1", number(0.4)),
            ("d2", number(d2)),
            ("zeta", number(zeta)),
            ("grid1", integer(64)),
            ("grid2", integer(64)),
            ("rtop", ParameterValue::Table(scattering::optics::RealFunction::constant(0.1))),
            ("rbottom", ParameterValue::Table(scattering::optics::RealFunction::constant(0.1))),
            ("inside", index(2.0, 0.0)),
            ("outside", index(1.0, 0.0)),
            ("thickness", number(0.15)),
        ];
        specular(&crossed(0.7, order, 0, "Cylinder_CrossGrating", &values), 0.4, 0.2)
    };
    let gap = |order: i32| (of(0.4 * 2.0_f64.sqrt(), 45.0, order) - of(0.4, 0.0, order)).largest();
    // On round posts the rules for edges along the axes converge like 1/order; the sets of
    // harmonics and the pixels of the two descriptions differ.
    let (coarse, fine) = (gap(1), gap(4));
    assert!(fine < 0.5 * coarse, "{coarse} at order 1, {fine} at order 4");
}

#[test]
fn upper_grating_alone_may_be_moved_sideways() {
    let post = |shift: f64| {
        let flat = member(
            "Null_CrossGrating",
            &[("medium_i", index(1.0, 0.0)), ("medium_t", index(1.5, 0.0))],
        );
        let post = member(
            "Rectangle_CrossGrating",
            &[
                ("medium_t", index(1.0, 0.0)),
                ("grid1", integer(20)),
                ("grid2", integer(20)),
                ("length1", number(0.2)),
                ("length2", number(0.3)),
                ("inside", index(2.2, 0.1)),
                ("outside", index(1.0, 0.0)),
            ],
        );
        let values = [
            ("top", post),
            ("bottom", flat),
            ("overlay1", number(shift)),
            ("overlay2", number(0.07)),
        ];
        crossed(0.6, 2, 0, "Overlaid_CrossGrating", &values)
    };
    let (a, b) = (specular(&post(0.0), 0.6, 0.2), specular(&post(0.13), 0.6, 0.2));
    assert_same(a, b, ROUNDING, "moved grating");
}

#[test]
fn every_grating_may_stand_where_a_grating_is_wanted() {
    for family in [&grating::FAMILY, &cross_grating::FAMILY] {
        for class in family.classes() {
            assert!(family.is_below(class.name, family.base), "{}", class.name);
        }
    }
}

#[test]
fn parameters_out_of_range_are_named() {
    for (class, name, value, named) in [
        ("RCW_BRDF_Model", "alpha", number(0.0), "alpha"),
        ("RCW_BRDF_Model", "order", integer(-1), "order"),
        ("RCW_BRDF_Model", "order", integer(i32::MAX), "order"),
        ("RCW_BRDF_Model", "substrate", index(1.5, 0.0), "grating.medium_t"),
        ("CrossRCW_BRDF_Model", "alpha", number(f64::NAN), "alpha"),
        ("CrossRCW_BRDF_Model", "order2", integer(-3), "order2"),
        (
            "RCW_BRDF_Model",
            "grating",
            member("Single_Line_Grating", &[("medium_i", index(1.3, 0.0))]),
            "grating.medium_i",
        ),
        (
            "RCW_BRDF_Model",
            "grating",
            member("Single_Line_Grating", &[("topwidth", number(2.0))]),
            "grating.topwidth",
        ),
        ("RCW_BRDF_Model", "grating", member("Overlaid_Grating", &[]), "grating.bottom.medium_i"),
        ("RCW_BRDF_Model", "grating", member("Generic_Grating", &[]), "grating.filename"),
        ("CrossRCW_BRDF_Model", "grating", member("Generic_CrossGrating", &[]), "grating.filename"),
    ] {
        let error = models::build(&node(class, &[(name, value)])).err();
        let error = error.unwrap_or_else(|| panic!("{class} takes {name}"));
        assert_eq!(error.parameter, named, "{}", error.problem);
    }
}
