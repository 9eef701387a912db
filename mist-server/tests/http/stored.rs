//! Stores that version 0.1 has written stay readable; what cannot be used any more is left alone.

use std::path::Path;

use axum::http::{Method, StatusCode};
use mist_server::{ServeLimits, http::App};
use redb::{Database, TableDefinition};
use serde_json::json;

use crate::ask::ask;

const MATERIALS: TableDefinition<'_, &str, &str> = TableDefinition::new("materials");
const JOBS: TableDefinition<'_, &str, &str> = TableDefinition::new("jobs");
const PROGRAMS: TableDefinition<'_, &str, &str> = TableDefinition::new("programs");
const STEPS: TableDefinition<'_, (&str, u64), &[u8]> = TableDefinition::new("steps");
const TEXTS: TableDefinition<'_, (&str, &str), &str> = TableDefinition::new("texts");

/// The records of two jobs as `mist serve` 0.1 wrote them.
const DONE: &str = r#"{"number":0,"client":"127.0.0.1","bytes":585,"status":{"id":"dfdb9bbf7907f02eee7ee458","state":"done","progress":1.0,"submitted":1796083287.393,"started":1796083287.396,"finished":1796083287.412,"header_lines":0,"steps":3,"defects":["this run meets a defect"],"texts":["results","listing"]}}"#;
const FAILED: &str = r#"{"number":1,"client":"127.0.0.1","bytes":363,"status":{"id":"8006a5b72401726a6174ba42","state":"failed","progress":0.0,"submitted":1796083287.514,"started":1796083287.52,"finished":1796083287.521,"header_lines":0,"problem":{"title":"Unprocessable Entity","status":422,"code":"limit","message":"R would have 3.134e20 directions, more than 4e6: make differential larger or minsamples and polygonsides smaller"}}}"#;

/// A store of version 0.1 in `folder`.
fn write_store(folder: &Path) {
    let database = Database::create(folder.join("mist.redb")).unwrap();
    let change = database.begin_write().unwrap();
    {
        let mut materials = change.open_table(MATERIALS).unwrap();
        materials.insert("white", r#"{"model":"Lambertian_BRDF_Model"}"#).unwrap();
        materials.insert("gone", r#"{"model":"Model_Of_Yore"}"#).unwrap();
        let mut jobs = change.open_table(JOBS).unwrap();
        jobs.insert("dfdb9bbf7907f02eee7ee458", DONE).unwrap();
        jobs.insert("8006a5b72401726a6174ba42", FAILED).unwrap();
        jobs.insert("torn", "{").unwrap();
        change.open_table(PROGRAMS).unwrap();
        change.open_table(STEPS).unwrap();
        let mut texts = change.open_table(TEXTS).unwrap();
        texts.insert(("dfdb9bbf7907f02eee7ee458", "results"), "f\n1\n2\n3\n").unwrap();
    }
    change.commit().unwrap();
}

#[tokio::test]
async fn a_store_of_version_0_1_is_read() {
    let folder = tempfile::tempdir().unwrap();
    write_store(folder.path());
    let app = App::new(ServeLimits::default(), Some(folder.path()), None).unwrap();

    let materials = ask(&app, Method::GET, "/v1/materials", None, "").await.json();
    let names: Vec<_> = materials.as_array().unwrap().iter().map(|m| &m["name"]).collect();
    assert_eq!(names, ["white"]);
    let missing = ask(&app, Method::GET, "/v1/materials/gone", None, "").await;
    assert_eq!(missing.status, StatusCode::NOT_FOUND);

    let jobs = ask(&app, Method::GET, "/v1/jobs", None, "").await.json();
    assert_eq!(jobs.as_array().unwrap().len(), 2);
    let results = ask(&app, Method::GET, "/v1/jobs/dfdb9bbf7907f02eee7ee458/results", None, "");
    assert_eq!(results.await.text, "f\n1\n2\n3\n");
    let failed = ask(&app, Method::GET, "/v1/jobs/8006a5b72401726a6174ba42", None, "").await.json();
    assert_eq!(failed["problem"]["title"], json!("Unprocessable Entity"));
    assert_eq!(
        (&failed["problem"]["status"], &failed["problem"]["code"]),
        (&json!(422), &json!("limit"))
    );
    app.stop();
}
