//! What the service counts, as Prometheus reads it.

use std::{
    collections::BTreeMap,
    fmt::Write as _,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
};

use axum::{
    extract::State,
    http::{Method, header},
    response::IntoResponse,
};

use super::{App, problem::Problems};

/// Upper ends of the classes of durations, seconds.
const DURATIONS: [f64; 9] = [0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 10.0, 100.0];

/// Answers by method and status.
type Answers = BTreeMap<(&'static str, u16), u64>;

/// Counters; clones count together.
#[derive(Clone, Debug, Default)]
pub(super) struct Metrics(Arc<Counters>);

#[derive(Debug, Default)]
struct Counters {
    /// By route.
    requests: Mutex<BTreeMap<String, Answers>>,
    durations: [AtomicU64; DURATIONS.len() + 1],
    microseconds: AtomicU64,
    evaluations: AtomicU64,
    tables: AtomicU64,
    shared_tables: AtomicU64,
}

impl Metrics {
    /// A request that was answered.
    pub(super) fn count_request(&self, method: &Method, route: &str, status: u16, seconds: f64) {
        let key = (name(method), status);
        let mut requests = self.0.requests.lock().unwrap_or_else(PoisonError::into_inner);
        match requests.get_mut(route) {
            Some(counts) => *counts.entry(key).or_default() += 1,
            None => {
                requests.insert(route.to_owned(), [(key, 1)].into());
            }
        }
        drop(requests);
        let class = DURATIONS.iter().position(|end| seconds <= *end).unwrap_or(DURATIONS.len());
        self.0.durations[class].fetch_add(1, Ordering::Relaxed);
        // A duration of 500,000 years would be needed to overflow.
        self.0.microseconds.fetch_add((seconds * 1e6) as u64, Ordering::Relaxed);
    }

    /// Evaluations of models for renderers.
    pub(super) fn count_evaluations(&self, count: usize) {
        self.0.evaluations.fetch_add(count as u64, Ordering::Relaxed);
    }

    /// A table that was asked for; `shared` if nobody had to compute it for this asker.
    pub(super) fn count_table(&self, shared: bool) {
        self.0.tables.fetch_add(1, Ordering::Relaxed);
        self.0.shared_tables.fetch_add(u64::from(shared), Ordering::Relaxed);
    }

    fn write(&self, text: &mut String) {
        family(text, "mist_requests_total", "counter", "Requests answered.");
        let requests = self.0.requests.lock().unwrap_or_else(PoisonError::into_inner);
        let each =
            requests.iter().flat_map(|(route, counts)| counts.iter().map(move |c| (route, c)));
        for (route, ((method, status), count)) in each {
            let labels = format!("method=\"{method}\",route=\"{route}\",status=\"{status}\"");
            // Writing to a string cannot fail.
            let _ = writeln!(text, "mist_requests_total{{{labels}}} {count}");
        }
        drop(requests);
        let name = "mist_request_duration_seconds";
        family(text, name, "histogram", "How long requests took.");
        let mut sum = 0;
        for (class, count) in self.0.durations.iter().enumerate() {
            sum += count.load(Ordering::Relaxed);
            let end = DURATIONS.get(class).map_or_else(|| "+Inf".to_owned(), f64::to_string);
            let _ = writeln!(text, "{name}_bucket{{le=\"{end}\"}} {sum}");
        }
        let seconds = self.0.microseconds.load(Ordering::Relaxed) as f64 * 1e-6;
        let _ = writeln!(text, "{name}_sum {seconds}\n{name}_count {sum}");
        for (name, count, help) in [
            ("mist_evaluations_total", &self.0.evaluations, "Evaluations for renderers."),
            ("mist_tables_total", &self.0.tables, "Tables asked for."),
            ("mist_tables_shared_total", &self.0.shared_tables, "Tables that were there already."),
        ] {
            family(text, name, "counter", help);
            let _ = writeln!(text, "{name} {}", count.load(Ordering::Relaxed));
        }
    }
}

/// The name of a method; clients may invent any number of others.
fn name(method: &Method) -> &'static str {
    let known = [Method::GET, Method::POST, Method::PUT, Method::DELETE, Method::HEAD];
    let at = known.iter().position(|known| known == method);
    at.map_or("other", |at| ["GET", "POST", "PUT", "DELETE", "HEAD"][at])
}

fn family(text: &mut String, name: &str, kind: &str, help: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "# HELP {name} {help}\n# TYPE {name} {kind}");
}

fn gauge(text: &mut String, name: &str, help: &str, value: usize) {
    family(text, name, "gauge", help);
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{name} {value}");
}

/// Counters and gauges in the text format of Prometheus.
#[utoipa::path(
    get,
    path = "/metrics",
    tag = "service",
    responses((status = 200, description = "Prometheus text", body = String), Problems),
)]
pub(super) async fn metrics(State(app): State<App>) -> impl IntoResponse {
    let mut text = String::new();
    app.metrics.write(&mut text);
    gauge(&mut text, "mist_materials", "Materials kept.", app.materials.len());
    gauge(&mut text, "mist_computing_waiting", "Answers that wait.", app.compute.waiting());
    gauge(&mut text, "mist_memory_held_bytes", "Bytes held by requests.", app.memory.held());
    gauge(&mut text, "mist_tables_kept_bytes", "Bytes of tables kept.", app.flights.bytes());
    let name = "mist_jobs";
    family(&mut text, name, "gauge", "Jobs by state.");
    for (state, count) in app.jobs.counts() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name}{{state=\"{state}\"}} {count}");
    }
    ([(header::CONTENT_TYPE, "text/plain; version=0.0.4; charset=utf-8")], text)
}
