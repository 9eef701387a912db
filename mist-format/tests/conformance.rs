//! The conformance programs: what NIST's program runs is read, what it refuses or never
//! finishes reading is refused in the right line.

use mist_format::expr::{Expr, OperandStack, Scope};
use mist_format::program::{Program, VariableKind};
use mist_format::{Dialect, LineIndex, program};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Programs that are wrong as texts, with the line (from 1) that is to blame.
const REFUSED: &[(&str, usize)] = &[
    ("v_err_blank_in_vector", 5),
    ("v_err_bom", 1),
    ("v_err_eof_in_assignment", 9),
    ("v_err_files_basis", 23),
    ("v_err_files_keyword", 23),
    ("v_err_integral_missing_end", 15),
    ("v_err_integral_name", 15),
    ("v_err_integral_parameter", 14),
    ("v_err_integral_shape", 14),
    ("v_err_missing_incidentpol", 9),
    ("v_err_missing_required", 9),
    ("v_err_model_cue_typo", 1),
    ("v_err_no_model", 1),
    ("v_err_output_number", 21),
    ("v_err_parentheses", 5),
    ("v_err_required_case", 7),
    ("v_err_section_colon", 2),
    ("v_err_section_missing", 11),
    ("v_err_section_order", 19),
    ("v_err_vary_by", 13),
    ("v_err_vary_keyword", 13),
    ("v_err_vary_unknown", 12),
    ("v_hang_comment_at_eof", 23),
    ("v_hang_empty_file", 1),
    ("v_hang_missing_end_outputs", 19),
    ("v_hang_missing_end_variables", 2),
    ("v_hang_missing_end_vary", 11),
    ("v_hang_open_quote", 5),
];

/// Every program with its name.
fn programs() -> Vec<(String, PathBuf)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/conformance/programs");
    let mut found = Vec::new();
    for folder in std::fs::read_dir(root).expect("the conformance programs are there").flatten() {
        let name = folder.file_name().to_string_lossy().into_owned();
        let file = folder.path().join(format!("{name}.mist"));
        if file.exists() {
            found.push((name, file));
        }
    }
    found.sort();
    found
}

fn text_of(name: &str) -> String {
    let found = programs().into_iter().find(|program| program.0 == name);
    std::fs::read_to_string(found.expect("the program is there").1).unwrap()
}

/// Every expression of a program.
fn expressions(program: &Program) -> Vec<&program::SourceText> {
    let variables = program.variables.iter().filter(|v| v.kind != VariableKind::Literal);
    let parameters = program.integrals.iter().flat_map(|integral| &integral.parameters);
    let outputs = program.outputs.iter().map(|output| &output.expression);
    variables.map(|v| &v.value).chain(parameters.map(|p| &p.value)).chain(outputs).collect()
}

#[test]
fn programs_that_nist_runs_are_read() {
    let mut count = 0;
    for (name, file) in programs() {
        if name.starts_with("v_err_") || name.starts_with("v_hang_") {
            continue;
        }
        let text = std::fs::read_to_string(&file).unwrap();
        let read = program::parse(&text, Dialect::Compat);
        let program = read.unwrap_or_else(|found| panic!("{name}: {found:?}"));
        for expression in expressions(&program) {
            let compiled = Expr::compile(expression.as_str(), Dialect::Compat);
            assert!(compiled.is_ok(), "{name}: {expression}: {:?}", compiled.err());
        }
        count += 1;
    }
    assert!(count > 150, "only {count} programs");
}

#[test]
fn only_the_programs_about_odd_readings_are_refused_by_the_sound_dialect() {
    for (name, file) in programs() {
        if name.starts_with("v_err_") || name.starts_with("v_hang_") || name == "v_lang_lexing" {
            continue;
        }
        let text = std::fs::read_to_string(&file).unwrap();
        let read = program::parse(&text, Dialect::Sound);
        assert!(read.is_ok(), "{name}: {:?}", read.err());
    }
}

#[test]
fn programs_that_are_wrong_as_texts_are_refused_in_the_right_line() {
    for (name, line) in REFUSED {
        let text = text_of(name);
        for dialect in [Dialect::Compat, Dialect::Sound] {
            let found = program::parse(&text, dialect).expect_err(name);
            let place = LineIndex::new(&text).line(found[0].span.start);
            assert_eq!(place, *line, "{name}: {found:?}");
            assert!(found[0].help.is_some(), "{name} says what to write");
        }
    }
}

#[test]
fn odd_readings_are_explained_by_the_sound_dialect() {
    let text = text_of("v_lang_lexing");
    let found = program::parse(&text, Dialect::Sound).unwrap_err();
    let codes: Vec<_> = found.iter().map(|diagnostic| diagnostic.code).collect();
    let expected = [
        "program/equals-before-name",
        "program/junk-before-equals",
        "program/number",
        "program/comment-in-quotes",
    ];
    for code in expected {
        assert!(codes.contains(&code), "{code} is not among {codes:?}");
    }
}

/// Programs without loops and integrals: their outputs are what the evaluator makes of them.
const EXPRESSIONS: &[&str] = &[
    "v_lang_precedence",
    "v_lang_unary",
    "v_lang_whitespace",
    "v_lang_functions",
    "v_lang_vectors",
    "v_lang_nan_inf",
    "v_lang_boolean",
];

/// The values of all names an expression reads.
struct Values<'v>(Vec<Option<&'v Vec<f64>>>);

impl Scope for Values<'_> {
    fn variable(&self, slot: u32) -> Option<&[f64]> {
        self.0.get(slot as usize)?.map(Vec::as_slice)
    }
}

fn evaluate(text: &str, known: &HashMap<String, Vec<f64>>) -> Vec<f64> {
    let expr = Expr::compile(text, Dialect::Compat).unwrap_or_else(|e| panic!("{text}: {e}"));
    let mut scope = Values(expr.names().iter().map(|name| known.get(name)).collect());
    let value = expr.eval(&mut scope, &mut OperandStack::default());
    value.unwrap_or_else(|e| panic!("{text}: {e}")).as_slice().to_vec()
}

#[test]
fn expressions_have_nists_values() {
    let mut count = 0;
    for name in EXPRESSIONS {
        let program = program::parse(&text_of(name), Dialect::Compat).expect(name);
        let mut known = HashMap::new();
        for variable in program.variables.iter().filter(|v| v.kind != VariableKind::Literal) {
            let value = evaluate(variable.value.as_str(), &known);
            known.insert(variable.name.to_string(), value);
        }
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/conformance/programs");
        let table = root.join(name).join("expected").join(format!("{name}.dat"));
        let table = std::fs::read_to_string(table).expect(name);
        let expected: Vec<f64> = table
            .lines()
            .nth(1)
            .unwrap()
            .split('\t')
            .filter_map(|t| t.trim().parse().ok())
            .collect();
        assert_eq!(expected.len(), program.outputs.len(), "{name}");
        for (output, nist) in program.outputs.iter().zip(expected) {
            let value = evaluate(output.expression.as_str(), &known);
            let ours = *value.last().unwrap();
            known.insert(output.label.to_string(), value);
            // Ten printed digits in the shortest of the tables, seventeen in the others.
            let same = (ours - nist).abs() <= 1e-9 * nist.abs() || ours == nist;
            assert!(same || (ours.is_nan() && nist.is_nan()), "{name} {output:?}: {ours} {nist}");
            count += 1;
        }
    }
    assert!(count > 150, "only {count} outputs");
}
