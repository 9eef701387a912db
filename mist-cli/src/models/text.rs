//! The registry for a terminal.

use std::fmt::Write as _;

use scattering::{Class, registry};

use super::kinds::kind;

/// All classes, by family, with one line each.
pub(super) fn list() -> String {
    let mut text = String::new();
    for family in registry::FAMILIES {
        let classes = family.classes();
        if classes.is_empty() {
            continue;
        }
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{} ({})", family.title, family.base);
        let width = classes.iter().map(|class| class.name.len()).max().unwrap_or(0);
        for class in classes {
            let _ = writeln!(text, "  {:<width$}  {}", class.name, class.summary);
        }
        text.push('\n');
    }
    text + "`mist models NAME` has the parameters of one.\n"
}

/// One class with its parameters.
pub(super) fn class(class: &Class) -> String {
    let mut text = format!(
        "{} (a {})\n{}\n\n  {}\n\nSource: {}\n",
        class.name, class.parent, class.summary, class.equation, class.source
    );
    let rows: Vec<[String; 4]> = class
        .parameters()
        .map(|p| {
            let unit = if p.unit.is_empty() { String::new() } else { format!(" [{}]", p.unit) };
            [p.name.into(), kind(p.kind), p.kind.default_text(), format!("{}{unit}", p.doc)]
        })
        .collect();
    if rows.is_empty() {
        return text + "\nNo parameters.\n";
    }
    let width = |at: usize| rows.iter().map(|row| row[at].len()).max().unwrap_or(0);
    let [name, holds, default] = [width(0).max(9), width(1).max(5), width(2).max(7)];
    let head = ["parameter", "holds", "default", "meaning"].map(str::to_owned);
    text.push('\n');
    for [a, b, c, d] in std::iter::once(&head).chain(&rows) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {a:<name$}  {b:<holds$}  {c:<default$}  {d}");
    }
    text
}
