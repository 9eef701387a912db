//! Programs as JSON with their data files: every command that takes a program takes them.

use std::{fs, path::Path};

use assert_cmd::Command;
use serde_json::json;

const PROGRAM: &str = "MODEL = Facet_BRDF_Model\nVARIABLES:\n  s = 0.2\n  thetas = 0.1\n\
    #lambda = 0.55\n  $substrate = glass.nk\n  $sdf = Gaussian_Slope_Distribution_Function\n\
    #sdf.s = s\n  incidentangle = 0.3  incidentpol = (1,0,0,0)  rotation = 0\nEND\n\
    VARY: FOR thetas FROM 0 TO 0.4 BY 0.1 END\nINTEGRALS:\n\
    f = DIFFERENTIAL CENTER = (thetas,0) END\nEND\nOUTPUTS: 1 brdf=f END\nFILES: END\n";
const GLASS: &str = "0.4 1.5 0\n0.8 1.5 0\n";

/// Exit code, standard output and standard error.
fn mist(dir: &Path, words: &[&str]) -> (i32, String, String) {
    let output = Command::cargo_bin("mist").unwrap().current_dir(dir).args(words).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn a_program_with_its_files_runs_as_the_program_beside_its_files() {
    let (plain, described) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    fs::write(plain.path().join("a.mist"), PROGRAM).unwrap();
    fs::write(plain.path().join("glass.nk"), GLASS).unwrap();
    let json = json!({"program": PROGRAM, "files": {"glass.nk": GLASS}, "job": "a"});
    fs::write(described.path().join("a.json"), json.to_string()).unwrap();
    for dir in [(plain.path(), "a.mist"), (described.path(), "a.json")] {
        let (status, _, told) = mist(dir.0, &["run", dir.1]);
        assert_eq!(status, 0, "{told}");
    }
    let results = |dir: &Path| fs::read_to_string(dir.join("a.dat")).unwrap();
    assert_eq!(results(plain.path()), results(described.path()));

    for words in [
        &["check", "a.json"][..],
        &["tolerance", "a.json", "--vary", "s"],
        &["table", "a.json", "--grid", "thetai=0,30,thetas=0,30,phis=0", "--lambda=450:50:600"],
    ] {
        let (_, _, told) = mist(described.path(), words);
        assert!(!told.contains("not a program") && !told.contains("glass.nk"), "{words:?}: {told}");
    }
    let request = json!({"program": PROGRAM, "files": {"glass.nk": GLASS},
        "geometries": [{"theta_i": 0.3, "theta_s": 0.1, "phi_s": 0}]});
    fs::write(described.path().join("eval.json"), request.to_string()).unwrap();
    let (status, said, told) = mist(described.path(), &["eval", "eval.json"]);
    assert_eq!(status, 0, "{told}");
    let rows = results(described.path());
    let row = rows.lines().find(|line| line.trim_start().starts_with("0.1")).unwrap();
    let brdf: f64 = row.split_whitespace().nth(1).unwrap().parse().unwrap();
    let answer: serde_json::Value = serde_json::from_str(&said).unwrap();
    let value = answer["mueller"][0][0].as_f64().unwrap();
    // The integral over a differential solid angle has the cosine of scattering.
    assert!((value * 0.1_f64.cos() / brdf - 1.0).abs() < 1e-5, "{value} {brdf}");
}

#[test]
fn what_is_wrong_with_a_described_program_is_told_with_its_place() {
    let dir = tempfile::tempdir().unwrap();
    for (text, words) in [
        (json!({"program": PROGRAM.replace("_Model\n", "_Modell\n")}).to_string(), "m.json:1:9"),
        (json!({"program": "", "fils": {}}).to_string(), "unknown field `fils`"),
        (json!({"model": "Lambertian_BRDF_Model"}).to_string(), "not a program with its files"),
    ] {
        fs::write(dir.path().join("m.json"), text).unwrap();
        let (status, _, told) = mist(dir.path(), &["run", "m.json"]);
        assert_eq!(status, 2, "{told}");
        assert!(told.contains(words), "{told}");
    }
}
