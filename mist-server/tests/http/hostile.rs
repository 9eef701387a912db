//! Requests that would keep the service from others: each ends, and others are answered meanwhile.

use std::time::{Duration, Instant};

use axum::http::{Method, StatusCode};
use mist_server::{ServeLimits, http::App};

use crate::ask::{GLASS, ask};

/// Minutes of work on any machine.
const LONG: &str = "/v1/materials/glass/table.mtab?thetai=0:1:80&thetas=0:1:80&phis=0:4:180\
                    &patch=cell&lambda=400:10:700";
/// A table of one row.
const SMALL: &str = "/v1/materials/glass/table.mtab?thetai=30&thetas=20&phis=0&lambda=400:20:700";

/// A grating that needs hours: matrices of 401 rows for every angle.
fn grating() -> String {
    let geometry =
        |k: usize| format!(r#"{{"theta_i":{},"theta_s":0.2,"phi_s":0}}"#, k as f64 * 1e-4);
    let geometries: Vec<String> = (0..10_000).map(geometry).collect();
    format!(
        r#"{{"model":"RCW_BRDF_Model","parameters":{{"order":"200"}},"geometries":[{}]}}"#,
        geometries.join(",")
    )
}

fn with(change: impl FnOnce(&mut ServeLimits)) -> App {
    let mut limits = ServeLimits::default();
    change(&mut limits);
    App::new(limits, None, None).unwrap()
}

/// The number that the metrics give for `name`.
async fn metric(app: &App, name: &str) -> f64 {
    let text = ask(app, Method::GET, "/metrics", None, "").await.text;
    let line = text.lines().find(|line| line.starts_with(&format!("{name} "))).unwrap();
    line.rsplit(' ').next().unwrap().parse().unwrap()
}

/// Waits until nothing is computed any more.
async fn idle(app: &App, most: Duration) {
    let begun = Instant::now();
    while metric(app, "mist_computing").await > 0.0 {
        assert!(begun.elapsed() < most, "still computing after {:?}", begun.elapsed());
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn gratings_of_200_orders_end_at_the_time_limit() {
    let app = with(|limits| limits.max_time = 1.0);
    let begun = Instant::now();
    let body = grating();
    let asks = [0, 1].map(|_| {
        let (app, body) = (app.clone(), body.clone());
        tokio::spawn(async move { ask(&app, Method::POST, "/v1/evaluate", None, &body).await })
    });
    for answer in asks {
        let answer = answer.await.unwrap();
        assert_eq!(answer.status, StatusCode::UNPROCESSABLE_ENTITY, "{}", answer.text);
        assert_eq!(answer.json()["limit"], "max-time");
    }
    // An operation on matrices that cannot be interrupted, on a loaded machine.
    idle(&app, Duration::from_secs(10)).await;
    assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_computation_ends_when_its_client_leaves() {
    let app = App::default();
    let body = grating();
    let gone = ask(&app, Method::POST, "/v1/evaluate", None, &body);
    assert!(tokio::time::timeout(Duration::from_millis(500), gone).await.is_err());
    idle(&app, Duration::from_secs(10)).await;
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let gone = ask(&app, Method::GET, LONG, None, "");
    assert!(tokio::time::timeout(Duration::from_millis(500), gone).await.is_err());
    idle(&app, Duration::from_secs(10)).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_promise_that_nobody_asks_for_again_ends() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let promised = ask(&app, Method::GET, &format!("{LONG}&wait=0"), None, "").await;
    assert_eq!(promised.status, StatusCode::ACCEPTED);
    assert!(metric(&app, "mist_computing").await > 0.0);
    idle(&app, Duration::from_secs(30)).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn more_evaluations_than_allowed_are_refused() {
    let app = with(|limits| limits.max_evaluations = 100.0);
    let answer = ask(&app, Method::POST, "/v1/evaluate", None, &grating()).await;
    assert_eq!(answer.json()["limit"], "max-evaluations", "{}", answer.text);
}

#[tokio::test(flavor = "multi_thread")]
async fn small_tables_are_quick_beside_a_long_one_of_the_same_client() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    for wait in 0..3 {
        let long = format!("{LONG}&wait=0&digits={}", 9 + wait);
        assert_eq!(ask(&app, Method::GET, &long, None, "").await.status, StatusCode::ACCEPTED);
    }
    let mut times = Vec::new();
    for angle in 0..40 {
        let begun = Instant::now();
        let uri = SMALL.replace("thetas=20", &format!("thetas={angle}"));
        assert_eq!(ask(&app, Method::GET, &uri, None, "").await.status, StatusCode::OK);
        times.push(begun.elapsed());
    }
    times.sort();
    assert!(metric(&app, "mist_computing").await > 0.0);
    // Milliseconds on an idle machine.
    assert!(times[20] < Duration::from_secs(1), "{times:?}");
    assert!(times[39] < Duration::from_secs(10), "{times:?}");
    let put = ask(&app, Method::PUT, "/v1/materials/other", None, GLASS).await;
    assert_eq!(put.status, StatusCode::CREATED);
}

#[tokio::test(flavor = "multi_thread")]
async fn abandoned_promises_without_number_stop_nobody() {
    let app = App::default();
    ask(&app, Method::PUT, "/v1/materials/glass", None, GLASS).await;
    let mut refused = 0;
    for angle in 0..262 {
        let uri = format!("{LONG}&wait=0&incident=1,0,0,{}", f64::from(angle) * 1e-3);
        let status = ask(&app, Method::GET, &uri, None, "").await.status;
        refused += usize::from(status != StatusCode::ACCEPTED);
    }
    assert!(refused > 0);
    assert_eq!(ask(&app, Method::GET, SMALL, None, "").await.status, StatusCode::OK);
    let ready = ask(&app, Method::GET, "/readyz", None, "").await;
    assert_eq!(ready.status, StatusCode::OK, "{}", ready.text);
}
