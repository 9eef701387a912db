//! The Rust sources of the workspace: crates, their modules and the items in them, without tests.
//!
//! `tests/tests/architecture.rs` asks these types what the crates depend on. The scanner reads the
//! sources with `syn`; it follows `mod` lines from `lib.rs` and `main.rs`, so a file that no module
//! declares is not seen, and it leaves out everything under `#[cfg(test)]`.

pub mod circles;
pub mod functions;
pub mod imports;
pub mod paths;
pub mod prose;

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use syn::{Attribute, ImplItem, Item, Meta};

/// The tree of modules below one `lib.rs` or `main.rs`.
pub struct CrateTree {
    /// Name of the package.
    pub package: String,
    /// Modules; the first is the root, a parent comes before its children.
    pub modules: Vec<Module>,
}

/// One module: a file, or a block `mod name { … }` in a file.
pub struct Module {
    /// Path from the root, such as `program::parse`; empty for the root itself.
    pub path: String,
    /// File that holds the module.
    pub file: PathBuf,
    /// Index of the parent; `None` for the root.
    pub parent: Option<usize>,
    /// Indices of the child modules by name.
    pub children: BTreeMap<String, usize>,
    /// Items of the module without tests and without `mod` items.
    pub items: Vec<Item>,
}

/// The folder of the workspace.
///
/// # Panics
///
/// If this package has no parent folder.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("tests/ has a parent").to_owned()
}

/// Names of the folders in `members` of the workspace's `Cargo.toml`, in its order.
///
/// # Panics
///
/// If the manifest cannot be read or has no `members`.
pub fn packages() -> Vec<String> {
    let text = fs::read_to_string(root().join("Cargo.toml")).expect("the manifest can be read");
    let (_, members) = text.split_once("members = [").expect("the manifest lists its members");
    let (members, _) = members.split_once(']').expect("the list of members ends");
    members.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// Every tree of modules in the folder `src` of `package`.
///
/// # Panics
///
/// If a source cannot be read or parsed.
pub fn trees(package: &str) -> Vec<CrateTree> {
    let src = root().join(package).join("src");
    let roots = ["lib.rs", "main.rs"].map(|name| src.join(name));
    roots.into_iter().filter(|file| file.exists()).map(|file| tree(package, file)).collect()
}

fn tree(package: &str, file: PathBuf) -> CrateTree {
    let folder = file.parent().expect("a source is in a folder").to_owned();
    let items = parse(&file);
    let mut tree = CrateTree { package: package.to_owned(), modules: Vec::new() };
    tree.add(None, "", ModuleFile { file, folder }, items);
    tree
}

/// The file of a module and the folder of its children.
struct ModuleFile {
    file: PathBuf,
    folder: PathBuf,
}

impl CrateTree {
    /// Adds a module and, below it, the modules that it declares; gives its index.
    fn add(
        &mut self,
        parent: Option<usize>,
        name: &str,
        place: ModuleFile,
        items: Vec<Item>,
    ) -> usize {
        let path = match parent.map(|parent| self.modules[parent].path.as_str()) {
            None => String::new(),
            Some("") => name.to_owned(),
            Some(above) => format!("{above}::{name}"),
        };
        let (declared, items) = split(items);
        let index = self.modules.len();
        let file = place.file.clone();
        self.modules.push(Module { path, file, parent, children: BTreeMap::new(), items });
        for module in declared {
            let name = module.ident.to_string();
            let (place, items) = match module.content {
                Some((_, items)) => {
                    let folder = place.folder.join(&name);
                    (ModuleFile { file: place.file.clone(), folder }, items)
                }
                None => {
                    let found = child_file(&place.folder, &name);
                    let items = parse(&found.file);
                    (found, items)
                }
            };
            let child = self.add(Some(index), &name, place, items);
            self.modules[index].children.insert(name, child);
        }
        index
    }
}

/// Separates the modules that are declared from the other items; both without tests.
fn split(items: Vec<Item>) -> (Vec<syn::ItemMod>, Vec<Item>) {
    let mut declared = Vec::new();
    let mut others = Vec::new();
    for item in items {
        match item {
            Item::Mod(module) if !is_test(&module.attrs) => declared.push(module),
            Item::Mod(_) => {}
            other => others.extend(without_tests(other)),
        }
    }
    (declared, others)
}

fn child_file(folder: &Path, name: &str) -> ModuleFile {
    let beside = folder.join(format!("{name}.rs"));
    let inside = folder.join(name).join("mod.rs");
    let file = if beside.exists() { beside } else { inside };
    ModuleFile { file, folder: folder.join(name) }
}

fn parse(file: &Path) -> Vec<Item> {
    let text = fs::read_to_string(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let parsed = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    parsed.items
}

/// The item, or nothing if it is compiled for tests only.
fn without_tests(item: Item) -> Option<Item> {
    if is_test(attributes(&item)) {
        return None;
    }
    Some(match item {
        Item::Impl(mut block) => {
            block.items.retain(|item| match item {
                ImplItem::Fn(function) => !is_test(&function.attrs),
                ImplItem::Const(constant) => !is_test(&constant.attrs),
                _ => true,
            });
            Item::Impl(block)
        }
        other => other,
    })
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) if list.path.is_ident("cfg") => list.tokens.to_string() == "test",
        Meta::Path(path) => path.is_ident("test"),
        _ => false,
    })
}

/// Name of a type, trait or alias that an item declares.
pub fn type_name(item: &Item) -> Option<String> {
    match item {
        Item::Enum(item) => Some(item.ident.to_string()),
        Item::Struct(item) => Some(item.ident.to_string()),
        Item::Trait(item) => Some(item.ident.to_string()),
        Item::Type(item) => Some(item.ident.to_string()),
        Item::Union(item) => Some(item.ident.to_string()),
        _ => None,
    }
}

/// All Rust sources below `folder`, in order of their names.
///
/// # Panics
///
/// If a folder cannot be read.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    for entry in entries {
        let path = entry.expect("the folder can be read").path();
        if path.is_dir() {
            if path.file_name().is_none_or(|name| name != "target") {
                found.extend(files(&path));
            }
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// `path` relative to the workspace, with `/` between the names.
pub fn shown(path: &Path) -> String {
    path.strip_prefix(root()).unwrap_or(path).to_string_lossy().replace('\\', "/")
}
