//! Paths such as `crate::program::parse` that the code of a module names, with their lines.

use proc_macro2::{Delimiter, Ident, Spacing, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Item, UseTree};

/// A path as it is written, without generic arguments.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenPath {
    /// Names between `::`, such as `["crate", "program", "parse"]`.
    pub segments: Vec<String>,
    /// Line of its first name, from 1.
    pub line: usize,
}

/// Name that a `use` line brings into a module.
#[derive(Clone, Debug)]
pub struct ImportedName {
    /// The name inside of the module; `*` for everything.
    pub local: String,
    /// Path that the name stands for.
    pub path: WrittenPath,
    /// True if other modules see the name (`pub use`, `pub(crate) use`).
    pub is_public: bool,
}

/// The names that the `use` items bring in.
pub fn imported_names(items: &[Item]) -> Vec<ImportedName> {
    let mut found = Vec::new();
    for item in items {
        if let Item::Use(item) = item {
            let is_public = !matches!(item.vis, syn::Visibility::Inherited);
            collect(&item.tree, &mut Vec::new(), is_public, &mut found);
        }
    }
    found
}

fn collect(tree: &UseTree, above: &mut Vec<Ident>, is_public: bool, found: &mut Vec<ImportedName>) {
    let mut push = |above: &[Ident], name: &Ident, local: String| {
        let mut segments: Vec<String> = above.iter().map(Ident::to_string).collect();
        if name != "self" || above.is_empty() {
            segments.push(name.to_string());
        }
        let local = match local.as_str() {
            "self" => segments.last().cloned().unwrap_or(local),
            _ => local,
        };
        let line = name.span().start().line;
        found.push(ImportedName { local, path: WrittenPath { segments, line }, is_public });
    };
    match tree {
        UseTree::Path(path) => {
            above.push(path.ident.clone());
            collect(&path.tree, above, is_public, found);
            above.pop();
        }
        UseTree::Name(name) => push(above, &name.ident, name.ident.to_string()),
        UseTree::Rename(rename) => push(above, &rename.ident, rename.rename.to_string()),
        UseTree::Glob(glob) => {
            let star = Ident::new("glob", glob.star_token.spans[0]);
            push(above, &star, "*".into());
            if let Some(last) = found.last_mut() {
                last.path.segments.pop();
            }
        }
        UseTree::Group(group) => {
            for tree in &group.items {
                collect(tree, above, is_public, found);
            }
        }
    }
}

/// Every path and single name in the code of `items`; `use` items are left out.
pub fn written_paths(items: &[Item]) -> Vec<WrittenPath> {
    let mut found = Vec::new();
    for item in items.iter().filter(|item| !matches!(item, Item::Use(_))) {
        walk(item.to_token_stream(), &mut found);
    }
    found
}

fn walk(tokens: TokenStream, found: &mut Vec<WrittenPath>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut at = 0;
    while at < tokens.len() {
        match &tokens[at] {
            TokenTree::Group(group) => {
                if !is_restriction(&tokens, at, group.delimiter()) {
                    walk(group.stream(), found);
                }
                at += 1;
            }
            TokenTree::Ident(first) if !is_continued(&tokens, at) => {
                let mut segments = vec![first.to_string()];
                at += 1;
                while let Some(name) = next_segment(&tokens, at) {
                    segments.push(name.to_string());
                    at += 3;
                }
                found.push(WrittenPath { segments, line: first.span().start().line });
            }
            _ => at += 1,
        }
    }
}

/// True if the group at `at` belongs to `pub(…)`.
fn is_restriction(tokens: &[TokenTree], at: usize, delimiter: Delimiter) -> bool {
    let before = at.checked_sub(1).map(|before| &tokens[before]);
    delimiter == Delimiter::Parenthesis
        && matches!(before, Some(TokenTree::Ident(word)) if word == "pub")
}

/// True if the name at `at` follows `::` or a dot.
fn is_continued(tokens: &[TokenTree], at: usize) -> bool {
    match at.checked_sub(1).map(|before| &tokens[before]) {
        Some(TokenTree::Punct(sign)) if sign.as_char() == '.' => {
            // `..name` is a range or the rest of a struct, not a field.
            !matches!(at.checked_sub(2).map(|i| &tokens[i]),
                Some(TokenTree::Punct(sign)) if sign.as_char() == '.')
        }
        Some(TokenTree::Punct(sign)) if sign.as_char() == ':' => {
            matches!(at.checked_sub(2).map(|i| &tokens[i]),
                Some(TokenTree::Punct(sign)) if sign.as_char() == ':' && sign.spacing() == Spacing::Joint)
        }
        _ => false,
    }
}

/// The name after `::` at `at`.
fn next_segment(tokens: &[TokenTree], at: usize) -> Option<&Ident> {
    match tokens.get(at..at + 3)? {
        [TokenTree::Punct(a), TokenTree::Punct(b), TokenTree::Ident(name)]
            if a.as_char() == ':' && b.as_char() == ':' && a.spacing() == Spacing::Joint =>
        {
            Some(name)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn items(text: &str) -> Vec<Item> {
        syn::parse_file(text).expect("the text is Rust").items
    }

    #[test]
    fn paths_are_found_in_code_and_in_macros() {
        let found =
            written_paths(&items("fn f() { g(crate::a::b(1)); println!(\"{}\", super::c) }"));
        let long: Vec<_> = found.iter().filter(|path| path.segments.len() > 1).collect();
        assert_eq!(long[0].segments, ["crate", "a", "b"]);
        assert_eq!(long[1].segments, ["super", "c"]);
    }

    #[test]
    fn fields_and_methods_are_not_names() {
        let found = written_paths(&items("fn f(x: T) { x.solve.y() }"));
        assert!(found.iter().all(|path| path.segments != ["solve"] && path.segments != ["y"]));
    }

    #[test]
    fn use_lines_are_taken_apart() {
        let found = imported_names(&items("pub use a::{self, b::C as D, e::*};"));
        let shown: Vec<_> =
            found.iter().map(|n| (n.local.as_str(), n.path.segments.join("::"))).collect();
        assert_eq!(shown, [("a", "a".into()), ("D", "a::b::C".into()), ("*", "a::e".into())]);
        assert!(found.iter().all(|name| name.is_public));
    }
}
