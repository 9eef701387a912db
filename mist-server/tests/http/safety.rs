//! Refusals of the service: without a key, beyond its limits, outside of what was sent.

use axum::http::{Method, StatusCode};
use mist_server::{ServeLimits, http::App};
use serde_json::json;

use crate::{
    ask::{GLASS, ask, send},
    jobs::post_json,
};

const SIMPLE: &str = "MODEL = Lambertian_BRDF_Model\nVARIABLES:\n\
    incidentangle = 0 incidentpol = (1,0,0,0) rotation = 0 differential = 1 minsamples = 10 END\n\
    VARY: END\nINTEGRALS: R = HEMI END END\nOUTPUTS: 1 R END\nFILES: END\n";

#[tokio::test]
async fn a_hostile_program_is_refused_and_the_service_lives() {
    // So many tokens would be refused before anything else.
    let limits = ServeLimits { max_time: 20.0, max_tokens: usize::MAX, ..ServeLimits::default() };
    let app = App::new(limits, None, None).unwrap();
    let deep = format!("{}1{}", "(".repeat(200_000), ")".repeat(200_000));
    let minus = format!("{}1", "-".repeat(200_000));
    let loops = "VARY:\nFOR rotation FROM 0 TO 1 BY 1e-12\nEND";
    for (what, program) in [
        ("deep nesting", SIMPLE.replace("rotation = 0", &format!("rotation = {deep}x"))),
        ("many signs", SIMPLE.replace("rotation = 0", &format!("rotation = {minus}x"))),
        ("a huge loop", SIMPLE.replace("VARY: END", loops)),
        (
            "a billion directions",
            SIMPLE.replace("differential = 1", "integrationmode = 2 differential = 1e-12"),
        ),
        ("a list outside", SIMPLE.replace("VARY: END", "VARY:\nLIST /etc/passwd\nEND")),
        ("a table outside", SIMPLE.replace("rotation = 0", "rotation = @/etc/passwd(1)")),
        (
            "a file outside",
            SIMPLE.replace("VARIABLES:", "VARIABLES: $reflectance.table = /etc/passwd"),
        ),
        (
            "a file above",
            SIMPLE.replace("VARIABLES:", "VARIABLES: $reflectance.table = ../../etc/passwd"),
        ),
    ] {
        let answer = post_json(&app, "/v1/run", &json!({ "program": program })).await;
        assert_eq!(answer.status, StatusCode::UNPROCESSABLE_ENTITY, "{what}: {}", answer.text);
        assert!(!answer.text.contains("root:"), "{what}: {}", answer.text);
    }
    let well = post_json(&app, "/v1/run", &json!({ "program": SIMPLE })).await;
    assert_eq!(well.status, StatusCode::OK, "{}", well.text);
}

#[tokio::test]
async fn what_is_too_large_is_refused_with_the_name_of_the_limit() {
    let limits = ServeLimits {
        max_body: 10_000,
        max_program: 1000,
        max_wavelengths: 100,
        max_tokens: 200,
        max_memory: 10_000_000,
        ..ServeLimits::default()
    };
    let app = App::new(limits, None, None).unwrap();
    let put = ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    assert_eq!(put.status, StatusCode::CREATED, "{}", put.text);
    let huge = " ".repeat(20_000);
    let long = format!("{SIMPLE}{}", " ".repeat(2000));
    let wordy = SIMPLE.replace("rotation = 0", &format!("rotation = 0{}", "+1".repeat(200)));
    let table = "/v1/materials/glass/table.mtab";
    let cases = [
        (Method::PUT, "/v1/materials/a".to_owned(), huge.as_str(), 413, "max-body"),
        (Method::POST, "/v1/run".to_owned(), long.as_str(), 413, "max-program"),
        (Method::POST, "/v1/run".to_owned(), wordy.as_str(), 413, "max-tokens"),
        (Method::POST, "/v1/jobs".to_owned(), wordy.as_str(), 413, "max-tokens"),
        (
            Method::GET,
            format!("{table}?thetai=0:10:80&thetas=0:5:80&phis=0:2:180&lambda=400:10:700"),
            "",
            422,
            "max-memory",
        ),
        (
            Method::GET,
            format!("{table}?thetai=0:0.01:90&thetas=0:0.01:90&phis=0:0.01:180"),
            "",
            422,
            "max-steps",
        ),
        (
            Method::GET,
            format!("{table}?thetai=0&thetas=0&phis=0&lambda=400:0.01:700"),
            "",
            422,
            "max-wavelengths",
        ),
        (
            Method::GET,
            format!("{table}?thetai=0:1:90&thetas=0:1:90&phis=0:1:180&lambda=400:10:700"),
            "",
            422,
            "max-numbers",
        ),
    ];
    for (method, uri, body, status, limit) in cases {
        let kind = [("content-type", "application/x-mist")];
        let (found, headers, bytes) = send(&app, method, &uri, &kind, body.to_owned()).await;
        let text = String::from_utf8(bytes).unwrap();
        assert_eq!(found.as_u16(), status, "{uri}: {text}");
        assert_eq!(headers["content-type"], "application/problem+json");
        let problem: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(problem["limit"], limit, "{uri}: {text}");
    }
}

#[tokio::test]
async fn orders_of_billions_are_refused_before_they_are_made() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let axis = "0:0.001:89".to_owned() + &",0:0.001:89".repeat(1000);
    for query in [
        "table.mtab?thetai=0:1e-9:90&thetas=0&phis=0".to_owned(),
        "table.mtab?thetai=0:0.001:90&thetas=0:0.001:90&phis=0:0.001:180".to_owned(),
        format!("table.mtab?thetai={axis}&thetas=0&phis=0"),
        format!("table.csv?thetai={axis}&thetas=0&phis=0"),
        "table.pbsdf?grid=1000000000x1000000000x1000000000".to_owned(),
        "table.pbsdf?grid=1000x1000x1000".to_owned(),
        "table.bsdf?grid=1024x1024x4096".to_owned(),
        "table.RISEdataBSDF?nodes=1000000000".to_owned(),
        "table.csv?thetai=0:0.01:89&thetas=0:0.01:89&phis=0:0.01:180".to_owned(),
    ] {
        let uri = format!("/v1/materials/glass/{query}");
        let answer = ask(&app, Method::GET, &uri, None, "").await;
        let head = &query[..query.len().min(100)];
        assert_eq!(answer.status, StatusCode::UNPROCESSABLE_ENTITY, "{head}: {}", answer.text);
    }
}

#[tokio::test]
async fn a_service_with_keys_lets_nobody_in_without_one() {
    // `mist key --hash` of the key "k" and of the key "r".
    let keys = "all read,run 8254c329a92850f6d539dd376f4816ee2764517da5e0235514af433164480d7a\n\
                look read 454349e422f05297191ead13e21d3db520e5abef52055e4964b82fb213f593a1\n";
    let app = App::new(ServeLimits::default(), None, Some(keys)).unwrap();
    let get = "/v1/materials";
    let put = "/v1/materials/glass";
    for (method, uri, key, status) in [
        (Method::GET, "/healthz", "", 200),
        (Method::GET, get, "", 401),
        (Method::GET, get, "Bearer x", 401),
        (Method::GET, get, "Basic k", 401),
        (Method::GET, get, "Bearer r", 200),
        (Method::PUT, put, "Bearer r", 403),
        (Method::PUT, put, "bearer k", 201),
        (Method::POST, "/v1/materials/none/evaluate", "Bearer r", 400),
        (Method::GET, "/metrics", "", 401),
    ] {
        let headers: Vec<(&str, &str)> =
            [("authorization", key)].into_iter().filter(|(_, key)| !key.is_empty()).collect();
        let (found, answer, _) = send(&app, method, uri, &headers, GLASS).await;
        assert_eq!(found.as_u16(), status, "{uri} {key}");
        assert_eq!(answer.contains_key("www-authenticate"), status == 401);
    }
}

#[tokio::test]
async fn addresses_and_methods_that_there_are_not_are_problems_too() {
    let app = App::default();
    for (method, uri, status) in [
        (Method::GET, "/v2", 404),
        (Method::PATCH, "/v1/models", 405),
        (Method::GET, "/v1/jobs/x", 404),
    ] {
        let answer = ask(&app, method, uri, None, "").await;
        assert_eq!(answer.status.as_u16(), status);
        assert_eq!(answer.headers["content-type"], "application/problem+json");
        assert!(answer.headers.contains_key("x-request-id"));
        assert_eq!(answer.json()["status"], status);
    }
}
