//! NIST's tables for the conformance programs, whose parameters are repeated here.

use std::{f64::consts::PI, fs, path::Path};

use scattering::{
    Model, ParameterValue,
    optics::{AbscissaScale, RealFunction, RefractiveIndex, TableInterpolation},
};

use super::parts::{direction, index, integer, member, model, number, projected, seen, text};

const DEG: f64 = PI / 180.0;

/// Agreement of NIST's builds among themselves is 1e-13 of a value; ours differs by the method
/// (no eigenvalues), which costs the rounding of some hundred matrix products.
const TOLERANCE: f64 = 1e-11;

fn rows(program: &str) -> Vec<Vec<f64>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/conformance");
    let name = program.rsplit('/').next().unwrap();
    let path = folder.join(program).join(format!("expected/{name}.dat"));
    let table = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| line.split_whitespace().map(|x| x.parse().unwrap()).collect())
        .collect();
    assert!(!rows.is_empty(), "{program}");
    rows
}

/// s → all, p → all, +45° → left circular.
const SOURCES: [([f64; 4], [f64; 4]); 3] = [
    ([1.0, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]),
    ([1.0, -1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]),
    ([1.0, 0.0, 1.0, 0.0], [0.5, 0.0, 0.0, 0.5]),
];

fn compare(what: &str, got: &[f64], row: &[f64]) {
    let largest = row.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (got, want) in got.iter().zip(row) {
        let error = (got - want).abs() / largest;
        assert!(error < TOLERANCE, "{what}: {got:e} is not {want:e}, off by {error:e}");
    }
    assert_eq!(got.len(), row.len(), "{what}");
}

/// A line grating of period `period` seen by NIST's programs: orders 0 and −1 at each angle.
struct OrderAngles {
    lambda: f64,
    period: f64,
    rotation: f64,
    exit: f64,
    orders: &'static [i32],
}

impl OrderAngles {
    fn check(&self, program: &str, model: &Model) {
        let alpha = DEG;
        for row in rows(program) {
            let theta = row[0] * DEG;
            let mut got = Vec::new();
            for &order in self.orders {
                let step = f64::from(order) * self.lambda / self.period;
                let x = theta.sin() + step * self.rotation.cos();
                let to = direction(x / self.exit, step * self.rotation.sin() / self.exit);
                let m = projected(model, theta, self.rotation, &to);
                got.extend(
                    SOURCES
                        .map(|(source, detector)| seen(&m, source, detector) * PI * alpha * alpha),
                );
            }
            compare(&format!("{program} at {} deg", row[0]), &got, &row[1..]);
        }
    }
}

fn line_model(
    lambda: f64,
    order: i32,
    kind: i32,
    substrate: ParameterValue,
    grating: ParameterValue,
) -> Model {
    model(
        "RCW_BRDF_Model",
        &[
            ("lambda", number(lambda)),
            ("alpha", number(DEG)),
            ("type", integer(kind)),
            ("order", integer(order)),
            ("substrate", substrate),
            ("grating", grating),
        ],
    )
}

#[test]
fn trapezoidal_line_has_nists_orders() {
    let (lambda, period) = (0.569, 1.077);
    let grating = member(
        "Single_Line_Grating",
        &[
            ("period", number(period)),
            ("height", number(0.115)),
            ("topwidth", number(period * 0.388)),
            ("bottomwidth", number(period * 0.54)),
            ("nlevels", integer(4)),
        ],
    );
    let model = line_model(lambda, 11, 0, index(4.05, 0.05), grating);
    OrderAngles { lambda, period, rotation: 0.0, exit: 1.0, orders: &[0, -1] }
        .check("programs/v_rcw_line", &model);
}

#[test]
fn conical_mounting_has_nists_orders() {
    let (lambda, period) = (0.496, 0.992);
    let grating = member(
        "Single_Line_Grating",
        &[
            ("period", number(period)),
            ("material", index(1.5, 0.0)),
            ("height", number(0.134)),
            ("topwidth", number(0.3)),
            ("bottomwidth", number(0.35)),
            ("nlevels", integer(3)),
        ],
    );
    let model = line_model(lambda, 6, 0, index(4.05, 0.05), grating);
    OrderAngles { lambda, period, rotation: 10.5 * DEG, exit: 1.0, orders: &[0] }
        .check("programs/v_rcw_conical", &model);
}

#[test]
fn sinusoidal_relief_has_nists_orders() {
    let (lambda, period) = (0.529, 0.762);
    let grating = member(
        "Sinusoidal_Relief_Grating",
        &[
            ("period", number(period)),
            ("material", index(2.0, 0.1)),
            ("amplitude", number(0.15)),
            ("nlevels", integer(6)),
            ("option", integer(1)),
        ],
    );
    let model = line_model(lambda, 7, 0, index(4.05, 0.05), grating);
    OrderAngles { lambda, period, rotation: 0.0, exit: 1.0, orders: &[0, -1] }
        .check("programs/v_rcw_shapes", &model);
}

#[test]
fn transmitted_orders_are_nists() {
    let (lambda, period) = (0.611, 1.166);
    let grating = member(
        "Single_Line_Grating",
        &[
            ("period", number(period)),
            ("medium_t", index(1.5, 0.0)),
            ("material", index(2.0, 0.0)),
            ("height", number(0.2)),
            ("topwidth", number(0.3)),
            ("bottomwidth", number(0.3)),
            ("nlevels", integer(1)),
        ],
    );
    let model = line_model(lambda, 8, 1, index(1.5, 0.0), grating);
    OrderAngles { lambda, period, rotation: 0.0, exit: 1.5, orders: &[0, -1] }
        .check("programs/v_rcw_transmission", &model);
}

#[test]
fn volume_hologram_has_nists_orders() {
    let (lambda, period) = (0.609, 1.012);
    let grating = member(
        "Sinusoidal_Volume_Grating",
        &[
            ("period", number(period)),
            ("medium_t", index(1.48, 0.0)),
            ("minimum", index(1.45, 0.0)),
            ("maximum", index(1.629, 0.0)),
            ("thick", number(1.437)),
        ],
    );
    let model = line_model(lambda, 6, 0, index(1.48, 0.0), grating);
    OrderAngles { lambda, period, rotation: 0.0, exit: 1.0, orders: &[0, -1] }
        .check("programs/v_rcw_volume", &model);
}

#[test]
fn overlaid_gratings_have_nists_orders() {
    let (lambda, period) = (0.599, 0.884);
    let top = member(
        "Single_Line_Grating",
        &[
            ("period", number(period)),
            ("medium_t", index(1.0, 0.0)),
            ("material", index(2.0, 0.1)),
            ("height", number(0.1)),
            ("topwidth", number(0.3)),
            ("bottomwidth", number(0.3)),
            ("nlevels", integer(1)),
        ],
    );
    let bottom = member(
        "Single_Line_Grating",
        &[
            ("period", number(period)),
            ("material", index(1.8, 0.0)),
            ("height", number(0.15)),
            ("topwidth", number(0.35)),
            ("bottomwidth", number(0.4)),
            ("nlevels", integer(2)),
        ],
    );
    let grating = member(
        "Overlaid_Grating",
        &[("period", number(period)), ("overlay", number(0.126)), ("top", top), ("bottom", bottom)],
    );
    let model = line_model(lambda, 6, 0, index(4.05, 0.05), grating);
    OrderAngles { lambda, period, rotation: 0.0, exit: 1.0, orders: &[0, -1] }
        .check("programs/v_rcw_overlaid", &model);
}

#[test]
fn drawn_grating_has_nists_orders() {
    let (lambda, period) = (0.542, 0.989);
    let drawing = include_str!("../../../tests/conformance/programs/v_rcw_generic/trap.grt");
    let grating = member(
        "Generic_Grating",
        &[
            ("period", number(period)),
            ("filename", text(drawing)),
            ("pstring", text("(0.122,0.328,0.15)")),
            ("nlayers", integer(8)),
        ],
    );
    let model = line_model(lambda, 5, 0, index(4.05, 0.05), grating);
    OrderAngles { lambda, period, rotation: 0.0, exit: 1.0, orders: &[0] }
        .check("programs/v_rcw_generic", &model);
}

#[test]
fn rounded_lines_have_nists_spectrum() {
    let period = 1.056;
    for row in rows("programs/v_rcw_spectral") {
        let grating = member(
            "Corner_Rounded_Grating",
            &[
                ("period", number(period)),
                ("material", index(3.9, 0.02)),
                ("height", number(0.15)),
                ("width", number(0.3)),
                ("sidewall", number(85.0)),
                ("radiusb", number(0.02)),
                ("radiust", number(0.02)),
                ("nlevels", integer(6)),
            ],
        );
        let model = line_model(row[0], 7, 0, index(4.05, 0.05), grating);
        let theta = SPECTRAL_ANGLE * DEG;
        let m = projected(&model, theta, 0.0, &direction(theta.sin(), 0.0));
        let got = SOURCES.map(|(from, to)| seen(&m, from, to) * PI * DEG * DEG);
        compare(&format!("v_rcw_spectral at {} um", row[0]), &got, &row[1..]);
    }
}

/// The program's fixed angle of incidence.
const SPECTRAL_ANGLE: f64 = 14.9;

#[test]
fn dispersive_lines_have_nists_spectrum() {
    let data = include_str!("../../../tests/conformance/bench/b05_rcw_spectral/semiA.dat");
    let points: Vec<[f64; 3]> = data
        .lines()
        .skip(1)
        .map(|line| {
            let mut x = line.split_whitespace().map(|x| x.parse().unwrap());
            std::array::from_fn(|_| x.next().unwrap())
        })
        .collect();
    let table = |column: usize| {
        let rows: Vec<(f64, f64)> = points.iter().map(|p| (p[0], p[column])).collect();
        RealFunction::points(&rows, AbscissaScale::Linear, TableInterpolation::Linear)
    };
    let material = ParameterValue::Index(RefractiveIndex { n: table(1), k: table(2) });
    let (period, theta) = (1.171, 24.8 * DEG);
    for row in rows("bench/b05_rcw_spectral") {
        let grating = member(
            "Single_Line_Grating",
            &[
                ("period", number(period)),
                ("material", material.clone()),
                ("height", number(0.25)),
                ("topwidth", number(0.3)),
                ("bottomwidth", number(0.4)),
                ("nlevels", integer(8)),
            ],
        );
        let model = line_model(row[0], 20, 0, index(4.05, 0.05), grating);
        let mut got = Vec::new();
        for order in [0.0, -1.0] {
            let to = direction(theta.sin() + order * row[0] / period, 0.0);
            let m = projected(&model, theta, 0.0, &to);
            for (from, detector) in [
                ([1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0]),
                ([1.0, 0.48, -0.6, 0.64], [0.5, 0.1, -0.35, 0.2]),
                ([1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]),
            ] {
                got.push(seen(&m, from, detector) * PI * DEG * DEG);
            }
        }
        compare(&format!("b05_rcw_spectral at {} um", row[0]), &got, &row[1..]);
    }
}

/// The value of one program of a crossed grating: order 0, three pairs of polarizations.
fn check_crossed(program: &str, model: &Model, rotation: f64) {
    for row in rows(program) {
        let theta = row[0] * DEG;
        let m = projected(model, theta, rotation, &direction(theta.sin(), 0.0));
        let got = [
            ([1.0, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]),
            ([1.0, -1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]),
            ([1.0, 0.48, -0.6, 0.64], [0.5, 0.1, -0.35, 0.2]),
        ]
        .map(|(from, to)| seen(&m, from, to));
        compare(&format!("{program} at {} deg", row[0]), &got, &row[1..]);
    }
}

fn crossed_model(lambda: f64, grating: ParameterValue) -> Model {
    model(
        "CrossRCW_BRDF_Model",
        &[
            ("lambda", number(lambda)),
            ("alpha", number(0.02)),
            ("order1", integer(2)),
            ("order2", integer(2)),
            ("substrate", index(1.5, 0.0)),
            ("grating", grating),
        ],
    )
}

#[test]
fn line_grating_as_a_crossed_one_has_nists_order() {
    let lines = member(
        "Single_Line_Grating",
        &[
            ("period", number(0.6)),
            ("medium_t", index(1.5, 0.0)),
            ("material", index(2.0, 0.0)),
            ("height", number(0.15)),
            ("topwidth", number(0.25)),
            ("bottomwidth", number(0.3)),
            ("nlevels", integer(2)),
        ],
    );
    let grating = member("OneD_CrossGrating", &[("medium_t", index(1.5, 0.0)), ("grating", lines)]);
    check_crossed("programs/v_crossrcw_oned", &crossed_model(0.621, grating), 0.144);
}

#[test]
fn conical_holes_have_nists_order() {
    let grating = member(
        "Cylinder_CrossGrating",
        &[
            ("medium_t", index(1.5, 0.0)),
            ("grid1", integer(64)),
            ("grid2", integer(64)),
            ("d1", number(0.5)),
            ("d2", number(0.411)),
            ("thickness", number(0.12)),
            ("inside", index(1.0, 0.0)),
            ("outside", index(2.0, 0.0)),
            ("rtop", ParameterValue::Table(RealFunction::constant(0.15))),
            ("rbottom", ParameterValue::Table(RealFunction::constant(0.12))),
            ("nlevels", integer(2)),
        ],
    );
    check_crossed("programs/v_crossrcw_holes", &crossed_model(0.56, grating), 0.145);
}
