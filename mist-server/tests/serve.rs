//! The real service on loopback: crashes, stops, and the examples of `docs/http.md`.

use std::{
    fs,
    io::{BufRead, BufReader, Read, Write},
    net::TcpStream,
    path::Path,
    process::{Child, Command, Stdio},
    time::{Duration, Instant},
};

use serde_json::{Value, json};

/// A running service; it dies with the test.
struct Service {
    process: Child,
    address: String,
}

impl Service {
    fn start(data: &Path, more: &[&str]) -> Self {
        let mut process = Command::new(env!("CARGO_BIN_EXE_mist"))
            .args(["serve", "--listen", "127.0.0.1:0", "--data"])
            .arg(data)
            .args(more)
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(process.stderr.take().unwrap());
        let mut line = String::new();
        while !line.contains("listening on http://") {
            line.clear();
            assert!(lines.read_line(&mut line).unwrap() > 0, "the service does not listen");
        }
        let address = line.trim().rsplit('/').next().unwrap().to_owned();
        // Nobody waits for a log that nobody reads.
        std::thread::spawn(move || std::io::copy(&mut lines, &mut std::io::sink()));
        Self { process, address }
    }

    /// The body of the answer and its status.
    fn ask(&self, method: &str, path: &str, body: &str) -> (u16, String) {
        let mut stream = TcpStream::connect(&self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        // HTTP/1.0: the connection ends with the answer.
        let head = format!(
            "{method} {path} HTTP/1.0\r\nHost: mist\r\nContent-Type: application/json\r\n\
             Content-Length: {}\r\n\r\n",
            body.len()
        );
        stream.write_all(head.as_bytes()).unwrap();
        stream.write_all(body.as_bytes()).unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        (head.split(' ').nth(1).unwrap().parse().unwrap(), body.to_owned())
    }

    fn submit(&self, program: &str) -> String {
        let (status, text) =
            self.ask("POST", "/v1/jobs", &json!({ "program": program }).to_string());
        assert_eq!(status, 202, "{text}");
        let accepted: Value = serde_json::from_str(&text).unwrap();
        accepted["id"].as_str().unwrap().to_owned()
    }

    /// The status of a job as soon as `good` likes it.
    fn wait(&self, id: &str, good: impl Fn(&Value) -> bool) -> Value {
        let begun = Instant::now();
        loop {
            let (code, text) = self.ask("GET", &format!("/v1/jobs/{id}"), "");
            assert_eq!(code, 200, "{text}");
            let status: Value = serde_json::from_str(&text).unwrap();
            if good(&status) {
                return status;
            }
            assert!(begun.elapsed() < Duration::from_secs(300), "{status}");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    fn results(&self, id: &str) -> String {
        let status = self.wait(id, |status| status["finished"].is_number());
        assert_eq!(status["state"], "done", "{status}");
        self.ask("GET", &format!("/v1/jobs/{id}/results"), "").1
    }
}

impl Drop for Service {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// A job of some seconds with many steps.
const LONG: &str = "MODEL = Facet_BRDF_Model\nVARIABLES:\n\
    rad = atan(1)/45 t = 0 incidentangle = t*rad incidentpol = (1,0.2,0.1,0) rotation = 0\n\
    differential = (0.7*rad)^2 minsamples = 100 END\n\
    VARY:\nFOR t FROM 0 TO 80 BY 0.1\nEND\nINTEGRALS: R = HEMI END END\nOUTPUTS: 1 R END\n\
    FILES: format = %.17g\\t END\n";

#[test]
fn a_job_that_was_killed_in_the_middle_goes_on_to_the_table_of_an_undisturbed_run() {
    let data = tempfile::tempdir().unwrap();
    let mut service = Service::start(data.path(), &[]);
    let id = service.submit(LONG);
    service.wait(&id, |status| status["progress"].as_f64().unwrap() > 0.3);
    // SIGKILL: nothing can be tidied up.
    service.process.kill().unwrap();
    service.process.wait().unwrap();
    let service = Service::start(data.path(), &[]);
    let disturbed = service.results(&id);
    let status = service.wait(&id, |_| true);
    assert!(status["resumed_after"].as_u64().unwrap_or(0) > 0, "{status}");
    let undisturbed = service.results(&service.submit(LONG));
    assert!(disturbed == undisturbed, "the tables differ");
}

#[cfg(unix)]
#[test]
fn a_service_that_is_asked_to_stop_keeps_what_its_job_has_done() {
    let data = tempfile::tempdir().unwrap();
    let mut service = Service::start(data.path(), &[]);
    let put = r#"{"model":"Lambertian_BRDF_Model"}"#;
    assert_eq!(service.ask("PUT", "/v1/materials/white", put).0, 201);
    let id = service.submit(LONG);
    service.wait(&id, |status| status["progress"].as_f64().unwrap() > 0.1);
    let kill = Command::new("kill").arg(service.process.id().to_string()).status().unwrap();
    assert!(kill.success());
    assert!(service.process.wait().unwrap().success());
    let service = Service::start(data.path(), &[]);
    assert!(service.ask("GET", "/v1/materials", "").1.contains("white"));
    service.results(&id);
    assert!(service.wait(&id, |_| true)["resumed_after"].as_u64().unwrap() > 0);
}

#[test]
fn a_client_that_is_slow_or_gone_does_not_stop_the_others() {
    let data = tempfile::tempdir().unwrap();
    let service = Service::start(data.path(), &["--max-silence", "1", "--max-connections", "64"]);
    let connect = || TcpStream::connect(&service.address).unwrap();
    let mut slow: Vec<TcpStream> = (0..20).map(|_| connect()).collect();
    for stream in &mut slow {
        stream.write_all(b"GET /healthz HTTP/1.1\r\nHost").unwrap();
    }
    for _ in 0..20 {
        let mut gone = connect();
        gone.write_all(b"POST /v1/run HTTP/1.1\r\nHost: a\r\nContent-Length: 1000\r\n\r\nMODEL")
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

#[test]
fn a_key_that_mist_key_made_opens_the_service() {
    let data = tempfile::tempdir().unwrap();
    let made = Command::new(env!("CARGO_BIN_EXE_mist")).args(["key", "farm"]).output().unwrap();
    let key = String::from_utf8(made.stderr).unwrap();
    let file = data.path().join("keys");
    fs::write(&file, made.stdout).unwrap();
    assert!(!fs::read_to_string(&file).unwrap().contains(key.trim()));
    let service = Service::start(data.path(), &["--keys", file.to_str().unwrap()]);
    assert_eq!(service.ask("GET", "/v1/materials", "").0, 401);
    let with_key =
        format!("GET /v1/materials HTTP/1.0\r\nAuthorization: Bearer {}\r\n\r\n", key.trim());
    let mut stream = TcpStream::connect(&service.address).unwrap();
    stream.write_all(with_key.as_bytes()).unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    assert!(answer.contains("200 OK"), "{answer}");
}

/// The blocks of a document: the word behind the fence, and the text.
fn blocks(document: &str) -> Vec<(String, String)> {
    let mut blocks: Vec<(String, String)> = Vec::new();
    let mut is_open = false;
    for line in document.lines() {
        if let Some(word) = line.strip_prefix("```") {
            if !is_open {
                blocks.push((word.to_owned(), String::new()));
            }
            is_open = !is_open;
        } else if is_open {
            let (_, text) = blocks.last_mut().unwrap();
            text.push_str(line);
            text.push('\n');
        }
    }
    blocks
}

#[cfg(unix)]
#[test]
fn the_examples_of_the_manual_do_what_it_says() {
    if Command::new("curl").arg("--version").output().is_err() {
        eprintln!("there is no curl: the examples are not run");
        return;
    }
    let document = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/http.md");
    let blocks = blocks(&fs::read_to_string(document).unwrap());
    let folder = tempfile::tempdir().unwrap();
    let service = Service::start(&folder.path().join("data"), &[]);
    let words = |text: &str| -> Vec<Vec<String>> {
        text.lines().map(|line| line.split_whitespace().map(str::to_owned).collect()).collect()
    };
    let mut examples = 0;
    for (at, (kind, script)) in blocks.iter().enumerate() {
        if kind != "sh" {
            continue;
        }
        examples += 1;
        let ran = Command::new("sh")
            .args(["-e", "-c", script])
            .env("URL", format!("http://{}", service.address))
            .current_dir(folder.path())
            .output()
            .unwrap();
        let (out, err) =
            (String::from_utf8_lossy(&ran.stdout), String::from_utf8_lossy(&ran.stderr));
        assert!(ran.status.success(), "{script}\n{out}\n{err}");
        assert!(!out.contains("\"status\":"), "{script}\n{out}");
        if let Some((_, expected)) = blocks.get(at + 1).filter(|(kind, _)| kind == "text") {
            assert_eq!(words(&out), words(expected), "{script}\n{out}\n{err}");
        }
    }
    assert!(examples >= 10, "{examples} examples");
}
