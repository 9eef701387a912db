//! `mist export` and the same tables over HTTP.

use std::{fs, path::Path};

use assert_cmd::Command;
use axum::{
    body::{Body, to_bytes},
    http::{HeaderValue, Request, StatusCode, header},
};
use mist_server::http::{App, router};
use rise_bridge::{mitsuba::pbsdf::PbsdfTable, tensor::TensorReader};
use tempfile::TempDir;
use tower::ServiceExt;

const METAL: &str = r#"{"model": "Facet_BRDF_Model", "parameters": {"substrate": "(0.7,2.4)",
    "sdf": "Gaussian_Slope_Distribution_Function", "sdf.s": 0.35}}"#;
const NM: &str = "450,500,550,600,650";

fn folder() -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("metal.json"), METAL).unwrap();
    dir
}

/// The standard output of the command; panics if it fails.
fn good(dir: &Path, words: &[&str]) -> String {
    let output = Command::cargo_bin("mist").unwrap().current_dir(dir).args(words).unwrap();
    String::from_utf8(output.stdout).unwrap()
}

/// Its exit code and what it writes to standard error.
fn bad(dir: &Path, words: &[&str]) -> (i32, String) {
    let output = Command::cargo_bin("mist").unwrap().current_dir(dir).args(words).output().unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn a_pbsdf_is_written_with_its_error_and_agrees_with_its_material() {
    let dir = folder();
    let words = ["export", "metal.json", "--format", "pbsdf", "--wavelengths", NM, "--grid"];
    let said = good(dir.path(), &[&words[..], &["9x8x12", "-o", "metal.pbsdf"]].concat());
    assert!(said.contains("9x8x12 nodes, 5 wavelengths") && said.contains('%'), "{said}");
    let file = fs::File::open(dir.path().join("metal.pbsdf")).unwrap();
    assert_eq!(PbsdfTable::read(file).unwrap().axes()[0].len(), 9);
    let said = good(dir.path(), &["export", "metal.json", "--compare", "metal.pbsdf"]);
    assert!(said.contains("\n550\t1.000000\t"), "{said}");
}

#[test]
fn a_program_gives_the_model_of_its_first_step() {
    let dir = folder();
    let program = "MODEL = Facet_BRDF_Model\nVARIABLES:\ns = 0.35 t = 0\n$substrate = (0.7,2.4)\n\
        $sdf = Gaussian_Slope_Distribution_Function\n#sdf.s = s\n\
        incidentangle = t incidentpol = (1,0,0,0) rotation = 0 differential = 1 minsamples = 10 END\n\
        VARY: FOR s FROM 0.35 TO 0.5 BY 0.1 END\nINTEGRALS: END\nOUTPUTS: END\nFILES: END\n";
    fs::write(dir.path().join("metal.mist"), program).unwrap();
    for name in ["metal.json", "metal.mist"] {
        good(dir.path(), &["export", name, "--grid", "5x4x6", "-o", &format!("{name}.pbsdf")]);
    }
    let numbers = |name: &str| {
        let file = fs::File::open(dir.path().join(name)).unwrap();
        TensorReader::open(file).unwrap().numbers("M").unwrap()
    };
    assert_eq!(numbers("metal.json.pbsdf"), numbers("metal.mist.pbsdf"));
}

#[test]
fn every_format_is_known_by_its_name() {
    let dir = folder();
    let grid = "thetai=0:40:80,thetas=0:40:80,phis=0:90:180";
    for (name, more) in [
        ("a.bsdf", &["--grid", "4x8"][..]),
        ("b.bsdf", &["--grid", "4x8", "--rgb"]),
        ("a.xompt", &["--grid", grid]),
        ("a.astm", &["--grid", grid]),
        ("a.csv", &["--grid", grid]),
        ("a.pbsdf", &["--grid", "5x4x6", "--plugin", "--wavelengths", "400:50:700"]),
    ] {
        let said = good(dir.path(), &[&["export", "metal.json", "-o", name], more].concat());
        assert!(said.starts_with(name), "{said}");
        assert!(fs::metadata(dir.path().join(name)).unwrap().len() > 100);
    }
}

#[test]
fn what_cannot_be_written_is_refused_with_the_reason_and_leaves_no_file() {
    let dir = folder();
    fs::write(
        dir.path().join("glass.json"),
        METAL.replace("(0.7,2.4)\"", "(1.5,0)\", \"type\": 1"),
    )
    .unwrap();
    for (words, reason) in [
        (&["metal.json", "--wavelengths", "400:50:700"][..], "exactly 5"),
        (&["metal.json", "--grid", "37x46"], "phi_d, theta_d and theta_h"),
        (&["metal.json", "--grid", "auto:0"], "percentage"),
        (&["glass.json"], "type: 1 is not reflection"),
        (&["metal.json", "--wavelengths", "450,440,550,600,650"], "rising wavelengths"),
    ] {
        let all = [&["export"], words, &["-o", "x.pbsdf"]].concat();
        let (code, said) = bad(dir.path(), &all);
        assert!(code == 2 && said.contains(reason), "{words:?}: {said}");
        assert!(!dir.path().join("x.pbsdf").exists());
    }
    let (code, said) = bad(dir.path(), &["export", "metal.json", "-o", "x.dat"]);
    assert!(code == 2 && said.contains("--format"), "{said}");
    fs::write(dir.path().join("cut.pbsdf"), "tensor_file").unwrap();
    let (code, said) = bad(dir.path(), &["export", "metal.json", "--compare", "cut.pbsdf"]);
    assert!(code == 2 && said.contains("not a tensor file"), "{said}");
}

#[tokio::test]
async fn the_service_gives_the_tables_by_one_url_and_knows_its_tags() {
    let app = App::default();
    let ask = async |mut request: Request<Body>| {
        request.headers_mut().insert(header::HOST, HeaderValue::from_static("localhost"));
        router(app.clone()).oneshot(request).await.unwrap()
    };
    let put = Request::put("/v1/materials/metal")
        .header("content-type", "application/json")
        .body(Body::from(METAL))
        .unwrap();
    assert_eq!(ask(put).await.status(), StatusCode::CREATED);
    for (file, field) in [
        ("table.pbsdf?grid=5x4x6", "M"),
        ("table.bsdf?grid=4x8", "spectra"),
        ("table.bsdf?grid=4x8&rgb=1", "rgb"),
    ] {
        let uri = format!("/v1/materials/metal/{file}");
        let answer = ask(Request::get(&uri).body(Body::empty()).unwrap()).await;
        assert_eq!(answer.status(), StatusCode::OK, "{file}");
        let tag = answer.headers()[header::ETAG].clone();
        let bytes = to_bytes(answer.into_body(), 1 << 24).await.unwrap();
        assert!(TensorReader::open(std::io::Cursor::new(bytes)).unwrap().field(field).is_ok());
        let again = Request::get(&uri).header(header::IF_NONE_MATCH, tag);
        let again = ask(again.body(Body::empty()).unwrap()).await;
        assert_eq!(again.status(), StatusCode::NOT_MODIFIED);
    }
    for (file, begins) in [
        ("table.RISEdataBSDF?nodes=4&lambda=450:100:650&filter=p", &[0xdf, 0x0b, 0, 0][..]),
        ("table.xompt?thetai=0&thetas=0:40:80&phis=0", b"{\"metadata\""),
        ("table.astm?thetai=0&thetas=0:40:80&phis=0", b"PROGRAM"),
        ("table.csv?thetai=0&thetas=0:40:80&phis=0", b"generator,"),
        ("table.xml?lambda=400:100:700", b"<?xml"),
    ] {
        let uri = format!("/v1/materials/metal/{file}");
        let answer = ask(Request::get(uri).body(Body::empty()).unwrap()).await;
        assert_eq!(answer.status(), StatusCode::OK, "{file}");
        let bytes = to_bytes(answer.into_body(), 1 << 24).await.unwrap();
        assert!(bytes.starts_with(begins), "{file}");
    }
    for wrong in
        ["table.pbsdf?grid=5x4", "table.pbsdf?lambda=400:50:700", "table.bsdf?grid=4000x4000"]
    {
        let uri = format!("/v1/materials/metal/{wrong}");
        let answer = ask(Request::get(uri).body(Body::empty()).unwrap()).await;
        assert_eq!(answer.status(), StatusCode::UNPROCESSABLE_ENTITY, "{wrong}");
    }
    let unknown = Request::get("/v1/materials/metal/table.pbsdf?grit=1").body(Body::empty());
    assert_eq!(ask(unknown.unwrap()).await.status(), StatusCode::BAD_REQUEST);
}
