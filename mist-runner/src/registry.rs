//! The registry of models as JSON: for programs, for editors, for a page.

use mist_format::suggestion::did_you_mean;
use scattering::{Class, Parameter, registry, spec::ParameterKind};
use serde_json::{Map, Value, json};

/// All classes, by family.
pub fn list() -> Value {
    let families = registry::FAMILIES.iter().map(|family| {
        let classes: Vec<Value> = family.classes().into_iter().map(class).collect();
        json!({ "base": family.base, "classes": classes })
    });
    json!({ "families": families.collect::<Vec<_>>() })
}

/// One class.
pub fn class(class: &Class) -> Value {
    json!({
        "name": class.name,
        "parent": class.parent,
        "summary": class.summary,
        "equation": class.equation,
        "source": class.source.split(' ').collect::<Vec<_>>(),
        "parameters": class.parameters().map(parameter).collect::<Vec<_>>(),
    })
}

/// The message for the name of a class that does not exist.
pub fn unknown(name: &str) -> String {
    let all = registry::classes().map(|class| class.name);
    let hint = did_you_mean(name, all).map_or_else(String::new, |hint| format!("; {hint}"));
    format!("model called {name:?}{hint}")
}

/// The JSON Schema (2020-12) of the parameters of a class.
///
/// Values are texts as programs write them, or numbers; a parameter that holds an object of
/// another class names the classes it may have. `x-unit`, `x-kind` and `x-base` are for editors.
pub fn schema(class: &Class) -> Value {
    let properties: Map<String, Value> =
        class.parameters().map(|param| (param.name.to_owned(), property(param))).collect();
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": format!("/v1/models/{}", class.name),
        "title": class.name,
        "description": class.summary,
        "type": "object",
        "properties": properties,
        "additionalProperties": true,
        "x-parent": class.parent,
        "x-equation": class.equation,
        "x-source": class.source.split(' ').collect::<Vec<_>>(),
        "x-order": class.parameters().map(|param| param.name).collect::<Vec<_>>(),
    })
}

fn property(param: &Parameter) -> Value {
    let mut property = json!({
        "description": param.doc,
        "default": default(param),
        "x-kind": kind(param.kind).0,
        "x-unit": param.unit,
    });
    match param.kind {
        ParameterKind::Number(_) => property["type"] = json!(["number", "string"]),
        ParameterKind::Integer(_) => property["type"] = json!(["integer", "string"]),
        ParameterKind::Member { family, base, .. } => {
            property["type"] = json!("string");
            property["x-base"] = json!(base);
            let members =
                family.classes().into_iter().filter(|class| family.is_below(class.name, base));
            let names: Vec<&str> = members.map(|class| class.name).collect();
            property["enum"] = json!(names);
        }
        _ => property["type"] = json!(["string", "number"]),
    }
    property
}

/// The default as a number where it is one.
fn default(param: &Parameter) -> Value {
    match param.kind {
        ParameterKind::Integer(i) => json!(i),
        ParameterKind::Number(x) => json!(x),
        kind => json!(kind.default_text()),
    }
}

fn parameter(param: &Parameter) -> Value {
    let (kind, base) = kind(param.kind);
    json!({
        "name": param.name,
        "kind": kind,
        "base": base,
        "default": param.kind.default_text(),
        "unit": param.unit,
        "doc": param.doc,
    })
}

/// The kind of a parameter, and the base of its classes if it is an object.
pub fn kind(kind: ParameterKind) -> (&'static str, Option<&'static str>) {
    match kind {
        ParameterKind::Number(_) => ("number", None),
        ParameterKind::Integer(_) => ("integer", None),
        ParameterKind::Text => ("text", None),
        ParameterKind::File => ("file", None),
        ParameterKind::Formula(_) => ("formula", None),
        ParameterKind::Index { .. } => ("index", None),
        ParameterKind::Table(_) => ("table", None),
        ParameterKind::Films => ("films", None),
        ParameterKind::Member { base, .. } => ("member", Some(base)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_schema_of_every_class_has_its_parameters_with_defaults_and_units() {
        for class in registry::classes() {
            let schema = schema(class);
            for param in class.parameters() {
                let property = &schema["properties"][param.name];
                assert_eq!(property["x-unit"], json!(param.unit), "{}", class.name);
                assert!(!property["default"].is_null(), "{} {}", class.name, param.name);
                if let ParameterKind::Member { default, .. } = param.kind {
                    let names = property["enum"].as_array().unwrap();
                    assert!(
                        names.iter().any(|name| name == default),
                        "{} {}: {default}",
                        class.name,
                        param.name
                    );
                }
            }
        }
    }
}
