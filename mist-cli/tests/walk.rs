//! Walks the documents: their commands run in an empty folder, and print what stands there.
//!
//! A block of the kind `console` has commands behind `$ ` and below each what it prints. Numbers agree to
//! 0.1 %; seconds and the order of magnitude of times are not compared. `UPDATE_GOLDEN=1` writes what was
//! printed into the documents.

use std::{fs, path::Path, process::Command};

use tempfile::TempDir;

/// The largest relative difference of printed numbers.
const SAME: f64 = 1e-3;

/// A command with its lines in a document.
struct Step {
    /// The line behind `$ `.
    command: String,
    /// The lines that it prints.
    printed: Vec<String>,
}

fn root(path: &str) -> String {
    format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"))
}

/// Runs all commands of the document at `path`, and compares or updates.
fn walk(path: &str) {
    let text = fs::read_to_string(root(path)).unwrap();
    let dir = tempfile::tempdir().unwrap();
    copy(Path::new(&root("examples")), &dir.path().join("examples"));
    let mut result = String::new();
    let mut wrong = Vec::new();
    let mut rest = text.as_str();
    let mut commands = 0;
    while let Some(at) = rest.find("```console\n") {
        let begin = at + "```console\n".len();
        let end = begin + rest[begin..].find("```").expect("a block ends");
        result.push_str(&rest[..begin]);
        for step in steps(&rest[begin..end]) {
            commands += 1;
            let printed = run(&dir, &step.command);
            if !same(&step.printed, &printed) {
                let (wanted, found) = (step.printed.join("\n"), printed.join("\n"));
                wrong.push(format!(
                    "$ {}\n-- in {path}:\n{wanted}\n-- printed:\n{found}\n",
                    step.command
                ));
            }
            let lines = [vec![format!("$ {}", step.command)], printed].concat();
            result.push_str(&(lines.join("\n") + "\n"));
        }
        rest = &rest[end..];
    }
    result.push_str(rest);
    assert!(commands > 0, "{path} has no command");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(root(path), result).unwrap();
    } else {
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }
}

fn steps(block: &str) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    for line in block.lines() {
        match (line.strip_prefix("$ "), steps.last_mut()) {
            (Some(command), _) => {
                steps.push(Step { command: command.to_owned(), printed: Vec::new() });
            }
            (None, Some(step)) => step.printed.push(line.to_owned()),
            (None, None) => panic!("a block of the kind console begins with `$ `: {line}"),
        }
    }
    steps
}

/// The lines that the command prints on both streams.
fn run(dir: &TempDir, command: &str) -> Vec<String> {
    let binary = assert_cmd::cargo::cargo_bin("mist");
    let folder = binary.parent().unwrap().to_string_lossy().into_owned();
    let path = format!("{folder}:{}", std::env::var("PATH").unwrap_or_default());
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("{command} 2>&1")]).current_dir(dir).env("PATH", path);
    let output = shell.output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{command}: {text}");
    text.lines().map(|line| line.trim_end().to_owned()).collect()
}

fn same(wanted: &[String], printed: &[String]) -> bool {
    let words = |line: &String| -> Vec<String> {
        line.split([' ', '\t', ',']).filter(|w| !w.is_empty()).map(str::to_owned).collect()
    };
    let words = |lines: &[String]| -> Vec<Vec<String>> { lines.iter().map(words).collect() };
    let (wanted, printed) = (words(wanted), words(printed));
    wanted.len() == printed.len()
        && wanted.iter().zip(&printed).all(|(a, b)| {
            let pairs = a.iter().zip(b).enumerate();
            a.len() == b.len() && pairs.into_iter().all(|(at, (x, y))| same_word((a, at), x, y))
        })
}

/// True if two words of the line `line` say the same; seconds are not compared.
fn same_word((line, at): (&[String], usize), x: &str, y: &str) -> bool {
    if line.get(at + 1).is_some_and(|next| next == "s") {
        return true;
    }
    match (x.parse::<f64>(), y.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= SAME * a.abs().max(b.abs()).max(1e-9),
        _ => x == y,
    }
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().flatten() {
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).unwrap();
        }
    }
}

#[test]
fn the_commands_of_the_readme_print_what_it_says() {
    walk("README.md");
}

#[test]
fn the_commands_of_the_tutorial_print_what_it_says() {
    walk("docs/tutorial.md");
}

#[test]
fn the_commands_of_the_guides_print_what_they_say() {
    let guides = fs::read_dir(root("docs/guides")).unwrap().flatten();
    let names = guides.map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.for_each(|name| walk(&format!("docs/guides/{name}")));
}
