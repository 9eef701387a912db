//! The readers printed in `docs/formats/mtab.md` read the tables we write.

use std::{fs, path::Path, process::Command};

const DOCUMENT: &str = include_str!("../../docs/formats/mtab.md");
const TABLE: &str = include_str!("data/orange_paint.mtab");

/// The text of the first code block in `language`.
fn block(language: &str) -> &'static str {
    let (_, rest) = DOCUMENT.split_once(&format!("```{language}\n")).unwrap();
    rest.split_once("```").unwrap().0
}

/// A folder with the whole table and a table cut after its second row.
fn tables() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("paint.mtab"), TABLE).unwrap();
    let cut: String = TABLE.split_inclusive('\n').take(18).collect();
    fs::write(dir.path().join("cut.mtab"), cut).unwrap();
    dir
}

/// Output of a command that must succeed; `None`, with the reason on stderr, where the tool is
/// not installed. In continuous integration (`CI` is set) it must be.
#[expect(clippy::print_stderr, reason = "a test that could not be made says so")]
fn run(tool: &str, args: &[&str], dir: &Path) -> Option<String> {
    match Command::new(tool).args(args).current_dir(dir).output() {
        Ok(output) => {
            let errors = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{tool} {args:?}: {errors}");
            Some(String::from_utf8(output.stdout).unwrap())
        }
        Err(error) => {
            assert!(std::env::var_os("CI").is_none(), "{tool} belongs to the tests: {error}");
            eprintln!("not tested, {tool} cannot be started: {error}");
            None
        }
    }
}

#[test]
fn the_document_shows_the_table_of_the_tests() {
    assert!(DOCUMENT.contains(TABLE));
}

#[test]
fn the_reader_in_python_reads_the_table_and_refuses_a_cut_one() {
    let dir = tables();
    let main = "
print(*(row['I'] for row in read_mtab('paint.mtab')))
try:
    read_mtab('cut.mtab')
except ValueError:
    print('refused')
";
    let script = format!("{}{main}", block("python"));
    if let Some(out) = run("python3", &["-c", &script], dir.path()) {
        assert_eq!(out, "0.265840164 0.300732752 0.0668403239 0.0697341296\nrefused\n");
    }
}

#[test]
fn the_reader_in_c_reads_the_table_and_refuses_a_cut_one() {
    let dir = tables();
    let main = r#"
int main(void) {
    double rows[4 * 17];
    long count = read_mtab(fopen("paint.mtab", "r"), 17, rows, 4);
    printf("%ld %.9g %.9g\n", count, rows[7], rows[3 * 17 + 7]);
    printf("%ld\n", read_mtab(fopen("cut.mtab", "r"), 17, rows, 4));
    printf("%ld\n", read_mtab(fopen("paint.mtab", "r"), 17, rows, 3));
    return 0;
}
"#;
    fs::write(dir.path().join("reader.c"), format!("{}{main}", block("c"))).unwrap();
    let args = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-o", "reader", "reader.c"];
    if run("cc", &args, dir.path()).is_some() {
        let reader = dir.path().join("reader");
        let out = run(reader.to_str().unwrap(), &[], dir.path()).unwrap();
        assert_eq!(out, "4 0.265840164 0.0697341296\n-1\n-1\n");
    }
}
