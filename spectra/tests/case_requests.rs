//! Colour cases: accepted forms and refusals.

use proptest::prelude::*;
use serde_json::{Value, json};
use spectra::case::{CaseError, evaluate};

fn grey() -> Value {
    json!({
        "id": "grey",
        "wavelengths": [400.0, 500.0, 600.0, 700.0],
        "values": [0.5, 0.5, 0.5, 0.5],
        "illuminant": "D65",
        "rgb": [{ "space": "sRGB", "adaptation": "Bradford" }],
    })
}

fn with(field: &str, value: Value) -> Value {
    let mut case = grey();
    case[field] = value;
    case
}

fn refused(request: &Value) -> CaseError {
    evaluate(request).expect_err("the request is wrong")
}

#[test]
fn a_grey_case_has_equal_channels_equal_to_its_luminance() {
    let response = evaluate(&grey()).unwrap();
    let result = &response.results[0];
    assert!((result.xyz[1] - 0.5).abs() < 1e-15);
    for channel in result.rgb[0].linear {
        // The sum and two matrices.
        assert!((channel - 0.5).abs() < 2e-15);
    }
    assert_eq!(result.rgb[0].u8, [188; 3]);
}

#[test]
fn the_order_of_wavelengths_does_not_matter() {
    let case = |wavelengths: Value, values: Value| {
        let mut case = with("wavelengths", wavelengths);
        case["values"] = values;
        evaluate(&case).unwrap()
    };
    let up = case(json!([400, 500, 610, 700]), json!([0.1, 0.2, 0.3, 0.4]));
    let mixed = case(json!([610, 400, 700, 500]), json!([0.3, 0.1, 0.4, 0.2]));
    assert_eq!(up, mixed);
}

#[test]
fn without_a_list_every_space_and_adaptation_is_given() {
    let mut case = grey();
    case.as_object_mut().unwrap().remove("rgb");
    assert_eq!(evaluate(&case).unwrap().results[0].rgb.len(), 8 * 4);
    case["illuminant"] = Value::Null;
    let emission = evaluate(&case).unwrap();
    assert_eq!(emission.results[0].rgb.len(), 8);
    assert_eq!((emission.results[0].white_xyz, emission.results[0].lab), (None, None));
}

#[test]
fn pairs_may_be_written_short() {
    let short = evaluate(&with("rgb", json!([["sRGB", "Bradford"]]))).unwrap();
    assert_eq!(short, evaluate(&grey()).unwrap());
}

#[test]
fn filters_may_be_text_in_radians_or_objects_in_degrees() {
    let text = evaluate(&with("filters", json!(["linear(0)"]))).unwrap();
    let filter = json!([{ "type": "linear_polariser", "angle_deg": 0.0 }]);
    assert_eq!(text, evaluate(&with("filters", filter)).unwrap());
    assert!((text.results[0].xyz[1] - 0.25).abs() < 1e-15);
}

#[test]
fn circular_light_passes_the_analyser_of_its_own_hand_only() {
    let mut case = grey();
    case.as_object_mut().unwrap().remove("values");
    case["stokes"] = json!([[1, 1, 1, 1], [0, 0, 0, 0], [0, 0, 0, 0], [1, 1, 1, 1]]);
    for (handedness, passed) in [(1.0, 1.0), (-1.0, 0.0)] {
        case["filters"] = json!([{ "type": "circular_analyser", "handedness": handedness }]);
        let luminance = evaluate(&case).unwrap().results[0].xyz[1];
        assert!((luminance - passed).abs() < 1e-15, "{luminance}");
    }
}

#[test]
fn an_error_names_the_case_and_the_field() {
    for (field, value, at) in [
        ("wavelengths", json!([400, 500, 500, 700]), "wavelengths"),
        ("wavelengths", json!([400]), "wavelengths"),
        ("wavelengths", json!([400, "x", 500, 600]), "wavelengths[1]"),
        ("wavelengths", json!("400"), "wavelengths"),
        ("wavelengths", json!([-400, 500, 600, 700]), "wavelengths"),
        ("wavelengths", Value::Null, "wavelengths"),
        ("values", json!([0.5, 0.5, 0.5]), "values"),
        ("values", json!([0.5, null, 0.5, 0.5]), "values[1]"),
        ("values", json!([1e308, 1e308, 1e308, 1e308]), "values"),
        ("values", Value::Null, "values"),
        ("stokes", json!([[], [], [], []]), "stokes"),
        ("value_factor", json!("pi"), "value_factor"),
        ("interpolation", json!("sprauge"), "interpolation"),
        ("interpolation", json!("sprague"), "interpolation"),
        ("interpolation", json!("none"), "interpolation"),
        ("extrapolation", json!("keep"), "extrapolation"),
        ("illuminant", json!("D66"), "illuminant"),
        ("illuminant", json!(-1), "illuminant"),
        ("illuminant", json!([]), "illuminant"),
        ("illuminant", json!("custom"), "custom_illuminant"),
        ("observer", json!("CIE1932"), "observer"),
        ("method", json!("absolute_683"), "method"),
        ("method", json!("sum"), "method"),
        ("method", json!("astm_e308"), "wavelengths"),
        ("domain_nm", json!([380, 780, 5]), "domain_nm"),
        ("filters", json!([{ "type": "linear_polarizer_x" }]), "filters[0].type"),
        ("filters", json!([{ "type": "linear_polariser" }]), "filters[0].angle_deg"),
        ("filters", json!(["linear(0)", "linear(x)"]), "filters[1]"),
        ("rgb", json!([{ "space": "sRBG" }]), "rgb[0].space"),
        ("rgb", json!([{ "space": "sRGB", "adaptation": "bradfort" }]), "rgb[0].adaptation"),
        ("rgb", json!(["sRGB"]), "rgb[0]"),
        ("extrapolaton", json!("hold"), "extrapolaton"),
    ] {
        let case = with(field, value.clone());
        let error = refused(&case);
        assert_eq!((error.case.as_str(), error.field.as_str()), ("grey", at), "{value} {error}");
    }
}

#[test]
fn an_error_says_what_was_meant() {
    let error = refused(&with("illuminant", json!("D66")));
    let text = error.to_string();
    assert!(
        text.starts_with("case `grey`: field `illuminant`: unknown illuminant `D66`"),
        "{text}"
    );
    assert!(text.contains("did you mean D65") || text.contains("or D65"), "{text}");
}

#[test]
fn adaptation_of_emission_is_refused() {
    let error = refused(&with("illuminant", Value::Null));
    assert_eq!(error.field, "rgb[0]");
}

#[test]
fn a_case_without_an_id_is_named_by_its_number() {
    let mut bad = with("values", json!([1, 2]));
    bad.as_object_mut().unwrap().remove("id");
    let error = refused(&json!({ "cases": [grey(), bad] }));
    assert_eq!((error.case.as_str(), error.field.as_str()), ("2", "values"));
}

#[test]
fn illuminants_of_the_request_are_checked_too() {
    let flat = json!({ "start_nm": 300, "end_nm": 900, "step_nm": 200, "values": [1, 1, 1, 1] });
    let request = |light: &Value| json!({ "illuminants": { "mine": light }, "cases": [] });
    assert!(evaluate(&request(&flat)).is_ok());
    for (field, value) in [
        ("end_nm", json!(830)),
        ("values", json!([0, 0, 0, 0])),
        ("values", json!([1])),
        ("step_nm", json!(0)),
        ("step_nm", Value::Null),
    ] {
        let mut light = flat.clone();
        light[field] = value;
        let error = refused(&request(&light));
        assert!(error.field.starts_with("illuminants.mine."), "{error}");
    }
}

fn any_value() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        any::<f64>().prop_map(Value::from),
        (-10_i64..1000).prop_map(Value::from),
        prop_oneof![
            Just("D65"),
            Just("custom"),
            Just("zero"),
            Just("astm_e308"),
            Just("relative_Y1"),
            Just("cubic"),
            Just("matrix(1,2)"),
            Just("linear(1,2,3)"),
            Just("")
        ]
        .prop_map(Value::from),
    ];
    leaf.prop_recursive(3, 24, 6, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..6).prop_map(Value::from),
            prop::collection::vec((prop::sample::select(FIELDS.to_vec()), inner), 0..4)
                .prop_map(|pairs| pairs.into_iter().map(|(k, v)| (k.to_owned(), v)).collect()),
        ]
    })
}

const FIELDS: [&str; 16] = [
    "wavelengths",
    "values",
    "stokes",
    "value_factor",
    "interpolation",
    "extrapolation",
    "illuminant",
    "custom_illuminant",
    "observer",
    "method",
    "rgb_exposure",
    "filters",
    "rgb",
    "type",
    "space",
    "cases",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn no_request_makes_it_panic(
        changes in prop::collection::vec((prop::sample::select(FIELDS.to_vec()), any_value()), 1..4),
    ) {
        let mut case = grey();
        for (field, value) in changes {
            case[field] = value;
        }
        let _ = evaluate(&case);
    }

    #[test]
    fn any_numbers_give_a_finite_colour_or_an_error(
        wavelengths in prop::collection::vec(prop_oneof![350.0..850.0, any::<f64>()], 0..9),
        values in prop::collection::vec(prop_oneof![-1.0..1.0, any::<f64>()], 9),
    ) {
        let mut case = with("wavelengths", json!(wavelengths));
        case["values"] = json!(values[..wavelengths.len()]);
        if let Ok(response) = evaluate(&case) {
            let result = &response.results[0];
            prop_assert!(result.xyz.iter().chain(&result.rgb[0].encoded).all(|v| v.is_finite()));
        }
    }
}

#[test]
fn a_digitized_led_on_uneven_wavelengths_has_no_negative_colour() {
    // Straight lines between the points; a cubic spline gave X, Y, Z = 0.025, −0.006, −0.063.
    let case = json!({
        "wavelengths": [
            360.0, 361.0, 362.0, 368.0, 369.0, 370.0, 596.5, 599.5, 601.5, 620, 640, 641, 650, 651,
            655, 658, 660, 665, 670, 680, 700, 720, 830
        ],
        "values": [
            0, 0.0035, 0, 0, 0.0012, 0, 0.0001, 0.001, 0.0011, 0.01, 0.12, 0.13, 0.55, 0.6, 0.9, 1.0,
            0.97, 0.6, 0.25, 0.04, 0.002, 0, 0
        ],
        "illuminant": "E", "quantity": "reflectance", "rgb": []
    });
    let found = evaluate(&case).unwrap().results[0].xyz;
    for (found, expected) in found.iter().zip([0.043690783, 0.016768136, 3.82773e-5]) {
        // The digits of the reference.
        assert!((found - expected).abs() < 1e-8, "{found} {expected}");
    }
}
