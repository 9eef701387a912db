//! Behaviour of the predictor on small pictures; numbers are compared in the tests of the
//! workspace.

use std::f64::consts::TAU;

use super::*;

const N: usize = 64;

/// 50 cd/m² with waves: (cycles in the picture along x, along y, contrast).
fn waves(waves: &[(f64, f64, f64)]) -> Luminances {
    let at = |i: usize| {
        let (x, y) = ((i % N) as f64 / N as f64, (i / N) as f64 / N as f64);
        let sum: f64 = waves.iter().map(|(u, v, c)| c * (TAU * (u * x + v * y)).cos()).sum();
        50.0 * (1.0 + sum)
    };
    Luminances::new(N, N, (0..N * N).map(at).collect()).unwrap()
}

fn mean(test: &Luminances, reference: &Luminances, settings: DetectorSettings) -> f64 {
    detect(test, reference, &Viewing::default(), &settings).unwrap().mean()
}

#[test]
fn equal_pictures_and_a_common_factor_are_not_seen_to_differ() {
    let reference = waves(&[(8.0, 0.0, 0.3)]);
    let brighter: Vec<f64> = waves(&[]).values().iter().map(|l| 1.05 * l).collect();
    let brighter = Luminances::new(N, N, brighter).unwrap();
    for front_end in [FrontEnd::Hdr, FrontEnd::Daly1993] {
        let settings = DetectorSettings { front_end, compat: false };
        assert_eq!(mean(&reference, &reference, settings), 0.0);
        // The mean of a picture does not reach the channels; what is left is rounding.
        assert!(mean(&brighter, &waves(&[]), settings) < 1e-12);
    }
}

#[test]
fn the_probability_grows_with_contrast() {
    let flat = waves(&[]);
    let seen = |c: f64| mean(&waves(&[(8.0, 0.0, c)]), &flat, DetectorSettings::default());
    let all = [0.002, 0.005, 0.01, 0.02, 0.05].map(seen);
    assert!(all.windows(2).all(|pair| pair[0] < pair[1]), "{all:?}");
    assert!(all[0] < 0.01 && all[4] > 0.7, "{all:?}");
}

#[test]
fn structure_of_the_same_orientation_masks_more_than_across() {
    let seen = |mask: (f64, f64, f64)| {
        mean(&waves(&[mask, (8.0, 0.0, 0.03)]), &waves(&[mask]), DetectorSettings::default())
    };
    let (along, across) = (seen((9.0, 0.0, 0.5)), seen((0.0, 9.0, 0.5)));
    assert!(along < across, "{along} {across}");
}

#[test]
fn a_sound_map_turns_with_its_pictures() {
    let turned = |picture: &Luminances| {
        let values = (0..N * N).map(|i| picture.values()[(i % N) * N + i / N]).collect();
        Luminances::new(N, N, values).unwrap()
    };
    let (test, reference) =
        (waves(&[(7.0, 3.0, 0.03), (2.0, -9.0, 0.02)]), waves(&[(1.0, 5.0, 0.2)]));
    let before = mean(&test, &reference, DetectorSettings::default());
    let after = mean(&turned(&test), &turned(&reference), DetectorSettings::default());
    // Rounding of transforms in the other order; the fan at 45° lies on both sides of a diagonal.
    assert!((before - after).abs() < 1e-9, "{before} {after}");
}

#[test]
fn dark_and_missing_values_count_as_the_smallest_positive_one() {
    let picture = Luminances::new(2, 2, vec![0.0, f64::NAN, 0.3, 7.0]).unwrap();
    assert_eq!(picture.values(), [0.3, 0.3, 0.3, 7.0]);
    let black = Luminances::new(2, 2, vec![-1.0; 4]).unwrap();
    let seen = detect(&black, &black, &Viewing::default(), &DetectorSettings::default()).unwrap();
    assert_eq!(seen.max(), 0.0);
}

#[test]
fn odd_and_unequal_sizes_work_and_wrong_ones_are_refused() {
    let picture = |w: usize, h: usize, c: f64| {
        let values = (0..w * h).map(|i| 20.0 + c * (i as f64).sin()).collect();
        Luminances::new(w, h, values).unwrap()
    };
    let viewing = Viewing::default();
    for (w, h) in [(15, 22), (31, 17), (2, 3)] {
        let seen = detect(
            &picture(w, h, 1.0),
            &picture(w, h, 0.5),
            &viewing,
            &DetectorSettings::default(),
        );
        assert!(seen.unwrap().probability().iter().all(|p| (0.0..=1.0).contains(p)));
    }
    let differ =
        detect(&picture(4, 4, 1.0), &picture(4, 5, 1.0), &viewing, &DetectorSettings::default());
    assert!(matches!(differ, Err(VisibleError::Differ { .. })));
    assert!(matches!(Luminances::new(1, 4, vec![1.0; 4]), Err(VisibleError::Size { .. })));
    assert!(matches!(Luminances::new(2, 2, vec![1.0; 3]), Err(VisibleError::Values { .. })));
    let infinite = Luminances::new(2, 2, vec![1.0, 1.0, f64::INFINITY, 1.0]);
    assert_eq!(infinite, Err(VisibleError::Infinite { column: 0, row: 1 }));
}
