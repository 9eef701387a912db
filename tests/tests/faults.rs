//! Every seeded fault of `faults/` refers to an existing line of the sources.

use std::{collections::BTreeMap, fs, path::Path};

use serde_json::Value;

#[test]
fn every_seeded_fault_finds_its_line_once() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = tests.parent().expect("tests/ has a parent");
    let list = fs::read_to_string(tests.join("faults/faults.json")).unwrap();
    let faults: Vec<Value> = serde_json::from_str(&list).unwrap();
    let text = |fault: &Value, key: &str| fault[key].as_str().expect(key).to_owned();
    assert!(faults.len() >= 40, "only {} faults", faults.len());
    // In their order: a fault may lie in what an earlier one wrote.
    let mut files = BTreeMap::new();
    for fault in &faults {
        let name = text(fault, "file");
        let source = files
            .entry(name.clone())
            .or_insert_with(|| fs::read_to_string(root.join(name)).unwrap());
        let (find, write) = (text(fault, "find"), text(fault, "write"));
        assert_eq!(source.matches(&find).count(), 1, "{}: {find}", text(fault, "what"));
        assert!(write.contains("FAULT"), "{}: no switch", text(fault, "what"));
        *source = source.replace(&find, &write);
    }
}
