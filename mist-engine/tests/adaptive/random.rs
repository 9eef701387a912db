//! Random lobes and apertures: coarse integrals lie within their errors of fine ones.

use std::f64::consts::TAU;

use mist_engine::{
    region::Region,
    sampling::adaptive::{Accuracy, Estimate, integrate},
};
use proptest::{
    prelude::*,
    strategy::ValueTree,
    test_runner::{Config, RngAlgorithm, TestRng, TestRunner},
};
use rayon::prelude::*;
use scattering::{Basis, Incidence, Model};

use crate::references::{facets, rough, shadowed};

#[derive(Clone, Debug)]
enum Lobe {
    /// Facets with this density of slopes, of this rms.
    Facets(&'static str, f64),
    /// The same with Gaussian slopes, some of which hide others: a lobe with kinks.
    Shadowed(f64),
    /// Roughness with a spectral density that falls at the reciprocal of this length, µm.
    Rough(f64),
}

impl Lobe {
    fn model(&self) -> Model {
        match *self {
            Self::Facets(sdf, slope) => facets(sdf, slope),
            Self::Shadowed(slope) => shadowed(slope),
            Self::Rough(length) => rough(length),
        }
    }
}

#[derive(Clone, Debug)]
struct Case {
    lobe: Lobe,
    theta_i: f64,
    region: Region,
    tolerance: f64,
}

fn powers_of_ten(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from..to).prop_map(|x| 10_f64.powf(x))
}

fn smooth() -> impl Strategy<Value = Lobe> {
    let slope = || powers_of_ten(-3.0, 0.0);
    prop_oneof![
        slope().prop_map(|s| Lobe::Facets("Gaussian_Slope_Distribution_Function", s)),
        slope().prop_map(|s| Lobe::Facets("Exponential_Slope_Distribution_Function", s)),
        powers_of_ten(-1.0, 3.0).prop_map(Lobe::Rough),
    ]
}

fn with_kinks() -> impl Strategy<Value = Lobe> {
    powers_of_ten(-3.0, 0.0).prop_map(Lobe::Shadowed)
}

/// Apertures anywhere, and more often near the mirror direction.
fn regions(theta_i: f64) -> impl Strategy<Value = Region> {
    let center = prop_oneof![
        1 => Just((theta_i, 0.0)),
        3 => (-0.3..0.3, -0.5..0.5).prop_map(move |(a, b): (f64, f64)| (theta_i + a, b)),
        2 => (0.0..1.5, -3.1..3.1),
    ];
    (center, powers_of_ten(-2.0, 0.2), -0.1..0.1, 0.1..0.8, 0.0..TAU, 3..6_usize, 0..6).prop_map(
        |(center, alpha, aside, part, turn, corners, kind)| match kind {
            0 => Region::Hemi,
            1 | 2 => Region::Circle { center, alpha },
            3 | 4 => Region::Annulus {
                outer_center: center,
                outer_alpha: alpha,
                inner_center: (center.0 + aside, center.1),
                inner_alpha: part * alpha,
            },
            _ => polygon(center, alpha.min(0.8), part, turn, corners),
        },
    )
}

/// Corners around `center` in direction cosines, every second one nearer to it, above the horizon.
fn polygon(center: (f64, f64), size: f64, part: f64, turn: f64, corners: usize) -> Region {
    let middle = [center.0.sin() * center.1.cos(), center.0.sin() * center.1.sin()];
    let corner = |k: usize| {
        let (sin, cos) = (turn + TAU * k as f64 / corners as f64).sin_cos();
        let radius = if k.is_multiple_of(2) { size } else { size * part };
        let (x, y) = (middle[0] + radius * cos, middle[1] + radius * sin);
        (x.hypot(y).min(0.999).asin(), y.atan2(x))
    };
    Region::Polygon { vertices: (0..corners).map(corner).collect(), polarization_center: center }
}

fn cases(lobes: impl Strategy<Value = Lobe>) -> impl Strategy<Value = Case> {
    let theta = prop_oneof![1 => Just(0.0), 4 => 0.0..1.5];
    (lobes, theta, powers_of_ten(-7.0, -2.0)).prop_flat_map(|(lobe, theta_i, tolerance)| {
        let case = move |region| Case { lobe: lobe.clone(), theta_i, region, tolerance };
        regions(theta_i).prop_map(case)
    })
}

fn estimate(case: &Case, tolerance: f64) -> Option<Estimate> {
    let (model, incidence) = (case.lobe.model(), Incidence::new(case.theta_i, 0.0));
    let accuracy = Accuracy::required(tolerance, 10_000_000);
    integrate(&model, &incidence, Basis::Psps, &case.region, &accuracy, &|| false).ok()
}

/// By how many of its errors the coarse integral is off; none for regions that do not exist.
fn off(case: &Case) -> Option<f64> {
    let (coarse, fine) = (estimate(case, case.tolerance)?, estimate(case, 1e-9)?);
    let off = (coarse.matrix[(0, 0)] - fine.matrix[(0, 0)]).abs() - fine.error[(0, 0)];
    let error = coarse.error[(0, 0)].max(1e-20);
    Some(off / error)
}

/// The cases outside of their errors, of `count` random ones.
fn outside(lobes: impl Strategy<Value = Lobe>, count: usize) -> Vec<(f64, Case)> {
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let strategy = cases(lobes);
    let cases: Vec<Case> =
        (0..count).map(|_| strategy.new_tree(&mut runner).unwrap().current()).collect();
    let offs: Vec<(f64, Case)> =
        cases.into_par_iter().filter_map(|case| Some((off(&case)?, case))).collect();
    // Polygons whose edges cross do not exist.
    assert!(offs.len() > count * 19 / 20, "only {} regions exist", offs.len());
    offs.into_iter().filter(|(off, _)| *off > 1.0).collect()
}

#[test]
fn a_thousand_integrals_of_smooth_lobes_lie_within_their_errors() {
    let outside = outside(smooth(), 1000);
    assert!(outside.is_empty(), "{outside:#?}");
}

/// A kink that runs within a fiftieth of a cell along its edge is seen by no node.
#[test]
fn ninety_nine_of_a_hundred_integrals_of_lobes_with_kinks_lie_within_their_errors() {
    let outside = outside(with_kinks(), 300);
    assert!(outside.len() <= 3, "{outside:#?}");
}
