//! The commands that compare: pictures, programs and measurements, spectra.

use std::{fs, path::Path};

use assert_cmd::Command;
use rise_bridge::image::{Encoding, Format, Image};
use serde_json::Value;

fn mist(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("mist").expect("the binary is built");
    command.current_dir(folder).args(arguments);
    command
}

fn stdout(folder: &Path, arguments: &[&str]) -> String {
    let output = mist(folder, arguments).assert().success().get_output().stdout.clone();
    String::from_utf8(output).unwrap()
}

fn stderr(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = mist(folder, arguments).assert().code(code).get_output().stderr.clone();
    String::from_utf8(output).unwrap()
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&stdout(folder, arguments)).unwrap()
}

/// A picture of 48 × 40 pixels with waves of this contrast around a half.
fn waves(contrast: f32, encoding: Encoding, channels: usize) -> Image {
    let at = |i: usize| 0.5 * (1.0 + contrast * ((i % 48) as f32 * 0.8).sin());
    let values = (0..48 * 40).flat_map(|i| vec![at(i); channels]).collect();
    Image::new([48, 40], channels, values, encoding).unwrap()
}

fn save(folder: &Path, name: &str, image: &Image) {
    let format = Format::of_name(name).unwrap();
    fs::write(folder.join(name), image.write(format).unwrap()).unwrap();
}

#[test]
fn pictures_of_any_format_are_compared_and_the_map_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (name, channels) in [("a.exr", 1), ("a.pfm", 3)] {
        save(folder, name, &waves(0.2, Encoding::Linear, channels));
        save(folder, &format!("flat-{name}"), &waves(0.0, Encoding::Linear, channels));
    }
    let display = ["--display-size", "0.375x0.300", "--display-pixels", "1280x1024"];
    let grey = [&["diff", "a.exr", "flat-a.exr", "--compat", "--json"][..], &display].concat();
    let grey = json(folder, &[&grey[..], &["--distance", "0.5"]].concat());
    let seen = grey["hdrvdp"]["p75_percent"].as_f64().unwrap();
    assert!(seen > 50.0 && grey["hdrvdp"]["p95_percent"].as_f64().unwrap() <= seen, "{grey}");
    // Colours are luminance times the scale, here 1; one channel is luminance itself.
    let arguments = ["diff", "a.pfm", "flat-a.pfm", "--compat", "--json"];
    assert_eq!(json(folder, &arguments)["hdrvdp"]["p75_percent"], grey["hdrvdp"]["p75_percent"]);
    let said = stdout(
        folder,
        &["diff", "a.exr", "flat-a.exr", "--daly", "--map", "m.png", "--overlay", "o.png"],
    );
    assert!(said.contains("P>75%") && said.contains("Daly") && said.contains("FLIP"), "{said}");
    for (name, channels) in [("m.png", 1), ("o.png", 3)] {
        let image = Image::read(&fs::read(folder.join(name)).unwrap()).unwrap();
        assert_eq!((image.size(), image.channels()), ([48, 40], channels));
    }
}

#[test]
fn pictures_that_cannot_be_compared_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    save(folder, "a.png", &waves(0.2, Encoding::Srgb, 3));
    let small = Image::new([4, 4], 1, vec![0.5; 16], Encoding::Srgb).unwrap();
    save(folder, "small.png", &small);
    fs::write(folder.join("text.png"), "no picture").unwrap();
    assert!(stderr(folder, &["diff", "a.png", "small.png"], 2).contains("48 × 40"));
    assert!(stderr(folder, &["diff", "a.png", "text.png"], 2).contains("text.png"));
    assert!(stderr(folder, &["diff", "a.png", "none.png"], 2).contains("none.png"));
    assert!(stderr(folder, &["diff", "a.png", "a.png", "--distance", "0"], 2).contains("distance"));
    assert!(stderr(folder, &["diff", "a.png", "a.png", "--map", "m.gif"], 2).contains("m.gif"));
    stderr(folder, &["diff", "a.png", "a.png", "--display-size", "3"], 2);
}
