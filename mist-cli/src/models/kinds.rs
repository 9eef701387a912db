//! Kinds of parameters, in words.

use scattering::ParameterKind;

/// Kind of a parameter, as text.
pub(super) fn kind(kind: ParameterKind) -> String {
    match kind {
        ParameterKind::Number(_) => "number".into(),
        ParameterKind::Integer(_) => "integer".into(),
        ParameterKind::Text => "text".into(),
        ParameterKind::File => "file".into(),
        ParameterKind::Formula(_) => "formula of x".into(),
        ParameterKind::Index { .. } => "index".into(),
        ParameterKind::Table(_) => "table".into(),
        ParameterKind::Films => "films".into(),
        ParameterKind::Member { base, .. } => base.into(),
    }
}
