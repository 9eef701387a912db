//! The state of one parameter, by its kind.

use std::{
    hash::{Hash, Hasher},
    mem::discriminant,
    sync::Arc,
};

use mist_format::{
    number::{integer_prefix, number_prefix, reread, whole_number},
    suggestion::did_you_mean,
};
use scattering::{
    Defect, Family, Mode, Parameter, ParameterKind, ParameterValue, registry, spec::SharedNotices,
};

use super::{
    error::SetError,
    films::FilmsState,
    formula::FormulaState,
    index::IndexState,
    input::{ParameterContext, ParameterInput},
    object::ObjectState,
    path::RelativePath,
    persistent::Persistent,
    table::TableState,
};
use crate::quirk::Quirk;

/// The state of a parameter.
#[derive(Clone, Debug)]
pub(crate) enum ParameterState {
    Number(f64),
    Integer(i32),
    /// Text for the class itself.
    Text(Arc<str>),
    /// The name of a file and its text.
    File {
        name: Arc<str>,
        text: Arc<str>,
    },
    /// A function of x.
    Formula(Arc<FormulaState>),
    Index(Persistent<IndexState>),
    Table(Persistent<TableState>),
    Films(Persistent<FilmsState>),
    Member(Persistent<ObjectState>),
}

impl Hash for ParameterState {
    fn hash<H: Hasher>(&self, state: &mut H) {
        discriminant(self).hash(state);
        match self {
            Self::Number(x) => x.to_bits().hash(state),
            Self::Integer(i) => i.hash(state),
            // A file's text does not change during a run: its name tells it.
            Self::Text(text) | Self::File { name: text, .. } => text.hash(state),
            Self::Formula(formula) => formula.text().hash(state),
            Self::Index(index) => index.hash(state),
            Self::Table(table) => table.hash(state),
            Self::Films(films) => films.hash(state),
            Self::Member(object) => object.hash(state),
        }
    }
}

impl PartialEq for ParameterState {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => a.to_bits() == b.to_bits(),
            (Self::Integer(a), Self::Integer(b)) => a == b,
            (Self::Text(a), Self::Text(b)) => a == b,
            (Self::File { name: a, .. }, Self::File { name: b, .. }) => a == b,
            (Self::Formula(a), Self::Formula(b)) => a == b,
            (Self::Index(a), Self::Index(b)) => a == b,
            (Self::Table(a), Self::Table(b)) => a == b,
            (Self::Films(a), Self::Films(b)) => a == b,
            (Self::Member(a), Self::Member(b)) => a == b,
            _ => false,
        }
    }
}

impl Eq for ParameterState {}

impl ParameterState {
    /// The default that the registry declares.
    pub(crate) fn default_of(param: &Parameter) -> Self {
        match param.kind {
            ParameterKind::Number(x) => Self::Number(x),
            ParameterKind::Integer(i) => Self::Integer(i),
            ParameterKind::Text => Self::Text("".into()),
            ParameterKind::File => Self::File { name: "".into(), text: "".into() },
            ParameterKind::Formula(x) => Self::Formula(Arc::new(FormulaState::constant(x))),
            ParameterKind::Index { n, k } => {
                Self::Index(Persistent::new(IndexState::constant(n, k)))
            }
            ParameterKind::Table(x) => Self::Table(Persistent::new(TableState::constant(x))),
            ParameterKind::Films => Self::Films(Persistent::default()),
            ParameterKind::Member { family, default, .. } => {
                let class = family.class(default).expect("a test builds every default");
                Self::Member(Persistent::new(ObjectState::new(class)))
            }
        }
    }

    /// Sets the parameter itself.
    pub(crate) fn set(
        &mut self,
        param: &Parameter,
        input: ParameterInput<'_>,
        context: &ParameterContext<'_>,
    ) -> Result<(), SetError> {
        if let Self::Table(table) = self
            && input != ParameterInput::Text("default")
        {
            return table.edit().replace(input, context);
        }
        match input {
            ParameterInput::Text(text) => self.set_text(param, text, context),
            ParameterInput::Numbers(values) => match Self::of_numbers(param, values, context) {
                Some(state) => {
                    *self = state;
                    Ok(())
                }
                None => self.set_text(param, &input.to_text(), context),
            },
        }
    }

    /// The state that numbers give without a text; none if there is no such state, or if NIST's
    /// program reads the numbers from a text in its own way.
    fn of_numbers(
        param: &Parameter,
        values: &[f64],
        context: &ParameterContext<'_>,
    ) -> Option<Self> {
        match (param.kind, values) {
            (ParameterKind::Number(_), [x]) if context.mode == Mode::Compat => {
                reread(*x).map(Self::Number)
            }
            _ if !context.keeps_bits(values) => None,
            (ParameterKind::Number(_), [x]) => Some(Self::Number(*x)),
            (ParameterKind::Integer(_), [x]) => {
                let whole = *x as i32;
                (f64::from(whole) == *x).then_some(Self::Integer(whole))
            }
            (ParameterKind::Index { .. }, [n]) => {
                Some(Self::Index(Persistent::new(IndexState::of_numbers(*n, 0.0))))
            }
            (ParameterKind::Index { .. }, [n, k]) => {
                Some(Self::Index(Persistent::new(IndexState::of_numbers(*n, *k))))
            }
            _ => None,
        }
    }

    fn set_text(
        &mut self,
        param: &Parameter,
        text: &str,
        context: &ParameterContext<'_>,
    ) -> Result<(), SetError> {
        if text == "default" && !self.ignores_default(context) {
            *self = Self::default_of(param);
            return Ok(());
        }
        *self = match param.kind {
            ParameterKind::Number(_) => Self::Number(number(text, context.mode)?),
            ParameterKind::Integer(_) => Self::Integer(integer(text, context.mode)?),
            ParameterKind::Text => Self::Text(text.into()),
            ParameterKind::File => {
                let file =
                    context.library.text(text).map_err(|e| SetError::value(e.to_string()))?;
                Self::File { name: text.into(), text: file }
            }
            ParameterKind::Formula(_) => {
                Self::Formula(Arc::new(FormulaState::read(text, context.library)?))
            }
            ParameterKind::Index { .. } => {
                Self::Index(Persistent::new(IndexState::read(text, context)?))
            }
            ParameterKind::Table(_) => unreachable!("a table is replaced in place"),
            ParameterKind::Films => Self::Films(Persistent::new(FilmsState::read(text, context)?)),
            ParameterKind::Member { family, base, .. } => {
                let class = member(text, family, base)?;
                Self::Member(Persistent::new(ObjectState::new(class)))
            }
        };
        Ok(())
    }

    /// Whether NIST's library reads `default` as a number, that is as 0: numbers of nested
    /// objects.
    fn ignores_default(&self, context: &ParameterContext<'_>) -> bool {
        let is_number = matches!(self, Self::Number(_) | Self::Integer(_));
        is_number && context.is_nested && Quirk::NestedDefault.applies_in(context.mode)
    }

    /// Sets a parameter below this one; `before` is this one as it was last evaluated.
    pub(crate) fn set_below(
        &mut self,
        param: &Parameter,
        rest: RelativePath<'_>,
        input: ParameterInput<'_>,
        context: &mut ParameterContext<'_>,
        before: Option<&Self>,
    ) -> Result<(), SetError> {
        match self {
            Self::Member(object) => {
                let before = match before {
                    Some(Self::Member(object)) => Some(&**object),
                    _ => None,
                };
                context.is_nested = true;
                object.edit().set(rest, input, context, before)
            }
            Self::Index(index) => index.edit().set(rest.text(), input, context),
            Self::Table(table) => table.edit().set(rest.text(), input, context),
            Self::Films(films) => films.edit().set(rest.text(), input, context),
            _ => Err(SetError::name(format!(
                "{} is not an object: no sub-parameter {} is allowed",
                param.name,
                rest.text()
            ))),
        }
    }

    pub(crate) fn as_number(&self) -> Option<f64> {
        match self {
            Self::Number(x) => Some(*x),
            _ => None,
        }
    }

    pub(crate) fn value(&self, mode: Mode, met: &SharedNotices) -> ParameterValue {
        match self {
            Self::Number(x) => ParameterValue::Number(*x),
            Self::Integer(i) => ParameterValue::Integer(*i),
            Self::Text(text) | Self::File { text, .. } => ParameterValue::Text(text.clone()),
            Self::Formula(formula) => ParameterValue::Formula(formula.function()),
            Self::Index(index) => {
                if index.is_misread() && mode == Mode::Sound {
                    met.lock().expect("no build panics").insert(Defect::IndexText.into());
                }
                ParameterValue::Index(index.value())
            }
            Self::Table(table) => ParameterValue::Table(table.value()),
            Self::Films(films) => ParameterValue::Films(films.value()),
            Self::Member(object) => ParameterValue::Member(Arc::new(object.node(mode, met))),
        }
    }
}

/// A number: the whole text, or under compat its longest numeric beginning (0 without one).
fn number(text: &str, mode: Mode) -> Result<f64, SetError> {
    if let Some(x) = whole_number(text) {
        return Ok(x);
    }
    let prefix = number_prefix(text.as_bytes());
    if Quirk::NumericPrefix.applies_in(mode) {
        return Ok(prefix.value.unwrap_or(0.0));
    }
    let error = SetError::value(format!("{text:?} is not a number"));
    Err(match prefix.value {
        Some(x) => error.help(format!(
            "write {x}, or use `#` in place of `$` for an expression; NIST's program reads {x}"
        )),
        None => error.help("NIST's program reads 0; use `#` in place of `$` for an expression"),
    })
}

fn integer(text: &str, mode: Mode) -> Result<i32, SetError> {
    let prefix = integer_prefix(text);
    let value = prefix.value.and_then(|value| i32::try_from(value).ok());
    if Quirk::NumericPrefix.applies_in(mode) {
        return Ok(value.unwrap_or(0));
    }
    let whole = prefix.taken == text.trim_end().len();
    value.filter(|_| whole).ok_or_else(|| {
        SetError::value(format!("{text:?} is not an integer"))
            .help(format!("NIST's program reads {}", value.unwrap_or(0)))
    })
}

/// The class called `name`, at or below `base`.
fn member(name: &str, family: &Family, base: &str) -> Result<&'static scattering::Class, SetError> {
    let found = family.class(name);
    let found = found.filter(|class| family.is_below(class.name, base));
    found.ok_or_else(|| {
        let abstract_class = name == base || registry::is_abstract(name);
        let problem = if abstract_class {
            format!("{name} is a family of classes, not one of them")
        } else {
            format!("there is no {base} called {name:?}")
        };
        let classes = family.classes().into_iter().map(|class| class.name);
        let choices: Vec<&str> = classes.filter(|choice| family.is_below(choice, base)).collect();
        let all = format!("choose one of {}", choices.join(", "));
        SetError::value(problem).help(all).help_if(did_you_mean(name, choices))
    })
}
