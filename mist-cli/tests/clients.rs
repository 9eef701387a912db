//! The clients in `clients/` against the real service on loopback.

use std::{
    fs,
    io::{BufRead, BufReader},
    path::Path,
    process::{Child, Command, Output, Stdio},
};

/// A running service; it dies with the test.
struct Service {
    process: Child,
    url: String,
}

impl Service {
    fn start() -> Self {
        let mut process = Command::new(env!("CARGO_BIN_EXE_mist"))
            .args(["serve", "--listen", "127.0.0.1:0"])
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(process.stderr.take().unwrap());
        let mut line = String::new();
        while !line.contains("http://") {
            line.clear();
            assert!(lines.read_line(&mut line).unwrap() > 0, "the service does not listen");
        }
        let url = line[line.find("http://").unwrap()..].trim().to_owned();
        // Nobody waits for a log that nobody reads.
        std::thread::spawn(move || std::io::copy(&mut lines, &mut std::io::sink()));
        Self { process, url }
    }
}

impl Drop for Service {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// The output of a tool; `None`, with the reason on stderr, where it is not installed. In
/// continuous integration (`CI` is set) it must be.
#[expect(clippy::print_stderr, reason = "a test that could not be made says so")]
fn run(command: &mut Command) -> Option<Output> {
    match command.output() {
        Ok(output) => Some(output),
        Err(error) => {
            assert!(std::env::var_os("CI").is_none(), "{command:?} belongs to the tests: {error}");
            eprintln!("not tested, {command:?} cannot be started: {error}");
            None
        }
    }
}

fn clients() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../clients"))
}

#[test]
fn the_python_client_passes_its_tests_with_and_without_numpy() {
    let service = Service::start();
    let script = clients().join("python/test_mist_client.py");
    // -I leaves out what users have installed, numpy too.
    let path = format!("import sys; sys.path.insert(0, {:?})", clients().join("python"));
    let isolated =
        format!("{path}; sys.argv[:] = ['test', {:?}]; exec(open({script:?}).read())", service.url);
    let (mut plain, mut bare) = (Command::new("python3"), Command::new("python3"));
    for command in [plain.arg(&script).arg(&service.url), bare.args(["-ISc", &isolated])] {
        if let Some(output) = run(command.env("PYTHONDONTWRITEBYTECODE", "1")) {
            let told = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success() && told.contains("\nOK"), "{told}");
        }
    }
}

/// Three numbers per line.
fn numbers(output: &Output) -> Vec<f64> {
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    text.split_whitespace().map(|word| word.parse().unwrap()).collect()
}

#[test]
fn the_header_for_cpp_reads_tables_as_they_are_and_refuses_others() {
    let dir = tempfile::tempdir().unwrap();
    let program = dir.path().join("example");
    let mut compiler = Command::new("c++");
    compiler.args(["-std=c++17", "-Wall", "-Wextra", "-Werror", "-o"]).arg(&program);
    let Some(built) = run(compiler.arg(clients().join("cpp/example.cpp"))) else { return };
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));

    let service = Service::start();
    let material =
        r#"{"model":"Facet_BRDF_Model","parameters":{"substrate":"(1.5,0)","sdf.s":0.3}}"#;
    let glass = format!("{}/v1/materials/glass", service.url);
    let table = dir.path().join("glass.mtab");
    let query = "thetai=0:15:75&thetas=0:15:75&phis=0:30:180&lambda=400:50:700&stokes=1";
    let mut put = Command::new("curl");
    let json = "Content-Type: application/json";
    put.args(["-sSf", "-X", "PUT", "-H", json, "-d", material, &glass]);
    let mut get = Command::new("curl");
    get.args(["-sSf", &format!("{glass}/table.mtab?{query}"), "-o"]).arg(&table);
    for command in [&mut put, &mut get] {
        let Some(asked) = run(command) else { return };
        assert!(asked.status.success(), "{}", String::from_utf8_lossy(&asked.stderr));
    }

    // At a node, and at its mirror image behind the mirrored filter.
    let text = fs::read_to_string(&table).unwrap();
    let row = text.lines().find(|line| line.starts_with("45 30 120 ")).unwrap();
    let row: Vec<f64> = row.split(' ').map(|word| word.parse().unwrap()).collect();
    let ask = |phis: &str, filter: &str| {
        numbers(
            &Command::new(&program).arg(&table).args(["45", "30", phis, filter]).output().unwrap(),
        )
    };
    let (here, there) = (ask("120", "30"), ask("-120", "-30"));
    assert_eq!((&here[..3], &there[..]), (&row[4..7], &here[..]));
    let (sin, cos) = 60_f64.to_radians().sin_cos();
    let green = 0.5 * (row[5] + cos * row[9] + sin * row[13]);
    // Nine digits are printed.
    assert!((here[4] - green).abs() < 1e-8 * green.abs(), "{} {green}", here[4]);

    let cut = dir.path().join("cut.mtab");
    let lines: Vec<&str> = text.lines().collect();
    fs::write(&cut, lines[..lines.len() - 2].join("\n")).unwrap();
    let refused = Command::new(&program).arg(&cut).args(["45", "30", "0", "0"]).output().unwrap();
    assert_eq!(refused.status.code(), Some(1));
    let outside = Command::new(&program).arg(&table).args(["80", "30", "0", "0"]).output().unwrap();
    assert_eq!(outside.status.code(), Some(1));
}
