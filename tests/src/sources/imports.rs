//! Graph of the modules of a crate that use each other.

use std::{
    collections::{BTreeMap, BTreeSet},
    fmt,
};

use syn::Item;

use super::{
    CrateTree, Module,
    paths::{ImportedName, WrittenPath, imported_names, written_paths},
    shown,
};

/// The place where one module uses another.
#[derive(Clone, Debug)]
pub struct Usage {
    /// File of the module that uses.
    pub file: String,
    /// Line in it.
    pub line: usize,
    /// The path as it is written.
    pub path: String,
}

impl fmt::Display for Usage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.file, self.line, self.path)
    }
}

/// Edges between the modules of one crate, by index: user → used, with the first place.
pub type Edges = BTreeMap<(usize, usize), Usage>;

/// Names that a module declares and imports.
struct Contents {
    declared: BTreeSet<String>,
    imported: Vec<ImportedName>,
    code: Vec<WrittenPath>,
}

/// Every use of one module of the crate by another.
///
/// A name that a module only re-exports counts as a use of the module that declares it. A `pub use`
/// by itself is not a use: it only declares.
pub fn edges(tree: &CrateTree) -> Edges {
    let contents: Vec<Contents> = tree.modules.iter().map(contents).collect();
    let crates = super::packages().iter().map(|name| name.replace('-', "_")).collect();
    let resolver = Resolver { tree, contents: &contents, crates };
    let mut edges = Edges::new();
    for (user, module) in tree.modules.iter().enumerate() {
        let own = &contents[user];
        let named: BTreeSet<&str> = own.code.iter().map(|path| path.segments[0].as_str()).collect();
        let imports = own
            .imported
            .iter()
            .filter(|import| !import.is_public || named.contains(import.local.as_str()));
        let paths = imports.map(|import| &import.path).chain(own.code.iter());
        for path in paths.filter(|path| path.segments.len() > 1 || path.segments[0] == "super") {
            if let Some(used) = resolver.module_of(user, &path.segments, 0)
                && used != user
            {
                edges.entry((user, used)).or_insert_with(|| Usage {
                    file: shown(&module.file),
                    line: path.line,
                    path: path.segments.join("::"),
                });
            }
        }
    }
    edges
}

fn contents(module: &Module) -> Contents {
    Contents {
        declared: module.items.iter().filter_map(declared_name).collect(),
        imported: imported_names(&module.items),
        code: written_paths(&module.items),
    }
}

fn declared_name(item: &Item) -> Option<String> {
    match item {
        Item::Const(item) => Some(item.ident.to_string()),
        Item::Fn(item) => Some(item.sig.ident.to_string()),
        Item::Static(item) => Some(item.ident.to_string()),
        Item::Macro(item) => item.ident.as_ref().map(ToString::to_string),
        other => super::type_name(other),
    }
}

/// Finds the module in which a path ends.
struct Resolver<'a> {
    tree: &'a CrateTree,
    contents: &'a [Contents],
    /// Names of the crates of the workspace.
    crates: Vec<String>,
}

/// Longest chain of re-exports.
const MAX_REEXPORTS: usize = 12;

impl Resolver<'_> {
    /// The module that declares what `segments`, written in module `from`, names; `None` for names
    /// of other crates.
    fn module_of(&self, from: usize, segments: &[String], depth: usize) -> Option<usize> {
        if depth > MAX_REEXPORTS {
            return None;
        }
        let modules = &self.tree.modules;
        let first = segments.first()?.as_str();
        let rest = &segments[1..];
        match first {
            "crate" => self.descend(0, rest, depth),
            "self" => self.descend(from, rest, depth),
            "super" => self.descend_from_super(modules[from].parent?, rest, depth),
            name if modules[from].children.contains_key(name) => {
                self.descend(from, segments, depth)
            }
            // A function may have the name of a crate; before `::` the crate is meant.
            name if !rest.is_empty() && self.crates.iter().any(|known| known == name) => None,
            name => {
                let import = self.contents[from].imported.iter().find(|i| i.local == name)?;
                if import.path.segments == segments {
                    return None;
                }
                let path: Vec<String> = import.path.segments.iter().chain(rest).cloned().collect();
                self.module_of(from, &path, depth + 1)
            }
        }
    }

    fn descend_from_super(&self, at: usize, rest: &[String], depth: usize) -> Option<usize> {
        if rest.first().is_some_and(|name| name == "super") {
            return self.descend_from_super(self.tree.modules[at].parent?, &rest[1..], depth);
        }
        self.descend(at, rest, depth)
    }

    /// Follows `segments` from module `at` on, through children and re-exports.
    fn descend(&self, at: usize, segments: &[String], depth: usize) -> Option<usize> {
        if depth > MAX_REEXPORTS {
            return None;
        }
        let Some(name) = segments.first() else { return Some(at) };
        if let Some(&child) = self.tree.modules[at].children.get(name) {
            return self.descend(child, &segments[1..], depth);
        }
        let contents = &self.contents[at];
        if contents.declared.contains(name) {
            return Some(at);
        }
        if let Some(import) = contents.imported.iter().find(|import| import.local == *name) {
            let path: Vec<String> =
                import.path.segments.iter().chain(&segments[1..]).cloned().collect();
            // A name of another crate that is passed on: this module declares it for ours.
            return self.module_of(at, &path, depth + 1).or(Some(at));
        }
        for glob in contents.imported.iter().filter(|import| import.local == "*") {
            if let Some(module) = self.module_of(at, &glob.path.segments, depth + 1)
                && module != at
                && self.has(module, name)
            {
                return self.descend(module, segments, depth + 1);
            }
        }
        Some(at)
    }

    fn has(&self, module: usize, name: &String) -> bool {
        self.tree.modules[module].children.contains_key(name)
            || self.contents[module].declared.contains(name)
            || self.contents[module].imported.iter().any(|import| import.local == *name)
    }
}
