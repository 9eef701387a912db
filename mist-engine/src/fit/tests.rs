//! Fits of a program whose answer is known.

use std::sync::Arc;

use std::collections::BTreeMap;

use super::*;
use crate::{MemoryFiles, Options};

/// y = a x + b + c·0, with products and a variable that does nothing to choose from.
const LINE: &str = "
    MODEL = Lambertian_BRDF_Model
    VARIABLES:
      incidentangle = 0   incidentpol = (1,0,0,0)   rotation = 0
      differential = 0.01   minsamples = 5
      x = 0   a = 1   b = 1   idle = 1   root = 0.5
    END
    VARY: FOR x FROM 1 TO 8 BY 1 END
    INTEGRALS: R = DIFFERENTIAL CENTER = (0,0) END END
    OUTPUTS:
      1 y=a*x+b
      2 product=a*b*x
      3 r=sqrt(root)*x
    END
    FILES: END
";

fn program(names: &[&str]) -> ProgramFunction {
    let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
    ProgramFunction::new(LINE, Arc::new(MemoryFiles::default()), Options::default(), &names)
        .unwrap()
}

/// A table of `output` over x, and what the fit of `names` to it says.
fn fitted(
    names: &[&str],
    output: &str,
    value: impl Fn(f64) -> f64,
    settings: &FitSettings,
) -> Result<Fit, FitError> {
    let program = program(names);
    let mut text = format!("x {output}\n");
    for x in 1..=8 {
        text += &format!("{x} {:?}\n", value(f64::from(x)));
    }
    let measured = MeasuredTable::parse(&text, program.titles(), program.headers()).unwrap();
    fit(&program, &measured, settings, &Control::default())
}

/// 3x − 2 with errors that sum to 0 over x and over the products with x.
fn noisy(x: f64) -> f64 {
    let errors = [1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0, 1.0];
    3.0 * x - 2.0 + 0.1 * errors[x as usize - 1]
}

#[test]
fn a_straight_line_has_the_errors_of_the_textbook() {
    let fit = fitted(&["a", "b"], "y", noisy, &FitSettings::default()).unwrap();
    let [a, b] = &fit.parameters[..] else { panic!("two variables") };
    // χ² = 8·0.01, ν = 6; Σ(x − x̄)² = 42, so s_a = s/√42 and s_b = s √(1/8 + 4.5²/42).
    let s = (0.08_f64 / 6.0).sqrt();
    let expected = [(3.0, s / 42_f64.sqrt()), (-2.0, s * (0.125_f64 + 4.5 * 4.5 / 42.0).sqrt())];
    for (found, (value, error)) in [a, b].into_iter().zip(expected) {
        // The minimum is reached to 1e-10 of χ², the derivatives are those of a straight line.
        assert!((found.value - value).abs() < 1e-6, "{found:?}");
        assert!((found.standard_error.unwrap() / error - 1.0).abs() < 1e-6, "{found:?} {error}");
        let half = found.interval.unwrap()[1] - found.value;
        // Student's t for six degrees of freedom.
        assert!((half / error - 2.4469).abs() < 1e-3, "{found:?}");
    }
    // −x̄/√(mean of x²).
    let correlation = -4.5 / (204.0_f64 / 8.0).sqrt();
    assert!((fit.correlation[0][1] - correlation).abs() < 1e-6, "{:?}", fit.correlation);
    assert!((fit.residuals.rms - 0.1).abs() < 1e-6 && fit.residuals.degrees_of_freedom == 6);
}

#[test]
fn known_uncertainties_do_not_ask_the_residuals() {
    let settings = FitSettings { absolute: true, ..FitSettings::default() };
    let fit = fitted(&["a", "b"], "y", noisy, &settings).unwrap();
    let error = fit.parameters[0].standard_error.unwrap();
    assert!((error * 42_f64.sqrt() - 1.0).abs() < 1e-6, "{error}");
}

#[test]
fn what_cannot_be_determined_is_told_with_what_takes_its_place() {
    let product = fitted(&["a", "b"], "product", |x| 6.0 * x, &FitSettings::default());
    let Err(FitError::NotIdentifiable { name, with }) = product else { panic!("{product:?}") };
    assert_eq!((name.as_str(), &with[..]), ("b", &["a".to_owned()][..]));
    let idle = fitted(&["a", "idle"], "y", noisy, &FitSettings::default());
    let Err(error @ FitError::NotIdentifiable { .. }) = idle else { panic!("{idle:?}") };
    assert!(error.to_string().contains("idle cannot be determined: nothing that was measured"));
}

#[test]
fn a_bound_is_kept_to_and_told() {
    let bounds = BTreeMap::from([("b".to_owned(), [-1.0, 5.0])]);
    let settings = FitSettings { bounds, ..FitSettings::default() };
    let fit = fitted(&["a", "b"], "y", noisy, &settings).unwrap();
    let b = &fit.parameters[1];
    assert!(b.at_bound && b.value == -1.0 && b.interval.is_none(), "{b:?}");
    assert!(fit.parameters[0].interval.is_some());
}

#[test]
fn values_that_the_program_does_not_take_are_stepped_around() {
    // √root from a start whose first step leads far below zero.
    let fit = fitted(&["root"], "r", |x| 0.02 * x, &FitSettings::default()).unwrap();
    assert!((fit.parameters[0].value / 4e-4 - 1.0).abs() < 1e-6, "{fit:?}");
}

#[test]
fn wrong_settings_and_too_few_data_are_refused() {
    let with = |change: fn(&mut FitSettings)| {
        let mut settings = FitSettings::default();
        change(&mut settings);
        fitted(&["a"], "y", noisy, &settings)
    };
    let refused: [fn(&mut FitSettings); 5] = [
        |s| s.step = 0.0,
        |s| s.confidence = 1.0,
        |s| s.iterations = 0,
        |s| _ = s.start.insert("b".into(), 1.0),
        |s| _ = s.bounds.insert("a".into(), [5.0, 6.0]),
    ];
    for change in refused {
        assert!(matches!(with(change), Err(FitError::Setting { .. })));
    }
    let program = program(&["a", "b"]);
    let few = MeasuredTable::parse("x y\n1 2\n2 3\n", program.titles(), &[]).unwrap();
    let few = fit(&program, &few, &FitSettings::default(), &Control::default());
    assert!(matches!(few, Err(FitError::TooFewData { data: 2, variables: 2 })));
}
