//! A real service on loopback.

use std::{
    io::{BufRead, BufReader, Read, Write},
    net::TcpStream,
    path::Path,
    process::{Child, Command, Stdio},
    time::{Duration, Instant},
};

use serde_json::{Value, json};

/// A running service; it dies with the test.
pub(crate) struct Service {
    pub(crate) process: Child,
    pub(crate) address: String,
}

impl Service {
    pub(crate) fn start(data: &Path, more: &[&str]) -> Self {
        Self::begin(Command::new(env!("CARGO_BIN_EXE_mist")), data, more)
    }

    /// A service that `command` runs with the arguments that are added.
    pub(crate) fn begin(mut command: Command, data: &Path, more: &[&str]) -> Self {
        let mut process = command
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

    /// A connection that does not wait for ever.
    pub(crate) fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(&self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        stream
    }

    /// The body of the answer and its status.
    pub(crate) fn ask(&self, method: &str, path: &str, body: &str) -> (u16, String) {
        let mut stream = self.connect();
        // HTTP/1.0: the connection ends with the answer.
        let head = format!(
            "{method} {path} HTTP/1.0\r\nHost: localhost\r\nContent-Type: application/json\r\n\
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

    pub(crate) fn submit(&self, program: &str) -> String {
        let (status, text) =
            self.ask("POST", "/v1/jobs", &json!({ "program": program }).to_string());
        assert_eq!(status, 202, "{text}");
        let accepted: Value = serde_json::from_str(&text).unwrap();
        accepted["id"].as_str().unwrap().to_owned()
    }

    /// The status of a job as soon as `good` likes it.
    pub(crate) fn wait(&self, id: &str, good: impl Fn(&Value) -> bool) -> Value {
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

    pub(crate) fn results(&self, id: &str) -> String {
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
