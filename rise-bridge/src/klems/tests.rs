//! Files of known materials, the geometry of the patches, the error.

use std::f64::consts::PI;

use mist_engine::{Control, material::Material};
use scattering::Mode;

use super::{
    basis::{containing, patches},
    *,
};
use crate::export::Bands;

fn file(json: &str) -> Vec<KlemsBlock> {
    let material = Material::from_json(json).unwrap().prepare(Mode::Sound, None).unwrap();
    let bands = Bands::new(&material, &[400.0, 500.0, 600.0, 700.0]).unwrap();
    let out = write(&bands, "a < b", Vec::new(), &Control::default()).unwrap();
    read(&String::from_utf8(out).unwrap()).unwrap()
}

#[test]
fn a_grey_diffuser_has_one_value_in_all_bands() {
    let blocks = file(
        r#"{"model": "Lambertian_BRDF_Model",
        "parameters": {"reflectance": "Table_Reflectance", "reflectance.table": 0.5}}"#,
    );
    assert_eq!(blocks.len(), 6);
    for value in blocks.iter().flat_map(|block| block.values.iter().flatten()) {
        // The sums of the three colour-matching functions differ by parts in 10⁴.
        assert!((value * PI - 0.5).abs() < 2e-4, "{value}");
    }
}

#[test]
fn the_light_of_facets_is_on_the_diagonal_and_patches_fill_the_hemisphere() {
    let omegas = projected_solid_angles();
    assert_eq!(omegas.len(), 145);
    assert!((omegas.iter().sum::<f64>() - PI).abs() < 1e-12);
    let blocks = file(
        r#"{"model": "Facet_BRDF_Model", "parameters": {"substrate": "(0.7,2.4)",
        "sdf": "Gaussian_Slope_Distribution_Function", "sdf.s": 0.2}}"#,
    );
    for from in [0, 5, 40, 100] {
        let column: Vec<f64> = blocks[0].values.iter().map(|row| row[from]).collect();
        let most = column.iter().copied().fold(0.0, f64::max);
        assert_eq!(column[from], most, "{from}");
    }
}

#[test]
fn every_patch_contains_its_centre_and_its_directions() {
    for (k, patch) in patches().iter().enumerate() {
        assert_eq!(containing(patch.centre()), k);
        for (u, w) in [(0.01, 0.01), (0.01, 0.99), (0.99, 0.01), (0.99, 0.99)] {
            assert_eq!(containing(patch.direction(u, w)), k, "{u} {w}");
        }
    }
}

#[test]
fn the_error_is_zero_for_a_diffuser_and_grows_as_the_lobe_narrows() {
    let of = |json: &str| {
        let material = Material::from_json(json).unwrap().prepare(Mode::Sound, None).unwrap();
        interpolation_error(&Bands::new(&material, &[400.0, 550.0, 700.0]).unwrap()).unwrap()
    };
    let facets = |slope: f64| {
        of(&format!(
            r#"{{"model": "Facet_BRDF_Model", "parameters": {{"substrate": "(0.7,2.4)",
            "sdf": "Gaussian_Slope_Distribution_Function", "sdf.s": {slope}}}}}"#
        ))
    };
    let white = of(r#"{"model": "Lambertian_BRDF_Model", "parameters": {}}"#);
    assert!(white.quantile_95 < 1e-12, "{white:?}");
    let (wide, narrow) = (facets(0.5), facets(0.1));
    assert!(wide.median > 0.01 && 2.0 * wide.median < narrow.median, "{wide:?} {narrow:?}");
}

/// A file of one block with the white space of WINDOW and genBSDF: tabs, carriage returns, a
/// comma behind every number.
fn with_tabs() -> String {
    let row = |value: f64| vec![format!("{value:.6},\t"); 145].concat();
    let rows: Vec<String> = (0..145).map(|k| row(0.001 * f64::from(k))).collect();
    let head = "<?xml version=\"1.0\"?>\r\n<WindowElement>\r\n\t<DataDefinition>\r\n\
        \t\t<IncidentDataStructure>Columns</IncidentDataStructure>\r\n\
        \t\t<AngleBasis>\r\n\t\t<AngleBasisName>LBNL/Klems Full</AngleBasisName>\r\n\
        \t</AngleBasis></DataDefinition>\r\n";
    format!(
        "{head}\t<WavelengthData>\r\n\t\t<LayerNumber>System</LayerNumber>\r\n\
         \t\t<Wavelength unit=\"Integral\">Visible</Wavelength>\r\n\
         \t<WavelengthDataBlock>\r\n\
         \t\t<WavelengthDataDirection>\r\n\tTransmission Front\r\n</WavelengthDataDirection>\r\n\
         \t\t<ScatteringDataType>BTDF</ScatteringDataType>\r\n\
         \t\t<ScatteringData>\r\n{}\r\n\t\t</ScatteringData>\r\n\
         \t</WavelengthDataBlock>\r\n\t</WavelengthData>\r\n</WindowElement>\r\n",
        rows.join("\r\n")
    )
}

#[test]
fn white_space_of_all_kinds_is_read() {
    let blocks = read(&with_tabs()).unwrap();
    assert_eq!(blocks.len(), 1);
    assert_eq!(
        (blocks[0].band.as_str(), blocks[0].side.as_str()),
        ("Visible", "Transmission Front")
    );
    assert_eq!((blocks[0].values[7][0], blocks[0].values[144][144]), (0.007, 0.144));
    let wrong = read(&with_tabs().replace("0.007000,\t", "x,\t")).unwrap_err().to_string();
    assert!(wrong.contains("\"x\" is not a number"), "{wrong}");
    let half = with_tabs().replace("Klems Full", "Klems Half");
    assert!(read(&half).unwrap_err().to_string().contains("LBNL/Klems Half; expected"));
}

#[test]
fn other_files_are_refused() {
    assert!(read("<WindowElement/>").is_err());
}
