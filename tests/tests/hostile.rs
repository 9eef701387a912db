//! Texts of excessive size are refused with a place and a reason.

use std::sync::Arc;

use mist_engine::{MemoryFiles, Options, compile};
use mist_format::{Diagnostic, Dialect, program};

/// A program with the expression `value`.
fn text(value: &str) -> String {
    format!(
        "MODEL = Lambertian_BRDF_Model\nVARIABLES:\n a = 1  x = {value}\n incidentangle = 0.5  \
         incidentpol = (1,0,0,0)  rotation = 0  differential = 0.01  minsamples = 1\nEND\n\
         VARY: END\nINTEGRALS: R = DIFFERENTIAL CENTER=(0.1,0) END END\n\
         OUTPUTS: 1 R*a END\nFILES: END\n"
    )
}

fn refused(text: &str) -> Diagnostic {
    let files = Arc::new(MemoryFiles::default());
    let found = compile(text, files, &Options::default()).err().expect("it is refused");
    found.into_iter().next().expect("with a reason")
}

#[test]
fn two_hundred_thousand_parentheses_are_refused_with_a_place() {
    let many = 200_000;
    let nested = format!("{}1{}", "(".repeat(many), ")".repeat(many));
    let found = refused(&text(&nested));
    assert_eq!(found.code, "expr/too-long");
    assert_eq!(found.span.of(&text(&nested)), "(");
    for open in ["(", "-", "sin(", "a("] {
        let found = refused(&text(&open.repeat(many)));
        assert!(found.help.is_some(), "{found:?}");
    }
}

#[test]
fn a_program_of_a_hundred_megabytes_is_refused() {
    let line = " variable = 1 ; a comment\n";
    let long = format!("MODEL = M\nVARIABLES:\n{}", line.repeat(100_000_000 / line.len()));
    for dialect in [Dialect::Sound, Dialect::Compat] {
        let found = program::parse(&long, dialect).unwrap_err();
        assert_eq!(found[0].code, "program/too-long");
    }
}

#[test]
fn the_longest_program_is_read_and_printed() {
    let head = text("1");
    let (before, behind) = head.split_at(head.find(" a = 1").unwrap());
    let line = " variable = 1\n";
    let room = program::MAX_PROGRAM_BYTES - head.len();
    let long = format!("{before}{}{behind}", line.repeat(room / line.len()));
    let read = program::parse(&long, Dialect::Sound).unwrap();
    assert!(read.variables.len() > 1_000_000);
}
