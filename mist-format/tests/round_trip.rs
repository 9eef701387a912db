//! Printing and reading again; nothing that is read makes the reader panic.

mod laws;

use mist_format::{Dialect, program};
use proptest::prelude::*;
use std::path::Path;

#[test]
fn the_conformance_programs_are_printed_and_read_again() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/conformance/programs");
    for folder in std::fs::read_dir(root).unwrap().flatten() {
        for file in std::fs::read_dir(folder.path()).into_iter().flatten().flatten() {
            if file.path().extension().is_some_and(|ext| ext == "mist") {
                let text = std::fs::read_to_string(file.path()).unwrap();
                laws::program(&text);
            }
        }
    }
}

#[test]
fn the_layout_is_one_entry_per_line() {
    let messy = "model=M ; the model\n; about\nvariables: minsamples=1 differential=1 \
                 incidentangle=0 incidentpol=(1,0,0,0)\n\n\n rotation=\"0 + 0\" ; last\nend\nvary: \
                 for rotation from 0 to 1 by 1 list f end integrals: R=circle alpha = 1 end end\n\
                 outputs: 1 \"a b=R\" 2 R end files:\n; nothing\nend behind the end\n";
    let printed = program::parse(messy, Dialect::Sound).unwrap().to_string();
    let expected = "\
MODEL = M ; the model

; about
VARIABLES:
    minsamples = 1
    differential = 1
    incidentangle = 0
    incidentpol = (1,0,0,0)

    rotation = \"0 + 0\" ; last
END

VARY:
    FOR rotation FROM 0 TO 1 BY 1
    LIST f
END

INTEGRALS:
    R = circle
        alpha = 1
    END
END

OUTPUTS:
    1 \"a b=R\"
    2 R
END

FILES:
    ; nothing
END behind the end
";
    assert_eq!(printed, expected);
}

/// Pieces that programs are made of, also in wrong places.
fn piece() -> impl Strategy<Value = String> {
    let fixed = prop::sample::select(vec![
        "=", " ", "\n", "\r\n", ";", "\"", "END", "(", ")", ",", "1", "x", "$p", "#q", "-", "é",
        "VARY:", "FOR", "FROM", "TO", "BY", "LIST", "CIRCLE", "ALPHA", "; c\n", "COLOR:",
        "\u{feff}",
    ]);
    prop_oneof![fixed.prop_map(str::to_owned), "[ -~]{0,6}"]
}

fn soup() -> impl Strategy<Value = String> {
    prop::collection::vec(piece(), 0..60).prop_map(|pieces| pieces.concat())
}

/// A program whose sections hold a mixture of sensible and odd entries.
fn likely_program() -> impl Strategy<Value = String> {
    let blank = prop::sample::select(vec![" ", "\n", "\n\n", " ; note\n", "\n  ; own\n", "\t"]);
    let value = prop::sample::select(vec!["1", "(1,2)", "\"a + b\"", "\"\"", "\"x;y\nz\"", "x=y"]);
    let entry = (prop::sample::select(vec!["a", "#b", "$c", "junk d"]), value, blank.clone())
        .prop_map(|(name, value, blank)| format!("{name} ={value}{blank}"));
    let entries = prop::collection::vec(entry, 0..6).prop_map(|entries| entries.concat());
    (entries, blank.clone(), blank.clone(), blank, soup()).prop_map(|(entries, a, b, c, end)| {
        format!(
            "MODEL = M{a}VARIABLES:{b}minsamples=1 differential=1 incidentangle=0 rotation=0{c}\
             incidentpol=1{a}{entries}\nEND{b}VARY:{c}FOR rotation{a}FROM 0 TO 1 BY \"1 + 1\"{b}END\n\
             INTEGRALS:{c}R={a}HEMI{b}INPOL=1{c}END{a}END{b}OUTPUTS:{c}1{a}\"l=R + 1\"{b}2 R{c}END\n\
             FILES:{a}header=\"h\"{b}END{c}COLOR:{a}table = t{b}END{end}"
        )
    })
}

proptest! {
    #[test]
    fn likely_programs_are_printed_and_read_again(text in likely_program()) {
        laws::program(&text);
    }

    #[test]
    fn reading_never_panics(text in soup()) {
        laws::program(&text);
        laws::program(&format!("MODEL=m VARIABLES: {text}"));
        laws::expression(&text);
        laws::table(&text);
        laws::optics(&text);
        laws::stack(&text);
        laws::archive(text.as_bytes());
    }

    #[test]
    fn what_the_sound_dialect_computes_nist_computes_alike(text in "[-+*/^()1x,. 2e&<]{0,16}") {
        laws::expression(&text);
    }
}

#[test]
fn what_fuzzing_found_keeps_to_the_laws() {
    laws::optics("g+1)!18446744073709551615");
    laws::optics("gold.txt!18446744073709551615");
    laws::stack("(1.446,0 .002");
    laws::stack("(1.446,0) .002 (1.5 .1");
    laws::table("zz\n1\n");
}
