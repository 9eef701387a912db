//! A scene for RISE becomes programs, tables and scenes; the tables are the integrals over rings.

use std::{
    collections::BTreeMap,
    sync::{Arc, LazyLock},
};

use mist_engine::{
    Control, Files, Limits, MemoryFiles,
    material::{Material, table::mueller},
    region::Region,
    request::{ColourQuery, Patch, PatchRow, TableDirections, TableRequest},
    sampling::adaptive::{Accuracy, integrate},
};
use rise_bridge::rise::{
    product::{self, BridgeFiles, BridgeOptions},
    table::{read, ring},
};
use scattering::{Basis, Incidence, Mode};

const SCENE: &str = include_str!("data/two_balls.RISEscene");
const NM: [f64; 5] = [450.0, 500.0, 550.0, 600.0, 650.0];
const NODES: usize = 5;

fn files() -> Arc<dyn Files + Send + Sync> {
    let gold = "0.45 1.4 1.9\n0.55 0.4 2.4\n0.65 0.2 3.2\n";
    let body = "450 0.2\n550 0.6\n650 0.3\n";
    let texts = [("gold.nk", gold), ("body.spectra", body)];
    let texts = texts.map(|(name, text)| (name.to_owned(), Arc::from(text)));
    Arc::new(MemoryFiles(BTreeMap::from(texts)))
}

static MADE: LazyLock<BridgeFiles> = LazyLock::new(|| {
    let wanted =
        BridgeOptions { nodes: NODES, wavelengths: NM.to_vec(), derive: true, bands: true };
    product::make(SCENE, "two_balls", &files(), &wanted, &Control::default()).unwrap()
});

#[test]
fn tables_are_read_back_and_are_nists_integrals_over_rings() {
    let made = &*MADE;
    let json = r#"{"model": "Facet_BRDF_Model", "parameters": {"substrate": "gold.nk",
        "sdf": "Gaussian_Slope_Distribution_Function", "sdf.s": 0.5}}"#;
    let gold = Material::from_json(json).unwrap().prepare(Mode::Sound, Some(files())).unwrap();
    // The first band has 450, 500 and 550 nm in the place of red, green and blue.
    let table = read(&made.files["gold_b00.RISEdataBSDF"]).unwrap();
    assert_eq!(table, made.tables["gold_b00.RISEdataBSDF"]);
    let places: Vec<PatchRow> = (0..NODES * NODES)
        .map(|k| {
            let (inner, outer) = ring(k % NODES, NODES);
            let thetai = (22.5 * (k / NODES) as f64).min(89.0);
            PatchRow { thetai, thetas: 0.0, phis: 0.0, patch: Patch::Ring(inner, outer) }
        })
        .collect();
    let request = TableRequest {
        material: String::new(),
        directions: TableDirections::List(places),
        wavelengths: NM.to_vec(),
        settings: ColourQuery::default().settings(None).unwrap(),
        incident: [1.0, 0.0, 0.0, 0.0],
        stokes: false,
        basis: Basis::Psps,
        // Adaptive, as the program.
        sampling: None,
        limits: Limits::default(),
    };
    let rows = mueller(&gold, &request, &Control::default()).unwrap();
    for (at, (row, rgb)) in rows.iter().zip(&table.rgb).enumerate() {
        for (m, value) in row.matrices.iter().zip(rgb) {
            let exact = m[(0, 0)];
            // The same directions; the program goes through texts with 16 digits.
            assert!((value - exact).abs() <= 1e-6 * exact + 1e-12, "{at}: {value} {exact}");
        }
    }
}

#[test]
fn a_derived_diffuser_has_its_spectrum_in_every_ring() {
    let made = &*MADE;
    let table = &made.tables["body_b00.RISEdataBSDF"];
    for rgb in &table.rgb {
        for (value, reflectance) in rgb.iter().zip([0.2, 0.4, 0.6]) {
            // Printed with 16 digits; a constant has no error of integration.
            assert!((value * std::f64::consts::PI - reflectance).abs() < 1e-12);
        }
    }
    assert!((table.reflectance()[2] - 0.6).abs() < 1e-12);
}

#[test]
fn scenes_show_the_tables_and_keep_the_rest() {
    let made = &*MADE;
    let names: Vec<&str> = made.scenes.iter().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "two_balls_mist.RISEscene",
            "two_balls_mist_pol.RISEscene",
            "two_balls_b00.RISEscene",
            "two_balls_b01.RISEscene"
        ]
    );
    let text = |name: &str| String::from_utf8(made.files[name].clone()).unwrap();
    let plain = text(names[0]);
    assert!(plain.contains("filename\tgold.RISEdataBSDF") && plain.contains("composite_material"));
    assert!(plain.contains("directional_light") && plain.contains("material\tgold"));
    assert!(!plain.contains("mist: model"));
    assert!(text(names[1]).contains("filename\tgold_pol.RISEdataBSDF"));
    assert_eq!(product::images(&plain).unwrap(), ["balls_mist.png"]);
    assert_eq!(product::images(&text(names[2])).unwrap(), ["two_balls_b00.exr"]);
    // Glass is specular: it stays as it is, with the reason.
    assert!(made.skipped.iter().any(|reason| reason.starts_with("glass: ")), "{:?}", made.skipped);
    let program = text("gold.mist");
    assert!(program.contains("ANNULUS") && program.contains("$substrate = gold.nk"));
    assert!(made.files.contains_key("gold.nk") && made.files.contains_key("gold.dat"));
}

#[test]
fn the_filter_divides_the_light_of_facets() {
    let made = &*MADE;
    let sum = |file: &str| made.tables[file].rgb.iter().map(|c| c[1]).sum::<f64>();
    // Facets of a metal reflect more s than p: the filter for p darkens them.
    assert!(sum("gold_pol.RISEdataBSDF") < sum("gold.RISEdataBSDF"));
    assert!(sum("gold_pol.RISEdataBSDF") > 0.5 * sum("gold.RISEdataBSDF"));
}

#[test]
fn mistakes_of_a_scene_are_told_with_their_place() {
    let wanted =
        BridgeOptions { nodes: NODES, wavelengths: NM.to_vec(), derive: false, bands: false };
    let error = |scene: &str| {
        product::make(scene, "x", &files(), &wanted, &Control::default()).unwrap_err().to_string()
    };
    assert!(error("film\n").contains("RISE ASCII SCENE"));
    assert!(error("RISE ASCII SCENE 7\n").contains("no material"));
    let wrong = SCENE.replace("filter = p", "filter = x");
    assert!(error(&wrong).contains("neither s nor p"));
    let wrong = SCENE.replace("sdf.s = 0.5", "sdf.t = 0.5");
    assert!(error(&wrong).contains("no parameter t"), "{}", error(&wrong));
}

/// The rings of a table cover the hemisphere, so that they sum to its reflectance, at every width of
/// the lobe.
#[test]
fn rings_sum_to_the_hemispherical_reflectance() {
    let nm = [450.0, 550.0, 650.0];
    for slope in [0.01, 0.03, 0.1, 0.3, 1.0] {
        let scene = SCENE.replace("sdf.s = 0.5", &format!("sdf.s = {slope}"));
        assert_ne!(scene, SCENE);
        let wanted =
            BridgeOptions { nodes: 7, wavelengths: nm.to_vec(), derive: false, bands: true };
        let made =
            product::make(&scene, "two_balls", &files(), &wanted, &Control::default()).unwrap();
        let table = &made.tables["gold_b00.RISEdataBSDF"];
        let json = format!(
            r#"{{"model": "Facet_BRDF_Model", "parameters": {{"substrate": "gold.nk",
            "sdf": "Gaussian_Slope_Distribution_Function", "sdf.s": {slope}}}}}"#
        );
        let gold = Material::from_json(&json).unwrap().prepare(Mode::Sound, Some(files())).unwrap();
        for (band, nm) in nm.into_iter().enumerate() {
            let (model, _) = gold.at(nm / 1000.0).model().unwrap();
            for thetai in [0.0, 30.0, 75.0] {
                let incidence = Incidence::new(f64::to_radians(thetai), 0.0);
                let accuracy = Accuracy::required(1e-9, 10_000_000);
                let all =
                    integrate(&model, &incidence, Basis::Psps, &Region::Hemi, &accuracy, &|| false)
                        .unwrap();
                let sum: f64 = (0..7)
                    .map(|r| {
                        let (inner, outer) = ring(r, 7);
                        let square = |t: f64| t.to_radians().sin().powi(2);
                        let omega = std::f64::consts::PI * (square(outer) - square(inner));
                        omega * table.at(incidence.theta(), r)[band]
                    })
                    .sum();
                // Each ring has the default tolerance.
                let (want, off) = (all.matrix[(0, 0)], 1e-5 * all.matrix[(0, 0)]);
                assert!((sum - want).abs() < off, "slope {slope}, {thetai}°: {sum} {want}");
            }
        }
    }
}
