//! Clients that are slow, gone or too many, and a disk that is full.

use std::{
    fs,
    io::{BufRead, BufReader, Read, Write},
    net::TcpStream,
    process::Command,
    time::Duration,
};

use serde_json::json;

use crate::{restarts::LONG, service::Service};

#[test]
fn a_client_that_is_slow_or_gone_does_not_stop_the_others() {
    let data = tempfile::tempdir().unwrap();
    let service = Service::start(data.path(), &["--max-silence", "1", "--max-connections", "64"]);
    let mut slow: Vec<TcpStream> = (0..20).map(|_| service.connect()).collect();
    for stream in &mut slow {
        stream.write_all(b"GET /healthz HTTP/1.1\r\nHost").unwrap();
    }
    for _ in 0..20 {
        let mut gone = service.connect();
        gone.write_all(b"POST /v1/run HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/x-mist\r\nContent-Length: 1000\r\n\r\nMODEL")
            .unwrap();
    }
    assert_eq!(service.ask("GET", "/healthz", ""), (200, "ok\n".into()));
    for stream in &mut slow {
        stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        // The connection is closed, with or without a word.
        let _ = stream.read_to_end(&mut Vec::new());
    }
    assert_eq!(service.ask("GET", "/healthz", ""), (200, "ok\n".into()));
}

/// A table of some seconds and megabytes.
const LARGE: &str = "/v1/materials/glass/table.mtab?thetai=0:5:80&thetas=0:1:80&phis=0:2:180\
                     &lambda=400:50:700&digits=17";

fn put_glass(service: &Service) {
    let glass = r#"{"model":"Facet_BRDF_Model","parameters":{"substrate":"(1.5,0)","sdf.s":0.3}}"#;
    let (status, text) = service.ask("PUT", "/v1/materials/glass", glass);
    assert_eq!(status, 201, "{text}");
}

#[test]
fn a_client_that_does_not_read_its_answer_loses_its_place() {
    let data = tempfile::tempdir().unwrap();
    let service = Service::start(data.path(), &["--max-silence", "1", "--max-connections", "1"]);
    put_glass(&service);
    // Once for all: what follows is there already.
    assert_eq!(service.ask("GET", LARGE, "").0, 200);
    let mut deaf = service.connect();
    // More answers than the buffers of the system hold.
    for _ in 0..8 {
        let get = format!("GET {LARGE} HTTP/1.1\r\nHost: localhost\r\n\r\n");
        deaf.write_all(get.as_bytes()).unwrap();
    }
    // There is one place, and this waits for it.
    assert_eq!(service.ask("GET", "/healthz", ""), (200, "ok\n".into()));
    drop(deaf);
}

#[test]
fn what_a_client_that_is_gone_had_asked_for_is_not_computed_on() {
    let data = tempfile::tempdir().unwrap();
    let service = Service::start(data.path(), &["--max-computing", "1", "--max-connections", "64"]);
    put_glass(&service);
    let id = service.submit(LONG);
    for path in [
        // Minutes of work.
        "/v1/materials/glass/table.mtab?thetai=0:1:80&thetas=0:1:80&phis=0:4:180&patch=cell\
         &lambda=400:10:700",
        &format!("/v1/jobs/{id}/events"),
    ] {
        let mut gone = service.connect();
        let get = format!("GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n");
        gone.write_all(get.as_bytes()).unwrap();
        std::thread::sleep(Duration::from_millis(200));
    }
    // There is one place for work, and this waits for it.
    let small = "/v1/materials/glass/table.mtab?thetai=0&thetas=0&phis=0&lambda=400:100:700";
    let (status, text) = service.ask("GET", small, "");
    assert_eq!(status, 200, "{text}");
    assert_eq!(service.ask("DELETE", &format!("/v1/jobs/{id}"), "").0 / 100, 2);
}

#[test]
fn bodies_that_are_announced_and_do_not_come_hold_no_memory() {
    let data = tempfile::tempdir().unwrap();
    let service = Service::start(data.path(), &["--max-memory", "100000000"]);
    let idle: Vec<TcpStream> = (0..100)
        .map(|_| {
            let mut stream = service.connect();
            let head = b"PUT /v1/materials/a HTTP/1.1\r\nHost: localhost\r\n\
                Content-Type: application/json\r\nContent-Length: 16000000\r\n\r\n{";
            stream.write_all(head).unwrap();
            stream
        })
        .collect();
    put_glass(&service);
    // An address has at most 128 connections; those beyond are closed.
    let many: Vec<TcpStream> = (0..60).map(|_| service.connect()).collect();
    let mut more = service.connect();
    let _ = more.write_all(b"GET /healthz HTTP/1.0\r\nHost: localhost\r\n\r\n");
    let mut answer = Vec::new();
    // A reset is a close too.
    let _ = more.read_to_end(&mut answer);
    assert!(answer.is_empty(), "{}", String::from_utf8_lossy(&answer));
    drop((idle, many));
}

/// Memory of the process in use, kB.
#[cfg(target_os = "linux")]
fn resident(service: &Service) -> u64 {
    let status = fs::read_to_string(format!("/proc/{}/status", service.process.id())).unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

/// Sends `count` requests one after the other through one connection; the statuses and whether
/// `Retry-After` came with them.
fn many(stream: TcpStream, request: &str, count: usize) -> Vec<(u16, bool)> {
    let mut writer = stream.try_clone().unwrap();
    let mut reader = BufReader::new(stream);
    let mut answer = || {
        writer.write_all(request.as_bytes()).unwrap();
        let (mut status, mut length, mut again) = (0, 0, false);
        loop {
            let mut line = String::new();
            assert!(reader.read_line(&mut line).unwrap() > 0, "the connection ended");
            let line = line.trim().to_ascii_lowercase();
            if let Some(rest) = line.strip_prefix("http/1.1 ") {
                status = rest.split(' ').next().unwrap().parse().unwrap();
            } else if let Some(rest) = line.strip_prefix("content-length:") {
                length = rest.trim().parse().unwrap();
            } else if line.starts_with("retry-after:") {
                again = true;
            } else if line.is_empty() {
                break;
            }
        }
        reader.read_exact(&mut vec![0; length]).unwrap();
        (status, again)
    };
    (0..count).map(|_| answer()).collect()
}

#[test]
fn ten_thousand_jobs_are_each_accepted_or_put_off() {
    let data = tempfile::tempdir().unwrap();
    let service = Service::start(data.path(), &[]);
    let body = json!({ "program": LONG }).to_string();
    let request = format!(
        "POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n\
         Content-Length: {}\r\n\r\n{body}",
        body.len()
    );
    let answers: Vec<(u16, bool)> = std::thread::scope(|scope| {
        let each = |_| scope.spawn(|| many(service.connect(), &request, 1000));
        let clients: Vec<_> = (0..10).map(each).collect();
        clients.into_iter().flat_map(|client| client.join().unwrap()).collect()
    });
    assert_eq!(answers.len(), 10_000);
    let accepted = answers.iter().filter(|(status, _)| *status == 202).count();
    assert!((100..=210).contains(&accepted), "{accepted} accepted");
    for (status, again) in answers {
        assert!(status == 202 || [429, 503].contains(&status) && again, "{status} {again}");
    }
    assert_eq!(service.ask("GET", "/readyz", "").0, 200);
    #[cfg(target_os = "linux")]
    // Some megabytes of programs and of the job that runs.
    assert!(resident(&service) < 300_000, "{} kB", resident(&service));
}

#[cfg(unix)]
#[test]
fn a_service_whose_disk_is_full_says_so_and_lives() {
    let data = tempfile::tempdir().unwrap();
    // No file may become longer than 8 MiB: writing beyond is an error, as on a full disk.
    let mut limited = Command::new("sh");
    let script = "trap '' XFSZ; ulimit -f 16384; exec \"$0\" \"$@\"";
    limited.args(["-c", script, env!("CARGO_BIN_EXE_mist")]);
    let service = Service::begin(limited, data.path(), &[]);
    put_glass(&service);
    let large = json!({"program": LONG, "files": {"a.txt": "x".repeat(12 << 20)}}).to_string();
    for (method, path) in [("PUT", "/v1/materials/large"), ("POST", "/v1/jobs")] {
        let (status, text) = service.ask(method, path, &large);
        assert_eq!(status, 507, "{text}");
        assert!(text.contains("\"unavailable\""), "{text}");
    }
    // What was there is there, and small things fit.
    assert_eq!(service.ask("GET", "/v1/materials/glass", "").0, 200);
    let id = service.submit(&LONG.replace("BY 0.1", "BY 40"));
    service.results(&id);
}
