//! The registry for programs.

use scattering::{Class, Family, Param, spec::Kind};
use serde_json::{Value, json};

/// All classes, by family.
pub(super) fn list() -> String {
    let families = Family::ALL.iter().map(|family| {
        let classes: Vec<Value> = family.classes().into_iter().map(describe).collect();
        json!({ "base": family.base(), "classes": classes })
    });
    line(&json!({ "families": families.collect::<Vec<_>>() }))
}

/// One class.
pub(super) fn class(class: &Class) -> String {
    line(&describe(class))
}

fn line(value: &Value) -> String {
    format!("{value:#}\n")
}

fn describe(class: &Class) -> Value {
    json!({
        "name": class.name,
        "parent": class.parent,
        "summary": class.summary,
        "equation": class.equation,
        "source": class.source.split(' ').collect::<Vec<_>>(),
        "parameters": class.parameters().map(parameter).collect::<Vec<_>>(),
    })
}

fn parameter(param: &Param) -> Value {
    let (kind, base) = match param.kind {
        Kind::Number => ("number", None),
        Kind::Integer => ("integer", None),
        Kind::Text => ("text", None),
        Kind::File => ("file", None),
        Kind::Formula => ("formula", None),
        Kind::Index => ("index", None),
        Kind::Table => ("table", None),
        Kind::Films => ("films", None),
        Kind::Member(_, base) => ("member", Some(base)),
    };
    json!({
        "name": param.name,
        "kind": kind,
        "base": base,
        "default": param.default,
        "unit": param.unit,
        "doc": param.doc,
    })
}
