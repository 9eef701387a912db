//! Programs with one thing that is probably not meant each.

use std::{collections::BTreeMap, sync::Arc};

use mist_format::{Diagnostic, LineIndex};

use crate::{MemoryFiles, Options, compile};

/// A program without a reason for advice, with `{…}` where something may be put.
fn program(changes: &[(&str, &str)]) -> String {
    let mut text = "\
MODEL = Microroughness_BRDF_Model
VARIABLES:
  deg = atan(1)/45
  theta = 30
  more = 1
  #lambda = 0.5
  incidentangle = theta*deg  incidentpol = (1,0,0,0)  rotation = 0
  differential = 1e-3  minsamples = 100
END
VARY: END
INTEGRALS:
  R = CIRCLE  CENTER = (theta*deg,0)  ALPHA = 10*deg  END
END
OUTPUTS:
  1 R*more
END
FILES: END
"
    .to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    text
}

fn advice(text: &str) -> Vec<Diagnostic> {
    let rows = ("rows".to_owned(), Arc::from("theta\n10\n60\n"));
    let files = Arc::new(MemoryFiles(BTreeMap::from([rows])));
    compile(text, files, &Options::default()).unwrap().advice()
}

/// Warnings as code, line and text at the place.
fn told(changes: &[(&str, &str)]) -> Vec<(&'static str, usize, String)> {
    let text = program(changes);
    let lines = LineIndex::new(&text);
    let told = |found: Diagnostic| {
        assert!(found.help.is_some(), "{found:?}");
        (found.code, lines.line(found.span.start), found.span.of(&text).to_owned())
    };
    advice(&text).into_iter().map(told).collect()
}

fn one(code: &'static str, line: usize, text: &str) -> Vec<(&'static str, usize, String)> {
    vec![(code, line, text.to_owned())]
}

#[test]
fn a_program_that_is_right_gets_no_advice() {
    assert_eq!(told(&[]), []);
    let loops = "VARY: FOR theta FROM 0 TO 85 BY 5 FOR #lambda FROM 0.4 TO 0.7 BY 0.1 END";
    assert_eq!(told(&[("VARY: END", loops)]), []);
    assert_eq!(told(&[("VARY: END", "VARY: LIST rows END")]), []);
    assert_eq!(told(&[("#lambda = 0.5", "wl = 500 #lambda = wl/1000")]), []);
    let own = ("deg = atan(1)/45", "deg = 0.0174533");
    assert_eq!(told(&[own, ("ALPHA = 10*deg", "ALPHA = 0.17")]), []);
}

#[test]
fn unused_variables_are_told_with_what_may_be_meant() {
    assert_eq!(told(&[("1 R*more", "1 R")]), one("program/unused-variable", 5, "more"));
    let text = program(&[("more = 1", "lambda = 1"), ("R*more", "R")]);
    assert_eq!(
        advice(&text)[0].help.as_deref(),
        Some("write `#lambda` to set the model's parameter lambda")
    );
    let text = program(&[("more = 1", "intergrationmode = 1"), ("R*more", "R")]);
    assert_eq!(advice(&text)[0].help.as_deref(), Some("did you mean `integrationmode`?"));
}

#[test]
fn a_variable_that_reads_only_itself_is_unused() {
    let found = told(&[("more = 1", "more = 1 more = more+1"), ("R*more", "R")]);
    assert_eq!(found, one("program/unused-variable", 5, "more"));
}

#[test]
fn a_variable_that_only_a_loop_a_list_or_an_aperture_reads_is_used() {
    for reader in [
        ("VARY: END", "VARY: FOR theta FROM 0 TO more BY 1 END"),
        ("ALPHA = 10*deg", "ALPHA = 10*deg*more"),
    ] {
        assert_eq!(told(&[("R*more", "R"), reader]), [], "{reader:?}");
    }
    assert_eq!(told(&[("R*more", "R"), ("VARY: END", "VARY: FOR more FROM 1 TO 2 BY 1 END")]), []);
}

#[test]
fn angles_that_look_like_degrees_are_told_at_their_literal() {
    let cases = [
        ("incidentangle = theta*deg", "incidentangle = 30", 7, "30"),
        ("incidentangle = theta*deg", "incidentangle = theta", 4, "30"),
        ("incidentangle = theta*deg", "incidentangle = -45", 7, "-45"),
        ("rotation = 0", "rotation = 90", 7, "90"),
        ("CENTER = (theta*deg,0)", "CENTER = (30,0)", 12, "30"),
        ("CENTER = (theta*deg,0)", "CENTER = (theta*deg,180)", 12, "180"),
        ("ALPHA = 10*deg", "ALPHA = 5+5", 12, "5+5"),
        ("R*more", "R*cos(60)*more", 15, "60"),
        ("R*more", "R*cos(theta)*more", 15, "theta"),
    ];
    for (from, to, line, literal) in cases {
        assert_eq!(told(&[(from, to)]), one("angle/degrees", line, literal), "{to}");
    }
}

#[test]
fn a_loop_over_degrees_is_told_at_its_bound() {
    let direct = ("incidentangle = theta*deg", "incidentangle = theta");
    let found = told(&[direct, ("VARY: END", "VARY: FOR theta FROM 0 TO 80 BY 10 END")]);
    assert_eq!(found, one("angle/degrees", 10, "80"));
    let found = told(&[direct, ("VARY: END", "VARY: LIST rows END")]);
    assert_eq!(found, one("angle/degrees", 10, "rows"));
}

#[test]
fn a_loop_over_the_angle_itself_is_told_at_its_bound_whatever_the_entry_says() {
    let found = told(&[("VARY: END", "VARY: FOR incidentangle FROM 0 TO 80 BY 10 END")]);
    assert_eq!(found, one("angle/degrees", 10, "80"));
}

#[test]
fn degrees_that_are_multiplied_twice_are_told() {
    let found = told(&[("R*more", "R*cosd(theta*deg)*more")]);
    assert_eq!(found, one("angle/radians", 15, "theta"));
}

#[test]
fn wavelengths_that_look_like_nanometres_are_told_at_their_literal() {
    assert_eq!(told(&[("= 0.5", "= 500")]), one("wavelength/nanometres", 6, "500"));
    let found = told(&[("#lambda = 0.5", "wl = 532 #lambda = wl")]);
    assert_eq!(found, one("wavelength/nanometres", 6, "532"));
    let found = told(&[("VARY: END", "VARY: FOR #lambda FROM 400 TO 700 BY 100 END")]);
    assert_eq!(found, one("wavelength/nanometres", 10, "700"));
}

#[test]
fn apertures_far_from_differential_are_told() {
    let few = [("differential = 1e-3", "differential = 1"), ("minsamples = 100", "minsamples = 1")];
    assert_eq!(told(&few), []);
    let grid = ("rotation = 0", "rotation = 0 integrationmode = 2");
    assert_eq!(told(&[grid, few[0], few[1]]), one("sampling/few", 12, "R"));
    for settings in [&[grid][..], &[]] {
        let empty = [settings, &[("ALPHA = 10*deg", "ALPHA = 0")]].concat();
        assert_eq!(told(&empty), one("sampling/few", 12, "R"));
    }
    let fine = told(&[grid, ("differential = 1e-3", "differential = 1e-8")]);
    assert_eq!(fine, one("sampling/many", 12, "R"));
    let refused = told(&[grid, ("differential = 1e-3", "differential = 1e-10")]);
    assert_eq!(refused, one("sampling/too-many", 12, "R"));
    let long = told(&[
        grid,
        ("differential = 1e-3", "differential = 1e-7"),
        ("VARY: END", "VARY: FOR more FROM 1 TO 20000 BY 1 END"),
    ]);
    assert_eq!(long, one("sampling/long-run", 8, "1e-7"));
}

#[test]
fn what_a_run_would_refuse_is_an_error() {
    let cases = [
        ("#lambda = 0.5", "#lambde = 0.5", "model/unknown-parameter", "#lambde"),
        ("#lambda = 0.5", "#type = 7", "model/parameter", "7"),
        ("rotation = 0", "rotation = 0 integrationmode = 7", "integral/region", "7"),
        ("1 R*more", "1 R*more*nothere", "expr/unknown-name", "nothere"),
        ("VARY: END", "VARY: FOR theta FROM 1 TO 2 BY 0 END", "loop/endless", ""),
    ];
    for (from, to, code, text) in cases {
        let source = program(&[(from, to)]);
        let found = advice(&source);
        let error = found.iter().find(|found| found.is_error()).expect(to);
        assert_eq!(error.code, code, "{to}");
        assert!(text.is_empty() || error.span.of(&source) == text, "{error:?}");
    }
}

#[test]
fn corners_of_polygons_are_told_where_they_are_written() {
    let corners = "R = POLYGON VERTEX=(0.1,0) VERTEX=(1.6,1) VERTEX=(0.5,2) END";
    let text = program(&[("R = CIRCLE  CENTER = (theta*deg,0)  ALPHA = 10*deg  END", corners)]);
    let found = advice(&text);
    let error = found.iter().find(|found| found.is_error()).unwrap();
    assert_eq!(error.span.of(&text), "(1.6,1)");
    let warning = found.iter().find(|found| !found.is_error()).unwrap();
    assert_eq!((warning.code, warning.span.of(&text)), ("angle/degrees", "1.6"));
}
