//! `mist preview` from a material to a picture.

use std::{fs, path::Path};

use assert_cmd::Command;
use tempfile::TempDir;

const PAINT: &str = r#"{"model": "Shadowed_Facet_BRDF_Model", "parameters": {"substrate": "(1.5,0)",
    "sdf": "Gaussian_Slope_Distribution_Function", "sdf.s": 0.25}}"#;

fn folder() -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("paint.json"), PAINT).unwrap();
    dir
}

/// Exit code, standard output and standard error of a small preview of the paint.
fn preview(dir: &Path, words: &[&str]) -> (i32, String, String) {
    let words = [&["preview", "paint.json", "--size", "24", "--samples", "2"], words].concat();
    let output = Command::cargo_bin("mist").unwrap().current_dir(dir).args(words).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// The number that follows `before` in `said`.
fn number_after(said: &str, before: &str) -> f64 {
    let at = said.find(before).unwrap_or_else(|| panic!("{before:?} in {said}")) + before.len();
    said[at..].split_whitespace().next().unwrap().parse().unwrap()
}

#[test]
fn a_filter_takes_the_glare_of_polarized_lamps_and_leaves_as_much_as_malus_says() {
    let dir = folder();
    let glare = |angle: &str| {
        let filter = format!("linear:{angle}");
        let lamps = ["--incident", "1,1,0,0", "--incident-basis", "horizontal", "--lamp", "4,90"];
        let words = ["--side-by-side", "--filter", &filter, "-o", "paint.png"];
        let (code, said, wrong) = preview(dir.path(), &[&lamps[..], &words].concat());
        assert_eq!(code, 0, "{wrong}");
        assert!(said.contains("48 × 24 pixels"), "{said}");
        assert!(fs::read(dir.path().join("paint.png")).unwrap().starts_with(b"\x89PNG"));
        number_after(&said, "without a filter, ") / number_after(&said, "brightest pixel: ")
    };
    // Light of one polarization that meets the surface within 2° of its normal keeps it.
    for (angle, part) in [("0", 1.0), ("60", 0.25), ("90", 0.0)] {
        assert!((glare(angle) - part).abs() < 0.01, "{angle}: {}", glare(angle));
    }
}

#[test]
fn what_cannot_be_drawn_is_refused_and_nothing_is_written() {
    let dir = folder();
    fs::write(dir.path().join("cut.ply"), "ply\nformat ascii 1.0\nelement vertex 3\n").unwrap();
    for (words, expected) in [
        (&["--shape", "cube", "-o", "a.png"][..], "not cube"),
        (&["--shape", "cut.ply", "-o", "a.png"], "cut.ply: not a mesh"),
        (&["--shape", "none.obj", "-o", "a.png"], "none.obj"),
        (&["--filter", "square", "-o", "a.png"], "square"),
        (&["-o", "a.gif"], ".png, .exr or .pfm"),
        (&["--spectral", "-o", "a.png"], ".exr"),
    ] {
        let (code, _, wrong) = preview(dir.path(), words);
        assert_eq!(code, 2, "{words:?}: {wrong}");
        assert!(wrong.contains(expected), "{words:?}: {wrong}");
    }
    let names = fs::read_dir(dir.path()).unwrap().map(|entry| entry.unwrap().file_name());
    assert_eq!(names.count(), 2, "the material and the mesh");
}
