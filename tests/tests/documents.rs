//! The statements of `docs/language.md` and `docs/accuracy.md` that can be checked.
//!
//! Blocks that begin with `mist` are programs, which run in sound mode. Blocks that begin with
//! `data NAME` are files for the programs after them. A block that begins with `text` directly after
//! a program contains its results; white space is not compared. `UPDATE_GOLDEN=1` rewrites results
//! that differ.

use std::{collections::BTreeMap, fs, path::Path, sync::Arc};

use mist_engine::{Control, MemoryFiles, MemorySink, Options, compile, deviation};
use mist_format::expr::Function;

/// A fenced block of a document: the text after the fence, and the text of the block.
struct Block {
    info: String,
    text: String,
}

fn document(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name);
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn blocks(document: &str) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut is_open = false;
    for line in document.lines() {
        if let Some(info) = line.strip_prefix("```") {
            if !is_open {
                blocks.push(Block { info: info.trim().to_owned(), text: String::new() });
            }
            is_open = !is_open;
        } else if is_open {
            let block = blocks.last_mut().expect("an open block is there");
            block.text.push_str(line);
            block.text.push('\n');
        }
    }
    assert!(!is_open, "a block is not closed");
    blocks
}

fn results(program: &str, files: &BTreeMap<String, Arc<str>>) -> String {
    let files = Arc::new(MemoryFiles(files.clone()));
    let job = compile(program, files, &Options::default())
        .unwrap_or_else(|diagnostics| panic!("{diagnostics:?} in\n{program}"));
    let mut sink = MemorySink::default();
    job.run(&mut sink, &Control::default()).unwrap_or_else(|e| panic!("{e} in\n{program}"));
    sink.results
}

/// The words of every line.
fn words(text: &str) -> Vec<Vec<&str>> {
    text.lines().map(|line| line.split_whitespace().collect()).collect()
}

/// Results with one blank between columns.
fn as_table(results: &str) -> String {
    words(results).iter().map(|row| row.join(" ") + "\n").collect()
}

#[test]
fn every_program_of_the_manual_gives_the_table_below_it() {
    let is_updated = std::env::var_os("UPDATE_GOLDEN").is_some();
    let mut manual = document("docs/language.md");
    let blocks = blocks(&manual);
    let mut files = BTreeMap::new();
    let mut programs = 0;
    for (at, block) in blocks.iter().enumerate() {
        if let Some(name) = block.info.strip_prefix("data ") {
            files.insert(name.to_owned(), Arc::from(block.text.as_str()));
        }
        if block.info == "mist" {
            let got = results(&block.text, &files);
            if let Some(want) = blocks.get(at + 1).filter(|next| next.info == "text") {
                if is_updated && words(&got) != words(&want.text) {
                    manual = manual.replacen(&want.text, &as_table(&got), 1);
                    continue;
                }
                assert_eq!(words(&got), words(&want.text), "{}", block.text);
            }
            programs += 1;
        }
    }
    if is_updated {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/language.md");
        fs::write(path, manual).expect("the manual can be written");
        return;
    }
    assert!(programs >= 4, "only {programs} programs were found");
}

#[test]
fn the_manual_lists_every_function_with_its_arguments() {
    let manual = document("docs/language.md");
    for function in Function::ALL {
        let start = format!("| `{}(", function.name());
        let row = manual.lines().find(|line| line.starts_with(&start));
        let row = row.unwrap_or_else(|| panic!("{} has no row", function.name()));
        let arguments = row[start.len()..].split(')').next().unwrap_or("");
        assert_eq!(arguments.split(',').count(), function.arity(), "{row}");
    }
}

#[test]
fn the_manual_has_the_chapter_of_deviations() {
    let mut manual = document("docs/language.md");
    let chapter = deviation::chapter();
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        let start = manual.find("### Reading\n").expect("the chapter begins");
        let physics = start + manual[start..].find("### Physics\n").expect("it has three tables");
        let table = physics + manual[physics..].find("\n| ---").expect("the table begins") + 1;
        let end = manual[table..].find("\n\n").map_or(manual.len(), |length| table + length + 1);
        manual.replace_range(start..end, &chapter[..chapter.len() - 1]);
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/language.md");
        fs::write(path, &manual).expect("the manual can be written");
    }
    for line in chapter.lines() {
        assert!(manual.lines().any(|row| row == line), "docs/language.md lacks: {line}");
    }
}

#[test]
fn every_defect_has_the_tests_that_the_page_on_accuracy_names() {
    let page = document("docs/accuracy.md");
    let rows: Vec<Vec<&str>> = page
        .lines()
        .map(|line| line.split('|').map(|cell| cell.trim().trim_matches('`')).collect::<Vec<_>>())
        .filter(|cells| cells.len() == 6 && cells[3].ends_with(".rs"))
        .collect();
    for number in [1, 3, 4, 6, 7, 8, 9, 11, 13, 14, 17, 18, 19, 20] {
        assert!(rows.iter().any(|cells| cells[1] == format!("B{number}")), "B{number} has no row");
    }
    for cells in rows {
        let test = format!("#[test]\n    fn {}()", cells[4]).replace("    ", "");
        let source = document(cells[3]).replace("    ", "");
        assert!(source.contains(&test), "{} has no test {}", cells[3], cells[4]);
    }
}

#[test]
fn tests_that_documents_name_are_there() {
    for name in [
        "README.md",
        "ARCHITECTURE.md",
        "docs/accuracy.md",
        "docs/conventions.md",
        "docs/language.md",
    ] {
        for word in document(name).split(|c: char| c.is_whitespace() || "`()|,;".contains(c)) {
            if word.starts_with("tests/") || word.contains("/tests/") || word.contains("/src/") {
                let path = word.trim_end_matches(['.', ':', '/']);
                if path.contains(['*', '{', '<', '…', ':']) {
                    continue;
                }
                let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
                assert!(file.exists(), "{name} names {path}, which is not there");
            }
        }
    }
}
