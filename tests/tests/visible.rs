//! Visible differences against HDR-VDP 1.7.1: percentages, and means over blocks of 16 × 16 pixels.
//!
//! `reference/vdp/vdp.json` has the results of the tool for the pictures in its folder.

use std::{
    fs,
    path::{Path, PathBuf},
};

use pictures::{
    difference::{ComparisonSettings, compare},
    image::Image,
    visible::{DetectionMap, DetectorSettings, FrontEnd, Luminances, Viewing, detect},
};
use serde::Deserialize;

#[derive(Deserialize)]
struct Reference {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    id: String,
    test: String,
    reference: String,
    display: Display,
    #[serde(rename = "hdrvdp_1.7")]
    hdr: Found,
    daly_1993_mode: Found,
}

#[derive(Deserialize)]
struct Display {
    width_m: f64,
    height_m: f64,
    x: f64,
    y: f64,
    distance_m: f64,
}

#[derive(Deserialize)]
struct Found {
    p75_percent: f64,
    p95_percent: f64,
    block16x16_mean: Vec<Vec<f64>>,
}

impl Case {
    fn images(&self) -> [Image; 2] {
        [&self.test, &self.reference].map(|name| {
            Image::read(&fs::read(folder().join(name)).expect("the picture is there")).unwrap()
        })
    }

    fn viewing(&self) -> Viewing {
        let Display { width_m, height_m, x, y, distance_m } = self.display;
        Viewing::new([width_m, height_m], [x, y], distance_m).unwrap()
    }

    fn detect(&self, model: DetectorSettings) -> DetectionMap {
        let [test, reference] = self.images().map(|image| {
            let [width, height] = image.size();
            let values = image.values().iter().map(|v| f64::from(*v)).collect();
            Luminances::new(width, height, values).unwrap()
        });
        detect(&test, &reference, &self.viewing(), &model).unwrap()
    }
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/vdp")
}

fn cases() -> Vec<Case> {
    let text = fs::read_to_string(folder().join("vdp.json")).expect("the reference is there");
    serde_json::from_str::<Reference>(&text).expect("the reference is JSON").cases
}

/// Means over blocks of 16 × 16 pixels.
fn blocks(map: &DetectionMap) -> Vec<Vec<f64>> {
    let [width, height] = map.size();
    let block = |top: usize, left: usize| {
        let rows = (top..top + 16).map(|y| &map.probability()[y * width + left..][..16]);
        rows.flatten().sum::<f64>() / 256.0
    };
    (0..height / 16).map(|y| (0..width / 16).map(|x| block(16 * y, 16 * x)).collect()).collect()
}

/// The largest difference of a percentage, and of a block.
fn worst(map: &DetectionMap, found: &Found) -> [f64; 2] {
    let percentages = [(0.75, found.p75_percent), (0.95, found.p95_percent)];
    let percent = percentages.map(|(p, expected)| (map.percent_above(p) - expected).abs());
    let ours = blocks(map);
    assert_eq!(ours.len(), found.block16x16_mean.len());
    let pairs = ours.iter().flatten().zip(found.block16x16_mean.iter().flatten());
    let block = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    [percent[0].max(percent[1]), block]
}

#[test]
fn the_predictor_for_high_dynamic_range_agrees_with_the_tool() {
    for case in cases() {
        let map = case.detect(DetectorSettings { front_end: FrontEnd::Hdr, compat: true });
        let [percent, block] = worst(&map, &case.hdr);
        // The tool's table of steps of luminance is known at 39 places only, to 0.2 %.
        assert!(percent < 0.05 && block < 0.002, "{}: {percent} {block}", case.id);
    }
}

#[test]
fn the_predictor_of_daly_agrees_with_the_tool() {
    for case in cases() {
        let map = case.detect(DetectorSettings { front_end: FrontEnd::Daly1993, compat: true });
        let [percent, block] = worst(&map, &case.daly_1993_mode);
        // The tool computes in single precision; block means are printed with five decimals.
        assert!(percent < 0.005 && block < 2e-5, "{}: {percent} {block}", case.id);
    }
}

#[test]
fn without_the_habits_of_the_tool_percentages_move_by_less_than_a_point() {
    for case in cases() {
        let map = case.detect(DetectorSettings { front_end: FrontEnd::Hdr, compat: false });
        let [percent, _] = worst(&map, &case.hdr);
        assert!(percent < 1.0, "{}: {percent}", case.id);
    }
}

#[test]
fn a_grey_float_picture_is_luminance_and_colours_are_scaled() {
    let cases = cases();
    let case = cases.iter().find(|case| case.id == "gabor4cpd_c0.02").expect("it is there");
    let [test, reference] = case.images();
    let settings = ComparisonSettings {
        viewing: case.viewing(),
        compat: true,
        ..ComparisonSettings::default()
    };
    let found = compare(&test, &reference, &settings).unwrap();
    assert!((found.detection.p75_percent - case.hdr.p75_percent).abs() < 0.05);
    let coloured = |image: &Image| {
        let values = image.values().iter().flat_map(|v| [v / 50.0; 3]).collect();
        Image::new(image.size(), 3, values, image.encoding()).unwrap()
    };
    let scaled = ComparisonSettings { scale: 50.0, ..settings };
    let again = compare(&coloured(&test), &coloured(&reference), &scaled).unwrap();
    // The same luminances but for single precision.
    assert!((again.detection.p75_percent - found.detection.p75_percent).abs() < 0.005);
    assert!((again.detection.mean - found.detection.mean).abs() < 1e-6);
}
