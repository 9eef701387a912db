//! Diffuse materials whose colour is RGB become tables of that colour, and say that it was invented.

use std::sync::Arc;

use mist_engine::{Control, Files, MemoryFiles};
use rise_bridge::rise::product::{self, BridgeFiles, BridgeOptions};

fn scene(colour: &str) -> String {
    format!(
        "RISE ASCII SCENE 7\n\
         uniformcolor_painter\n{{\nname paint\ncolor {colour}\n}}\n\
         lambertian_material\n{{\nname body\nreflectance paint\n}}\n"
    )
}

fn make(text: &str) -> BridgeFiles {
    let files: Arc<dyn Files + Send + Sync> = Arc::new(MemoryFiles::default());
    let wavelengths = (0..=40).map(|k| 380.0 + 10.0 * f64::from(k)).collect();
    let options = BridgeOptions { nodes: 3, wavelengths, derive: true, bands: false };
    product::make(text, "scene", &files, &options, &Control::default()).unwrap()
}

#[test]
fn an_uplifted_diffuser_has_its_colour_within_1_percent() {
    for rgb in [[0.6, 0.1, 0.1], [0.05, 0.5, 0.2], [0.2, 0.3, 0.75]] {
        let [r, g, b] = rgb;
        let made = make(&scene(&format!("{r} {g} {b}")));
        let found = made.tables["body.RISEdataBSDF"].reflectance();
        for (found, wanted) in found.iter().zip(rgb) {
            assert!((found - wanted).abs() <= 0.01 * wanted, "{found} {wanted}");
        }
        assert_eq!(made.invented.len(), 1);
        assert!(made.invented[0].starts_with("body: body_rd.txt: a smooth reflectance"));
    }
}

#[test]
fn an_inline_colour_is_read() {
    let text =
        "RISE ASCII SCENE 7\nlambertian_material\n{\nname body\nreflectance 0.4 0.4 0.4\n}\n";
    let made = make(text);
    let found = made.tables["body.RISEdataBSDF"].reflectance();
    assert!((found[1] - 0.4).abs() < 1e-6, "{found:?}");
    assert!(made.invented.is_empty());
}

#[test]
fn a_colour_above_white_is_refused() {
    let files: Arc<dyn Files + Send + Sync> = Arc::new(MemoryFiles::default());
    let options =
        BridgeOptions { nodes: 3, wavelengths: vec![500.0, 600.0], derive: true, bands: false };
    let error = product::make(&scene("1.5 0.2 0.1"), "s", &files, &options, &Control::default());
    let error = error.unwrap_err().to_string();
    assert!(error.contains("1.5 is not a reflectance"), "{error}");
}
