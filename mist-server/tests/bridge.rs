//! `mist bridge` with a stand-in for RISE: what it wrote counts, not how it ended.
#![cfg(unix)]

use std::{fs, os::unix::fs::PermissionsExt, path::Path};

use assert_cmd::Command;
use rise_bridge::rise::table::read;

const SCENE: &str = "RISE ASCII SCENE 7\nfile_rasterizeroutput\n{\n\tpattern\tout/ball\n\ttype\tPNG\n}\n\
    datadriven_material\n{\n\tname\tball\n\tfilename\tnone\n\
    \t# mist: model = Lambertian_BRDF_Model\n\t# mist: reflectance.table = 0.5\n}\n";

/// A program in the place of RISE, which ends with the code 1 as RISE does.
fn renderer(dir: &Path, body: &str) -> std::path::PathBuf {
    let path = dir.join("rise");
    fs::write(&path, format!("#!/bin/sh\ncat > commands\n{body}\nexit 1\n")).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    path
}

fn bridge(dir: &Path, rise: Option<&Path>) -> std::process::Output {
    fs::write(dir.join("ball.RISEscene"), SCENE).unwrap();
    let words = ["bridge", "ball.RISEscene", "--out", "made", "--nodes", "4", "--wavelengths"];
    let mut command = Command::cargo_bin("mist").unwrap();
    command.current_dir(dir).args(words).arg("450,550,650").env_remove("RISE_BIN");
    if let Some(rise) = rise {
        command.arg("--render").env("RISE_BIN", rise);
    }
    command.output().unwrap()
}

#[test]
fn a_scene_becomes_a_table_and_a_scene() {
    let dir = tempfile::tempdir().unwrap();
    let output = bridge(dir.path(), None);
    assert!(output.status.success(), "{output:?}");
    let table = read(&fs::read(dir.path().join("made/ball.RISEdataBSDF")).unwrap()).unwrap();
    let white = 0.5 / std::f64::consts::PI;
    assert!(table.rgb.iter().flatten().all(|x| (x - white).abs() < 1e-6));
    let scene = fs::read_to_string(dir.path().join("made/ball_mist.RISEscene")).unwrap();
    assert!(scene.contains("filename\tball.RISEdataBSDF"));
}

#[test]
fn a_picture_that_is_there_is_a_success_whatever_the_exit_code() {
    let dir = tempfile::tempdir().unwrap();
    let rise = renderer(dir.path(), "echo picture > ball_mist.png");
    let output = bridge(dir.path(), Some(&rise));
    assert!(output.status.success(), "{output:?}");
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("ball_mist.RISEscene: ball_mist.png in"), "{said}");
    let commands = fs::read_to_string(dir.path().join("made/commands")).unwrap();
    assert_eq!(commands, "render\nquit\n");
}

#[test]
fn silent_failures_are_failures() {
    let dir = tempfile::tempdir().unwrap();
    fs::create_dir(dir.path().join("made")).unwrap();
    fs::write(dir.path().join("made/ball_mist.png"), "an old picture").unwrap();
    for (body, reason) in [
        ("true", "RISE wrote no ball_mist.png"),
        ("echo x > ball_mist.png; echo 'derive diagnostic: apply failed'", "RISE says"),
        ("echo x > ball_mist.png; echo 'DataDrivenBSDF:: Signature not found'", "RISE says"),
    ] {
        let rise = renderer(dir.path(), body);
        let output = bridge(dir.path(), Some(&rise));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(1) && said.contains(reason), "{body}: {said}");
    }
    let missing = bridge(dir.path(), Some(Path::new("no/such/program")));
    assert_eq!(missing.status.code(), Some(2));
}
