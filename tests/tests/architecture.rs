//! The arrows between the crates, and what every source file begins with.

use std::{
    fs,
    path::{Path, PathBuf},
};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Names in the section `[dependencies]` of a crate.
fn dependencies(folder: &str) -> Vec<String> {
    let text = fs::read_to_string(root().join(folder).join("Cargo.toml")).unwrap();
    text.lines()
        .skip_while(|line| *line != "[dependencies]")
        .skip(1)
        .take_while(|line| !line.starts_with('['))
        .filter_map(|line| line.split(['.', ' ', '=']).next())
        .filter(|name| !name.is_empty() && !name.starts_with('#'))
        .map(str::to_owned)
        .collect()
}

const OURS: [&str; 6] =
    ["spectra", "scattering", "mist-format", "mist-engine", "rise-bridge", "mist-server"];

#[test]
fn crates_depend_on_each_other_in_one_direction_only() {
    let allowed: [(&str, &[&str]); 6] = [
        ("spectra", &[]),
        ("scattering", &[]),
        ("mist-format", &[]),
        ("mist-engine", &["spectra", "scattering", "mist-format"]),
        ("rise-bridge", &["spectra", "scattering", "mist-format", "mist-engine"]),
        ("mist-server", &["spectra", "scattering", "mist-format", "mist-engine", "rise-bridge"]),
    ];
    for (folder, allowed) in allowed {
        for name in dependencies(folder) {
            let ours = OURS.contains(&name.as_str());
            assert!(!ours || allowed.contains(&name.as_str()), "{folder} depends on {name}");
        }
    }
}

#[test]
fn only_the_server_knows_terminals_and_sockets() {
    for folder in OURS.iter().filter(|name| **name != "mist-server") {
        for name in dependencies(folder) {
            let outside = ["clap", "axum", "tokio", "indicatif", "annotate-snippets"];
            assert!(!outside.contains(&name.as_str()), "{folder} depends on {name}");
        }
    }
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn every_source_file_begins_by_saying_what_is_inside() {
    let mut files = Vec::new();
    for folder in OURS {
        sources(&root().join(folder).join("src"), &mut files);
    }
    assert!(files.len() > 100);
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        let says = text.starts_with("//!") || text.starts_with("#![doc = include_str!");
        assert!(says, "{} does not say what is inside", file.display());
    }
}
