//! Files of runs: CSV, pictures, names, replaced files, interruptions, and messages.

use std::{
    fs,
    path::Path,
    process::{Command as Process, Stdio},
    time::{Duration, Instant},
};

use assert_cmd::Command;
use tempfile::TempDir;

const PROGRAM: &str = "\
MODEL = Lambertian_BRDF_Model
VARIABLES:
    t = 0  wl = 400
    incidentangle = t*deg  incidentpol = (1,0,0,0)  rotation = 0
    #lambda = wl/1000
END
VARY:
    FOR t FROM 0 TO 60 BY 30
    FOR wl FROM 400 TO 700 BY 150
END
FILES:
    results = NAME
END
COLOR:
    quantity = brdf
    plot = a.png
    table = a.mtab
END
";

fn folder(name: &str) -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("a.mist"), PROGRAM.replace("NAME", name)).unwrap();
    dir
}

fn mist(dir: &TempDir, words: &[&str]) -> (i32, String, String) {
    let mut command = Command::cargo_bin("mist").unwrap();
    let output = command.current_dir(dir.path()).args(words).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn read(dir: &TempDir, name: &str) -> String {
    fs::read_to_string(dir.path().join(name)).unwrap()
}

#[test]
fn results_and_tables_are_csv_by_their_names() {
    let dir = folder("a.csv");
    assert_eq!(mist(&dir, &["run", "a.mist"]).0, 0);
    let table = read(&dir, "a.csv");
    let mut lines = table.lines();
    let head = "wl (nm),t (deg),brdf.I (1/sr),brdf.Q (1/sr),brdf.U (1/sr),brdf.V (1/sr)";
    assert_eq!(lines.next().unwrap(), head);
    assert_eq!(lines.next().unwrap(), "400,0,0.31831,0,0,0");
    assert!(fs::read(dir.path().join("a.png")).unwrap().starts_with(b"\x89PNG"));
    let words = ["table", "a.mist", "--grid", "thetai=0:30:60,thetas=0,phis=0", "--lambda"];
    let words = [&words[..], &["400:100:700", "-o", "t.csv", "--plot", "t.pdf"]].concat();
    assert_eq!(mist(&dir, &words).0, 0);
    let table = read(&dir, "t.csv");
    assert!(
        table.starts_with("thetai (deg),thetas (deg),phis (deg),omega (sr),R (1/sr)"),
        "{table}"
    );
    assert_eq!(table.lines().count(), 4);
    assert!(fs::read(dir.path().join("t.pdf")).unwrap().starts_with(b"%PDF"));
}

#[test]
fn lines_end_without_a_tab_unless_under_compat() {
    let dir = folder("a.dat");
    assert_eq!(mist(&dir, &["run", "a.mist"]).0, 0);
    assert!(read(&dir, "a.dat").lines().all(|line| !line.ends_with('\t')));
    let listing = read(&dir, "a.lst");
    assert!(listing.contains("Loop: FOR t FROM 0 TO 60 BY 30"), "{listing}");
    assert_eq!(listing.matches("Setting parameter lambda").count(), 1, "{listing}");
}

#[test]
fn a_job_renames_all_files() {
    let dir = folder("a.dat");
    assert_eq!(mist(&dir, &["run", "a.mist", "--job", "b"]).0, 0);
    for name in ["b.dat", "b.lst", "b.mtab", "b.png"] {
        assert!(dir.path().join(name).exists(), "{name}");
    }
    assert!(!dir.path().join("a.dat").exists());
}

#[test]
fn files_are_replaced_with_a_notice_or_not_at_all() {
    let dir = folder("a.dat");
    let (_, said, _) = mist(&dir, &["run", "a.mist"]);
    assert!(!said.contains("replaces"), "{said}");
    let (_, said, _) = mist(&dir, &["run", "a.mist"]);
    assert!(said.contains("a.dat (replaces an older file)"), "{said}");
    let (status, _, told) = mist(&dir, &["run", "a.mist", "--no-clobber"]);
    assert_eq!(status, 2);
    assert!(told.contains("a.dat exists"), "{told}");
    let (status, said, told) = mist(&dir, &["run", "--quiet", "a.mist"]);
    assert_eq!((status, said.as_str(), told.as_str()), (0, "", ""));
}

#[test]
fn two_programs_write_no_common_file_and_none_outside() {
    let dir = folder("a.dat");
    fs::copy(dir.path().join("a.mist"), dir.path().join("b.mist")).unwrap();
    let (status, _, told) = mist(&dir, &["run", "a.mist", "b.mist"]);
    assert_eq!(status, 2);
    assert!(told.contains("would be written twice, as results of a.mist and as"), "{told}");
    let dir = folder("../a.dat");
    let (status, _, told) = mist(&dir, &["run", "a.mist", "--out", "new"]);
    assert_eq!(status, 2);
    assert!(told.contains("--allow-outside"), "{told}");
    let words = ["run", "a.mist", "--out", "new", "--allow-outside"];
    assert_eq!(mist(&dir, &words).0, 0);
    assert!(dir.path().join("a.dat").exists());
}

#[test]
fn a_plot_needs_the_extension_of_a_picture() {
    let dir = folder("a.dat");
    fs::write(dir.path().join("a.mist"), PROGRAM.replace("a.png", "a.jpg")).unwrap();
    let (status, _, told) = mist(&dir, &["run", "a.mist"]);
    assert_eq!(status, 2);
    assert!(told.contains("ends with .svg, .png or .pdf"), "{told}");
}

/// Sends SIGINT to a run in `folder` when it has begun; gives its exit code and its message.
#[cfg(unix)]
fn interrupted(folder: &Path, words: &[&str]) -> (i32, String) {
    let mut run = Process::new(assert_cmd::cargo::cargo_bin("mist"));
    run.current_dir(folder).args(words).stdout(Stdio::null()).stderr(Stdio::piped());
    let run = run.spawn().unwrap();
    let begun = || fs::read_dir(folder).unwrap().count() > 1;
    let start = Instant::now();
    while !begun() && start.elapsed() < Duration::from_secs(30) {
        std::thread::sleep(Duration::from_millis(20));
    }
    let pid = run.id().to_string();
    assert!(Process::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let output = run.wait_with_output().unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_tells_what_it_kept_and_how_to_go_on() {
    let dir = folder("a.dat");
    let long = PROGRAM.replace("BY 30", "BY 0.02").replace("BY 150", "BY 0.1");
    fs::write(dir.path().join("a.mist"), long).unwrap();
    let (status, told) = interrupted(dir.path(), &["run", "a.mist"]);
    assert_eq!(status, 130, "{told}");
    assert!(told.contains("--shard 1/1 a.mist"), "{told}");
    let (status, told) = interrupted(dir.path(), &["run", "--shard", "1/2", "a.mist"]);
    assert_eq!(status, 130, "{told}");
    assert!(told.contains("kept in a.1-of-2"), "{told}");
}
