//! The OpenAPI document is the one in `docs`, and is complete.

use std::fs;

#[test]
fn the_document_in_the_repository_is_the_one_that_is_served() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/openapi.json");
    let kept = fs::read_to_string(path).unwrap();
    let served = mist_server::http::openapi();
    assert!(kept == served, "it is stale: mist serve --openapi > docs/openapi.json");
}

#[test]
fn every_address_says_what_may_go_wrong() {
    let document: serde_json::Value = serde_json::from_str(&mist_server::http::openapi()).unwrap();
    assert_eq!(document["openapi"], "3.1.0");
    for (path, methods) in document["paths"].as_object().unwrap() {
        for (method, operation) in methods.as_object().unwrap() {
            let problem = &operation["responses"]["422"]["content"]["application/problem+json"];
            assert!(problem.is_object(), "{method} {path}");
            assert!(operation["summary"].is_string(), "{method} {path}");
        }
    }
}

#[test]
fn every_format_is_in_the_description_and_in_the_document() {
    let document: serde_json::Value = serde_json::from_str(&mist_server::http::openapi()).unwrap();
    let path = &document["paths"]["/v1/materials/{name}/{file}"]["get"]["parameters"];
    let file = path.as_array().unwrap().iter().find(|each| each["name"] == "file").unwrap();
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/http.md")).unwrap();
    for format in rise_bridge::formats::FORMATS {
        let extension = format!(".{}`", format.extension);
        let description = file["description"].as_str().unwrap();
        assert!(description.contains(&extension), "{extension} in {description}");
        assert!(text.contains(&format!(".{}", format.extension)), "{extension} in docs/http.md");
    }
}
