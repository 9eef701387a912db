//! The states of parameters by their kinds, and of the objects that hold them.

use std::{
    hash::{Hash, Hasher},
    mem::discriminant,
    sync::Arc,
};

use mist_format::{number::reread, suggestion::did_you_mean};
use scattering::{
    Class, Defect, Mode, Parameter, ParameterKind, ParameterNode, ParameterValue,
    spec::SharedNotices,
};

use super::{
    error::SetError,
    films::FilmsState,
    formula::FormulaState,
    index::IndexState,
    input::{ParameterContext, ParameterInput},
    path::RelativePath,
    persistent::Persistent,
    table::TableState,
    text::{integer, member, number},
};
use crate::deviation::EngineDeviation;

/// Parameters that every class of NIST's library takes and that change nothing here.
const IGNORED: &[&str] = &["recalc", "quiet"];

/// An object in the tree of parameters.
#[derive(Clone, Debug)]
pub(crate) struct ObjectState {
    pub(crate) class: &'static Class,
    /// One per parameter of the class, in its order.
    slots: Vec<ParameterState>,
}

impl Hash for ObjectState {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.class.name.hash(state);
        self.slots.hash(state);
    }
}

impl PartialEq for ObjectState {
    fn eq(&self, other: &Self) -> bool {
        self.class.name == other.class.name && self.slots == other.slots
    }
}

impl Eq for ObjectState {}

impl ObjectState {
    /// Every parameter at its default.
    pub(crate) fn new(class: &'static Class) -> Self {
        Self { class, slots: class.parameters().map(ParameterState::default_of).collect() }
    }

    /// Sets the parameter `path`, seen from this object; `before` is this object as it was last
    /// evaluated.
    pub(crate) fn set(
        &mut self,
        path: RelativePath<'_>,
        input: ParameterInput<'_>,
        context: &mut ParameterContext<'_>,
        before: Option<&Self>,
    ) -> Result<(), SetError> {
        let (name, rest) = (path.name(), path.rest());
        if rest.is_some_and(|rest| rest.text().is_empty()) {
            return Err(SetError::name(format!("the sub-parameter of {name} is missing")));
        }
        if IGNORED.contains(&name) && rest.is_none() {
            return Ok(());
        }
        let before = before.filter(|before| before.class.name == self.class.name);
        if let Some(lambda) = before.and_then(Self::wavelength) {
            context.evaluated_at = Some(lambda);
        }
        let (at, param) = path.find_in(self.class).ok_or_else(|| self.unknown(name))?;
        let slot_before = before.map(|before| &before.slots[at]);
        match rest {
            Some(rest) => self.slots[at].set_below(param, rest, input, context, slot_before),
            None => self.slots[at].set(param, input, context),
        }
    }

    /// The parameters of its class with their states.
    pub(crate) fn parameters(&self) -> impl Iterator<Item = (&'static Parameter, &ParameterState)> {
        self.class.parameters().zip(&self.slots)
    }

    fn unknown(&self, name: &str) -> SetError {
        let known: Vec<&str> = self.class.parameters().map(|param| param.name).collect();
        let list = known.join(", ");
        SetError::name(format!("{} has no parameter {name}", self.class.name))
            .help(format!("it has {list}"))
            .help_if(did_you_mean(name, known))
    }

    /// True if `path` names a parameter of this object or of one in it.
    pub(crate) fn owns(&self, path: RelativePath<'_>) -> bool {
        let Some((at, _)) = path.find_in(self.class) else { return false };
        match (path.rest(), &self.slots[at]) {
            (None, _) => true,
            (Some(rest), ParameterState::Member(object)) => object.owns(rest),
            (Some(_), _) => false,
        }
    }

    /// The value of the parameter `lambda`, if there is one.
    pub(crate) fn wavelength(&self) -> Option<f64> {
        let (at, _) = self.class.parameter("lambda")?;
        self.slots[at].as_number()
    }

    pub(crate) fn set_wavelength(&mut self, lambda: f64) {
        for (slot, param) in self.slots.iter_mut().zip(self.class.parameters()) {
            match slot {
                ParameterState::Member(object) => object.edit().set_wavelength(lambda),
                ParameterState::Number(value) if param.name == "lambda" => {
                    *value = lambda;
                }
                _ => {}
            }
        }
    }

    /// True if an index in here remembers a value for its last wavelength.
    pub(crate) fn remembers(&self) -> bool {
        self.slots.iter().any(|slot| match slot {
            ParameterState::Member(object) => object.remembers(),
            ParameterState::Index(index) => index.remembers(),
            _ => false,
        })
    }

    pub(crate) fn forget_other_wavelengths(&mut self, around: Option<f64>) {
        let lambda = self.wavelength().or(around);
        for slot in &mut self.slots {
            match slot {
                ParameterState::Member(object) if object.remembers() => {
                    object.edit().forget_other_wavelengths(lambda);
                }
                ParameterState::Index(index) if index.holds_other_than(lambda) => {
                    index.edit().forget()
                }
                _ => {}
            }
        }
    }

    pub(crate) fn node(&self, mode: Mode, met: &SharedNotices) -> ParameterNode {
        let values = self.slots.iter().map(|slot| slot.value(mode, met)).collect();
        ParameterNode { class: self.class, values, mode, notices: met.clone() }
    }
}

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

    /// True if NIST's library reads `default` as a number, that is as 0: numbers of nested
    /// objects.
    fn ignores_default(&self, context: &ParameterContext<'_>) -> bool {
        let is_number = matches!(self, Self::Number(_) | Self::Integer(_));
        is_number && context.is_nested && EngineDeviation::NestedDefault.applies_in(context.mode)
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
