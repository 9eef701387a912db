//! Tags, preconditions and methods as HTTP defines them.

use axum::http::{Method, StatusCode};
use mist_server::http::App;

use crate::ask::{GLASS, ask, send};

const URI: &str = "/v1/materials/glass";

#[tokio::test]
async fn a_material_is_created_replaced_and_changed_only_as_it_is_known() {
    let app = App::default();
    let (status, created, _) = send(&app, Method::PUT, URI, &[], GLASS).await;
    assert_eq!((status, &created["location"]), (StatusCode::CREATED, &URI.parse().unwrap()));
    let tag = created["etag"].to_str().unwrap();
    let other = GLASS.replace("0.3", "0.4");
    let put = async |name, tag| send(&app, Method::PUT, URI, &[(name, tag)], other.clone()).await.0;
    assert_eq!(put("if-match", "\"sha256-0\"").await, StatusCode::PRECONDITION_FAILED);
    assert_eq!(put("if-none-match", "*").await, StatusCode::PRECONDITION_FAILED);
    let known = [("if-none-match", tag)];
    assert_eq!(send(&app, Method::GET, URI, &known, "").await.0, StatusCode::NOT_MODIFIED);
    assert_eq!(put("if-match", tag).await, StatusCode::OK);
    let (status, got, _) = send(&app, Method::GET, URI, &known, "").await;
    assert_eq!(status, StatusCode::OK);
    assert_ne!(got["etag"], tag);
    let delete = async |tag| send(&app, Method::DELETE, URI, &[("if-match", tag)], "").await.0;
    assert_eq!(delete(tag).await, StatusCode::PRECONDITION_FAILED);
    assert_eq!(delete("*").await, StatusCode::NO_CONTENT);
    assert_eq!(put("if-match", "*").await, StatusCode::PRECONDITION_FAILED);
}

#[tokio::test]
async fn a_compressed_answer_has_a_tag_of_its_own() {
    let app = App::default();
    ask(&app, Method::PUT, URI, None, GLASS).await;
    let table = format!("{URI}/table.mtab?thetai=0:30:60&thetas=0:30:60&phis=0&lambda=400:50:700");
    let (_, plain, _) = send(&app, Method::GET, &table, &[], "").await;
    let gzip = [("accept-encoding", "gzip")];
    let (_, packed, _) = send(&app, Method::GET, &table, &gzip, "").await;
    let weak = format!("W/{}", plain["etag"].to_str().unwrap());
    assert_eq!(packed["etag"], weak.as_str());
    let known = [("accept-encoding", "gzip"), ("if-none-match", weak.as_str())];
    assert_eq!(send(&app, Method::GET, &table, &known, "").await.0, StatusCode::NOT_MODIFIED);
}

#[tokio::test]
async fn options_names_the_methods_and_head_is_get_without_a_body() {
    let app = App::default();
    let (status, answer, _) = send(&app, Method::OPTIONS, "/v1/jobs", &[], "").await;
    assert_eq!(status, StatusCode::NO_CONTENT);
    let allow = answer["allow"].to_str().unwrap();
    assert!(allow.contains("GET") && allow.contains("POST"), "{allow}");
    let (status, _, bytes) = send(&app, Method::HEAD, "/v1/models", &[], "").await;
    assert_eq!((status, bytes.len()), (StatusCode::OK, 0));
}

#[tokio::test]
async fn a_problem_has_the_members_of_rfc_9457() {
    let problem = ask(&App::default(), Method::GET, URI, None, "").await.json();
    assert_eq!((&problem["type"], &problem["title"]), (&"about:blank".into(), &"Not Found".into()));
    assert_eq!(problem["detail"], problem["message"]);
}
