//! Messages, comments and documents avoid phrases that readers did not understand, and types do not
//! have the names that `docs/glossary.md` lists as old.

use std::{fs, path::Path};

use mist_tests::sources::{packages, root, shown, trees, type_name};

/// Phrases that readers quoted as hard to understand, in halves, so that this file has none of them.
const PHRASES: &[(&str, &str)] = &[
    ("all that must ", "be there"),
    ("that are ", "nothing"),
    ("means nothing ", "for"),
    ("mist key` ", "closes it"),
    ("what stands ", "behind"),
    ("is not read, ", "nor"),
    ("without rhyme ", "or reason"),
    ("whoever ", "asks"),
    ("who asks ", "for"),
    ("a wish to ", "stop"),
];

/// Folders that hold no text of this project.
const SKIPPED: &[&str] = &["target", ".git", "node_modules", "conformance", "reference"];

/// Calls `read` with the path and the lower-case text of every source, page and document.
fn for_each_text(folder: &Path, read: &mut impl FnMut(&Path, &str)) {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    for entry in entries {
        let path = entry.expect("the folder can be read").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let extension = path.extension().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() {
            if !SKIPPED.contains(&name.as_str()) {
                for_each_text(&path, read);
            }
        } else if ["rs", "md", "js", "html", "py", "hpp", "toml"].contains(&extension.as_str()) {
            let text = fs::read_to_string(&path).expect("a source is text").to_lowercase();
            let words: Vec<&str> = text
                .split_whitespace()
                .filter(|word| !["//", "///", "//!"].contains(word))
                .collect();
            read(&path, &words.join(" "));
        }
    }
}

#[test]
fn no_text_has_a_phrase_that_readers_did_not_understand() {
    let mut faults = Vec::new();
    for_each_text(&root(), &mut |path, text| {
        for (start, end) in PHRASES {
            let phrase = format!("{start}{end}");
            if text.contains(&phrase) {
                faults.push(format!("{}: {phrase}", shown(path)));
            }
        }
    });
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Words of the column "old name" that were names of types.
fn old_names() -> Vec<String> {
    let text = fs::read_to_string(root().join("docs/glossary.md")).expect("the glossary is there");
    let rows = text.lines().filter_map(|line| line.strip_prefix('|')?.strip_suffix('|'));
    let cells = rows.filter_map(|row| row.rsplit('|').next());
    let names = cells.flat_map(|cell| cell.split(',')).map(|name| name.trim().trim_matches('`'));
    names
        .filter(|name| {
            name.starts_with(char::is_uppercase) && name.chars().all(char::is_alphanumeric)
        })
        .map(str::to_owned)
        .collect()
}

#[test]
fn no_type_has_an_old_name_of_the_glossary() {
    let old = old_names();
    assert!(old.len() >= 10, "only {old:?}");
    let mut faults = Vec::new();
    for tree in packages().iter().flat_map(|package| trees(package)) {
        for module in &tree.modules {
            for name in module.items.iter().filter_map(type_name).filter(|name| old.contains(name))
            {
                faults.push(format!("{}: {name}", shown(&module.file)));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
