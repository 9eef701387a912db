//! Random programs without a word on integration: their integrals lie within the stated errors of
//! integrals with a required error of 1e-8.

use proptest::{
    prelude::*,
    strategy::ValueTree,
    test_runner::{Config, RngAlgorithm, TestRng, TestRunner},
};

use scattering::Mode;

use crate::programs::{numbers, run, run_in};

/// A model with a lobe of the width 10^`width` rad, about.
fn model(kind: usize, width: f64) -> String {
    let slope = 10_f64.powf(width);
    // ABC densities fall at 1/B: λ/(2πB) is the width.
    let length = 0.532 / (std::f64::consts::TAU * slope);
    let gaussian = format!("$sdf = Gaussian_Slope_Distribution_Function\n #sdf.s = {slope}\n");
    let rough = format!("$psd = ABC_PSD_Function\n #psd.B = {length}\n");
    let below = |text: &str| text.replace("$sdf", "$model.sdf").replace("#sdf", "#model.sdf");
    let inside = |text: &str| text.replace("$psd", "$model.psd").replace("#psd", "#model.psd");
    match kind {
        0 => format!("Facet_BRDF_Model {gaussian}"),
        1 => format!(
            "Facet_BRDF_Model $sdf = Exponential_Slope_Distribution_Function\n #sdf.s = {slope}\n"
        ),
        2 => format!(
            "Facet_BRDF_Model $sdf = Anisotropic_Gaussian_Slope_Distribution_Function\n \
             #sdf.sigmax = {slope}\n #sdf.sigmay = {}\n",
            0.3 * slope
        ),
        3 => format!("Subsurface_Facet_BRDF_Model {gaussian}"),
        4 => format!("Microroughness_BRDF_Model {rough}"),
        5 => format!("Two_Face_BRDF_Model {rough} #face = 1\n"),
        6 => format!("Correlated_Roughness_BRDF_Model {rough}"),
        7 => format!("Roughness_Stack_BRDF_Model {rough}"),
        8 => format!("RCW_BRDF_Model #alpha = {}\n #order = 3\n", slope.min(0.2)),
        9 => {
            format!("CrossRCW_BRDF_Model #alpha = {}\n #order1 = 2\n #order2 = 0\n", slope.min(0.2))
        }
        10 => format!(
            "Two_Source_BRDF_Model $source1 = Facet_BRDF_Model\n \
             $source1.sdf = Gaussian_Slope_Distribution_Function\n #source1.sdf.s = {slope}\n \
             $source2 = RCW_BRDF_Model\n #source2.alpha = 0.01\n #source2.order = 3\n"
        ),
        11 => format!(
            "Transmit_BRDF_Model #substrate = (1.5,0)\n #type = 1\n $model = Facet_BRDF_Model\n {} \
             #model.substrate = (1.5,0)\n #model.type = 1\n",
            below(&gaussian)
        ),
        12 => format!(
            "Finite_Aperture_Instrument_BRDF_Model #alpha = 0.5\n \
             $model = Microroughness_BRDF_Model\n {}",
            inside(&rough)
        ),
        13 => format!(
            "Focussed_Beam_Instrument_BRDF_Model #alpha = 0.5\n $model = Facet_BRDF_Model\n {}",
            below(&gaussian)
        ),
        14 => format!(
            "Layered_BRDF_Model $model = Facet_BRDF_Model\n {} #model.substrate = (0.2,3)\n \
             #substrate = (0.2,3)\n",
            below(&gaussian)
        ),
        _ => format!("Shadowed_Facet_BRDF_Model {gaussian}"),
    }
}

/// The number of kinds of models.
const MODELS: usize = 16;

/// An aperture near the mirror direction (`theta`, 0).
fn aperture(kind: usize, theta: f64, [aside, around, size, part]: [f64; 4]) -> String {
    let (t, alpha) = ((theta + aside).clamp(0.0, 1.5), 10_f64.powf(size));
    match kind {
        0 => "HEMI".into(),
        1 => format!("CIRCLE CENTER = ({t},{around}) ALPHA = {alpha}"),
        2 => format!("CIRCLE CENTER = ({theta},0) ALPHA = {alpha}"),
        3 => format!(
            "ANNULUS OUTERCENTER = ({t},{around}) OUTERALPHA = {alpha} INNERCENTER = \
             ({theta},0) INNERALPHA = {}",
            part * alpha
        ),
        4 => {
            let (low, high) = ((t - 0.2 * part).max(0.01), (t + 0.3 * part).min(1.55));
            format!(
                "POLYGON VERTEX = ({low},{around}) VERTEX = ({high},{}) VERTEX = ({high},{})",
                around + 0.5 * part,
                around - 0.4 * part
            )
        }
        _ => format!("DIFFERENTIAL CENTER = ({t},{around})"),
    }
}

/// The number of kinds of apertures.
const SHAPES: usize = 6;

fn program(case: &Case, settings: &str) -> String {
    let Case { model, aperture, theta, rotation } = case;
    let (name, parameters) = model.split_once(' ').expect("a model and its parameters");
    format!(
        "MODEL = {name}\nVARIABLES:\n incidentangle = {theta}  incidentpol = (1,0,0,0)\n \
         rotation = {rotation}\n uncertainty = 1\n {settings}\n {parameters}\nEND\nVARY: END\n\
         INTEGRALS: R = {aperture} END END\nOUTPUTS: 1 R END\nFILES: format = %.15e\\t END\n"
    )
}

#[derive(Clone, Debug)]
struct Case {
    model: String,
    aperture: String,
    theta: f64,
    rotation: f64,
}

/// `count` programs: every model, every shape, at random otherwise.
fn cases(count: usize) -> Vec<Case> {
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let numbers = (-2.0..0.0, 0.05..1.3, -0.3..0.3, -0.5..0.5, -1.7..0.1, 0.1..0.9, 0.0..3.0);
    (0..count)
        .map(|k| {
            let (width, theta, aside, around, size, part, rotation) =
                numbers.new_tree(&mut runner).unwrap().current();
            let shape = (k / MODELS + k) % SHAPES;
            Case {
                model: model(k % MODELS, width),
                aperture: aperture(shape, theta, [aside, around, size, part]),
                theta,
                rotation,
            }
        })
        .collect()
}

/// By how many of its errors the default integral is off.
fn off(case: &Case) -> f64 {
    let usual = numbers(&run(&program(case, "")).0, 1);
    // Shadows have kinks, for which the evaluations do not always suffice for 1e-8.
    let reference = |tolerance: &str| {
        let accuracy =
            format!("integrationmode = 20  tolerance = {tolerance}  maxevaluations = 2e7");
        run_in(Mode::Sound, &program(case, &accuracy)).ok()
    };
    let best = ["1e-8", "1e-7"].into_iter().find_map(reference);
    let best = numbers(&best.expect("an error of 1e-7 is reached").0, 1);
    let off = (usual[0] - best[0]).abs() - best[1];
    if off <= 0.0 { 0.0 } else { off / usual[1] }
}

fn check(count: usize, few: usize) {
    let offs: Vec<(f64, Case)> = cases(count).into_iter().map(|case| (off(&case), case)).collect();
    let outside: Vec<_> = offs.iter().filter(|(off, _)| !(*off <= 1.0)).collect();
    assert!(outside.len() <= few, "{outside:#?}");
    assert!(outside.iter().all(|(off, _)| *off <= 10.0), "{outside:#?}");
}

#[test]
fn the_default_integrals_of_twenty_random_programs_lie_within_their_errors() {
    check(20, 0);
}

/// Takes minutes: `cargo test --release -p mist-engine --test adaptive two_hundred -- --ignored`.
#[test]
#[ignore = "two hundred references with an error of 1e-8 take minutes"]
fn at_least_198_of_two_hundred_random_programs_lie_within_their_errors() {
    check(200, 2);
}
