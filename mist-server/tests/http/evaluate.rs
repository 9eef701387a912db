//! Single geometries: as JSON, and as the bytes of a renderer.

use axum::http::{Method, StatusCode};
use mist_engine::material::eval;
use mist_server::http::App;
use scattering::Mode;

use crate::ask::{GLASS, ask, send};

const ANGLES: [(f64, f64, f64); 3] = [(0.6, 0.7, 0.1), (0.6, 0.3, -2.0), (1.2, 1.0, 3.0)];

/// Unit vectors to the source and to the viewer: light comes from -x.
fn pairs() -> Vec<u8> {
    let vector = |theta: f64, phi: f64| {
        [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()].map(|x| x as f32)
    };
    ANGLES
        .iter()
        .flat_map(|&(theta_i, theta_s, phi_s)| {
            [vector(theta_i, std::f64::consts::PI), vector(theta_s, phi_s)].concat()
        })
        .flat_map(f32::to_le_bytes)
        .collect()
}

fn numbers(bytes: &[u8]) -> Vec<f32> {
    bytes.chunks(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
}

#[tokio::test]
async fn the_body_of_mist_eval_has_the_answer_of_mist_eval() {
    let request = r#"{"model":"Facet_BRDF_Model","parameters":{"substrate":"(1.5,0)"},
        "geometries":[{"theta_i":0.5,"theta_s":0.2,"phi_s":0.3}]}"#;
    let answer = ask(&App::default(), Method::POST, "/v1/evaluate", None, request).await;
    assert_eq!(answer.status, StatusCode::OK, "{}", answer.text);
    let expected = eval::eval(request, Mode::Sound, None).unwrap();
    assert_eq!(answer.json(), serde_json::to_value(expected).unwrap());
    let wrong = request.replace("theta_s", "thetas");
    let refused = ask(&App::default(), Method::POST, "/v1/evaluate", None, &wrong).await;
    assert_eq!(refused.status, StatusCode::BAD_REQUEST);
}

#[tokio::test]
async fn a_program_is_evaluated_as_the_model_of_its_first_step() {
    let geometries = r#""geometries":[{"theta_i":0.5,"theta_s":0.2,"phi_s":0.3}]"#;
    let model = format!(
        r#"{{"model":"Facet_BRDF_Model","parameters":{{"substrate":"(1.5,0)"}},{geometries}}}"#
    );
    let text = "MODEL = Facet_BRDF_Model\nVARIABLES:\n#lambda = 0.532\n$substrate = (1.5,0)\n\
        incidentangle = 0.5  incidentpol = (1,0,0,0)  rotation = 0\nEND\n\
        VARY: END INTEGRALS: END OUTPUTS: END FILES: END\n";
    let program = format!(r#"{{"program":{},{geometries}}}"#, serde_json::json!(text));
    let app = App::default();
    let [of_model, of_program] =
        [&model, &program].map(|body| ask(&app, Method::POST, "/v1/evaluate", None, body.as_str()));
    let (of_model, of_program) = (of_model.await, of_program.await);
    assert_eq!(of_program.status, StatusCode::OK, "{}", of_program.text);
    assert_eq!(of_program.json()["mueller"], of_model.json()["mueller"]);
    let both = program.replacen('{', r#"{"model":"Facet_BRDF_Model","#, 1);
    let refused = ask(&app, Method::POST, "/v1/evaluate", None, &both).await;
    assert_eq!(refused.status, StatusCode::BAD_REQUEST);
    assert!(refused.text.contains("exclude each other"), "{}", refused.text);
}

#[tokio::test]
async fn vectors_have_the_matrices_of_their_angles() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    for basis in ["psps", "plane"] {
        let uri =
            format!("/v1/materials/glass/evaluate?out=mueller&basis={basis}&lambda=450,532,600");
        let (status, headers, bytes) = send(&app, Method::POST, &uri, &[], pairs()).await;
        assert_eq!(status, StatusCode::OK, "{}", String::from_utf8_lossy(&bytes));
        assert_eq!(headers["content-type"], "application/octet-stream");
        let found = numbers(&bytes);
        assert_eq!(found.len(), 3 * 3 * 16);
        let geometries: Vec<_> = ANGLES
            .iter()
            .map(|(i, s, p)| serde_json::json!({"theta_i": i, "theta_s": s, "phi_s": p}))
            .collect();
        let request = serde_json::json!({
            "model": "Facet_BRDF_Model", "basis": basis, "geometries": geometries,
            "parameters": {"substrate": "(1.5,0)", "sdf.s": 0.3, "lambda": 0.532},
        });
        let expected = eval::eval(&request.to_string(), Mode::Sound, None).unwrap();
        for (pair, matrix) in expected.mueller.iter().enumerate() {
            let own = &found[48 * pair + 16..48 * pair + 32];
            for (a, b) in matrix.iter().zip(own) {
                // Vectors in f32 are the angles to 1e-7; the lobe turns that into ten times as much.
                assert!((a.0 - f64::from(*b)).abs() < 3e-6 * matrix[0].0, "{basis}: {a:?} {b}");
            }
        }
    }
}

#[tokio::test]
async fn colours_and_spectra_have_their_widths_and_what_lies_below_is_black() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let uri = "/v1/materials/glass/evaluate?lambda=400:50:700";
    let (_, _, rgb) = send(&app, Method::POST, uri, &[], pairs()).await;
    assert_eq!(numbers(&rgb).len(), 9);
    assert!(numbers(&rgb).iter().all(|x| *x > 0.0));
    let (_, _, spectra) =
        send(&app, Method::POST, &format!("{uri}&out=spectral"), &[], pairs()).await;
    assert_eq!(numbers(&spectra).len(), 21);
    let below: Vec<u8> =
        [0.0f32, 0.6, 0.8, 0.0, 0.6, -0.8].iter().flat_map(|x| x.to_le_bytes()).collect();
    let (_, _, black) = send(&app, Method::POST, uri, &[], below).await;
    assert_eq!(numbers(&black), [0.0; 3]);
}

#[tokio::test]
async fn wrong_bodies_and_wrong_keys_are_told() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    for (query, bytes, status) in [
        ("", 23, 400),
        ("out=xyz", 24, 422),
        ("basis=spsp", 24, 422),
        ("lambda=", 24, 422),
        ("lambda=550", 24, 422),
        ("lambda=-5", 24, 422),
    ] {
        let uri = format!("/v1/materials/glass/evaluate?{query}");
        let (found, ..) = send(&app, Method::POST, &uri, &[], vec![0u8; bytes]).await;
        assert_eq!(found.as_u16(), status, "{query}");
    }
}

#[tokio::test]
async fn the_basis_of_mitsuba_is_that_of_its_stokes_vectors() {
    let app = App::default();
    let metal = r#"{"model":"Facet_BRDF_Model","parameters":[["substrate","(0.7,2.4)"],
        ["sdf","Gaussian_Slope_Distribution_Function"],["sdf.s","0.35"]]}"#;
    ask(&app, Method::PUT, "/v1/materials/metal", None, metal).await;
    let pair: [f32; 6] = [0.505076, -0.303046, 0.808122, -0.117041, 0.702247, 0.702247];
    let body: Vec<u8> = pair.iter().flat_map(|x| x.to_le_bytes()).collect();
    let uri = "/v1/materials/metal/evaluate?out=mueller&basis=mitsuba&lambda=550";
    let (status, _, bytes) = send(&app, Method::POST, uri, &[], body).await;
    assert_eq!(status, StatusCode::OK, "{}", String::from_utf8_lossy(&bytes));
    // Mitsuba 3.9.1, scalar_spectral_polarized, from a table of these matrices: its value has the
    // cosine of the light.
    let mitsuba = [
        [0.266088, 0.015451, -0.017741, 0.0],
        [0.006125, 0.228229, 0.106898, 0.082287],
        [0.022715, 0.119453, -0.236652, -0.022188],
        [0.0, 0.064270, 0.055972, -0.250970],
    ];
    for (expected, found) in mitsuba.as_flattened().iter().zip(numbers(&bytes)) {
        // The published digits.
        assert!((expected - 0.808122 * found).abs() < 2e-6, "{expected} {found}");
    }
}
