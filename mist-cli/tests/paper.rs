//! The example materials of the paper: each program runs and shows what it is there to show.

use std::{fs, path::Path};

use assert_cmd::Command;
use tempfile::TempDir;

/// Spectra of the four angles 15, 30, 45 and 60 degrees, each from 360 to 750 nm by 10 nm.
struct Spectra {
    rows: Vec<[f64; 7]>,
}

/// Columns of the results: the loops lead the outputs.
fn run(name: &str) -> Spectra {
    let dir = TempDir::new().unwrap();
    let program = format!("{}/../examples/paper/{name}.mist", env!("CARGO_MANIFEST_DIR"));
    Command::cargo_bin("mist")
        .expect("the binary is built")
        .current_dir(dir.path())
        .args(["run", &program])
        .assert()
        .success();
    for extension in ["dat", "mtab", "mspd", "svg"] {
        let file = dir.path().join(format!("{name}.{extension}"));
        assert!(fs::metadata(&file).unwrap().len() > 0, "{name}.{extension}");
    }
    Spectra::read(&dir.path().join(format!("{name}.dat")))
}

impl Spectra {
    fn read(file: &Path) -> Self {
        let text = fs::read_to_string(file).unwrap();
        let numbers = |line: &str| -> Option<Vec<f64>> {
            line.split_whitespace().map(|word| word.parse().ok()).collect()
        };
        let rows: Vec<_> = text.lines().filter_map(numbers).collect();
        let last_seven = |row: Vec<f64>| <[f64; 7]>::try_from(&row[row.len() - 7..]).unwrap();
        let rows: Vec<_> = rows.into_iter().filter(|row| row.len() >= 7).map(last_seven).collect();
        assert_eq!(rows.len(), 160, "four angles of forty wavelengths");
        Self { rows }
    }

    /// (wavelength, f0) at an angle.
    fn at(&self, angle: f64) -> Vec<(f64, f64)> {
        self.rows.iter().filter(|row| row[6] == angle).map(|row| (row[5], row[1])).collect()
    }

    fn value(&self, angle: f64, wavelength: f64) -> f64 {
        let near = |(w, _): &&(f64, f64)| (w - wavelength).abs() < 1e-9;
        self.at(angle).iter().find(near).expect("the wavelength is there").1
    }

    fn mean(&self, angle: f64, from: f64, to: f64) -> f64 {
        let within: Vec<_> = self
            .at(angle)
            .into_iter()
            .filter(|(wavelength, _)| (from..=to).contains(wavelength))
            .map(|(_, f)| f)
            .collect();
        within.iter().sum::<f64>() / within.len() as f64
    }
}

/// Wavelength of the highest value from 420 nm on.
fn peak(spectrum: &[(f64, f64)]) -> f64 {
    let seen = spectrum.iter().filter(|(wavelength, _)| *wavelength >= 420.0);
    seen.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap().0
}

/// Pearson's correlation of two spectra.
fn correlation(a: &[(f64, f64)], b: &[(f64, f64)]) -> f64 {
    let mean = |x: &[(f64, f64)]| x.iter().map(|p| p.1).sum::<f64>() / x.len() as f64;
    let (ma, mb) = (mean(a), mean(b));
    let sum = |f: &dyn Fn(f64, f64) -> f64| -> f64 {
        a.iter().zip(b).map(|(a, b)| f(a.1 - ma, b.1 - mb)).sum()
    };
    sum(&|a, b| a * b) / (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt()
}

#[test]
fn the_colour_of_iridescent_paint_moves_to_the_blue_at_grazing_angles() {
    let paint = run("iridescent");
    let (steep, grazing) = (peak(&paint.at(15.0)), peak(&paint.at(60.0)));
    assert!(grazing + 20.0 <= steep, "{steep} nm at 15 degrees, {grazing} nm at 60");
}

#[test]
fn pearl_shows_the_complement_of_its_gloss_over_white() {
    let (black, white) = (run("pearl_black"), run("pearl_white"));
    // In the mirror direction both show the flakes; beside it white shows what passed them.
    let gloss = black.at(45.0);
    let passed: Vec<_> =
        white.at(15.0).iter().zip(black.at(15.0)).map(|(w, b)| (w.0, w.1 - b.1)).collect();
    assert!(correlation(&gloss, &passed) < -0.8, "{}", correlation(&gloss, &passed));
    let brighter = white.mean(15.0, 400.0, 700.0) / black.mean(15.0, 400.0, 700.0);
    assert!(brighter > 1.2, "{brighter}");
}

#[test]
fn manganese_takes_the_green_of_nephrite_and_leaves_its_gloss() {
    let (with, without) = (run("nephrite_mn"), run("nephrite"));
    let ratio =
        |angle, wavelength| with.value(angle, wavelength) / without.value(angle, wavelength);
    assert!(ratio(15.0, 520.0) < 0.6, "{}", ratio(15.0, 520.0));
    assert!(ratio(15.0, 680.0) > 0.99);
    // The mirror direction shows the surface, not the body.
    assert!(ratio(45.0, 520.0) > 0.9, "{}", ratio(45.0, 520.0));
}

#[test]
fn waxes_have_the_colour_of_their_bodies_and_a_gloss_of_none() {
    let (polar, orange) = (run("wax_polar"), run("wax_orange"));
    let red_to_blue =
        |wax: &Spectra, angle| wax.mean(angle, 600.0, 700.0) / wax.mean(angle, 420.0, 500.0);
    assert!(red_to_blue(&orange, 15.0) > 5.0, "{}", red_to_blue(&orange, 15.0));
    let bluish = red_to_blue(&polar, 15.0);
    assert!(bluish > 0.5 && bluish < 1.0, "{bluish}");
    assert!(red_to_blue(&orange, 45.0) < red_to_blue(&orange, 15.0));
}

#[test]
fn a_tinted_lacquer_colours_the_flakes_below_it() {
    let lacquer = run("lacquer");
    // The dye takes the green of what has passed it twice.
    let dip = lacquer.value(30.0, 530.0) / lacquer.value(30.0, 690.0);
    assert!(dip < 0.7, "{dip}");
    assert!(lacquer.mean(45.0, 400.0, 700.0) > 3.0 * lacquer.mean(15.0, 400.0, 700.0));
}

#[test]
fn shadowing_dims_the_highlight_as_its_function_says() {
    let (on, off) = (run("shadow_on"), run("shadow_off"));
    let ratio = |angle: f64| on.mean(angle, 400.0, 700.0) / off.mean(angle, 400.0, 700.0);
    // At 70 degrees on both sides 1/(1 + 2 Λ) = 0.8708, for slopes of 0.35 along the plane of
    // incidence; the body under the surface is not shadowed, it gets what the surface does not
    // return.
    assert!((ratio(70.0) - 0.871).abs() < 0.02, "{}", ratio(70.0));
    assert!(ratio(85.0) < ratio(70.0) && ratio(40.0) > 0.95, "{} {}", ratio(40.0), ratio(85.0));
}
