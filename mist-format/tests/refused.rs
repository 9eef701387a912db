//! Programs in `refused/` that the sound dialect refuses, each with the diagnostics beside it.
//!
//! `UPDATE_GOLDEN=1` rewrites the diagnostics.

use mist_format::{Dialect, LineIndex, program};
use std::fmt::Write as _;
use std::path::Path;

#[test]
fn refused_programs_are_explained_as_written_beside_them() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/refused");
    let mut count = 0;
    for file in std::fs::read_dir(folder).unwrap().flatten().map(|file| file.path()) {
        if file.extension().is_none_or(|extension| extension != "mist") {
            continue;
        }
        let text = std::fs::read_to_string(&file).unwrap();
        let found = program::parse(&text, Dialect::Sound).expect_err(&file.to_string_lossy());
        let lines = LineIndex::new(&text);
        let mut told = String::new();
        for diagnostic in found {
            let place = lines.location(&text, diagnostic.span.start);
            writeln!(told, "{}:{}: {diagnostic}", place.line, place.column).unwrap();
            writeln!(told, "  at: {}", diagnostic.span.of(&text).escape_debug()).unwrap();
            for note in diagnostic.notes {
                writeln!(told, "  note: {}", note.message).unwrap();
            }
            writeln!(told, "  help: {}", diagnostic.help.expect("there is help")).unwrap();
        }
        let golden = file.with_extension("txt");
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            std::fs::write(&golden, &told).unwrap();
        }
        let expected = std::fs::read_to_string(&golden).unwrap_or_default();
        assert_eq!(told, expected, "{}", file.display());
        count += 1;
    }
    assert!(count > 10, "only {count} programs");
}
