//! Reads what a program of the suite expects from the comments that begin with `;@` and `;|`.

use std::{collections::BTreeMap, sync::Arc};

use scattering::Mode;

/// A program with its data files and everything that its comments expect.
#[derive(Clone, Debug, Default)]
pub struct SuiteProgram {
    /// Text of the whole file.
    pub text: String,
    /// Data files by name.
    pub files: BTreeMap<String, Arc<str>>,
    /// Origin of the expected numbers.
    pub source: Option<String>,
    /// Expectations in the order of the file.
    pub expectations: Vec<Expectation>,
}

/// One expectation of a run.
#[derive(Clone, Debug)]
pub struct Expectation {
    /// Line of its instruction, from 1.
    pub line: usize,
    /// Modes in which it holds.
    pub modes: Vec<Mode>,
    /// The expected outcome.
    pub outcome: ExpectedOutcome,
}

/// The outcome that an instruction expects.
#[derive(Clone, Debug, PartialEq)]
pub enum ExpectedOutcome {
    /// The run gives a table.
    Results {
        /// Titles and rows, as in the comments.
        table: String,
        /// Largest difference relative to the larger number.
        relative: f64,
        /// Largest difference as a fraction of the largest number of the row.
        of_row: f64,
    },
    /// The program is refused, when it is compiled or in a step.
    Refused(ExpectedDiagnostic),
    /// `mist check` warns.
    Warns(ExpectedDiagnostic),
    /// A sound run reports this defect of NIST's library.
    Meets(String),
}

/// The diagnostic that an instruction expects.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpectedDiagnostic {
    /// Its code, such as `expr/unknown-name`.
    pub code: String,
    /// The text of the program at its place.
    pub place: Option<String>,
    /// Lines that message, help or notes contain.
    pub contains: Vec<String>,
}

/// Relative tolerance of results that name none: the last digits of a sum of products.
const DEFAULT_RELATIVE: f64 = 1e-12;

/// Reads a program of the suite.
///
/// # Errors
///
/// The number of the line that is not an instruction, and why.
pub fn read(text: &str) -> Result<SuiteProgram, String> {
    let mut program = SuiteProgram { text: text.to_owned(), ..SuiteProgram::default() };
    let mut lines = text.lines().enumerate().peekable();
    while let Some((index, line)) = lines.next() {
        let Some(instruction) = line.trim_start().strip_prefix(";@") else { continue };
        let mut body = Vec::new();
        while let Some(text) =
            lines.peek().and_then(|(_, line)| line.trim_start().strip_prefix(";|"))
        {
            body.push(text.strip_prefix(' ').unwrap_or(text));
            lines.next();
        }
        add(&mut program, index + 1, instruction.trim(), &body)
            .map_err(|why| format!("line {}: {why}", index + 1))?;
    }
    if program.expectations.is_empty() {
        return Err("no expectation: add a line such as `;@ both results`".into());
    }
    let has_numbers = |e: &Expectation| matches!(e.outcome, ExpectedOutcome::Results { .. });
    if program.source.is_none() && program.expectations.iter().any(has_numbers) {
        return Err("results need the origin of their numbers: `;@ source …`".into());
    }
    Ok(program)
}

fn add(program: &mut SuiteProgram, line: usize, text: &str, body: &[&str]) -> Result<(), String> {
    let (first, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    let rest = rest.trim();
    match first {
        "source" => program.source = Some(rest.to_owned()),
        "file" => {
            let text = body.iter().flat_map(|line| [*line, "\n"]).collect::<String>();
            program.files.insert(rest.to_owned(), text.into());
        }
        _ => {
            let modes = match first {
                "sound" => vec![Mode::Sound],
                "compat" => vec![Mode::Compat],
                "both" => vec![Mode::Sound, Mode::Compat],
                _ => return Err(format!("`{first}` is none of source, file, sound, compat, both")),
            };
            program.expectations.push(Expectation { line, modes, outcome: outcome(rest, body)? });
        }
    }
    Ok(())
}

fn outcome(text: &str, body: &[&str]) -> Result<ExpectedOutcome, String> {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    match word {
        "results" => {
            let number = |key: &str, default: f64| match value_after(rest, key) {
                None => Ok(default),
                Some(text) => text.parse::<f64>().map_err(|_| format!("`{text}` is not a number")),
            };
            let relative = number("within", DEFAULT_RELATIVE)?;
            let of_row = number("of-row", 0.0)?;
            Ok(ExpectedOutcome::Results { table: body.join("\n"), relative, of_row })
        }
        "refused" => Ok(ExpectedOutcome::Refused(diagnostic(rest, body))),
        "warns" => Ok(ExpectedOutcome::Warns(diagnostic(rest, body))),
        "meets" => Ok(ExpectedOutcome::Meets(rest.trim().to_owned())),
        _ => Err(format!("`{word}` is none of results, refused, warns, meets")),
    }
}

/// The word behind the word `key`.
fn value_after<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let mut words = text.split_whitespace();
    words.find(|word| *word == key)?;
    words.next()
}

fn diagnostic(text: &str, body: &[&str]) -> ExpectedDiagnostic {
    let (code, rest) = text.trim().split_once(char::is_whitespace).unwrap_or((text.trim(), ""));
    let place = rest.trim().strip_prefix("at ").map(|place| place.trim().trim_matches('`'));
    ExpectedDiagnostic {
        code: code.to_owned(),
        place: place.map(str::to_owned),
        contains: body.iter().map(|line| line.trim().to_owned()).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instructions_take_the_lines_below_them() {
        let text = "; about\n;@ source arithmetic\n;@ file a.txt\n;| 1 2\n;@ both results within 1e-9\n;| a\n;| 1\n";
        let program = read(text).unwrap();
        assert_eq!(&*program.files["a.txt"], "1 2\n");
        let want = ExpectedOutcome::Results { table: "a\n1".into(), relative: 1e-9, of_row: 0.0 };
        assert_eq!(program.expectations[0].outcome, want);
        assert_eq!(program.expectations[0].modes.len(), 2);
    }

    #[test]
    fn numbers_need_a_source_and_a_file_needs_an_expectation() {
        assert!(read(";@ both results\n;| a\n").unwrap_err().contains("source"));
        assert!(read("MODEL = X\n").is_err());
        assert!(read(";@ sometimes results\n").unwrap_err().starts_with("line 1"));
    }

    #[test]
    fn diagnostics_have_a_code_and_maybe_a_place() {
        let program = read(";@ sound refused model/value at `1 2`\n;| needs\n").unwrap();
        let ExpectedOutcome::Refused(expected) = &program.expectations[0].outcome else { panic!() };
        assert_eq!(
            (expected.code.as_str(), expected.place.as_deref()),
            ("model/value", Some("1 2"))
        );
        assert_eq!(expected.contains, ["needs"]);
    }
}
