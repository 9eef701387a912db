//! Packages are complete: files that a crate includes lie in it, and copies equal their originals.

use std::{fs, path::Path};

use mist_tests::sources::{files, packages, root};

#[test]
fn files_that_a_crate_includes_lie_in_it() {
    let mut outside = Vec::new();
    for package in packages().iter().filter(|package| *package != "tests") {
        let folder = root().join(package);
        let folder = fs::canonicalize(folder).unwrap();
        for file in files(&folder.join("src")).iter().filter(|file| !is_test(file)) {
            for path in included(&fs::read_to_string(file).unwrap()) {
                let target = fs::canonicalize(file.parent().unwrap().join(&path));
                if !target.is_ok_and(|target| target.starts_with(&folder)) {
                    outside.push(format!("{}: {path}", file.display()));
                }
            }
        }
    }
    assert!(outside.is_empty(), "files outside of their package:\n{}", outside.join("\n"));
}

fn is_test(file: &Path) -> bool {
    file.iter().any(|part| part == "tests" || part == "tests.rs")
}

/// The paths of the files that a source includes.
fn included(source: &str) -> Vec<String> {
    let calls = ["include_str!(\"", "include_bytes!(\""];
    let of = |call: &&'static str| source.split(*call).skip(1).collect::<Vec<_>>();
    let rest = calls.iter().flat_map(of);
    rest.filter_map(|rest| Some(rest.split_once('"')?.0.to_owned())).collect()
}

#[test]
fn the_copy_of_an_example_equals_it() {
    let read = |path: &str| fs::read_to_string(root().join(path)).unwrap();
    assert_eq!(read("mist-server/page/gold.nk"), read("examples/gold/gold.nk"));
}
