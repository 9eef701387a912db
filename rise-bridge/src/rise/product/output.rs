//! The files of a bridge run.

use std::collections::BTreeMap;

use mist_engine::Warning;

use crate::rise::table::RingTable;

/// The files that a run makes.
#[derive(Clone, Debug, Default)]
pub struct BridgeFiles {
    /// Names and contents of the files.
    pub files: BTreeMap<String, Vec<u8>>,
    /// Scenes that can be rendered, by the names of their files.
    pub scenes: Vec<String>,
    /// The pictures of product B, one per render; [`stack`](fn@crate::rise::stack::stack) combines
    /// them.
    pub bands: Vec<String>,
    /// The tables by the names of their files.
    pub tables: BTreeMap<String, RingTable>,
    /// Materials that are not converted, with the reason.
    pub skipped: Vec<String>,
    /// Warnings of the materials.
    pub warnings: Vec<Warning>,
    /// Values that were invented, after the name of the material.
    pub invented: Vec<String>,
}

/// The names of the tables of one material.
pub(super) struct MaterialTables {
    pub(super) plain: String,
    pub(super) filtered: Option<String>,
    pub(super) bands: Vec<String>,
}

impl BridgeFiles {
    pub(super) fn add(&mut self, file: &str, table: RingTable) {
        self.files.insert(file.to_owned(), table.bytes());
        self.tables.insert(file.to_owned(), table);
    }

    pub(super) fn text(&mut self, file: &str, text: String) {
        self.files.insert(file.to_owned(), text.into_bytes());
    }
}
