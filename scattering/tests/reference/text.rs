//! From the text of a parameter to its typed value, for the forms that the reference file uses.

use std::sync::Arc;

use scattering::{
    Class, Mode, ParameterKind, ParameterNode, ParameterValue,
    optics::{AbscissaScale, RealFunction, RefractiveIndex, TableInterpolation},
    registry::find_class,
    stack::Film,
};

use super::FILE;

/// The class `name` with its defaults and then `params`, in their order.
pub(crate) fn node(name: &str, params: &[(&str, &str)], mode: Mode) -> ParameterNode {
    let mut node = ParameterNode::with_defaults(class(name), mode);
    for (path, text) in params {
        set(&mut node, path, text);
    }
    node
}

fn class(name: &str) -> &'static Class {
    find_class(name).unwrap_or_else(|| panic!("no class {name}"))
}

fn set(node: &mut ParameterNode, path: &str, text: &str) {
    let (name, rest) = path.split_once('.').map_or((path, None), |(a, b)| (a, Some(b)));
    let (at, param) = node
        .class
        .parameter(name)
        .unwrap_or_else(|| panic!("{} has no parameter {name}", node.class.name));
    match rest {
        Some(rest) => {
            let ParameterValue::Member(child) = &mut node.values[at] else {
                panic!("{name} of {} has no parameters", node.class.name)
            };
            set(Arc::make_mut(child), rest, text);
        }
        None => node.values[at] = value(param.kind, text, node),
    }
}

fn value(kind: ParameterKind, text: &str, node: &ParameterNode) -> ParameterValue {
    match kind {
        ParameterKind::Number(_) => ParameterValue::Number(number(text)),
        ParameterKind::Integer(_) => ParameterValue::Integer(text.parse().unwrap()),
        ParameterKind::Text => ParameterValue::Text(text.into()),
        ParameterKind::File => ParameterValue::Text(file(text).into()),
        ParameterKind::Formula(_) => formula(text),
        ParameterKind::Index { .. } => ParameterValue::Index(index(text)),
        ParameterKind::Table(_) => ParameterValue::Table(table(text)),
        ParameterKind::Films => ParameterValue::Films(films(text)),
        ParameterKind::Member { .. } => ParameterValue::Member(Arc::new(
            ParameterNode::with_defaults_noting(class(text), node.mode, node.notices.clone()),
        )),
    }
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("{text:?} is not a number"))
}

fn file(name: &str) -> &'static str {
    FILE["header"]["files"][name].as_str().unwrap_or_else(|| panic!("no file {name}"))
}

/// The one expression of the reference file, written out, or a constant.
fn formula(text: &str) -> ParameterValue {
    if text == "0.3+0.5*exp(-x^2)" {
        // The minus that opens the parenthesis is "0 −": the exponent is −(x²).
        return ParameterValue::Formula(Arc::new(|x: f64| 0.3 + 0.5 * (-(x * x)).exp()));
    }
    let value = number(text);
    ParameterValue::Formula(Arc::new(move |_| value))
}

/// `n`, `(n,k)`, or a file with n and k in its second and third columns.
fn index(text: &str) -> RefractiveIndex {
    if let Ok(n) = text.parse() {
        return RefractiveIndex::constant(n, 0.0);
    }
    if let Some(inner) = text.strip_prefix('(').and_then(|t| t.strip_suffix(')')) {
        let (n, k) = inner.split_once(',').unwrap_or((inner, "0"));
        return RefractiveIndex::constant(number(n), number(k));
    }
    let rows = rows(file(text));
    let column = |c: usize| {
        let points: Vec<_> = rows.iter().map(|row| (row[0], row[c])).collect();
        RealFunction::points(&points, AbscissaScale::Linear, TableInterpolation::Linear)
    };
    RefractiveIndex { n: column(1), k: column(2) }
}

/// A constant, a file, or `table file: x y / x y / …`.
fn table(text: &str) -> RealFunction {
    if let Ok(value) = text.parse() {
        return RealFunction::constant(value);
    }
    let rows = match text.strip_prefix("table file: ") {
        Some(lines) => rows(&lines.replace(" / ", "\n")),
        None => rows(file(text)),
    };
    let points: Vec<_> = rows.iter().map(|row| (row[0], row[1])).collect();
    RealFunction::points(&points, AbscissaScale::Linear, TableInterpolation::Linear)
}

/// The lines that consist of numbers only.
fn rows(text: &str) -> Vec<Vec<f64>> {
    let numbers = |line: &str| line.split_whitespace().map(|word| word.parse().ok()).collect();
    text.lines().filter(|line| !line.trim().is_empty()).filter_map(numbers).collect()
}

/// `material thickness material thickness …`, the film next to the substrate first.
pub(crate) fn films(text: &str) -> Vec<Film> {
    let words: Vec<&str> = text.split_whitespace().collect();
    words.chunks(2).map(|w| Film { index: index(w[0]), thickness: number(w[1]) }).collect()
}
