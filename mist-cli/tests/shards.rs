//! Runs in several processes: the merged table is that of one process, whatever happens between.

use std::{
    fs,
    path::Path,
    process::{Child, Command, Stdio},
    thread::sleep,
    time::Duration,
};

use tempfile::TempDir;

/// Facets seen in every direction, with a header, samples of one direction, and two loops.
const PROGRAM: &str = "MODEL = Facet_BRDF_Model
VARIABLES:
  degree = atan(1)/45
  theta = 0  slope = 0.1
  incidentangle = theta*degree  incidentpol = (1,0,0,0)  rotation = 0
  integrationmode = 2  differential = 4e-5  minsamples = 100
  $sdf = Gaussian_Slope_Distribution_Function
  #sdf.s = slope
END
VARY:
  FOR slope FROM 0.1 TO 0.3 BY 0.1
  FOR theta FROM 0 TO 70 BY 5
END
INTEGRALS:
  H = HEMI END
  f = DIFFERENTIAL  CENTER = (theta*degree,0)  END
END
OUTPUTS:
  1 R=H
  2 peak=f
END
FILES:
  header = \"one header\"
  header = \"and another\"
  results = sweep.tab
  format = %.12e\\t
END
";

fn folder(program: &str) -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("sweep.mist"), program).unwrap();
    dir
}

fn mist(dir: &TempDir, args: &[&str]) -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin("mist"));
    command.current_dir(dir.path()).args(args);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// The output of a command, which must end with `code`.
fn said(mut command: Command, code: i32) -> String {
    let output = command.output().unwrap();
    let text = [output.stdout, output.stderr].concat();
    let text = String::from_utf8(text).unwrap();
    assert_eq!(output.status.code(), Some(code), "{text}");
    text
}

fn read(dir: &TempDir, name: &str) -> String {
    fs::read_to_string(dir.path().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn without_time(listing: &str) -> &str {
    listing.rsplit_once("Elapsed time").expect("a listing ends with the time").0
}

/// Waits until `path` has `lines` lines.
fn wait_for_lines(path: &Path, lines: usize) {
    while fs::read_to_string(path).map_or(0, |text| text.lines().count()) < lines {
        sleep(Duration::from_millis(2));
    }
}

fn shards(dir: &TempDir, options: &[&str], numbers: &[&str]) -> Vec<Child> {
    let start = |number: &&str| {
        let args = [&["run", "sweep.mist", "--shard", number], options].concat();
        mist(dir, &args).spawn().unwrap()
    };
    numbers.iter().map(start).collect()
}

#[test]
fn shards_of_several_processes_one_of_them_killed_merge_to_the_table_of_one_run() {
    for options in [&[][..], &["--compat"]] {
        let one = folder(PROGRAM);
        said(mist(&one, &[&["run", "sweep.mist"], options].concat()), 0);
        let dir = folder(PROGRAM);
        let mut children = shards(&dir, options, &["1/3", "2/3", "3/3"]);
        wait_for_lines(&dir.path().join("sweep.2-of-3"), 3);
        // SIGKILL on Unix: the process has no chance to tidy up.
        children[1].kill().unwrap();
        for child in &mut children {
            child.wait().unwrap();
        }
        let names = ["sweep.1-of-3", "sweep.2-of-3", "sweep.3-of-3"];
        let before = read(&dir, names[1]);
        if !before.contains("\"end\"") {
            let merge = [&["merge", "-o", "sweep.tab"][..], &names].concat();
            let refused = said(mist(&dir, &merge), 2);
            assert!(refused.contains("sweep.2-of-3 is incomplete"), "{refused}");
            assert!(!dir.path().join("sweep.tab").exists());
        }
        let again = [&["run", "sweep.mist", "--shard", "2/3"], options].concat();
        let text = said(mist(&dir, &again), 0);
        assert!(!text.contains(" 0 of them done before"), "{text}");
        // What was finished stands as it was.
        let whole = before.rsplit_once('\n').unwrap().0;
        assert!(read(&dir, names[1]).starts_with(whole));
        // In any order, and a complete shard is left alone.
        let text = said(mist(&dir, &again), 0);
        assert!(text.contains("15 of 45 steps, 15 of them done before"), "{text}");
        let merge = [&["merge"][..], &[names[2], names[0], names[1]], &["-o", "all.tab"]].concat();
        said(mist(&dir, &merge), 0);
        assert_eq!(read(&dir, "all.tab"), read(&one, "sweep.tab"));
        let (merged, single) = (read(&dir, "sweep.lst"), read(&one, "sweep.lst"));
        assert_eq!(without_time(&merged), without_time(&single));
    }
}

/// Steps of one direction: quick.
fn quick() -> String {
    PROGRAM.replace("  H = HEMI END\n", "").replace("  1 R=H\n  2 peak=f", "  1 peak=f")
}

#[test]
fn samples_and_more_shards_than_steps_merge_too() {
    let program = quick().replace("  results = sweep.tab\n", "  samples = sweep.smp\n");
    let (one, dir) = (folder(&program), folder(&program));
    said(mist(&one, &["run", "sweep.mist"]), 0);
    let numbers: Vec<String> = (1..=60).map(|k| format!("{k}/60")).collect();
    for number in &numbers {
        said(mist(&dir, &["run", "sweep.mist", "--shard", number, "--threads", "1"]), 0);
    }
    let names: Vec<String> = (1..=60).map(|k| format!("sweep.{k}-of-60")).collect();
    let mut merge = mist(&dir, &["merge"]);
    merge.args(&names);
    said(merge, 0);
    for name in ["sweep.dat", "sweep.smp"] {
        assert_eq!(read(&dir, name), read(&one, name));
    }
}

#[test]
fn missing_double_and_foreign_shards_are_named() {
    let dir = folder(&quick());
    for number in ["1/3", "3/3"] {
        said(mist(&dir, &["run", "sweep.mist", "--shard", number]), 0);
    }
    let text = said(mist(&dir, &["merge", "sweep.1-of-3", "sweep.3-of-3"]), 2);
    assert!(text.contains("missing: sweep.2-of-3"), "{text}");
    let text = said(mist(&dir, &["merge", "sweep.1-of-3", "sweep.1-of-3"]), 2);
    assert!(text.contains("the same shard"), "{text}");
    said(mist(&dir, &["run", "sweep.mist", "--shard", "2/3", "--compat"]), 0);
    let text = said(mist(&dir, &["merge", "sweep.1-of-3", "sweep.2-of-3", "sweep.3-of-3"]), 2);
    assert!(text.contains("sweep.2-of-3 and sweep.1-of-3 are shards of different runs"), "{text}");
    let text = said(mist(&dir, &["run", "sweep.mist", "--shard", "2/3"]), 2);
    assert!(text.contains("sweep.2-of-3 belongs to a run of another program"), "{text}");
    let text = said(mist(&dir, &["merge", "sweep.mist"]), 2);
    assert!(text.contains("it is not a shard"), "{text}");
    fs::write(dir.path().join("sweep.2-of-4"), "a text of somebody\n").unwrap();
    said(mist(&dir, &["run", "sweep.mist", "--shard", "2/4"]), 1);
    assert_eq!(read(&dir, "sweep.2-of-4"), "a text of somebody\n");
    assert!(!dir.path().join("sweep.tab").exists());
}

#[test]
fn a_torn_line_is_cut_off_and_its_step_run_again() {
    let (one, dir) = (folder(&quick()), folder(&quick()));
    said(mist(&one, &["run", "sweep.mist"]), 0);
    said(mist(&dir, &["run", "sweep.mist", "--shard", "1/1"]), 0);
    let whole = read(&dir, "sweep.1-of-1");
    for length in [0, 10, whole.len() / 2, whole.len() - 3] {
        fs::write(dir.path().join("sweep.1-of-1"), &whole[..length]).unwrap();
        said(mist(&dir, &["run", "sweep.mist", "--shard", "1/1"]), 0);
        said(mist(&dir, &["merge", "sweep.1-of-1"]), 0);
        assert_eq!(read(&dir, "sweep.tab"), read(&one, "sweep.tab"), "{length}");
    }
}

#[test]
fn a_program_that_feeds_results_back_is_not_split() {
    let program =
        quick().replace("degree = atan(1)/45", "degree = atan(1)/45 peak = 0 last = peak");
    let dir = folder(&program);
    let text = said(mist(&dir, &["run", "sweep.mist", "--shard", "1/2"]), 2);
    assert!(text.contains("cannot be split") && text.contains("one after the other"), "{text}");
    let text = said(mist(&dir, &["run", "sweep.mist", "--shard", "3/2"]), 2);
    assert!(text.contains("k from 1 to n"), "{text}");
}
