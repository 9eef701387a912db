//! The invariants of `ARCHITECTURE.md` that a reader of the sources can check.

use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

const CRATES: [&str; 8] = [
    "spectra",
    "scattering",
    "mist-format",
    "mist-engine",
    "pictures",
    "preview",
    "rise-bridge",
    "mist-server",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("tests/ has a parent").to_owned()
}

/// Names in the section `[dependencies]` of a crate.
fn dependencies(name: &str) -> BTreeSet<String> {
    let path = root().join(name).join("Cargo.toml");
    let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    text.lines()
        .map(str::trim)
        .skip_while(|line| *line != "[dependencies]")
        .skip(1)
        .take_while(|line| !line.starts_with('['))
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
        .map(|line| line.split(['.', ' ', '=']).next().unwrap_or(line).to_owned())
        .collect()
}

/// Our crates that `name` uses.
fn ours(name: &str) -> Vec<String> {
    dependencies(name).into_iter().filter(|other| CRATES.contains(&other.as_str())).collect()
}

fn assert_uses_only(name: &str, allowed: &[&str]) {
    for used in ours(name) {
        assert!(allowed.contains(&used.as_str()), "{name} must not use {used}");
    }
}

#[test]
fn spectra_and_mist_format_use_no_crate_of_ours() {
    assert_uses_only("spectra", &[]);
    assert_uses_only("mist-format", &[]);
}

#[test]
fn scattering_knows_no_texts_and_no_engine() {
    assert_uses_only("scattering", &["spectra"]);
}

#[test]
fn the_engine_uses_texts_models_and_colours_only() {
    assert_uses_only("mist-engine", &["mist-format", "scattering", "spectra"]);
}

#[test]
fn pictures_know_colours_only() {
    assert_uses_only("pictures", &["spectra"]);
}

#[test]
fn the_preview_knows_no_format_of_a_renderer() {
    assert_uses_only("preview", &["mist-engine", "pictures", "scattering", "spectra"]);
}

#[test]
fn the_bridge_does_not_use_the_server() {
    let below = ["mist-engine", "mist-format", "pictures", "preview", "scattering", "spectra"];
    assert_uses_only("rise-bridge", &below);
}

#[test]
fn only_the_server_knows_arguments_sockets_and_terminals() {
    let server = dependencies("mist-server");
    for edge in ["clap", "axum", "tokio", "indicatif", "annotate-snippets"] {
        assert!(server.contains(edge), "{edge} is gone from mist-server: change this list");
        for name in CRATES.iter().filter(|name| **name != "mist-server") {
            assert!(!dependencies(name).contains(edge), "{name} must not use {edge}");
        }
    }
}

#[test]
fn only_the_server_opens_files_sockets_and_thread_pools() {
    for name in CRATES.iter().filter(|name| **name != "mist-server") {
        let all = sources(&root().join(name).join("src"));
        for path in all.iter().filter(|path| path.file_name().is_none_or(|n| n != "tests.rs")) {
            let text = fs::read_to_string(path).expect("a source is text");
            let code = text.split("#[cfg(test)]").next().unwrap_or(&text);
            let code = code.lines().filter(|line| !line.trim_start().starts_with("//"));
            for line in code {
                for edge in ["std::fs", "fs::read", "File::open", "std::net", "ThreadPoolBuilder"] {
                    assert!(!line.contains(edge), "{}: {line}", path.display());
                }
            }
        }
    }
}

#[test]
fn every_source_file_says_in_its_first_line_what_it_is() {
    let folders = CRATES.iter().map(|name| root().join(name)).chain([root().join("tests")]);
    let mut silent = Vec::new();
    for path in folders.flat_map(|folder| sources(&folder)) {
        let text = fs::read_to_string(&path).expect("a source is text");
        let first = text.lines().next().unwrap_or("");
        if !first.starts_with("//!") && !first.starts_with("#![doc = include_str!(") {
            silent.push(path);
        }
    }
    assert!(silent.is_empty(), "without a first line //!: {silent:?}");
}

/// All Rust sources below `folder`, in order.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    for entry in entries {
        let path = entry.expect("the folder can be read").path();
        if path.is_dir() {
            if path.file_name().is_none_or(|name| name != "target") {
                found.extend(sources(&path));
            }
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}
