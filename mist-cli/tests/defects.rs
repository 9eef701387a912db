//! Runs that meet a defect of NIST's program say so on stderr, and name it.

use std::fs;

use assert_cmd::Command;

const PROGRAM: &str = "\
MODEL = Facet_BRDF_Model
VARIABLES:
    pi = 4*atan(1)
    deg = pi/180
    differential = (5*deg)^2
    minsamples = 1
    incidentangle = 30*deg
    incidentpol = (1,0,0,0)
    rotation = 0
    $sdf = Table_Angle_Distribution_Function
    $sdf.T = 1
END
VARY:
END
INTEGRALS:
    R = HEMI
        INPOL = (1,0,0,0)
    END
END
OUTPUTS:
    1 seen=R
END
FILES:
END
";

fn said(arguments: &[&str]) -> String {
    said_of(PROGRAM, arguments)
}

fn said_of(program: &str, arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.mist"), program).unwrap();
    let mut command = Command::cargo_bin("mist").expect("the binary is built");
    command.current_dir(folder.path()).args(arguments);
    String::from_utf8(command.assert().code(0).get_output().stderr.clone()).unwrap()
}

#[test]
fn a_sound_run_names_the_defects_that_it_meets_in_one_line() {
    let said = said(&["run", "a.mist"]);
    let notes: Vec<&str> = said.lines().filter(|line| line.contains("defect")).collect();
    assert_eq!(notes.len(), 1, "{said}");
    assert!(notes[0].contains("[B1:") && notes[0].contains("[B19:"), "{said}");
}

#[test]
fn a_compat_run_reproduces_them_in_silence() {
    assert!(!said(&["run", "--compat", "a.mist"]).contains("defect"));
}

#[test]
fn a_run_says_where_a_coating_is_denser_than_its_model_holds() {
    let coating = |density: &str| {
        let model = "Pigmented_Coating_BRDF_Model";
        let parameters = format!("#particle_density = {density}");
        PROGRAM
            .replace("Facet_BRDF_Model", model)
            .replace("$sdf = Table_Angle_Distribution_Function", &parameters)
            .replace("    $sdf.T = 1\n", "")
    };
    let said = |density| said_of(&coating(density), &["run", "a.mist"]);
    assert!(said("30").contains("lower particle_density"), "{}", said("30"));
    assert!(!said("3").contains("particle_density"), "{}", said("3"));
}
