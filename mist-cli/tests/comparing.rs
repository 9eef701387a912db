//! The commands that compare: pictures, programs and measurements, spectra.

use std::{fs, path::Path};

use assert_cmd::Command;
use pictures::image::{Encoding, Image, PictureFormat};
use serde_json::Value;

fn mist(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("mist").expect("the binary is built");
    command.current_dir(folder).args(arguments);
    command
}

fn stdout(folder: &Path, arguments: &[&str]) -> String {
    let output = mist(folder, arguments).assert().success().get_output().stdout.clone();
    String::from_utf8(output).unwrap()
}

fn stderr(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = mist(folder, arguments).assert().code(code).get_output().stderr.clone();
    String::from_utf8(output).unwrap()
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&stdout(folder, arguments)).unwrap()
}

/// A picture of 48 × 40 pixels with waves of this contrast around a half.
fn waves(contrast: f32, encoding: Encoding, channels: usize) -> Image {
    let at = |i: usize| 0.5 * (1.0 + contrast * ((i % 48) as f32 * 0.8).sin());
    let values = (0..48 * 40).flat_map(|i| vec![at(i); channels]).collect();
    Image::new([48, 40], channels, values, encoding).unwrap()
}

fn save(folder: &Path, name: &str, image: &Image) {
    let format = PictureFormat::of_name(name).unwrap();
    fs::write(folder.join(name), image.write(format).unwrap()).unwrap();
}

#[test]
fn pictures_of_any_format_are_compared_and_the_map_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (name, channels) in [("a.exr", 1), ("a.pfm", 3)] {
        save(folder, name, &waves(0.2, Encoding::Linear, channels));
        save(folder, &format!("flat-{name}"), &waves(0.0, Encoding::Linear, channels));
    }
    let display = ["--display-size", "0.375x0.300", "--display-pixels", "1280x1024"];
    let grey = [&["diff", "a.exr", "flat-a.exr", "--compat", "--json"][..], &display].concat();
    let grey = json(folder, &[&grey[..], &["--distance", "0.5"]].concat());
    let seen = grey["hdrvdp"]["p75_percent"].as_f64().unwrap();
    assert!(seen > 50.0 && grey["hdrvdp"]["p95_percent"].as_f64().unwrap() <= seen, "{grey}");
    // Colours are luminance times the scale, here 1; one channel is luminance itself.
    let arguments = ["diff", "a.pfm", "flat-a.pfm", "--compat", "--json"];
    assert_eq!(json(folder, &arguments)["hdrvdp"]["p75_percent"], grey["hdrvdp"]["p75_percent"]);
    let said = stdout(
        folder,
        &["diff", "a.exr", "flat-a.exr", "--daly", "--map", "m.png", "--overlay", "o.png"],
    );
    assert!(said.contains("P>75%") && said.contains("Daly") && said.contains("FLIP"), "{said}");
    for (name, channels) in [("m.png", 1), ("o.png", 3)] {
        let image = Image::read(&fs::read(folder.join(name)).unwrap()).unwrap();
        assert_eq!((image.size(), image.channels()), ([48, 40], channels));
    }
}

#[test]
fn pictures_that_cannot_be_compared_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    save(folder, "a.png", &waves(0.2, Encoding::Srgb, 3));
    let small = Image::new([4, 4], 1, vec![0.5; 16], Encoding::Srgb).unwrap();
    save(folder, "small.png", &small);
    fs::write(folder.join("text.png"), "no picture").unwrap();
    assert!(stderr(folder, &["diff", "a.png", "small.png"], 2).contains("48 × 40"));
    assert!(stderr(folder, &["diff", "a.png", "text.png"], 2).contains("text.png"));
    assert!(stderr(folder, &["diff", "a.png", "none.png"], 2).contains("none.png"));
    assert!(stderr(folder, &["diff", "a.png", "a.png", "--distance", "0"], 2).contains("distance"));
    assert!(stderr(folder, &["diff", "a.png", "a.png", "--map", "m.gif"], 2).contains("m.gif"));
    stderr(folder, &["diff", "a.png", "a.png", "--display-size", "3"], 2);
}

/// A grey diffuser of the radiance factor rho in a goniometer with a gain, and its colour.
const PROGRAM: &str = "
    MODEL = Lambertian_BRDF_Model
    VARIABLES:
      incidentangle = 0   incidentpol = (1,0,0,0)   rotation = 0
      differential = 0.001   minsamples = 5   wl = 550   gain = 1
      rho = 0.3   $reflectance = Table_Reflectance   #reflectance.table = rho*(1+wl/1000)
      omega = 4*atan(1)*sin(0.02)^2*cos(0.7)
    END
    VARY: FOR wl FROM 360 TO 760 BY 40 END
    INTEGRALS: I = CIRCLE CENTER = (0.7,0) ALPHA = 0.02 END END
    OUTPUTS:
      1 f=I/omega
      2 signal=gain*I/omega
    END
    FILES: results = out.dat header = \"Measured by hand\" END
    COLOR:
      wavelength = wl/1000 spectrum = f quantity = brdf illuminant = D65
      observer = CIE1931_2 space = sRGB adaptation = Bradford spectra = out.mspd
    END
";

#[test]
fn the_results_of_a_program_are_fitted_back() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("true.mist"), PROGRAM.replace("rho = 0.3", "rho = 0.21")).unwrap();
    fs::write(folder.join("start.mist"), PROGRAM).unwrap();
    stdout(folder, &["run", "true.mist"]);
    let fit = |vary, file| ["fit", "start.mist", "--measured", file, "--vary", vary, "--json"];
    let found = json(folder, &fit("rho", "out.dat"));
    let rho = &found["parameters"][0];
    // The table has six digits.
    assert!((rho["value"].as_f64().unwrap() - 0.21).abs() < 1e-6, "{found}");
    let interval = &rho["interval"];
    assert!(interval[0].as_f64() < Some(0.21001) && interval[1].as_f64() > Some(0.20999));
    let said = stdout(folder, &fit("rho,gain", "out.dat")[..6]);
    assert!(said.contains("95 %") && said.contains("correlation"), "{said}");
    // Without the column f only the product of rho and gain is measured.
    let table = fs::read_to_string(folder.join("out.dat")).unwrap();
    fs::write(folder.join("product.dat"), table.replace("\tf\t", "\tother\t")).unwrap();
    let said = stderr(folder, &fit("rho,gain", "product.dat"), 1);
    assert!(said.contains("gain cannot be determined") && said.contains("rho"), "{said}");
    let said = stderr(folder, &fit("roh", "out.dat"), 2);
    assert!(said.contains("did you mean `rho`?"), "{said}");
    fs::write(folder.join("few.dat"), "wl f\n360 0.1\n").unwrap();
    assert!(stderr(folder, &fit("rho", "few.dat"), 2).contains("at least 2 are needed"));
}

#[test]
fn tolerances_are_told_per_unit_of_each_variable() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("a.mist"), PROGRAM).unwrap();
    let found = json(folder, &["tolerance", "a.mist", "--vary", "rho,gain", "--json"]);
    let [rho, gain] = [0, 1].map(|at: usize| found["parameters"][at]["largest"].as_f64().unwrap());
    assert!(rho > 10.0 && gain == 0.0, "{found}");
    let said = stdout(folder, &["tolerance", "a.mist", "--vary", "rho"]);
    assert!(said.contains("moves a colour by 1 dE") && said.contains("dL*"), "{said}");
    stderr(folder, &["tolerance", "a.mist", "--vary", "wl"], 2);
}

#[test]
fn a_simulated_spectrum_is_compared_with_a_measured_one() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("a.mist"), PROGRAM).unwrap();
    stdout(folder, &["run", "a.mist"]);
    // Twice the simulated radiance factor.
    let lines = (0..=10).map(|i| 360.0 + 40.0 * f64::from(i));
    let text: String =
        lines.map(|nm| format!("{nm} {}\n", 2.0 * 0.3 * (1.0 + nm / 1000.0))).collect();
    fs::write(folder.join("measured.txt"), text).unwrap();
    let arguments = ["compare-spectra", "measured.txt", "out.mspd", "--plot", "a.svg", "--json"];
    let found = json(folder, &arguments);
    let found = &found["comparisons"][0];
    // The circle is sampled in a few directions.
    assert!((found["scale"].as_f64().unwrap() - 2.0).abs() < 0.04, "{found}");
    assert!(found["correlation"].as_f64().unwrap() > 0.999_999, "{found}");
    assert!(found["scaled_ciede2000"].as_f64().unwrap() < 0.05, "{found}");
    let picture = fs::read_to_string(folder.join("a.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.matches("<circle").count() == 11);
    let said = stdout(folder, &arguments[..3]);
    assert!(said.contains("best factor") && said.contains("CIEDE2000"), "{said}");
    stderr(folder, &["compare-spectra", "measured.txt", "none.txt"], 2);
}
