//! Materials go in, tables come out.

use axum::http::{Method, StatusCode};
use mist_server::http::App;

use crate::ask::{GLASS, ask, send};

const TABLE: &str =
    "/v1/materials/glass/table.mtab?thetai=0:30:60&thetas=0:30:60&phis=0:90:180&lambda=400:50:700";

#[tokio::test]
async fn a_material_goes_in_and_its_table_comes_out() {
    let app = App::default();
    let health = ask(&app, Method::GET, "/healthz", None, "").await;
    assert_eq!((health.status, health.text.as_str()), (StatusCode::OK, "ok\n"));
    let put = ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    assert_eq!(put.status, StatusCode::CREATED);
    assert!(put.text.contains("sha256-"), "{}", put.text);
    let table = ask(&app, Method::GET, TABLE, None, "").await;
    assert_eq!(table.status, StatusCode::OK);
    assert!(table.text.starts_with("# MIST-TABLE 1\n") && table.text.contains("\n# end 27 "));
    let again = ask(&app, Method::GET, TABLE, table.tag.as_deref(), "").await;
    assert_eq!((again.status, again.text.as_str()), (StatusCode::NOT_MODIFIED, ""));
}

#[tokio::test]
async fn a_program_stands_for_the_material_of_its_first_step() {
    let app = App::default();
    let program = "MODEL = Lambertian_BRDF_Model\nVARIABLES:\n$reflectance.table = r.txt\n\
        incidentangle = 0 incidentpol = (1,0,0,0) rotation = 0 differential = 1 minsamples = 10 END\n\
        VARY: END\nINTEGRALS: END\nOUTPUTS: END\nFILES: END\n";
    let body =
        serde_json::json!({ "program": program, "files": { "r.txt": "0.3 0.5\n0.9 0.5\n" } });
    let put = ask(&app, Method::PUT, "/v1/materials/glass", None, &body.to_string()).await;
    assert_eq!(put.status, StatusCode::CREATED, "{}", put.text);
    let table = ask(&app, Method::GET, TABLE, None, "").await;
    assert!(table.text.contains("0.159154943"), "{}", table.text);
    let wrong = body.to_string().replace("Lambertian", "Lambertain");
    let refused = ask(&app, Method::PUT, "/v1/materials/wrong", None, &wrong).await;
    assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
    let problem: serde_json::Value = serde_json::from_str(&refused.text).unwrap();
    assert_eq!((problem["line"].as_u64(), problem["column"].as_u64()), (Some(1), Some(9)));
}

#[tokio::test]
async fn patches_in_the_url_and_in_the_body_have_the_rows_of_the_request() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let rows = "45 45 0 circle 2\n45 60 0 ring 10 12\n30 0 0 circle 5\n";
    let wanted = "lambda=400:50:700&stokes=1&digits=17";
    let uri = format!("/v1/materials/glass/integrate?{wanted}");
    let posted = ask(&app, Method::POST, &uri, None, rows).await;
    assert_eq!(posted.status, StatusCode::OK, "{}", posted.text);
    let table = rise_bridge::read::mtab(&posted.text).unwrap();
    assert_eq!(table.rows.iter().map(|row| row.thetas).collect::<Vec<_>>(), [45.0, 60.0, 0.0]);
    let in_url = rows.trim().replace(' ', "%20").replace('\n', ";");
    let uri = format!("/v1/materials/glass/table.mtab?{wanted}&patches={in_url}");
    assert_eq!(ask(&app, Method::GET, &uri, None, "").await.text, posted.text);
}

#[tokio::test]
async fn the_bare_text_of_a_program_is_a_material() {
    let app = App::default();
    let program = "MODEL = Lambertian_BRDF_Model\nVARIABLES:\n\
        incidentangle = 0 incidentpol = (1,0,0,0) rotation = 0 differential = 1 minsamples = 10 END\n\
        VARY: END\nINTEGRALS: END\nOUTPUTS: END\nFILES: END\n";
    let put = ask(&app, Method::PUT, "/v1/materials/white", None, program).await;
    assert_eq!(put.status, StatusCode::CREATED, "{}", put.text);
    let table = ask(&app, Method::GET, &TABLE.replace("glass", "white"), None, "").await;
    assert!(table.text.contains("0.318309886"), "{}", table.text);
}

#[tokio::test]
async fn wrong_requests_are_told_what_is_wrong() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let cases = [
        (Method::GET, "/v1/materials/none/table.mtab?thetai=0&thetas=0&phis=0", "", 404, "none"),
        (Method::GET, "/v1/materials/glass/table.xyz?thetai=0&thetas=0&phis=0", "", 404, "xyz"),
        (Method::GET, "/v1/materials/glass/table.mtab?thetai=0&thetas=x&phis=0", "", 422, "thetas"),
        (
            Method::GET,
            "/v1/materials/glass/table.mtab?thetai=0&thetas=0&phis=0&illuminant=D66",
            "",
            422,
            "illuminant",
        ),
        (Method::GET, "/v1/materials/glass/table.mtab?thetai=0&color=D65", "", 400, "color"),
        (Method::GET, "/v1/materials/glass/table.mtab", "", 400, "thetai"),
        (Method::GET, "/v1/materials/glass/table.mtab?thetai=0&digits=99", "", 400, "digits"),
        (Method::POST, "/v1/materials/glass/integrate", "1 2 3 square 4", 422, "line 1"),
        (Method::PUT, "/v1/materials/a", "{", 400, "request"),
        (Method::PUT, "/v1/materials/a", r#"{"model":"No_Model"}"#, 422, "No_Model"),
        (
            Method::PUT,
            "/v1/materials/a",
            r#"{"model":"Facet_BRDF_Model","parameters":{"substrate":"/etc/passwd"}}"#,
            422,
            "passwd",
        ),
    ];
    for (method, uri, body, status, word) in cases {
        let answer = ask(&app, method, uri, None, body).await;
        assert_eq!(answer.status.as_u16(), status, "{uri}: {}", answer.text);
        assert!(answer.text.contains(word), "{uri}: {}", answer.text);
    }
}

#[tokio::test]
async fn a_table_that_takes_longer_than_the_client_waits_is_promised_and_then_there() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let uri =
        "/v1/materials/glass/table.mtab?thetai=0:5:80&thetas=0:2:80&phis=0:5:180&lambda=400:20:700";
    let promised = ask(&app, Method::GET, &format!("{uri}&wait=0"), None, "").await;
    assert_eq!(promised.status, StatusCode::ACCEPTED, "{}", promised.text);
    let location = promised.headers["location"].to_str().unwrap().to_owned();
    assert!(promised.headers.contains_key("retry-after"));
    let there = ask(&app, Method::GET, &location.replace("wait=0", "wait=60"), None, "").await;
    assert_eq!(there.status, StatusCode::OK, "{}", there.text);
    let again = ask(&app, Method::GET, uri, there.tag.as_deref(), "").await;
    assert_eq!(again.status, StatusCode::NOT_MODIFIED);
}

#[tokio::test]
async fn all_who_ask_at_the_same_time_get_the_table_that_was_computed_once() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let asks = (0..8).map(|_| {
        let app = app.clone();
        tokio::spawn(async move { ask(&app, Method::GET, TABLE, None, "").await.text })
    });
    let mut texts = Vec::new();
    for one in asks.collect::<Vec<_>>() {
        texts.push(one.await.unwrap());
    }
    assert!(texts.iter().all(|text| *text == texts[0] && text.starts_with("# MIST-TABLE 1")));
    let metrics = ask(&app, Method::GET, "/metrics", None, "").await.text;
    assert!(metrics.contains("mist_tables_shared_total 7"), "{metrics}");
}

#[tokio::test]
async fn a_table_is_compressed_as_the_client_likes_it() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let plain = ask(&app, Method::GET, TABLE, None, "").await.text;
    for (accepts, encoding) in
        [("zstd, gzip", "zstd"), ("gzip;q=1, zstd;q=0.5", "gzip"), ("gzip", "gzip"), ("br", "")]
    {
        let accept = [("accept-encoding", accepts)];
        let (status, headers, bytes) = send(&app, Method::GET, TABLE, &accept, "").await;
        assert_eq!(status, StatusCode::OK);
        let found = headers.get("content-encoding").map_or("", |name| name.to_str().unwrap());
        assert_eq!(found, encoding, "{accepts}");
        // RFC 8878 and RFC 1952: how such data begin.
        match encoding {
            "zstd" => {
                assert_eq!(zstd::decode_all(&bytes[..]).unwrap(), plain.as_bytes());
            }
            "gzip" => assert_eq!(bytes[..2], [0x1f, 0x8b]),
            _ => assert_eq!(bytes, plain.as_bytes()),
        }
    }
}

#[tokio::test]
async fn tables_of_other_programs_are_promised_and_computed_once_too() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let uri = "/v1/materials/glass/table.bsdf?grid=8x16&lambda=400:100:700";
    let promised = ask(&app, Method::GET, &format!("{uri}&wait=0"), None, "").await;
    assert_eq!(promised.status, StatusCode::ACCEPTED, "{}", promised.text);
    assert!(promised.headers.contains_key("location"));
    assert!(promised.headers.contains_key("retry-after"));
    let (status, headers, bytes) = send(&app, Method::GET, uri, &[], "").await;
    assert_eq!(status, StatusCode::OK);
    assert!(bytes.starts_with(b"tensor_file"));
    let metrics = ask(&app, Method::GET, "/metrics", None, "").await.text;
    assert!(metrics.contains("mist_tables_shared_total 1"), "{metrics}");
    let tag = headers["etag"].to_str().unwrap();
    let again = ask(&app, Method::GET, uri, Some(tag), "").await;
    assert_eq!(again.status, StatusCode::NOT_MODIFIED);
}
