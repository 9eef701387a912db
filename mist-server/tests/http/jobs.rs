//! Programs over HTTP: at once, and in the background.

use std::time::Duration;

use axum::http::{Method, StatusCode};
use mist_engine::{Control, MemoryFiles, MemorySink, Options, compile};
use mist_server::{ServeLimits, http::App};
use serde_json::{Value, json};

use crate::ask::{Answer, ask, send};

/// A small table with a data file, a title, samples and colours.
pub(crate) const PROGRAM: &str = "MODEL = Lambertian_BRDF_Model\nVARIABLES:\n\
    rad = atan(1)/45 $reflectance.table = r.txt wl = 0.4 #lambda = wl thetai = 0\n\
    incidentangle = thetai*rad incidentpol = (1,0,0,0) rotation = 0\n\
    differential = (5*rad)^2 minsamples = 10 END\n\
    VARY:\nFOR thetai FROM 0 TO 60 BY 30\nFOR wl FROM 0.4 TO 0.7 BY 0.05\nEND\n\
    INTEGRALS: R = CIRCLE CENTER = (0,0) ALPHA = 10*deg END END\nOUTPUTS: 1 f=R/pi END\n\
    FILES: header = \"a white sample\" samples = s.txt END\n\
    COLOR:\nwavelength = wl\nspectrum = f\nquantity = factor\nEND\n";

const WHITE: &str = "0.3 0.5\n0.9 0.5\n";

fn body() -> Value {
    json!({"program": PROGRAM, "files": {"r.txt": WHITE}})
}

/// The results of the engine for the program.
fn expected() -> MemorySink {
    let files = MemoryFiles([("r.txt".to_owned(), WHITE.into())].into());
    let job = compile(PROGRAM, std::sync::Arc::new(files), &Options::default())
        .unwrap_or_else(|found| panic!("{found:?}"));
    let mut sink = MemorySink::default();
    job.run(&mut sink, &Control::default()).unwrap();
    sink
}

/// The status of a job once it is over.
pub(crate) async fn over(app: &App, id: &str) -> Value {
    for _ in 0..2000 {
        let status = ask(app, Method::GET, &format!("/v1/jobs/{id}"), None, "").await.json();
        if !["queued", "running"].contains(&status["state"].as_str().unwrap()) {
            return status;
        }
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    panic!("the job does not end");
}

pub(crate) async fn post_json(app: &App, uri: &str, body: &Value) -> Answer {
    let kind = [("content-type", "application/json")];
    let (status, headers, bytes) = send(app, Method::POST, uri, &kind, body.to_string()).await;
    Answer { status, headers, tag: None, text: String::from_utf8(bytes).unwrap() }
}

#[tokio::test]
async fn a_program_gives_its_table_as_text_csv_and_json() {
    let app = App::default();
    let results = expected().results;
    let text = post_json(&app, "/v1/run", &body()).await;
    assert_eq!((text.status, &text.text), (StatusCode::OK, &results));
    let kind = ("content-type", "application/json");
    for (accept, starts) in [("text/csv", "thetai,wl"), ("application/json", "{\"columns\":[")] {
        let headers = [kind, ("accept", accept)];
        let (status, headers, bytes) =
            send(&app, Method::POST, "/v1/run", &headers, body().to_string()).await;
        let text = String::from_utf8(bytes).unwrap();
        assert_eq!(status, StatusCode::OK, "{text}");
        assert!(headers["content-type"].to_str().unwrap().starts_with(accept));
        assert!(text.starts_with(starts) || text.starts_with("wl,thetai"), "{text}");
    }
}

#[tokio::test]
async fn a_job_ends_with_the_texts_of_its_run() {
    let app = App::default();
    let accepted = post_json(&app, "/v1/jobs", &body()).await;
    assert_eq!(accepted.status, StatusCode::ACCEPTED, "{}", accepted.text);
    let id = accepted.json()["id"].as_str().unwrap().to_owned();
    let status = over(&app, &id).await;
    assert_eq!((&status["state"], &status["progress"]), (&json!("done"), &json!(1.0)), "{status}");
    let sink = expected();
    let get =
        async |what: &str| ask(&app, Method::GET, &format!("/v1/jobs/{id}/{what}"), None, "").await;
    assert_eq!(get("results").await.text, sink.results);
    assert_eq!(get("samples").await.text, sink.samples);
    assert!(get("listing").await.text.contains("Integrating model: Lambertian_BRDF_Model"));
    assert!(get("table").await.text.starts_with("# MIST-TABLE 1\n"));
    assert!(get("table?format=svg").await.text.contains("<svg"));
    let events = get("events").await.text;
    assert!(events.contains("event: status") && events.contains("\"done\""), "{events}");
    let gone = ask(&app, Method::DELETE, &format!("/v1/jobs/{id}"), None, "").await;
    assert_eq!(gone.status, StatusCode::OK);
    assert_eq!(get("results").await.status, StatusCode::NOT_FOUND);
}

#[tokio::test]
async fn a_check_finds_what_a_run_would_refuse() {
    let app = App::default();
    let well = post_json(&app, "/v1/check", &body()).await;
    assert_eq!((well.status, well.json()), (StatusCode::OK, json!({"diagnostics": []})));
    let mut wrong = body();
    wrong["program"] = json!(PROGRAM.replace("Lambertian", "Lambertain").replace("R/pi", "R/"));
    let found = post_json(&app, "/v1/check", &wrong).await;
    assert_eq!(found.status, StatusCode::OK);
    let found = found.json()["diagnostics"].as_array().unwrap().clone();
    let refused = post_json(&app, "/v1/run", &wrong).await.json();
    assert_eq!(Value::from(found.clone()), refused["diagnostics"]);
    assert_eq!(found.len(), 2, "{found:?}");
    assert_eq!((&found[0]["line"], &found[0]["column"]), (&json!(1), &json!(9)));
}

#[tokio::test]
async fn finished_jobs_make_room_for_others() {
    let limits = ServeLimits { max_stored: 3000, ..ServeLimits::default() };
    let app = App::new(limits, None, None).unwrap();
    for _ in 0..5 {
        let accepted = post_json(&app, "/v1/jobs", &body()).await;
        assert_eq!(accepted.status, StatusCode::ACCEPTED, "{}", accepted.text);
        let id = accepted.json()["id"].as_str().unwrap().to_owned();
        assert_eq!(over(&app, &id).await["state"], "done");
    }
    // Some thousand bytes each: the last is there, and not all are.
    let kept = ask(&app, Method::GET, "/v1/jobs", None, "").await.json();
    assert!((1..=2).contains(&kept.as_array().unwrap().len()), "{kept}");
}

#[tokio::test]
async fn a_wrong_program_is_told_with_its_place_and_a_job_that_fails_says_why() {
    let app = App::default();
    let mut wrong = body();
    wrong["program"] = json!(PROGRAM.replace("Lambertian", "Lambertain"));
    for uri in ["/v1/run", "/v1/jobs"] {
        let refused = post_json(&app, uri, &wrong).await;
        assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
        let problem = refused.json();
        assert_eq!((&problem["line"], &problem["column"]), (&json!(1), &json!(9)), "{problem}");
    }
    let mut missing = body();
    missing["files"] = json!({});
    let id = post_json(&app, "/v1/jobs", &missing).await.json()["id"].as_str().unwrap().to_owned();
    let status = over(&app, &id).await;
    assert_eq!(status["state"], "failed");
    assert!(status["problem"]["message"].as_str().unwrap().contains("r.txt"), "{status}");
    let results = ask(&app, Method::GET, &format!("/v1/jobs/{id}/results"), None, "").await;
    assert_eq!(results.status, StatusCode::CONFLICT);
}

/// A program that runs until it is stopped.
pub(crate) fn endless() -> Value {
    let program = PROGRAM.replace("0.7 BY 0.05", "0.7 BY 0.0000001").replace("COLOR:", "OTHER:");
    let program = program.split("OTHER:").next().unwrap().to_owned();
    json!({"program": program, "files": {"r.txt": WHITE}})
}

#[tokio::test]
async fn a_job_is_cancelled_while_it_runs_and_while_it_waits() {
    let limits = ServeLimits { max_steps: u64::MAX, ..ServeLimits::default() };
    let app = App::new(limits, None, None).unwrap();
    let submit = async || {
        let accepted = post_json(&app, "/v1/jobs", &endless()).await;
        accepted.json()["id"].as_str().unwrap().to_owned()
    };
    let (runs, waits) = (submit().await, submit().await);
    for id in [&waits, &runs] {
        let status = ask(&app, Method::DELETE, &format!("/v1/jobs/{id}"), None, "").await.status;
        assert!(status.is_success(), "{status}");
        assert_eq!(over(&app, id).await["state"], "cancelled");
    }
    app.stop();
}

#[tokio::test]
async fn too_many_jobs_are_refused_with_the_name_of_the_limit() {
    let limits = ServeLimits { max_steps: u64::MAX, max_queued: 3, ..ServeLimits::default() };
    let app = App::new(limits, None, None).unwrap();
    let mut refused = 0;
    for _ in 0..20 {
        let answer = post_json(&app, "/v1/jobs", &endless()).await;
        if answer.status == StatusCode::TOO_MANY_REQUESTS {
            assert!(answer.headers.contains_key("retry-after"));
            assert_eq!(answer.json()["limit"], "max-queued");
            refused += 1;
        } else {
            assert_eq!(answer.status, StatusCode::ACCEPTED, "{}", answer.text);
        }
    }
    assert!(refused >= 16, "{refused}");
    app.stop();
}
