//! Models, colours, and what the service says about itself.

use axum::http::{Method, StatusCode};
use mist_server::http::App;

use crate::ask::ask;

#[tokio::test]
async fn a_model_has_a_schema_with_units_and_defaults() {
    let app = App::default();
    let list = ask(&app, Method::GET, "/v1/models", None, "").await.json();
    assert!(list["families"][0]["classes"].as_array().unwrap().len() > 20);
    let schema = ask(&app, Method::GET, "/v1/models/Facet_BRDF_Model", None, "").await;
    assert_eq!(schema.headers["content-type"], "application/schema+json");
    let lambda = &schema.json()["properties"]["lambda"];
    assert_eq!((&lambda["x-unit"], &lambda["default"]), (&"um".into(), &0.532.into()));
    let unknown = ask(&app, Method::GET, "/v1/models/Facet_BRDF_Modl", None, "").await;
    assert_eq!(unknown.status, StatusCode::NOT_FOUND);
    assert!(unknown.text.contains("Facet_BRDF_Model"), "{}", unknown.text);
}

#[tokio::test]
async fn colours_are_those_of_mist_color() {
    let case = r#"{"wavelengths":[400,500,600,700],"values":[0.1,0.2,0.7,0.8],"illuminant":"D65"}"#;
    let answer = ask(&App::default(), Method::POST, "/v1/color", None, case).await;
    assert_eq!(answer.status, StatusCode::OK, "{}", answer.text);
    let expected = spectra::case::evaluate(&serde_json::from_str(case).unwrap()).unwrap();
    assert_eq!(answer.json(), serde_json::to_value(expected).unwrap());
    for (wrong, status) in [("{", 400), ("{}", 422)] {
        let refused = ask(&App::default(), Method::POST, "/v1/color", None, wrong).await;
        assert_eq!(refused.status.as_u16(), status, "{}", refused.text);
    }
}

#[tokio::test]
async fn the_service_says_that_it_is_ready_and_what_it_did() {
    let app = App::default();
    assert_eq!(ask(&app, Method::GET, "/readyz", None, "").await.text, "ready\n");
    let metrics = ask(&app, Method::GET, "/metrics", None, "").await.text;
    let counted = "mist_requests_total{method=\"GET\",route=\"/readyz\",status=\"200\"} 1";
    assert!(metrics.contains(counted), "{metrics}");
    app.stop();
    let stopping = ask(&app, Method::GET, "/readyz", None, "").await;
    assert_eq!(stopping.status, StatusCode::SERVICE_UNAVAILABLE);
}
