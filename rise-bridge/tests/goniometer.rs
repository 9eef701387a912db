//! Goniometer tables: round trip, and agreement with the material.

use mist_engine::{Control, material::Material};
use rise_bridge::{
    export::Bands,
    goniometer::{GoniometerAxes, GoniometerForm, choose_axes, interpolation_error, read, write},
};
use scattering::{Basis, Geometry, Mode};

const FORMS: [GoniometerForm; 3] =
    [GoniometerForm::OpenMaterial, GoniometerForm::Astm, GoniometerForm::Ocean];

fn bands() -> Bands {
    let json = r#"{"model": "Facet_BRDF_Model", "parameters": {"substrate": "(0.7,2.4)"}}"#;
    let material = Material::from_json(json).unwrap().prepare(Mode::Sound, None).unwrap();
    Bands::new(&material, &[450.0, 550.5, 650.0]).unwrap()
}

fn axes() -> GoniometerAxes {
    GoniometerAxes {
        thetai: vec![0.0, 30.0, 75.0],
        thetas: vec![0.0, 40.0],
        phis: vec![-90.0, 0.0, 180.0],
    }
}

fn text(form: GoniometerForm) -> String {
    let out = write(&bands(), &axes(), form, "gold, rough", Vec::new(), &Control::default());
    String::from_utf8(out.unwrap()).unwrap()
}

#[test]
fn every_form_brings_the_material_back() {
    let bands = bands();
    for form in FORMS {
        let table = read(&text(form), form).unwrap();
        assert_eq!(table.rows.len(), axes().directions());
        for (ours, nm) in table.nm.iter().zip(bands.nm()) {
            assert!((ours - nm).abs() < 1e-9);
        }
        for row in &table.rows {
            let [theta_i, theta_s, phi_s] = [row.thetai, row.thetas, row.phis].map(f64::to_radians);
            let at = Geometry { theta_i, theta_s, phi_s, rotation: 0.0 };
            for (value, model) in row.values.iter().zip(bands.models()) {
                let exact = model.mueller(&at, Basis::Psps)[(0, 0)];
                // The angles went through radians and back.
                assert!((value - exact).abs() <= 1e-12 * exact, "{form:?} {row:?} {exact}");
            }
        }
    }
}

#[test]
fn tables_that_were_cut_off_or_changed_are_refused() {
    let cut = |form: GoniometerForm, keep: usize| {
        let text = text(form);
        let kept: Vec<&str> = text.lines().take(text.lines().count() - keep).collect();
        read(&kept.join("\n"), form)
    };
    assert!(cut(GoniometerForm::Astm, 1).is_err());
    assert!(cut(GoniometerForm::OpenMaterial, 1).is_err());
    let wrong = text(GoniometerForm::Ocean).replace("0,180,0,-90", "0,180,zero,-90");
    assert!(read(&wrong, GoniometerForm::Ocean).unwrap_err().to_string().starts_with("line 5"));
    let flat = GoniometerAxes { thetas: vec![0.0, 90.0], ..axes() };
    assert!(
        write(&bands(), &flat, GoniometerForm::Astm, "x", Vec::new(), &Control::default()).is_err()
    );
}

#[test]
fn a_chosen_grid_is_as_near_as_was_asked() {
    let bands = bands();
    let coarse = interpolation_error(&bands, &axes());
    assert!(coarse.quantile_95 > coarse.median && coarse.quantile_95 > 0.05, "{coarse:?}");
    let (axes, found) = choose_axes(&bands, 0.05).unwrap();
    assert!(found.quantile_95 <= 0.05 && found == interpolation_error(&bands, &axes), "{found:?}");
    let refusal = choose_axes(&bands, 1e-9).unwrap_err().to_string();
    assert!(refusal.contains("finest grid"), "{refusal}");
    let white = r#"{"model": "Lambertian_BRDF_Model"}"#;
    let white = Material::from_json(white).unwrap().prepare(Mode::Sound, None).unwrap();
    // A constant is met by the coarsest grid, to rounding.
    let (axes, found) = choose_axes(&Bands::new(&white, &[550.0]).unwrap(), 1e-9).unwrap();
    assert!(axes.thetai.len() == 6 && found.quantile_95 < 1e-12, "{found:?}");
}
