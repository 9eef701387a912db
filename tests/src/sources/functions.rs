//! Lengths of functions in lines.

use proc_macro2::Span;
use syn::{ImplItem, Item, TraitItem, spanned::Spanned};

use super::CrateTree;

/// Lengths of the functions of a crate outside of tests, from the line of `fn` to the closing brace.
pub fn function_lengths(tree: &CrateTree) -> Vec<usize> {
    tree.modules.iter().flat_map(|module| module.items.iter().flat_map(lengths)).collect()
}

fn lengths(item: &Item) -> Vec<usize> {
    match item {
        Item::Fn(function) => vec![lines(function.sig.span(), function.block.span())],
        Item::Impl(block) => {
            let functions = block.items.iter().filter_map(|item| match item {
                ImplItem::Fn(function) => Some(lines(function.sig.span(), function.block.span())),
                _ => None,
            });
            functions.collect()
        }
        Item::Trait(declared) => {
            let functions = declared.items.iter().filter_map(|item| match item {
                TraitItem::Fn(function) => {
                    let block = function.default.as_ref()?;
                    Some(lines(function.sig.span(), block.span()))
                }
                _ => None,
            });
            functions.collect()
        }
        _ => Vec::new(),
    }
}

fn lines(head: Span, body: Span) -> usize {
    body.end().line + 1 - head.start().line
}

/// The value below which the fraction `part` of the sorted `values` lies.
pub fn quantile(values: &[usize], part: f64) -> usize {
    let last = values.len().saturating_sub(1) as f64;
    values.get((last * part).round() as usize).copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_and_methods_are_measured() {
        let text = "fn f() {\n}\nstruct S;\nimpl S {\n fn g(&self) {\n  h()\n }\n}\n";
        let items = syn::parse_file(text).expect("the text is Rust").items;
        let found: Vec<usize> = items.iter().flat_map(lengths).collect();
        assert_eq!(found, [2, 3]);
    }

    #[test]
    fn the_median_is_the_middle_value() {
        assert_eq!(quantile(&[1, 2, 9], 0.5), 2);
        assert_eq!(quantile(&[], 0.5), 0);
    }
}
