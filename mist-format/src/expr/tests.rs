//! NIST's own results, and what the sound dialect refuses.
//!
//! The numbers behind `=>` were computed by NIST's MIST 4.22a.

use super::*;
use crate::dialect::Dialect;
use crate::dialect::TextDeviation;
use crate::table::TableError;
use std::collections::HashMap;

/// Variables by name; the table `t.txt` is x ↦ 2x in every column.
struct Names(Vec<Vec<f64>>);

impl Scope for Names {
    fn variable(&self, slot: u32) -> Option<&[f64]> {
        self.0.get(slot as usize).map(Vec::as_slice).filter(|value| !value.is_empty())
    }

    fn table(&mut self, file: &str, x: f64, column: i64) -> Result<f64, TableError> {
        match (file, column) {
            ("t.txt", 2) => Ok(2.0 * x),
            ("t.txt", _) => Err(TableError::MissingColumn { column, columns: Some(2) }),
            _ => Err(TableError::Unreadable { file: file.into(), reason: "none".into() }),
        }
    }
}

fn value(text: &str, dialect: Dialect) -> Result<Value, String> {
    let known: HashMap<&str, Vec<f64>> = HashMap::from([
        ("a", vec![8.0]),
        ("b", vec![7.5]),
        ("x", vec![2.9]),
        ("y", vec![2.5]),
        ("v", vec![5.4, 6.6, 3.5]),
        ("w", vec![3.9, 1.8]),
        ("#lambda", vec![0.5]),
        ("k.x_1", vec![1.0]),
        ("sin", vec![3.0]),
    ]);
    let expr = Expr::compile(text, dialect).map_err(|error| error.to_string())?;
    let values = expr.names().iter().map(|name| known.get(name.as_str()).cloned());
    let mut scope = Names(values.map(Option::unwrap_or_default).collect());
    expr.eval(&mut scope, &mut OperandStack::default()).map_err(|error| error.to_string())
}

fn number(text: &str) -> f64 {
    value(text, Dialect::Compat).unwrap_or_else(|error| panic!("{text}: {error}")).number()
}

fn assert_numbers(cases: &[(&str, f64)]) {
    for (text, expected) in cases {
        // Printed with 17 digits, computed with the same operations.
        assert!((number(text) - expected).abs() <= 1e-15 * expected.abs(), "{text}");
    }
}

fn assert_vectors(cases: &[(&str, &[f64])]) {
    for (text, expected) in cases {
        assert_eq!(value(text, Dialect::Compat).unwrap().as_slice(), *expected, "{text}");
    }
}

fn refusal(text: &str) -> Option<TextDeviation> {
    match Expr::compile(text, Dialect::Sound) {
        Err(ExprError { kind: ExprErrorKind::Refused { deviation }, .. }) => Some(deviation),
        _ => None,
    }
}

#[test]
fn precedence_is_nists() {
    assert_numbers(&[
        ("2^3^2", 64.0),
        ("1|0&0", 0.0),
        ("0&1|1", 1.0),
        ("1<2<3", 1.0),
        ("10/4*4", 10.0),
        ("1e2+1E-2+.5+5.", 105.51),
        ("2*a^-1", 0.25),
        ("7-2^2", 3.0),
        ("a=8", 1.0),
        ("(a+(b*(x+1)))", 37.25),
        ("1<1", 0.0),
        ("1>1", 0.0),
        ("-1&1", 1.0),
        ("0|0-2", 1.0),
    ]);
}

#[test]
fn signs_are_read_as_nist_reads_them() {
    assert_numbers(&[
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("2*-3^2", 18.0),
        ("0+-2^2", 4.0),
        ("1--x", 3.9),
        ("1-+x", -1.9),
        ("x*-y", -7.25),
        ("--2", 2.0),
        ("--x", -2.9),
        ("- -x", -2.9),
        ("+-x", 2.9),
        ("1-+-x", -1.9),
        ("1*--x", -2.9),
        ("1*--2", 2.0),
        ("-x-y", -5.4),
        ("-x*-y", 7.25),
        ("min(-x,-y)", -2.9),
        ("if(-1,-2,-3)", -2.0),
        ("max(-y^2,-9)", -6.25),
        ("max(-9,-y^2)", 6.25),
    ]);
}

#[test]
fn blanks_are_read_as_nist_reads_them() {
    assert_numbers(&[
        ("a + b", 15.5),
        (" a+b", 15.5),
        ("a  +  b", 15.5),
        ("a   + b", 15.5),
        ("a   - b", 0.5),
        ("a   * b", 60.0),
        ("a    + b", 7.5),
        ("a    - b", -7.5),
        ("2   + a", 8.0),
        ("(a)   - b", -7.5),
        ("sqrt(b)   - a", -8.0),
        (" -2^2", -4.0),
        ("  -2^2", 4.0),
        ("  -a", 8.0),
        ("a +   -b", 15.5),
        ("a+ -b", 0.5),
        ("a*   -2", -16.0),
        ("( a + b ) * 2", 31.0),
        ("max( a , b)", 8.0),
        ("abs (1)", 1.0),
        ("2 3", 3.0),
        ("2(3)", 3.0),
        ("2a", 8.0),
        ("a b", 7.5),
        ("1 2 3", 3.0),
        ("(a) (b)", 7.5),
        ("2 -3", -1.0),
        ("2   -3", -3.0),
        ("\ta+b", 15.5),
        ("a\n+b", 15.5),
        ("     a", 8.0),
        ("a ", 8.0),
        ("             0.4", 0.4),
    ]);
}

#[test]
fn vectors_are_computed_as_nist_computes_them() {
    assert_vectors(&[
        ("(1,2,3)", &[1.0, 2.0, 3.0]),
        ("1,2,3", &[1.0, 2.0, 3.0]),
        ("2*(1,2,3)", &[2.0, 2.0, 3.0]),
        ("(1,2)+(3,4)", &[4.0, 2.0, 4.0]),
        ("(1,2),(3,4)", &[1.0, 2.0, 4.0, 3.0]),
        ("1,2,(3,4)", &[1.0, 2.0, 4.0, 3.0]),
        ("((1,2),3)", &[1.0, 2.0, 3.0]),
        ("(0,-2^2)", &[0.0, 4.0]),
        ("-v", &[-5.4, 6.6, 3.5]),
        ("1,-v", &[1.0, -6.6, -3.5, -5.4]),
        ("1,-(2,3)", &[1.0, -3.0, -2.0]),
        ("w,w", &[3.9, 1.8, 1.8, 3.9]),
        ("(w),v", &[3.9, 1.8, 6.6, 3.5, 5.4]),
        ("max(w+0),1", &[3.9, 1.0]),
    ]);
    assert_numbers(&[("max(w)", 3.9), ("atan2(w)", 1.1383885512243588), ("if(v)", 6.6)]);
}

#[test]
fn names_may_be_parameters_have_dots_and_be_called_like_functions() {
    assert_numbers(&[("#lambda*2", 1.0), ("k.x_1+1", 2.0), ("sin", 3.0), ("a()", 8.0)]);
    assert_eq!(number("sin(0)"), 0.0);
    assert_eq!(number("@t.txt(3)"), 6.0);
    assert_eq!(number("@7(x)"), 7.0);
    let expr = Expr::compile("a+#b*a+@t.txt(c)+@t.txt(1)", Dialect::Sound).unwrap();
    assert_eq!(expr.names(), ["a", "#b", "c"]);
    assert_eq!(expr.files(), ["t.txt"]);
}

#[test]
fn what_nist_calls_invalid_is_invalid() {
    for text in [
        "", " ", "1e", "1e400", "---2", "1+2 ", "( 1 )", "(a  )", "()", "2*()", "5%3", "R+", "(1,",
        "(1+2", "1+2)", "a!", ",1", "1,,2", "*2", "µ", "1e400+2", "a    * b", "f(1", "\"",
    ] {
        for dialect in [Dialect::Compat, Dialect::Sound] {
            assert!(Expr::compile(text, dialect).is_err(), "{text}");
        }
    }
}

#[test]
fn unknown_names_and_wrong_arguments_are_errors_of_the_evaluation() {
    for text in ["nothing", "2*nothing", "$a", "sinc(1)", "atan2(1)", "abs(1,2)", "a(1)", "@t.txt"]
    {
        assert!(Expr::compile(text, Dialect::Sound).is_ok(), "{text}");
        assert!(value(text, Dialect::Compat).is_err(), "{text}");
    }
    assert!(value("@t.txt(1,2,3)", Dialect::Compat).is_err());
    assert!(value("@no.txt(1)", Dialect::Compat).is_err());
    assert!(value("@t.txt(1,3)", Dialect::Compat).is_err());
    assert!(value("3exp(1)", Dialect::Compat).unwrap_err().contains("`xp`"));
}

#[test]
fn the_sound_dialect_refuses_what_nist_misreads() {
    let cases = [
        ("2   + a", TextDeviation::OperatorLostToBlanks),
        ("a    - b", TextDeviation::OperatorLostToBlanks),
        ("2 3", TextDeviation::AdjacentOperands),
        ("2(3)", TextDeviation::AdjacentOperands),
        ("2a", TextDeviation::AdjacentOperands),
        ("(a) (b)", TextDeviation::AdjacentOperands),
        ("--x", TextDeviation::SignLost),
        ("+-x", TextDeviation::SignLost),
        ("  -a", TextDeviation::SignLost),
        ("a +   -b", TextDeviation::SignLost),
        ("  -2^2", TextDeviation::SignBindsToNumber),
        ("1e+x", TextDeviation::NumberJunk),
        ("3exp(1)", TextDeviation::NumberJunk),
    ];
    for (text, deviation) in cases {
        assert_eq!(refusal(text), Some(deviation), "{text}");
    }
    for text in ["2*(1,2,3)", "(1,2),(3,4)", "-v", "v+1", "w,w", "((1,2),3)"] {
        assert!(value(text, Dialect::Sound).is_err(), "{text}");
    }
}

#[test]
fn the_sound_dialect_computes_the_rest_alike() {
    for text in [
        "-2^2",
        "2*-3^2",
        "1--x",
        "--2",
        "2^3^2",
        "v",
        "(v)",
        "(1,-x,2*y)",
        "max(w)",
        "a  +  b",
        "             0.4",
        "            -0.4",
        "( a + b) * 2",
        "if(x>y,1,2)",
        "a ",
    ] {
        assert_eq!(value(text, Dialect::Sound), value(text, Dialect::Compat), "{text}");
    }
}

#[test]
fn the_library_skips_blanks_and_wants_operators() {
    let run = |text: &str| {
        let expr = Expr::compile_library(text).map_err(|error| error.to_string())?;
        let mut scope = Names(vec![vec![0.5]; expr.names().len()]);
        expr.eval(&mut scope, &mut OperandStack::default()).map_err(|error| error.to_string())
    };
    assert_eq!(run(" 1 / 4 ").unwrap().as_slice(), [0.25]);
    assert_eq!(run("- 2 ^ 2").unwrap().as_slice(), [-4.0]);
    assert_eq!(run("3*-2^2").unwrap().as_slice(), [12.0]);
    assert_eq!(run("( 1 , x )").unwrap().as_slice(), [1.0, 0.5]);
    assert_eq!(run("@t.txt(2)").unwrap().as_slice(), [4.0]);
    for text in ["2(3)", "2a", "1%2", "(1,2)*3", "gold.txt!4", "@t.txt(2,1)", ""] {
        assert!(run(text).is_err(), "{text}");
    }
    let error = Expr::compile_library(" 2 % 3").unwrap_err();
    assert_eq!(error.span.of(" 2 % 3"), "%");
}

#[test]
fn errors_point_at_the_text() {
    let place = |text: &str| {
        let error = Expr::compile(text, Dialect::Sound).unwrap_err();
        error.span.of(text).to_owned()
    };
    assert_eq!(place("2*(x + 1"), "(");
    assert_eq!(place("a+b)"), ")");
    assert_eq!(place("a    + b"), "+");
    assert_eq!(place("5%3"), "%");
    assert_eq!(place("1+1e400"), "1e400");
    assert_eq!(place("a+µ"), "µ");
    let text = "1+sinc(2)";
    let expr = Expr::compile(text, Dialect::Sound).unwrap();
    let error = expr.eval(&mut NoNames, &mut OperandStack::default()).unwrap_err();
    assert_eq!(error.span.of(text), "sinc(2)");
    assert!(error.diagnostic([]).help.unwrap().contains("sin"));
}

#[test]
fn hostile_input_is_refused_not_fatal() {
    let sum = vec!["1"; 200_000].join("+");
    for text in ["(".repeat(200_000), "-".repeat(200_000), "sin(".repeat(200_000), sum] {
        assert!(Expr::compile(&text, Dialect::Compat).is_err());
    }
    let deep = format!("{}1{}", "(".repeat(30_000), ")".repeat(30_000));
    assert_eq!(number(&deep), 1.0);
}

#[test]
fn a_scope_may_choose_its_own_slots() {
    let mut expr = Expr::compile("a-b", Dialect::Sound).unwrap();
    expr.bind(|name| if name == "a" { 1 } else { 0 });
    let mut scope = Names(vec![vec![1.0], vec![5.0]]);
    assert_eq!(expr.number(&mut scope, &mut OperandStack::default()).unwrap(), 4.0);
}

#[test]
fn short_programs_give_what_the_general_machine_gives() {
    let names = ["x", "y", "v", "missing"];
    let operands = [
        "2.5",
        "-3",
        "x",
        "-y",
        "(x-1)",
        "-(y*2)",
        "sin(x)",
        "-atan2(x,y)",
        "v",
        "if(x>y,x,-y)",
        "@t.txt(x)",
        "@t.txt(x,2)",
        "@t.txt(x,9)",
        "missing",
        "(1,x)",
        "max(v,1)",
        "sin((x,y))",
        "min(1)",
        "@3(x)",
    ];
    let mut short = 0;
    for a in operands {
        for b in operands {
            for op in ["+", "-", "*", "/", "^", "<", ">", "=", "&", "|", ",", " ", "  "] {
                for text in [format!("{a}{op}{b}"), format!("x*({a}{op}{b})^2-min({b},{a})")] {
                    let Ok(mut expr) = Expr::compile(&text, Dialect::Compat) else { continue };
                    expr.bind(|name| names.iter().position(|n| *n == name).unwrap_or(3) as u32);
                    let mut scope = Names(vec![vec![2.9], vec![2.5], vec![5.4, 6.6], vec![]]);
                    let mut stack = OperandStack::default();
                    let quick = expr.eval(&mut scope, &mut stack);
                    short += u32::from(expr.without_short_program());
                    let general = expr.eval(&mut scope, &mut stack);
                    let bits =
                        |value: Value| value.as_slice().iter().map(|x| x.to_bits()).collect();
                    let bits =
                        |result: Result<Value, EvalError>| result.map(|v| -> Vec<u64> { bits(v) });
                    assert_eq!(bits(quick), bits(general), "{text}");
                }
            }
        }
    }
    assert!(short > 2000, "{short}");
}
