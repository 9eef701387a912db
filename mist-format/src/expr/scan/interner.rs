//! Distinct names with their indices.

use std::collections::HashMap;

/// Distinct names in the order of their first use.
#[derive(Default)]
pub(super) struct Interner {
    pub(super) list: Vec<String>,
    places: HashMap<String, u32>,
}

impl Interner {
    /// The index of `name`, which is added if it is new.
    pub(super) fn intern(&mut self, name: &str) -> u32 {
        if let Some(place) = self.places.get(name) {
            return *place;
        }
        let place = self.list.len() as u32;
        self.places.insert(name.to_owned(), place);
        self.list.push(name.to_owned());
        place
    }
}
