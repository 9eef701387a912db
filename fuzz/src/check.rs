//! Compilation of a program with a few data files.

use std::{collections::BTreeMap, sync::Arc};

use mist_engine::{MemoryFiles, Options, compile};
use scattering::Mode;

/// Asserts that compilation gives a job, or diagnostics whose places lie in the text.
pub fn compiles_or_says_why(text: &str) {
    for mode in [Mode::Sound, Mode::Compat] {
        let options = Options { mode, ..Options::default() };
        let Err(found) = compile(text, files(), &options) else { continue };
        assert!(!found.is_empty(), "a refusal says why");
        for diagnostic in found {
            let span = diagnostic.span;
            assert!(span.start <= span.end && span.end <= text.len(), "{diagnostic:?}");
        }
    }
}

fn files() -> Arc<MemoryFiles> {
    let files = [("list", "a #lambda\n1 0.5\n2 0.6\n"), ("table", "0.4 1.5 0\n0.7 1.4 0.1\n")];
    let named = files.map(|(name, text)| (name.to_owned(), Arc::from(text)));
    Arc::new(MemoryFiles(BTreeMap::from(named)))
}
