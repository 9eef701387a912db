//! Adaptive integrals lie within their own errors of references: lobes from slope 0.001 to 1 and
//! apertures of every shape that cut through the lobe and the horizon.

use std::f64::consts::FRAC_PI_2;

use mist_engine::{
    region::Region,
    sampling::adaptive::{Demand, integrate},
};
use rayon::prelude::*;
use scattering::{Basis, Incidence, Mode, Model, Node, Value, models, spec};

use crate::plane;

/// One integral whose value is known.
struct Case {
    name: &'static str,
    model: Model,
    theta_i: f64,
    region: Region,
    /// About the width of the lobe in direction cosines.
    width: f64,
}

fn node(name: &str) -> Node {
    Node::with_defaults(spec::find_class(name).unwrap(), Mode::Sound)
}

/// Facets with a density of slopes `sdf` of rms `slope`.
fn facets(sdf: &str, slope: f64) -> Model {
    let sdf = node(sdf).with("s", Value::Number(slope)).unwrap();
    let facets = node("Facet_BRDF_Model").with("sdf", Value::Member(sdf.into())).unwrap();
    models::build(&facets).unwrap()
}

/// Roughness with a spectral density that falls at `1/length`.
fn rough(length: f64) -> Model {
    let psd = node("ABC_PSD_Function").with("B", Value::Number(length)).unwrap();
    let model = node("Microroughness_BRDF_Model").with("psd", Value::Member(psd.into())).unwrap();
    models::build(&model).unwrap()
}

/// Apertures around the mirror direction (`theta`, 0) of a lobe `wide` radians wide.
fn apertures(theta: f64, wide: f64) -> Vec<(&'static str, Region)> {
    let circle = |center, alpha| Region::Circle { center, alpha };
    let annulus = |outer_center, outer_alpha, inner_center, inner_alpha| Region::Annulus {
        outer_center,
        outer_alpha,
        inner_center,
        inner_alpha,
    };
    let polygon = |vertices: &[(f64, f64)]| Region::Polygon {
        vertices: vertices.to_vec(),
        polarization_center: (theta, 0.0),
    };
    let degree = 0.0174533;
    vec![
        ("hemisphere", Region::Hemi),
        ("cone of 5 degrees", circle((theta, 0.0), 5.0 * degree)),
        ("cone with its rim through the mirror", circle((theta - 0.1, 0.0), 0.1)),
        ("cone beside the mirror", circle((theta, 0.15 + 0.5 * wide), 0.15 * theta.sin())),
        ("cone across the horizon", circle((1.2, 0.1), 0.7)),
        ("cone around the horizon", circle((FRAC_PI_2, 0.0), 1.1)),
        ("ring around the mirror", annulus((theta, 0.0), 0.3, (theta, 0.0), wide.min(0.2))),
        ("ring across the horizon", annulus((1.1, 0.05), 0.8, (1.25, 0.2), 0.25)),
        (
            "rings that cross",
            annulus((theta, 0.0), 0.25, (theta + 0.2, 0.0), 0.2 - 0.5 * wide.min(0.2)),
        ),
        ("triangle", polygon(&[(theta - 0.3, 0.1), (theta + 0.2, 0.4), (theta + 0.1, -0.3)])),
        ("corner on the mirror", polygon(&[(theta, 0.0), (theta + 0.3, 0.3), (theta + 0.3, -0.2)])),
        (
            "polygon on the horizon",
            polygon(&[
                (FRAC_PI_2, -0.5),
                (FRAC_PI_2, 0.0),
                (FRAC_PI_2, 0.6),
                (0.2, 0.3),
                (0.3, -1.0),
            ]),
        ),
    ]
}

/// References must be known to this part of the integral for unpolarized light.
const KNOWN: f64 = 1e-10;

/// All apertures for one lobe.
fn cases(make: &dyn Fn() -> Model, theta_i: f64, width: f64) -> Vec<Case> {
    let regions = apertures(theta_i, 2.0 * width).into_iter();
    let case = |(name, region)| Case { name, model: make(), theta_i, region, width };
    regions.map(case).collect()
}

/// Elements that do not depend on how a sensitivity is turned across the aperture.
const ELEMENTS: [(usize, usize); 4] = [(0, 0), (0, 1), (3, 2), (3, 3)];

/// Twelve apertures for one lobe.
fn assert_within_errors(make: &dyn Fn() -> Model, theta_i: f64, width: f64) {
    let cases = cases(make, theta_i, width);
    assert_eq!(cases.len(), 12);
    let complaints: Vec<String> = cases.par_iter().flat_map_iter(check).collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

fn gaussian(slope: f64) -> impl Fn() -> Model {
    move || facets("Gaussian_Slope_Distribution_Function", slope)
}

#[test]
fn slopes_of_one_thousandth_are_within_their_errors() {
    assert_within_errors(&gaussian(0.001), 0.6, 0.001);
}

#[test]
fn slopes_of_one_thousandth_near_the_horizon_are_within_their_errors() {
    assert_within_errors(&gaussian(0.001), 1.3, 0.001);
}

#[test]
fn slopes_of_one_hundredth_are_within_their_errors() {
    assert_within_errors(&gaussian(0.01), 0.6, 0.01);
}

#[test]
fn slopes_of_one_tenth_are_within_their_errors() {
    assert_within_errors(&gaussian(0.1), 0.6, 0.1);
}

#[test]
fn slopes_of_three_tenths_are_within_their_errors() {
    assert_within_errors(&gaussian(0.3), 0.6, 0.3);
}

#[test]
fn slopes_of_one_are_within_their_errors() {
    assert_within_errors(&gaussian(1.0), 0.6, 1.0);
}

#[test]
fn lobes_of_roughness_are_within_their_errors() {
    // The density of roughness falls at 1/B: a lobe of width λ/(2πB), with tails of a power.
    assert_within_errors(&|| rough(20.0), 0.6, 0.532 / 20.0);
}

fn check(case: &Case) -> Vec<String> {
    let reference =
        |order| plane::integral(&case.model, case.theta_i, &case.region, case.width, order);
    let (coarse, best) = (reference(12), reference(16));
    let own = ELEMENTS.map(|at| (best[at] - coarse[at]).abs()).into_iter().fold(0.0, f64::max);
    let own = own / best[(0, 0)];
    let mut complaints = Vec::new();
    if !(own < KNOWN) {
        complaints.push(format!("{}: the reference is known to {own:.1e} only", case.name));
    }
    let incidence = Incidence::new(case.theta_i, 0.0);
    for tolerance in [1e-4, 1e-6] {
        let demand = Demand { tolerance, budget: 300_000 };
        let found =
            integrate(&case.model, &incidence, Basis::Psps, &case.region, &demand, &|| false);
        let found = match found {
            Ok(found) => found,
            Err(error) => {
                complaints.push(format!("{}, {tolerance:e}: {error}", case.name));
                continue;
            }
        };
        for at in ELEMENTS {
            let off = (found.matrix[at] - best[at]).abs();
            let allowed = found.error[at] + KNOWN * best[(0, 0)];
            if !(off <= allowed) {
                let n = found.evaluations;
                complaints.push(format!(
                    "{}, {tolerance:e}: {at:?} is off by {off:.1e} of {:.3e}, not {allowed:.1e}, n = {n}",
                    case.name, best[(0, 0)]
                ));
            }
        }
    }
    complaints
}
