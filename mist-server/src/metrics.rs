//! Counters of the service in the text format of Prometheus.

use std::{
    collections::BTreeMap,
    fmt::Write as _,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
};

/// Methods that are counted under their names.
const METHODS: [&str; 5] = ["GET", "POST", "PUT", "DELETE", "HEAD"];

/// Upper ends of the classes of durations, seconds.
const DURATIONS: [f64; 9] = [0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 10.0, 100.0];

/// Answers by method and status.
type Answers = BTreeMap<(&'static str, u16), u64>;

/// Counters; clones count together.
#[derive(Clone, Debug, Default)]
pub(crate) struct Metrics(Arc<Counters>);

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
    pub(crate) fn count_request(&self, method: &str, route: &str, status: u16, seconds: f64) {
        let key = (known(method), status);
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
    pub(crate) fn count_evaluations(&self, count: usize) {
        self.0.evaluations.fetch_add(count as u64, Ordering::Relaxed);
    }

    /// A table that was asked for; `shared` if it did not have to be computed for this request.
    pub(crate) fn count_table(&self, shared: bool) {
        self.0.tables.fetch_add(1, Ordering::Relaxed);
        self.0.shared_tables.fetch_add(u64::from(shared), Ordering::Relaxed);
    }

    /// The counters.
    pub(crate) fn text(&self) -> String {
        let mut text = String::new();
        write_head(&mut text, "mist_requests_total", "counter", "Requests answered.");
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
        write_head(&mut text, name, "histogram", "How long requests took.");
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
            write_head(&mut text, name, "counter", help);
            let _ = writeln!(text, "{name} {}", count.load(Ordering::Relaxed));
        }
        text
    }
}

/// A method that is counted under its name; clients may invent any number of others.
fn known(method: &str) -> &'static str {
    METHODS.into_iter().find(|known| *known == method).unwrap_or("other")
}

/// Appends the first lines of a metric to `text`.
fn write_head(text: &mut String, name: &str, kind: &str, help: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "# HELP {name} {help}\n# TYPE {name} {kind}");
}

/// Appends a gauge to `text`.
pub(crate) fn write_gauge(text: &mut String, name: &str, help: &str, value: usize) {
    write_head(text, name, "gauge", help);
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{name} {value}");
}

/// Appends the number of jobs in each state to `text`.
pub(crate) fn write_jobs(text: &mut String, counts: &[(&'static str, usize)]) {
    let name = "mist_jobs";
    write_head(text, name, "gauge", "Jobs by state.");
    for (state, count) in counts {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name}{{state=\"{state}\"}} {count}");
    }
}
