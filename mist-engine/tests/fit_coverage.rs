//! Confidence intervals cover the truth as often as they say, with the aperture of the instrument
//! inside the fit.

use std::{f64::consts::TAU, sync::Arc};

use mist_engine::{
    Control, MemoryFiles, Options,
    fit::{FitSettings, MeasuredTable, fit},
    function::ProgramFunction,
};

/// A rough surface of glass in a goniometer whose aperture is as wide as the lobe's flank, with a
/// factor of the instrument and a dark signal.
const PROGRAM: &str = "
    MODEL = Shadowed_Facet_BRDF_Model
    VARIABLES:
      deg0 = atan(1)/45
      thetas = 0
      incidentangle = 30*deg0   incidentpol = (1,0,0,0)   rotation = 0
      differential = (2*deg0)^2   minsamples = 8
      s = 0.1   gain = 1   dark = 0
      $substrate = (1.5,0)
      $sdf = Gaussian_Slope_Distribution_Function
      #sdf.s = s
      $shadow = Unit_Shadow_Function
      omega = 4*atan(1)*sin(3*deg0)^2
    END
    VARY: FOR thetas FROM 6 TO 54 BY 3 END
    INTEGRALS: R = CIRCLE CENTER = (thetas*deg0,0) ALPHA = 3*deg0 END END
    OUTPUTS: 1 y=gain*R/omega+dark END
    FILES: END
";

const NAMES: [&str; 3] = ["s", "gain", "dark"];
const TRUTH: [f64; 3] = [0.12, 1.3, 0.02];
const SETS: u64 = 100;

/// A number from 0 to 1 for each counter (splitmix64: G. L. Steele, D. Lea, C. H. Flood, OOPSLA
/// 2014).
fn uniform(counter: u64) -> f64 {
    let mut z = counter.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// A normal number for each counter, by Box and Muller.
fn normal(counter: u64) -> f64 {
    let (u, v) = (1.0 - uniform(2 * counter + 1), uniform(2 * counter + 2));
    (-2.0 * u.ln()).sqrt() * (TAU * v).cos()
}

#[test]
fn on_a_hundred_noisy_data_sets_each_interval_covers_the_truth_90_to_99_times() {
    let names = NAMES.map(str::to_owned);
    let files = Arc::new(MemoryFiles::default());
    let program = ProgramFunction::new(PROGRAM, files, Options::default(), &names).unwrap();
    let exact = program.run(&TRUTH, &Control::default()).unwrap().rows;
    let brightest = exact.iter().map(|row| row.outputs[0]).fold(0.0, f64::max);
    let mut covered = [0; 3];
    for set in 0..SETS {
        let mut text = "thetas\ty\n".to_owned();
        for (at, row) in (0..).zip(&exact) {
            let noise = 0.02 * brightest * normal(1000 * set + at);
            text += &format!("{}\t{:?}\n", row.loops[0], row.outputs[0] + noise);
        }
        let measured = MeasuredTable::parse(&text, program.titles(), program.headers()).unwrap();
        let fit = fit(&program, &measured, &FitSettings::default(), &Control::default()).unwrap();
        for ((count, parameter), truth) in covered.iter_mut().zip(&fit.parameters).zip(TRUTH) {
            let [low, high] = parameter.interval.unwrap();
            *count += usize::from((low..=high).contains(&truth));
        }
    }
    // 95 on the average; fewer than 90 or all 100 happen to one variable in sixty.
    for (name, count) in NAMES.iter().zip(covered) {
        assert!((90..=99).contains(&count), "{name}: {count} of {SETS}");
    }
}
