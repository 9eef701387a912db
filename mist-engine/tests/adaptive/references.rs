//! Adaptive integrals lie within their own errors of references: lobes from slope 0.001 to 1 and
//! apertures of every shape that cut through the lobe and the horizon.

use std::f64::consts::FRAC_PI_2;

use mist_engine::{
    region::Region,
    sampling::adaptive::{Accuracy, AdaptiveError, integrate},
};
use rayon::prelude::*;
use scattering::{Basis, Incidence, Mode, Model, ParameterNode, ParameterValue, models};

use crate::plane;

/// One integral whose value is known.
struct Case {
    name: String,
    model: Model,
    theta_i: f64,
    region: Region,
    /// About the width of the lobe in direction cosines.
    width: f64,
}

fn node(name: &str) -> ParameterNode {
    ParameterNode::with_defaults(scattering::registry::find_class(name).unwrap(), Mode::Sound)
}

/// The facets of `class` with a density of slopes `sdf` of rms `slope`.
fn with_slopes(class: &str, sdf: &str, slope: f64) -> Model {
    let sdf = node(sdf).with("s", ParameterValue::Number(slope)).unwrap();
    let facets = node(class).with("sdf", ParameterValue::Member(sdf.into())).unwrap();
    models::build(&facets).unwrap()
}

/// Facets with a density of slopes `sdf` of rms `slope`.
pub(crate) fn facets(sdf: &str, slope: f64) -> Model {
    with_slopes("Facet_BRDF_Model", sdf, slope)
}

/// Facets with a Gaussian density of slopes that shadow each other, with sharp limits.
pub(crate) fn shadowed(slope: f64) -> Model {
    with_slopes("Shadowed_Facet_BRDF_Model", "Gaussian_Slope_Distribution_Function", slope)
}

/// Roughness with a spectral density that falls at `1/length`.
pub(crate) fn rough(length: f64) -> Model {
    let psd = node("ABC_PSD_Function").with("B", ParameterValue::Number(length)).unwrap();
    let model =
        node("Microroughness_BRDF_Model").with("psd", ParameterValue::Member(psd.into())).unwrap();
    models::build(&model).unwrap()
}

fn annulus(
    outer_center: (f64, f64),
    outer_alpha: f64,
    inner_center: (f64, f64),
    inner_alpha: f64,
) -> Region {
    Region::Annulus { outer_center, outer_alpha, inner_center, inner_alpha }
}

/// Apertures around the mirror direction (`theta`, 0) of a lobe `wide` radians wide.
fn apertures(theta: f64, wide: f64) -> Vec<(&'static str, Region)> {
    let circle = |center, alpha| Region::Circle { center, alpha };
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

/// References are known to this part of the integral for unpolarized light.
const KNOWN: f64 = 1e-10;

/// Values of [`plane::integral`], by the name of the lobe and of the aperture: [`ELEMENTS`].
const REFERENCES: &str = include_str!("references.txt");

/// A lobe around a mirror direction.
struct Lobe {
    name: &'static str,
    make: fn() -> Model,
    theta_i: f64,
    /// About its width in direction cosines.
    width: f64,
}

/// Facets with a Gaussian density of slopes.
fn gaussian(slope: f64) -> Model {
    facets("Gaussian_Slope_Distribution_Function", slope)
}

const LOBES: [Lobe; 7] = [
    Lobe { name: "slope-0.001", make: || gaussian(0.001), theta_i: 0.6, width: 0.001 },
    Lobe { name: "slope-0.001-at-1-rad", make: || gaussian(0.001), theta_i: 1.0, width: 0.001 },
    Lobe { name: "slope-0.01", make: || gaussian(0.01), theta_i: 0.6, width: 0.01 },
    Lobe { name: "slope-0.1", make: || gaussian(0.1), theta_i: 0.6, width: 0.1 },
    Lobe { name: "slope-0.3", make: || gaussian(0.3), theta_i: 0.6, width: 0.3 },
    Lobe { name: "slope-1", make: || gaussian(1.0), theta_i: 0.6, width: 1.0 },
    // The density of roughness falls at 1/B: a lobe of width λ/(2πB), with tails of a power.
    Lobe { name: "roughness-20-um", make: || rough(20.0), theta_i: 0.6, width: 0.0266 },
];

/// A lobe that is a dozen times as long as it is wide, since it lies low, under crossing rings: of
/// its far end only the cells nearer to the mirror direction know.
fn long_lobe() -> Case {
    let region = annulus((1.491598, 0.0), 0.0226889, (1.515943, 0.0), 0.0153986);
    let (name, width) = ("slope-0.00086-at-1.49-rad\trings that cross".into(), 0.00086);
    Case { name, model: gaussian(0.00086065), theta_i: 1.491598, region, width }
}

/// Rings that cross at places from which rays from the mirror direction go on to touch the inner
/// one: the lengths of intervals bend within a millionth of a slice.
fn crossing_beside_a_ray_that_touches() -> Case {
    let region = annulus((1.0823, 0.4949), 0.08858, (1.168, 0.4949), 0.02916);
    let name = "slope-0.59-at-0-rad\trings that cross beside a ray that touches".into();
    Case { name, model: gaussian(0.59), theta_i: 0.0, region, width: 0.59 }
}

/// All apertures for all lobes, and what was wrong once.
fn cases() -> Vec<Case> {
    let of = |lobe: &Lobe| {
        let Lobe { name, make, theta_i, width } = *lobe;
        let regions = apertures(theta_i, 2.0 * width).into_iter();
        let case = |(shape, region)| Case {
            name: format!("{name}\t{shape}"),
            model: make(),
            theta_i,
            region,
            width,
        };
        regions.map(case).collect::<Vec<Case>>()
    };
    let once_wrong = [long_lobe(), crossing_beside_a_ray_that_touches()];
    LOBES.iter().flat_map(of).chain(once_wrong).collect()
}

/// Elements that do not depend on how a sensitivity is turned across the aperture.
const ELEMENTS: [(usize, usize); 4] = [(0, 0), (0, 1), (3, 2), (3, 3)];

/// The stored reference of a case.
fn stored(name: &str) -> [f64; 4] {
    let line = REFERENCES.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix('\t'));
    let line = line.unwrap_or_else(|| panic!("{name} has no reference"));
    let numbers: Vec<f64> = line.split('\t').map(|number| number.parse().unwrap()).collect();
    numbers.try_into().unwrap()
}

#[test]
fn eighty_six_integrals_lie_within_their_errors_of_references() {
    let cases = cases();
    assert_eq!(cases.len(), 86);
    let complaints: Vec<String> = cases.par_iter().flat_map_iter(check).collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

fn check(case: &Case) -> Vec<String> {
    let reference = stored(&case.name);
    let incidence = Incidence::new(case.theta_i, 0.0);
    let mut complaints = Vec::new();
    for tolerance in [1e-3, 1e-4, 1e-6, 1e-8] {
        let accuracy = Accuracy::required(tolerance, 2_000_000);
        let found =
            integrate(&case.model, &incidence, Basis::Psps, &case.region, &accuracy, &|| false);
        let found = match found {
            Ok(found) => found,
            Err(error) => {
                complaints.push(format!("{}, {tolerance:e}: {error}", case.name));
                continue;
            }
        };
        for (at, want) in ELEMENTS.into_iter().zip(reference) {
            let off = (found.matrix[at] - want).abs();
            let allowed = found.error[at] + KNOWN * reference[0];
            if !(off <= allowed) {
                complaints.push(format!(
                    "{}, {tolerance:e}: {at:?} is off by {off:.1e} of {:.3e}, not {allowed:.1e}",
                    case.name, reference[0]
                ));
            }
        }
    }
    complaints
}

#[test]
fn what_is_refused_has_not_reached_its_tolerance() {
    let Case { model, theta_i, region, .. } = long_lobe();
    let incidence = Incidence::new(theta_i, 0.0);
    let (mut refused, mut last) = (0, None);
    for budget in (500..20_000).step_by(64) {
        let accuracy = Accuracy::required(1e-3, budget);
        match integrate(&model, &incidence, Basis::Psps, &region, &accuracy, &|| false) {
            Err(AdaptiveError::Budget { tolerance, reached, .. }) => {
                assert!(reached > tolerance, "{reached} with {budget}");
                refused += 1;
            }
            other => last = Some(other.unwrap()),
        }
    }
    assert!(refused > 5);
    assert!(last.unwrap().evaluations < 19_000, "the largest budget suffices");
}

/// Takes minutes: `cargo test --release -p mist-engine --test adaptive -- --ignored --nocapture`
/// prints the lines of `references.txt`.
#[test]
#[ignore = "computes the stored references again"]
fn stored_references_are_those_of_the_other_method() {
    let computed: Vec<(String, [f64; 4])> = cases().par_iter().map(computed).collect();
    for (name, values) in &computed {
        println!("{name}\t{}", values.map(|x| format!("{x:.15e}")).join("\t"));
    }
    for (name, values) in &computed {
        for (a, b) in values.iter().zip(stored(name)) {
            assert!((a - b).abs() < KNOWN * values[0], "{name}: {a} is not {b}");
        }
    }
}

/// The reference by rules of 16 points, which those of 12 points must confirm.
fn computed(case: &Case) -> (String, [f64; 4]) {
    let by = |order| {
        let all = plane::integral(&case.model, case.theta_i, &case.region, case.width, order);
        ELEMENTS.map(|at| all[at])
    };
    let (coarse, best) = (by(12), by(16));
    for (a, b) in coarse.iter().zip(best) {
        assert!((a - b).abs() < KNOWN * best[0], "{}: {a} or {b}", case.name);
    }
    (case.name.clone(), best)
}
