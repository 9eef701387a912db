//! Every example of `mist new` runs as it is, without a warning.

use std::{fs, path::Path};

use assert_cmd::Command;

/// Exit code, standard output and standard error.
fn mist(dir: &Path, words: &[&str]) -> (i32, String, String) {
    let output = Command::cargo_bin("mist").unwrap().current_dir(dir).args(words).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// The names of the examples.
fn names(dir: &Path) -> Vec<String> {
    let (_, list, _) = mist(dir, &["new", "--list"]);
    list.lines().filter_map(|line| line.split_whitespace().nth(1)).map(str::to_owned).collect()
}

#[test]
fn every_example_runs_and_has_no_warning() {
    let dir = tempfile::tempdir().unwrap();
    let names = names(dir.path());
    assert!(names.len() >= 12, "{names:?}");
    for name in names {
        let file = format!("{name}.mist");
        assert_eq!(mist(dir.path(), &["new", "--from", &name]).0, 0, "{name}");
        for words in [
            &["check", &file, "--deny-warnings"][..],
            &["run", &file, "--deny-warnings"],
            &["fmt", "--check", &file],
        ] {
            let (status, said, told) = mist(dir.path(), words);
            assert_eq!(status, 0, "{words:?}: {said}{told}");
        }
    }
}

#[test]
fn materials_are_the_models_of_the_programs() {
    let dir = tempfile::tempdir().unwrap();
    let grid = ["--grid", "thetai=45,thetas=0,30,phis=0", "--lambda", "450,650"];
    for name in ["metallic-paint", "pearl", "plastic", "white-paint", "anodized"] {
        let tables = ["mist", "json"].map(|extension| {
            let file = format!("{name}.{extension}");
            assert_eq!(mist(dir.path(), &["new", "--from", name, &file]).0, 0, "{name}");
            let out = format!("{extension}.mspd");
            let words = [&["table", &file][..], &grid, &["-o", &out]].concat();
            let (status, _, told) = mist(dir.path(), &words);
            assert_eq!(status, 0, "{name}: {told}");
            let text = fs::read_to_string(dir.path().join(out)).unwrap();
            text.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>().join("\n")
        });
        assert_eq!(tables[0], tables[1], "{name}");
    }
}

#[test]
fn a_file_that_exists_is_not_replaced() {
    let dir = tempfile::tempdir().unwrap();
    let words = ["new", "--from", "pearl", "a.mist"];
    assert_eq!(mist(dir.path(), &words).0, 0);
    fs::write(dir.path().join("a.mist"), "mine").unwrap();
    let (status, _, told) = mist(dir.path(), &words);
    assert!(status == 2 && told.contains("a.mist exists"), "{told}");
    assert_eq!(fs::read_to_string(dir.path().join("a.mist")).unwrap(), "mine");
    assert_eq!(mist(dir.path(), &[&words[..], &["--force"]].concat()).0, 0);
    let (status, _, told) = mist(dir.path(), &["new", "--from", "metalic-paint"]);
    assert!(status == 2 && told.contains("did you mean `metallic-paint`?"), "{told}");
    let (status, _, told) = mist(dir.path(), &["new"]);
    assert!(status == 2 && told.contains("--from"), "{told}");
}
