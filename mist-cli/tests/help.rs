//! Help, completions, manual pages, and the search for models.

use assert_cmd::Command;

/// Exit code and standard output, or standard error if that is empty.
fn mist(words: &[&str]) -> (i32, String) {
    let output = Command::cargo_bin("mist").unwrap().args(words).output().unwrap();
    let said = if output.stdout.is_empty() { output.stderr } else { output.stdout };
    (output.status.code().unwrap(), String::from_utf8(said).unwrap())
}

#[test]
fn help_describes_commands_and_topics() {
    let (status, all) = mist(&["help"]);
    assert_eq!(status, 0);
    let topics = all.split("Topics:\n").nth(1).unwrap();
    let names: Vec<&str> =
        topics.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert!(names.len() >= 12, "{names:?}");
    for name in names {
        let (status, text) = mist(&["help", name]);
        assert_eq!(status, 0, "{name}");
        assert!(text.lines().count() > 5, "{name}: {text}");
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{name}");
    }
    assert_eq!(mist(&["help", "run"]).1.trim_end(), mist(&["run", "--help"]).1.trim_end());
    let (status, told) = mist(&["help", "unit"]);
    assert_eq!(status, 2);
    assert!(told.contains("units"), "{told}");
}

#[test]
fn the_program_of_the_topic_runs() {
    let (_, text) = mist(&["help", "programs"]);
    let dir = tempfile::tempdir().unwrap();
    let (start, end) = (text.find("MODEL").unwrap(), text.find("After FILES").unwrap());
    std::fs::write(dir.path().join("a.mist"), &text[start..end]).unwrap();
    let run =
        Command::cargo_bin("mist").unwrap().current_dir(&dir).args(["run", "a.mist"]).output();
    let run = run.unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let table = std::fs::read_to_string(dir.path().join("a.dat")).unwrap();
    assert_eq!(table.lines().count(), 4, "{table}");
}

#[test]
fn every_shell_has_completions() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let (status, script) = mist(&["completions", shell]);
        assert_eq!(status, 0, "{shell}");
        assert!(script.contains("compare-spectra"), "{shell}");
    }
}

#[test]
fn every_command_has_a_manual_page() {
    let dir = tempfile::tempdir().unwrap();
    let (status, said) = mist(&["man", dir.path().to_str().unwrap()]);
    assert_eq!(status, 0, "{said}");
    for name in ["mist.1", "mist-run.1", "mist-compare-spectra.1"] {
        let page = std::fs::read_to_string(dir.path().join(name)).unwrap();
        assert!(page.contains(".SH SYNOPSIS"), "{name}");
    }
}

#[test]
fn models_are_found_by_the_words_of_users() {
    let (status, said) = mist(&["models", "--search", "metallic", "paint"]);
    assert_eq!(status, 0);
    assert!(said.starts_with("Pigmented_Coating_BRDF_Model"), "{said}");
    let (status, told) = mist(&["models", "--search", "xyzzy"]);
    assert_eq!(status, 2);
    assert!(told.contains("no model fits"), "{told}");
}
