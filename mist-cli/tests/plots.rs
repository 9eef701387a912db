//! `--plot` of the commands.

use std::fs;

use assert_cmd::Command;
use tempfile::TempDir;

const PROGRAM: &str = "\
MODEL = Shadowed_Facet_BRDF_Model
VARIABLES:
    t = 0  thetas = 30  wl = 500
    incidentangle = t*deg  incidentpol = (1,0,0,0)  rotation = 0
    #lambda = wl/1000
    $substrate = (0.25,3.1)
    $sdf = Gaussian_Slope_Distribution_Function
    #sdf.s = 0.3
END
VARY:
    FOR thetas FROM 0 TO 60 BY 15
    FOR LOOP
END
INTEGRALS:
    R = DIFFERENTIAL
        CENTER = (thetas*deg,0)
    END
END
OUTPUTS:
    1 f=R/cos(thetas*deg)
END
FILES:
END
";

fn folder() -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    let plain = PROGRAM.replace("LOOP", "t FROM 0 TO 60 BY 30");
    fs::write(dir.path().join("plain.mist"), plain).unwrap();
    let colour = PROGRAM.replace("LOOP", "wl FROM 400 TO 700 BY 100") + "COLOR: spectrum = f END\n";
    fs::write(dir.path().join("colour.mist"), colour).unwrap();
    let single = PROGRAM.replace("    FOR LOOP\n", "");
    fs::write(dir.path().join("single.mist"), single).unwrap();
    fs::write(dir.path().join("scan.dat"), "thetas f\n0 0.8\n15 0.7\n30 0.5\n45 0.3\n").unwrap();
    dir
}

fn mist(dir: &TempDir, words: &[&str]) -> String {
    let mut command = Command::cargo_bin("mist").unwrap();
    let output = command.current_dir(dir.path()).args(words).output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{words:?}: {told}");
    told
}

fn read(dir: &TempDir, name: &str) -> String {
    fs::read_to_string(dir.path().join(name)).unwrap()
}

#[test]
fn a_run_draws_its_outputs_over_the_last_loop() {
    let dir = folder();
    mist(&dir, &["run", "plain.mist", "--plot", "a.svg"]);
    let svg = read(&dir, "a.svg");
    assert_eq!(svg.matches("<polyline").count(), 3, "{svg}");
    for text in ["thetas (deg)", "f by t (deg)", ">60</text>"] {
        assert!(svg.contains(text) || text == "thetas (deg)" && svg.contains(">thetas<"), "{text}");
    }
    mist(&dir, &["run", "colour.mist", "--plot", "c.svg"]);
    let svg = read(&dir, "c.svg");
    for text in ["flop: lightness", "L* (100", "wavelength (nm)", "brdf (1/sr)", "thetas (deg)"] {
        assert!(svg.contains(text), "{text}");
    }
}

#[test]
fn fits_tolerances_and_differences_are_drawn() {
    let dir = folder();
    let words = ["fit", "single.mist", "--measured", "scan.dat", "--vary", "sdf.s"];
    mist(&dir, &[&words[..], &["--plot", "fit.svg"]].concat());
    let svg = read(&dir, "fit.svg");
    assert_eq!((svg.matches("<circle").count(), svg.matches("<polyline").count()), (4, 1), "{svg}");
    mist(&dir, &["tolerance", "colour.mist", "--vary", "sdf.s", "--plot", "t.pdf"]);
    assert!(fs::read(dir.path().join("t.pdf")).unwrap().starts_with(b"%PDF"));
    for (name, light) in [("x.png", "40,120"), ("y.png", "60,120")] {
        mist(&dir, &["preview", "colour.mist", "-o", name, "--size", "32", "--lamp", light]);
    }
    mist(&dir, &["diff", "x.png", "y.png", "--plot", "d.svg"]);
    assert!(read(&dir, "d.svg").contains("pixels above it (%)"));
}
