//! The registry as the manual page `docs/models.md`.

use std::fmt::Write as _;

use scattering::{Class, registry};

use super::kinds::kind;

const INTRODUCTION: &str = "\
<!-- Made by `mist models --markdown`; a test compares. Edit the SPEC of a class instead. -->

# Models

Every class with its equation, its parameters and its source (keys of `docs/references.bib`).
In a program `$model.parameter = value` sets a parameter; `parameter.sub` reaches into the class
that a parameter names. Lengths are µm, angles rad.
";

/// The whole page.
pub(super) fn manual() -> String {
    let mut text = INTRODUCTION.to_owned();
    for family in registry::FAMILIES.iter().filter(|family| !family.classes().is_empty()) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "\n## {}", family.title);
        for class in family.classes() {
            text.push_str(&section(class));
        }
    }
    text
}

fn section(class: &Class) -> String {
    let mut text = format!(
        "\n### {}\n\n{}. A `{}`.\n\n    {}\n\nSource: {}\n",
        class.name,
        class.summary,
        class.parent,
        class.equation,
        class.source.split(' ').map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", "),
    );
    if class.parameters().next().is_some() {
        text.push_str(
            "\n| parameter | holds | default | unit | meaning |\n| --- | --- | --- | --- | --- |\n",
        );
        for p in class.parameters() {
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "| `{}` | {} | `{}` | {} | {} |",
                p.name,
                kind(p.kind),
                p.kind.default_text(),
                p.unit,
                p.doc.replace('|', "\\|")
            );
        }
    }
    text
}
