//! Units of columns, as far as a program tells them.

use crate::plan::Plan;

/// The unit of the column `title`: that of the parameter it is, or follows from how a length or an angle
/// is made of the variable (`#lambda = wl/1000`, `incidentangle = t*deg`).
pub(super) fn unit(title: &str, plan: &Plan) -> Option<&'static str> {
    if title.starts_with("brdf.") {
        return Some("1/sr");
    }
    if let Some(unit) = title.strip_prefix('#').and_then(|path| parameter_unit(path, plan)) {
        return Some(unit);
    }
    plan.program.variables.iter().find_map(|variable| {
        let unit = match variable.name.as_str() {
            "incidentangle" | "rotation" => Some("rad"),
            name => name.strip_prefix('#').and_then(|path| parameter_unit(path, plan)),
        };
        scaled(variable.value.as_str(), title, unit?)
    })
}

/// The unit of a model's parameter; empty ones are not told.
fn parameter_unit(path: &str, plan: &Plan) -> Option<&'static str> {
    let name = path.rsplit('.').next()?;
    let own = plan.class.parameters().find(|parameter| parameter.name == path);
    let unit = match own {
        Some(parameter) => parameter.unit,
        None if name == "lambda" => "um",
        None => return None,
    };
    (!unit.is_empty() && unit != "1").then_some(unit)
}

/// The unit of `variable` if `expression` turns it into `unit` in a way that leaves no doubt.
fn scaled(expression: &str, variable: &str, unit: &'static str) -> Option<&'static str> {
    let text: String = expression.chars().filter(|c| !c.is_whitespace() && *c != '"').collect();
    match (text.strip_prefix(variable)?, unit) {
        ("", _) => Some(unit),
        ("/1000" | "*0.001" | "*1e-3", "um") => Some("nm"),
        (rest, "rad") if rest.starts_with("*deg") || rest == "*pi/180" => Some("deg"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::scaled;

    #[test]
    fn a_unit_is_told_when_the_expression_leaves_no_doubt() {
        assert_eq!(scaled("wl/1000", "wl", "um"), Some("nm"));
        assert_eq!(scaled("thetai * deg0", "thetai", "rad"), Some("deg"));
        assert_eq!(scaled("wl", "wl", "um"), Some("um"));
        assert_eq!(scaled("wl/7", "wl", "um"), None);
        assert_eq!(scaled("wl2/1000", "wl", "um"), None);
    }
}
