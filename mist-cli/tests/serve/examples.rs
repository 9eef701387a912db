//! The examples of `docs/http.md`, and the key of `mist key`.

use std::{
    fs,
    io::{Read, Write},
    net::TcpStream,
    process::Command,
};

use crate::service::Service;

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
    let with_key = format!(
        "GET /v1/materials HTTP/1.0\r\nHost: localhost\r\nAuthorization: Bearer {}\r\n\r\n",
        key.trim()
    );
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
