//! Warnings of every command: one line each on standard error, the key `warnings`, `--deny-warnings`.

use std::{fs, path::Path};

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

const WHITE: &str = r#"{"model": "Lambertian_BRDF_Model"}"#;
const PROGRAM: &str = "MODEL = Facet_BRDF_Model\nVARIABLES:\n  thetas = 30\n  s = 0.2\n\
    #lambda = 0.55\n  $substrate = (1.5,0)\n  $sdf = Gaussian_Slope_Distribution_Function\n\
    #sdf.s = s\n  incidentangle = 30  incidentpol = (1,0,0,0)  rotation = 0\n\
    differential = 1  minsamples = 1\nEND\nVARY: FOR thetas FROM 0 TO 60 BY 5 END\nINTEGRALS:\n\
    f = DIFFERENTIAL CENTER = (thetas*deg,0) END\nEND\nOUTPUTS: 1 brdf=f END\n\
    FILES: format = %.8g\\t END\n";

fn folder(files: &[(&str, &str)]) -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(dir.path().join(name), text).unwrap();
    }
    dir
}

/// Exit code, standard output and the lines of standard error.
fn mist(dir: &Path, words: &[&str]) -> (i32, String, Vec<String>) {
    let output = Command::cargo_bin("mist").unwrap().current_dir(dir).args(words).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let told = text(output.stderr).lines().map(str::to_owned).collect();
    (output.status.code().unwrap(), text(output.stdout), told)
}

/// Runs a command that warns once with `code`; with --deny-warnings it fails.
fn warned(dir: &Path, words: &[&str], code: &str) -> String {
    let (status, said, told) = mist(dir, words);
    let lines: Vec<_> = told.iter().filter(|line| line.starts_with("warning")).collect();
    assert_eq!((status, lines.len()), (0, 1), "{words:?}: {told:?}");
    assert!(lines[0].starts_with(&format!("warning[{code}]: ")), "{lines:?}");
    let (status, _, told) = mist(dir, &[words, &["--deny-warnings"]].concat());
    let last = told.last().map_or("", String::as_str);
    assert_eq!((status, last), (2, "error: 1 warning, and --deny-warnings is given"), "{words:?}");
    said
}

#[test]
fn every_command_that_reads_a_program_tells_degrees_for_radians() {
    let dir = folder(&[("a.mist", PROGRAM)]);
    let grid = "thetai=0,30,thetas=0,30,phis=0";
    for words in [
        &["run", "a.mist"][..],
        &["check", "a.mist"],
        &["table", "a.mist", "--grid", grid, "--lambda", "400,500,600,700", "-o", "a.mtab"],
        &["export", "a.mist", "--grid", "5x4x6", "-o", "a.pbsdf"],
        &["preview", "a.mist", "--size", "8", "--samples", "1", "-o", "a.png"],
    ] {
        warned(dir.path(), words, "angle/degrees");
    }
}

#[test]
fn a_run_that_is_denied_writes_no_table() {
    let dir = folder(&[("a.mist", PROGRAM)]);
    assert_eq!(mist(dir.path(), &["run", "--deny-warnings", "a.mist"]).0, 2);
    assert!(!dir.path().join("a.dat").exists());
}

#[test]
fn requests_tell_their_units_and_their_json_has_the_warnings() {
    let eval = r#"{"model": "Lambertian_BRDF_Model",
        "geometries": [{"theta_i": 45, "theta_s": 0.2, "phi_s": 0}]}"#;
    let um = r#"{"wavelengths": [0.4, 0.5, 0.6, 0.7], "values": [0.1, 0.2, 0.7, 0.8],
        "illuminant": "D65"}"#;
    let dir = folder(&[("white.json", WHITE), ("eval.json", eval), ("um.json", um)]);
    let warnings = |text: &str| {
        let document: Value = serde_json::from_str(text).unwrap();
        document["warnings"].as_array().map_or(0, Vec::len)
    };
    assert_eq!(warnings(&warned(dir.path(), &["eval", "eval.json"], "angle/degrees")), 1);
    assert_eq!(warnings(&warned(dir.path(), &["color", "um.json"], "wavelength/unit")), 1);
    let grid = ["--grid", "thetai=0,30,thetas=0,30,phis=0", "-o", "white.json.json"];
    let words = [&["table", "white.json", "--lambda", "0.4:0.1:0.7"][..], &grid].concat();
    warned(dir.path(), &words, "wavelength/unit");
    let table = fs::read_to_string(dir.path().join("white.json.json")).unwrap();
    assert_eq!(warnings(&table), 1);
    let beyond = ["--grid", "thetai=0,30,thetas=0:30:120,phis=0", "-o", "white.mtab"];
    warned(dir.path(), &[&["table", "white.json"][..], &beyond].concat(), "angle/horizon");
}

#[test]
fn numbers_that_are_not_finite_are_told_with_their_column() {
    let program = PROGRAM
        .replace("incidentangle = 30", "incidentangle = 0.5")
        .replace("brdf=f", "brdf=f/(thetas-30)");
    let dir = folder(&[("a.mist", &program)]);
    warned(dir.path(), &["run", "a.mist"], "output/not-finite");
}

#[test]
fn a_material_with_a_table_in_nm_is_refused_by_every_command() {
    let material = r#"{"model": "Facet_BRDF_Model", "parameters": {"substrate": "m.txt",
        "sdf": "Gaussian_Slope_Distribution_Function", "sdf.s": 0.2}}"#;
    let dir = folder(&[("m.json", material), ("m.txt", "300 1.55 0.01\n900 1.52 0.02\n")]);
    for words in [
        &["table", "m.json", "--grid", "thetai=0,30,thetas=0,30,phis=0", "-o", "m.mtab"][..],
        &["export", "m.json", "--grid", "5x4x6", "-o", "m.pbsdf"],
        &["preview", "m.json", "--size", "8", "--samples", "1", "-o", "m.png"],
    ] {
        let (status, _, told) = mist(dir.path(), words);
        assert!(status == 2 && told.concat().contains("looks like nm"), "{words:?}: {told:?}");
    }
}

#[test]
fn tables_of_measured_values_are_read_as_instruments_write_them() {
    let program = PROGRAM.replace("incidentangle = 30", "incidentangle = 0.5");
    let dir = folder(&[("a.mist", &program)]);
    mist(dir.path(), &["run", "a.mist"]);
    let rows: Vec<String> = fs::read_to_string(dir.path().join("a.dat"))
        .unwrap()
        .lines()
        .skip(1)
        .map(|row| row.trim_end().to_owned())
        .collect();
    let table = |heading: &str, separator: &str, point: &str| {
        let rows = rows.iter().map(|row| row.replace('.', point).replace('\t', separator));
        format!("{heading}\n{}\n", rows.collect::<Vec<_>>().join("\n"))
    };
    let utf16: Vec<u8> = [0xfeff]
        .into_iter()
        .chain(table("thetas,brdf", ",", ".").encode_utf16())
        .flat_map(u16::to_le_bytes)
        .collect();
    for (name, text) in [
        ("quoted", table("\"thetas\",\"brdf\"", ",", ".").into_bytes()),
        ("semicolons", table("thetas;brdf", ";", ".").into_bytes()),
        ("decimal commas", table("thetas;brdf", ";", ",").into_bytes()),
        ("units", table("thetas [deg],brdf [1/sr]", ",", ".").into_bytes()),
        ("metadata", table("Instrument: X\nthetas,brdf", ",", ".").into_bytes()),
        ("capitals", table("ThetaS,BRDF", ",", ".").into_bytes()),
        ("utf16", utf16),
    ] {
        fs::write(dir.path().join("m.csv"), text).unwrap();
        let fit = ["fit", "a.mist", "--measured", "m.csv", "--vary", "s", "--start", "s=0.3"];
        let (status, said, told) = mist(dir.path(), &fit);
        assert!(status == 0 && said.starts_with("s = 0.2 ±"), "{name}: {said} {told:?}");
    }
    fs::write(dir.path().join("m.csv"), table("angle,reading", ",", ".")).unwrap();
    let (_, _, told) = mist(dir.path(), &["fit", "a.mist", "--measured", "m.csv", "--vary", "s"]);
    let told = told.concat();
    assert!(told.contains("its outputs are brdf") && told.contains("angle, reading"), "{told}");
}
