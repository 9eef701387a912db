//! Integrals over solid angles: the rows of a request, as a program would have them.

use axum::http::{Method, StatusCode};
use mist_engine::{Control, MemoryFiles, MemorySink, Options, compile};
use mist_server::http::App;

use crate::ask::{GLASS, ask, send};

/// Rows of one request, and the same apertures in a program.
const ROWS: &str =
    "45 45 0 circle 2\n45 60 0 ring 10 12\n45 30 20 polygon 20 10 40 10 40 40 20 40\n";

/// The integrals that a run of a program gives for these apertures.
fn run() -> Vec<f64> {
    let program = "MODEL = Facet_BRDF_Model\nVARIABLES:\n\
         $substrate = (1.5,0) #sdf.s = 0.3 #lambda = 0.532 rad = atan(1)/45 incidentangle = 45*rad incidentpol = (1,0,0,0) rotation = 0\n\
         differential = (0.5*rad)^2 minsamples = 100 END\nVARY: END\nINTEGRALS:\n\
         a = CIRCLE CENTER = (45*deg,0) ALPHA = 2*deg END\n\
         b = ANNULUS OUTERCENTER = (60*deg,0) INNERCENTER = (60*deg,0) OUTERALPHA = 12*deg INNERALPHA = 10*deg END\n\
         c = POLYGON VERTEX = (20*deg,10*deg) VERTEX = (40*deg,10*deg) VERTEX = (40*deg,40*deg) VERTEX = (20*deg,40*deg) POLCENTER = (30*deg,20*deg) END\n\
         END\nOUTPUTS: 1 a 2 b 3 c END\nFILES: format = %.17g\\t END\n";
    let job = compile(program, std::sync::Arc::new(MemoryFiles::default()), &Options::default())
        .unwrap_or_else(|found| panic!("{found:?}"));
    let mut sink = MemorySink::default();
    job.run(&mut sink, &Control::default()).unwrap();
    let row = sink.results.lines().nth(1).unwrap();
    row.split_whitespace().map(|cell| cell.parse().unwrap()).collect()
}

#[tokio::test]
async fn rows_are_the_integrals_of_mist_run_over_the_same_apertures() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let uri = "/v1/materials/glass/integrate?out=spectral&lambda=532,600&digits=17";
    let answer = ask(&app, Method::POST, uri, None, ROWS).await;
    assert_eq!(answer.status, StatusCode::OK, "{}", answer.text);
    let rows: Vec<Vec<f64>> = answer
        .text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split(' ').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 3);
    for (row, integral) in rows.iter().zip(run()) {
        let own = row[4] * row[3];
        // The same directions and weights, summed in another order.
        assert!((own - integral).abs() < 1e-12 * integral.abs(), "{own} {integral}");
    }
}

#[tokio::test]
async fn patches_as_json_have_the_rows_of_the_same_text() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let patches = serde_json::json!({"patches": [
        {"thetai": 45, "thetas": 45, "phis": 0, "circle": 2},
        {"thetai": 45, "thetas": 60, "phis": 0, "ring": [10, 12]},
        {"thetai": 45, "thetas": 30, "phis": 20,
            "polygon": [[20, 10], [40, 10], [40, 40], [20, 40]]},
    ]});
    for out in ["rgb", "spectral", "mueller"] {
        let uri = format!("/v1/materials/glass/integrate?out={out}&lambda=450,550,650");
        let text = ask(&app, Method::POST, &uri, None, ROWS).await;
        assert_eq!(text.status, StatusCode::OK, "{}", text.text);
        let json = ask(&app, Method::POST, &uri, None, &patches.to_string()).await;
        assert_eq!(json.text, text.text);
    }
    let two = r#"{"patches":[{"thetai":0,"thetas":0,"phis":0,"circle":2,"ring":[1,2]}]}"#;
    let uri = "/v1/materials/glass/integrate";
    assert_eq!(ask(&app, Method::POST, uri, None, two).await.status, StatusCode::BAD_REQUEST);
}

#[tokio::test]
async fn matrices_of_patches_begin_with_their_spectra() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let headers = [("accept", "application/json"), ("content-type", "application/x-mist")];
    let uri = |out| format!("/v1/materials/glass/integrate?out={out}&lambda=450,550,650");
    let mut answers = Vec::new();
    for out in ["mueller", "spectral"] {
        let (status, headers, bytes) =
            send(&app, Method::POST, &uri(out), &headers, ROWS.to_owned()).await;
        assert_eq!(
            (status, &headers["content-type"]),
            (StatusCode::OK, &"application/json".parse().unwrap())
        );
        answers.push(serde_json::from_slice::<serde_json::Value>(&bytes).unwrap());
    }
    for (matrices, spectrum) in
        answers[0]["rows"].as_array().unwrap().iter().zip(answers[1]["rows"].as_array().unwrap())
    {
        for k in 0..3 {
            assert_eq!(matrices["mueller"][k][0], spectrum["spectrum"][k]);
        }
        assert_eq!(matrices["omega"], spectrum["omega"]);
    }
}
