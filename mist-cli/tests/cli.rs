//! The command line: outputs, exit codes, files that appear whole or not at all.

use std::{fs, path::Path};

use assert_cmd::Command;
use tempfile::TempDir;

fn mist(folder: &Path) -> Command {
    let mut command = Command::cargo_bin("mist").expect("the binary is built");
    command.current_dir(folder);
    command
}

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn root(path: &str) -> String {
    format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"))
}

fn stdout(command: &mut Command) -> String {
    String::from_utf8(command.assert().success().get_output().stdout.clone()).unwrap()
}

fn stderr(command: &mut Command, code: i32) -> String {
    String::from_utf8(command.assert().code(code).get_output().stderr.clone()).unwrap()
}

#[test]
fn every_example_writes_its_colour_table_and_its_picture() {
    for name in ["gold", "paint", "pearl", "jade"] {
        let dir = folder();
        let program = root(&format!("examples/{name}/{name}.mist"));
        let said = stdout(mist(dir.path()).args(["run", &program]));
        for extension in ["mtab", "svg", "mspd", "dat", "lst"] {
            let file = format!("{name}.{extension}");
            assert!(said.contains(&file), "{said}");
            assert!(fs::metadata(dir.path().join(&file)).unwrap().len() > 0, "{file}");
        }
        let table = fs::read_to_string(dir.path().join(format!("{name}.mtab"))).unwrap();
        let table = rise_bridge::read::mtab(&table).unwrap();
        assert!(table.rows.len() >= 33 && table.stokes >= 3, "{name}");
    }
}

#[test]
fn the_examples_are_formatted() {
    let dir = folder();
    for name in ["gold", "paint", "pearl", "jade", "paper"] {
        for file in fs::read_dir(root(&format!("examples/{name}"))).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "mist") {
                let words = ["fmt", "--check", &path.to_string_lossy()].map(str::to_owned);
                assert_eq!(stdout(mist(dir.path()).args(words)), "", "{}", path.display());
            }
        }
    }
}

#[test]
fn a_table_needs_no_options() {
    let dir = folder();
    fs::write(dir.path().join("white.json"), r#"{"model": "Lambertian_BRDF_Model"}"#).unwrap();
    let said = stdout(mist(dir.path()).args(["table", "white.json"]));
    assert_eq!(said, "white.mtab: 252 rows\n");
}

#[test]
fn the_colour_of_a_spectrum_is_a_few_lines() {
    let dir = folder();
    let spectrum = "nm,R\n380,0.5\n480,0.5\n580,0.5\n680,0.5\n780,0.5\n";
    fs::write(dir.path().join("grey.csv"), spectrum).unwrap();
    let said = stdout(mist(dir.path()).args(["color", "grey.csv"]));
    assert!(said.contains("Lab           76.07  0.00  0.00\n"), "{said}");
    assert!(said.contains("sRGB          #bcbcbc  188 188 188\n"), "{said}");
    let case = r#"{"wavelengths":[380,580,780],"values":[0.5,0.5,0.5],"illuminant":"D65"}"#;
    for (words, count) in [(&["color"][..], 1), (&["color", "--all"], 32)] {
        let said = stdout(mist(dir.path()).args(words).write_stdin(case));
        let answer: serde_json::Value = serde_json::from_str(&said).unwrap();
        assert_eq!(answer["results"][0]["rgb"].as_array().unwrap().len(), count, "{said}");
    }
}

#[test]
fn a_wrong_program_is_refused_with_its_place_and_leaves_no_file() {
    let dir = folder();
    let program = fs::read_to_string(root("examples/gold/gold.mist")).unwrap();
    let wrong = program.replace("Shadowed_Facet_BRDF_Model", "Shadowed_Facet_BRDF_Modell");
    fs::write(dir.path().join("a.mist"), wrong).unwrap();
    let said = stderr(mist(dir.path()).args(["run", "a.mist"]), 2);
    let line = program.lines().position(|line| line.starts_with("MODEL")).unwrap() + 1;
    let place = format!("a.mist:{line}:9");
    assert!(said.contains(&place) && said.contains("`Shadowed_Facet_BRDF_Model`"), "{said}");
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
}

#[test]
fn results_in_a_folder_that_is_not_there_fail_with_the_remedy() {
    let dir = folder();
    let program =
        root("tests/conformance/programs/v_err_files_unwritable/v_err_files_unwritable.mist");
    let said = stderr(mist(dir.path()).args(["run", "--compat", &program]), 1);
    assert!(said.contains("nodir") && said.contains("make it first"), "{said}");
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0);
}

#[test]
fn under_compat_a_second_name_names_the_job() {
    let dir = folder();
    let program = root("tests/conformance/programs/v_lang_jobname/v_lang_jobname.mist");
    stdout(mist(dir.path()).args(["run", "--compat", &program, "job_7"]));
    assert!(dir.path().join("job_7.dat").exists() && dir.path().join("job_7.lst").exists());
}

#[cfg(unix)]
#[test]
fn a_run_that_is_asked_to_stop_leaves_no_file() {
    let dir = folder();
    let program = "MODEL = Lambertian_BRDF_Model\nVARIABLES:\n\
        incidentangle = 0 incidentpol = (1,0,0,0) rotation = 0 differential = 1 minsamples = 10\n\
        a = 0 END\nVARY: FOR a FROM 0 TO 1e8 BY 1 END\nINTEGRALS: R = HEMI END END\n\
        OUTPUTS: 1 R END\nFILES: END\n";
    fs::write(dir.path().join("endless.mist"), program).unwrap();
    let mut run = std::process::Command::new(assert_cmd::cargo::cargo_bin("mist"))
        .args(["run", "endless.mist"])
        .current_dir(dir.path())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    // Its temporary files are there: the run has begun.
    while fs::read_dir(dir.path()).unwrap().count() < 3 {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let id = run.id().to_string();
    assert!(std::process::Command::new("kill").args(["-TERM", &id]).status().unwrap().success());
    assert_eq!(run.wait().unwrap().code(), Some(130));
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
}

#[test]
fn many_programs_have_one_summary_and_the_worst_code() {
    let dir = folder();
    let gold = root("examples/gold/gold.mist");
    fs::write(dir.path().join("empty.mist"), "").unwrap();
    let mut run = mist(dir.path());
    let done = run.args(["run", &gold, "empty.mist", "missing.mist"]).assert().code(2);
    let said = String::from_utf8(done.get_output().stdout.clone()).unwrap();
    assert!(said.contains("3 programs: 1 good, 0 failed, 2 refused"), "{said}");
}

#[test]
fn editors_get_diagnostics_as_json_lines() {
    let dir = folder();
    let program = fs::read_to_string(root("examples/gold/gold.mist")).unwrap();
    fs::write(dir.path().join("a.mist"), program.replace("= f0,f1", "= f9,f1")).unwrap();
    let mut check = mist(dir.path());
    let done = check.args(["check", "--message-format", "json", "a.mist"]).assert().code(2);
    let said = String::from_utf8(done.get_output().stdout.clone()).unwrap();
    let found: serde_json::Value = serde_json::from_str(said.lines().next().unwrap()).unwrap();
    assert_eq!((&found["file"], &found["severity"]), (&"a.mist".into(), &"error".into()));
    assert_eq!(found["help"], "did you mean `f0`?");
    let line = program.lines().position(|line| line.contains("= f0,f1")).unwrap() + 1;
    assert_eq!(found["line"].as_u64(), Some(line as u64));
}

#[test]
fn a_coloured_table_of_results_is_the_table_of_the_run() {
    let dir = folder();
    stdout(mist(dir.path()).args(["run", &root("examples/gold/gold.mist")]));
    let from = ["table", "--from", "gold.dat", "--wavelength", "wl:nm", "--value", "f0,f1,f2,f3"];
    stdout(mist(dir.path()).args(from).args(["-o", "again.mtab"]));
    let read = |name: &str| {
        rise_bridge::read::mtab(&fs::read_to_string(dir.path().join(name)).unwrap()).unwrap()
    };
    let (run, again) = (read("gold.mtab"), read("again.mtab"));
    assert_eq!(run.rows.len(), again.rows.len());
    for (a, b) in run.rows.iter().zip(&again.rows) {
        // The results are printed with six digits.
        assert!((a.xyz[0][1] - b.xyz[0][1]).abs() < 1e-5 * a.xyz[0][1], "{a:?} {b:?}");
    }
}

#[test]
fn colours_of_a_grey_are_grey_and_a_wrong_case_is_named() {
    let dir = folder();
    let case = r#"{"id":"grey","wavelengths":[400,500,600,700],"values":[0.2,0.2,0.2,0.2],"illuminant":"D65"}"#;
    let said = stdout(mist(dir.path()).arg("color").write_stdin(case));
    let answer: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!(answer["results"][0]["id"], "grey");
    // Y is a sum of weights whose total is 1.
    assert!((answer["results"][0]["XYZ"][1].as_f64().unwrap() - 0.2).abs() < 1e-14);
    let said = stderr(mist(dir.path()).arg("color").write_stdin(case.replace("D65", "D66")), 2);
    assert!(said.contains("grey") && said.contains("illuminant"), "{said}");
}

#[test]
fn eval_answers_json_and_refuses_unknown_parameters() {
    let dir = folder();
    let request = r#"{"model":"Lambertian_BRDF_Model","parameters":{"reflectance.table":0.5},
        "geometries":[{"theta_i":0.5,"theta_s":0.2,"phi_s":0}]}"#;
    let said = stdout(mist(dir.path()).arg("eval").write_stdin(request));
    let answer: serde_json::Value = serde_json::from_str(&said).unwrap();
    let f = answer["mueller"][0][0].as_f64().unwrap();
    assert!((f - 0.5 / std::f64::consts::PI).abs() < 1e-15);
    let wrong = request.replace("reflectance.table", "reflectanse.table");
    let said = stderr(mist(dir.path()).arg("eval").write_stdin(wrong), 2);
    assert!(said.contains("reflectance"), "{said}");
}

#[test]
fn a_table_has_every_node_and_its_json_twin_the_same_numbers() {
    let dir = folder();
    fs::write(
        dir.path().join("glass.json"),
        r#"{"model":"Facet_BRDF_Model","parameters":{"substrate":"(1.5,0)","sdf.s":0.3}}"#,
    )
    .unwrap();
    let grid = "thetai=0:30:60,thetas=0:30:60,phis=0:90:180";
    let make = |output: &str| {
        stdout(mist(dir.path()).args([
            "table",
            "glass.json",
            "--grid",
            grid,
            "--lambda",
            "400:50:700",
            "--digits",
            "17",
            "-o",
            output,
        ]));
        fs::read_to_string(dir.path().join(output)).unwrap()
    };
    let (text, json) = (make("a.mtab"), make("a.json"));
    let rows: Vec<Vec<f64>> = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split_whitespace().map(|word| word.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 27);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let twin: Vec<Vec<f64>> = serde_json::from_value(json["rows"].clone()).unwrap();
    assert_eq!(rows, twin);
}

#[test]
fn the_manual_of_models_is_printed_from_the_registry() {
    let dir = folder();
    let said = stdout(mist(dir.path()).args(["models", "--markdown"]));
    let kept = fs::read_to_string(root("docs/models.md")).unwrap();
    assert!(said == kept, "docs/models.md is stale: mist models --markdown > docs/models.md");
}

#[test]
fn formatting_a_program_twice_changes_nothing_more() {
    let dir = folder();
    let once = stdout(mist(dir.path()).args(["fmt", &root("examples/pearl/pearl.mist")]));
    fs::write(dir.path().join("b.mist"), &once).unwrap();
    assert_eq!(stdout(mist(dir.path()).args(["fmt", "b.mist"])), once);
}

/// A program with an unused variable in line 3 and an angle in degrees in line 4.
const DOUBTFUL: &str = "\
MODEL = Lambertian_BRDF_Model
VARIABLES:
  spare = 1
  incidentangle = 45  incidentpol = (1,0,0,0)  rotation = 0  differential = 1e-3  minsamples = 50
END
VARY: END
INTEGRALS: R = HEMI END END
OUTPUTS: 1 R END
FILES: END
";

#[test]
fn check_shows_warnings_with_their_places_and_ends_well() {
    let dir = folder();
    fs::write(dir.path().join("a.mist"), DOUBTFUL).unwrap();
    let told = mist(dir.path()).args(["check", "a.mist"]).assert().code(0).get_output().clone();
    let said = String::from_utf8(told.stderr).unwrap();
    for part in [
        "warning[program/unused-variable]",
        "a.mist:3:3",
        "warning[angle/degrees]",
        "a.mist:4:19",
        "45*deg",
    ] {
        assert!(said.contains(part), "{part} in\n{said}");
    }
    let said = String::from_utf8(told.stdout).unwrap();
    assert_eq!(said, "a.mist: no mistake found, 2 warnings\n");
}

#[test]
fn check_gives_editors_warnings_as_json() {
    let dir = folder();
    fs::write(dir.path().join("a.mist"), DOUBTFUL).unwrap();
    let said = stdout(mist(dir.path()).args(["check", "--message-format", "json", "a.mist"]));
    let lines: Vec<serde_json::Value> =
        said.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 2, "{said}");
    assert!(lines.iter().all(|line| line["severity"] == "warning"), "{said}");
    assert_eq!((&lines[0]["line"], &lines[0]["column"]), (&3.into(), &3.into()));
    assert_eq!(lines[1]["code"], "angle/degrees");
}

#[test]
fn check_finds_what_the_first_step_would_refuse() {
    let dir = folder();
    fs::write(dir.path().join("a.mist"), DOUBTFUL.replace("spare = 1", "#spare = 1")).unwrap();
    let said = stderr(mist(dir.path()).args(["check", "a.mist"]), 2);
    assert!(said.contains("has no parameter spare") && said.contains("a.mist:3:3"), "{said}");
}

#[test]
fn a_program_that_cannot_be_converted_is_told_with_its_places() {
    let dir = folder();
    fs::write(dir.path().join("a.mist"), "MODEL = M\nVARIABLE:\nEND\n").unwrap();
    let said = stderr(mist(dir.path()).args(["convert", "a.mist"]), 2);
    assert!(said.contains("a.mist:2:1") && said.contains("VARIABLES:"), "{said}");
}
