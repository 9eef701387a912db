//! `mist bridge` with a stand-in for RISE: what it wrote counts, not how it ended.
#![cfg(unix)]

use std::{fs, os::unix::fs::PermissionsExt, path::Path};

use assert_cmd::Command;
use pictures::image::{Encoding, Image, PictureFormat};
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

/// Writes `picture.png` and `picture.exr`, which are grey, and `black.png`.
fn pictures(dir: &Path) {
    let image = |value| Image::new([2, 1], 3, vec![value; 6], Encoding::Linear).unwrap();
    for (name, value, format) in [
        ("picture.png", 0.25, PictureFormat::Png),
        ("picture.exr", 0.25, PictureFormat::Exr),
        ("black.png", 0.0, PictureFormat::Png),
    ] {
        fs::write(dir.join(name), image(value).write(format).unwrap()).unwrap();
    }
}

fn bridge(dir: &Path, rise: Option<&Path>, bands: bool) -> std::process::Output {
    pictures(dir);
    fs::write(dir.join("ball.RISEscene"), SCENE).unwrap();
    let words = ["bridge", "ball.RISEscene", "--out", "made", "--nodes", "4", "--wavelengths"];
    let mut command = Command::cargo_bin("mist").unwrap();
    command.current_dir(dir).args(words).arg("450,550,650").env_remove("RISE_BIN");
    if bands {
        command.arg("--bands");
    }
    if let Some(rise) = rise {
        command.arg("--render").env("RISE_BIN", rise);
    }
    command.output().unwrap()
}

#[test]
fn a_scene_becomes_a_table_and_a_scene() {
    let dir = tempfile::tempdir().unwrap();
    let output = bridge(dir.path(), None, false);
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
    let rise = renderer(dir.path(), "cp ../picture.png ball_mist.png");
    let output = bridge(dir.path(), Some(&rise), false);
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
        ("cp ../black.png ball_mist.png", "ball_mist.png is black"),
        ("echo x > ball_mist.png", "not a PNG"),
        ("echo x > ball_mist.png; echo 'derive diagnostic: apply failed'", "RISE says"),
        ("echo x > ball_mist.png; echo 'DataDrivenBSDF:: Signature not found'", "RISE says"),
    ] {
        let rise = renderer(dir.path(), body);
        let output = bridge(dir.path(), Some(&rise), false);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(1) && said.contains(reason), "{body}: {said}");
    }
    let missing = bridge(dir.path(), Some(Path::new("no/such/program")), false);
    assert_eq!(missing.status.code(), Some(2));
}

#[test]
fn renders_of_three_wavelengths_become_one_picture() {
    let dir = tempfile::tempdir().unwrap();
    let body = "cp ../picture.png ball_mist.png; cp ../picture.exr ball_b00.exr";
    let rise = renderer(dir.path(), body);
    let output = bridge(dir.path(), Some(&rise), true);
    assert!(output.status.success(), "{output:?}");
    let bytes = fs::read(dir.path().join("made/ball_bands.exr")).unwrap();
    // All wavelengths have the same radiance: a grey of that value. 32-bit numbers.
    let picture = Image::read(&bytes).unwrap();
    assert!(picture.values().iter().all(|x| (x - 0.25).abs() < 1e-6), "{picture:?}");
    assert!(dir.path().join("made/ball_bands.png").exists());
}

/// A plane that faces the camera, under a lamp at the camera.
const PLANE: &str = "film\n{\n\twidth\t4\n\theight\t3\n}\npinhole_camera\n{\n\tlocation\t0 0 9\n\
    \tlookat\t0 0 0\n\tup\t0 1 0\n\tfov\t1\n}\ndirectional_light\n{\n\tname\tkey\n\tpower\t2\n\
    \tcolor\t1 1 1\n\tdirection\t0 0 1\n}\n";

#[test]
fn a_deferred_picture_is_shaded_from_renders_of_geometry() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("plane.RISEscene"), format!("{SCENE}{PLANE}")).unwrap();
    for (name, value) in [("one.exr", 1.0), ("zero.exr", 0.0)] {
        let image = Image::new([8, 6], 3, vec![value; 144], Encoding::Linear).unwrap();
        fs::write(dir.path().join(name), image.write(PictureFormat::Exr).unwrap()).unwrap();
    }
    let rise = renderer(
        dir.path(),
        "case $1 in *_pz.RISEscene|*_lamp0.RISEscene) f=one;; *) f=zero;; esac\n\
         cp ../$f.exr ${1%.RISEscene}.exr",
    );
    let words = "bridge plane.RISEscene --out made --deferred --filter linear:30 --wavelengths \
                 450,550,650";
    let run = |more: &str| {
        let mut command = Command::cargo_bin("mist").unwrap();
        command.current_dir(dir.path()).env("RISE_BIN", &rise).args(words.split_whitespace());
        command.args(more.split_whitespace()).output().unwrap()
    };
    let planned = run("");
    assert!(planned.status.success(), "{planned:?}");
    assert!(String::from_utf8_lossy(&planned.stdout).contains("plane_d_ball_nx.RISEscene"));
    assert_eq!(run("--stack").status.code(), Some(2), "there are no renders yet");
    let done = run("--render");
    assert!(done.status.success(), "{done:?}");
    let picture = |name: &str| {
        let image = Image::read(&fs::read(dir.path().join("made").join(name)).unwrap()).unwrap();
        assert_eq!(image.size(), [4, 3]);
        image.values().to_vec()
    };
    let white = 2.0 * 0.5 / std::f64::consts::PI;
    // 32-bit numbers.
    let near = |x: &f32, y: f64| (f64::from(*x) - y).abs() < 1e-6;
    assert!(picture("plane_deferred.exr").iter().all(|x| near(x, white)));
    assert!(picture("plane_deferred_filter.exr").iter().all(|x| near(x, 0.5 * white)));
    assert_eq!(run("--stack").status.code(), Some(0));
    assert_eq!(run("--bands").status.code(), Some(2), "one or the other");
}
