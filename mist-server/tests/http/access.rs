//! Requests of foreign web pages, and of clients that may not do everything.

use std::time::{Duration, Instant};

use axum::{
    body::Body,
    http::{Method, Request, StatusCode},
};
use mist_server::{
    AccessOptions, ServeLimits,
    http::{App, router},
};
use tower::ServiceExt;

use crate::ask::{GLASS, ask, send};

/// `mist key --hash` of the keys "k" (run), "r" (read), "o" (run) and "a" (admin).
fn keys() -> String {
    let digests = [("k", "run"), ("r", "read"), ("o", "run"), ("a", "read,run,admin")];
    digests.map(|(key, scopes)| mist_server::keys::line(key, scopes, key)).join("\n")
}

fn with_keys(limits: ServeLimits) -> App {
    App::new(limits, None, Some(&keys())).unwrap()
}

fn access(host: &str, origin: &str) -> App {
    App::default().with_access(AccessOptions {
        hosts: vec![host.to_owned()],
        origins: vec![origin.to_owned()],
        ..AccessOptions::default()
    })
}

#[tokio::test]
async fn a_request_for_another_host_is_refused() {
    let app = access("lab.example", "https://page.example");
    for (host, status) in [
        ("localhost", 200),
        ("LOCALHOST:8650", 200),
        ("127.0.0.1:8650", 200),
        ("[::1]:8650", 200),
        ("lab.example:80", 200),
        ("evil.example", 403),
        ("localhost.evil.example", 403),
        ("192.0.2.1", 403),
        ("evil@localhost", 400),
        ("", 400),
    ] {
        for uri in ["/v1/models", "/", "/healthz", "/nowhere"] {
            let (found, ..) = send(&app, Method::GET, uri, &[("host", host)], "").await;
            let wanted = if status == 200 && uri == "/nowhere" { 404 } else { status };
            assert_eq!(found.as_u16(), wanted, "{host} {uri}");
        }
    }
    let absolute = "http://evil.example/v1/models";
    assert_eq!(send(&app, Method::GET, absolute, &[], "").await.0, StatusCode::FORBIDDEN);
}

#[tokio::test]
async fn a_missing_or_doubled_host_is_400() {
    for hosts in [&[][..], &["localhost", "localhost"], &["localhost", "evil.example"]] {
        let mut request = Request::builder().uri("/healthz");
        for host in hosts {
            request = request.header("host", *host);
        }
        let request = request.body(Body::empty()).unwrap();
        let answer = router(App::default()).oneshot(request).await.unwrap();
        assert_eq!(answer.status(), StatusCode::BAD_REQUEST, "{hosts:?}");
    }
}

#[tokio::test]
async fn a_foreign_page_can_neither_compute_nor_read() {
    let app = access("lab.example", "https://page.example");
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let table = "/v1/materials/glass/table.svg?thetai=0&thetas=0:30:60&phis=0&lambda=400,500";
    let own = ("origin", "http://localhost");
    let cases: [(&[(&str, &str)], u16); 11] = [
        (&[], 200),
        (&[own], 200),
        (&[("host", "localhost:8650"), ("origin", "http://localhost:8650")], 200),
        (&[("host", "localhost:8650"), ("origin", "http://localhost:3000")], 403),
        (&[("origin", "https://page.example"), ("sec-fetch-site", "cross-site")], 200),
        (&[("origin", "https://evil.example")], 403),
        (&[("origin", "null")], 403),
        (&[("sec-fetch-site", "cross-site")], 403),
        (&[("sec-fetch-site", "same-site")], 403),
        (&[("sec-fetch-site", "cross-site"), ("sec-fetch-mode", "navigate")], 403),
        (&[("sec-fetch-site", "none"), ("sec-fetch-mode", "navigate")], 200),
    ];
    for (headers, status) in cases {
        for uri in [table, "/v1/materials"] {
            let (found, answer, bytes) = send(&app, Method::GET, uri, headers, "").await;
            let text = String::from_utf8_lossy(&bytes);
            assert_eq!(found.as_u16(), status, "{uri} {headers:?}: {text}");
            let is_allowed = headers.iter().any(|header| header.1 == "https://page.example");
            assert_eq!(answer.contains_key("access-control-allow-origin"), is_allowed);
        }
    }
    // A link to the page is followed.
    let link = [("sec-fetch-site", "cross-site"), ("sec-fetch-mode", "navigate")];
    assert_eq!(send(&app, Method::GET, "/", &link, "").await.0, StatusCode::OK);
}

#[tokio::test]
async fn bodies_that_a_form_can_send_are_refused_with_a_remedy() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let form = "multipart/form-data; boundary=xyz";
    for kind in ["text/plain", form, "application/x-www-form-urlencoded", "", "image/png"] {
        for (method, uri) in [
            (Method::POST, "/v1/run"),
            (Method::POST, "/v1/jobs"),
            (Method::POST, "/v1/check"),
            (Method::POST, "/v1/color"),
            (Method::POST, "/v1/evaluate"),
            (Method::PUT, "/v1/materials/other"),
            (Method::POST, "/v1/materials/glass/evaluate"),
            (Method::POST, "/v1/materials/glass/integrate"),
        ] {
            let (status, _, bytes) = send(&app, method, uri, &[("content-type", kind)], "{}").await;
            let text = String::from_utf8(bytes).unwrap();
            assert_eq!(status, StatusCode::UNSUPPORTED_MEDIA_TYPE, "{uri} {kind}: {text}");
            assert!(text.contains("send the header `Content-Type: application/"), "{text}");
        }
    }
    let kind = [("content-type", "Application/JSON; charset=utf-8")];
    assert_eq!(send(&app, Method::PUT, "/v1/materials/b", &kind, GLASS).await.0, 201);
}

#[tokio::test]
async fn every_answer_is_closed_to_other_sites() {
    let app = App::default();
    let host = [("host", "evil.example")];
    let none: &[(&str, &str)] = &[];
    for (uri, headers) in [("/", none), ("/v1/models", none), ("/nowhere", none), ("/", &host)] {
        let (_, answer, _) = send(&app, Method::GET, uri, headers, "").await;
        assert_eq!(answer["x-content-type-options"], "nosniff", "{uri}");
        assert_eq!(answer["cross-origin-resource-policy"], "same-origin", "{uri}");
        let policy = answer["content-security-policy"].to_str().unwrap();
        assert!(policy.contains("frame-ancestors 'none'"), "{uri}: {policy}");
    }
}

#[tokio::test]
async fn a_key_changes_what_it_has_stored_and_admin_everything() {
    let app = with_keys(ServeLimits::default());
    let uri = "/v1/materials/glass";
    for (method, key, status) in [
        (Method::PUT, "r", 403),
        (Method::PUT, "k", 201),
        (Method::PUT, "o", 403),
        (Method::DELETE, "o", 403),
        (Method::GET, "o", 200),
        (Method::PUT, "k", 200),
        (Method::PUT, "a", 200),
        (Method::DELETE, "k", 403),
        (Method::DELETE, "a", 204),
        (Method::PUT, "o", 201),
        (Method::DELETE, "o", 204),
    ] {
        let key = format!("Bearer {key}");
        let (found, ..) = send(&app, method.clone(), uri, &[("authorization", &key)], GLASS).await;
        assert_eq!(found.as_u16(), status, "{method} {key}");
    }
    let job = "MODEL = Lambertian_BRDF_Model VARIABLES: incidentangle = 0 incidentpol = (1,0,0,0) \
        rotation = 0 differential = 1 minsamples = 10 END VARY: END INTEGRALS: R = HEMI END END \
        OUTPUTS: 1 R END FILES: END";
    let headers = |key| [("authorization", key), ("content-type", "application/x-mist")];
    let (status, answer, bytes) =
        send(&app, Method::POST, "/v1/jobs", &headers("Bearer k"), job).await;
    assert_eq!(status, 202, "{}", String::from_utf8_lossy(&bytes));
    let uri = answer["location"].to_str().unwrap();
    assert_eq!(send(&app, Method::DELETE, uri, &headers("Bearer o"), "").await.0, 403);
    assert_eq!(send(&app, Method::DELETE, uri, &headers("Bearer k"), "").await.0.as_u16() / 100, 2);
}

#[tokio::test]
async fn a_key_that_may_only_look_computes_within_small_limits() {
    let limits = ServeLimits { max_read_evaluations: 10.0, ..ServeLimits::default() };
    let app = with_keys(limits);
    let put = [("authorization", "Bearer k")];
    send(&app, Method::PUT, "/v1/materials/glass", &put, GLASS).await;
    let table = |nodes| {
        format!("/v1/materials/glass/table.mtab?thetai=0&thetas={nodes}&phis=0&lambda=400,500")
    };
    let read = [("authorization", "Bearer r")];
    assert_eq!(send(&app, Method::GET, &table("0,10"), &read, "").await.0, 200);
    let (status, _, bytes) = send(&app, Method::GET, &table("0:1:80"), &read, "").await;
    assert_eq!(status, 422, "{}", String::from_utf8_lossy(&bytes));
    assert_eq!(send(&app, Method::GET, &table("0:1:80"), &put, "").await.0, 200);
}

#[tokio::test]
async fn guesses_of_keys_are_slowed_down() {
    let app = with_keys(ServeLimits::default());
    let begun = Instant::now();
    for _ in 0..5 {
        assert_eq!(send(&app, Method::GET, "/v1/models", &[], "").await.0, 401);
    }
    assert!(begun.elapsed() >= Duration::from_millis(900), "{:?}", begun.elapsed());
}

#[cfg(unix)]
#[test]
fn what_is_stored_can_be_read_by_its_owner_only() {
    use std::os::unix::fs::PermissionsExt;
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("new").join("data");
    let app = App::new(ServeLimits::default(), Some(&folder), None).unwrap();
    let mode = |path: &std::path::Path| path.metadata().unwrap().permissions().mode() & 0o777;
    assert_eq!((mode(&folder), mode(&folder.join("mist.redb"))), (0o700, 0o600));
    app.stop();
}
