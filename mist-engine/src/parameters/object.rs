//! A class with the state of its parameters.

use std::hash::{Hash, Hasher};

use mist_format::suggestion::did_you_mean;
use scattering::{Class, Mode, ParameterNode, spec::SharedNotices};

use super::{
    error::SetError,
    input::{ParameterContext, ParameterInput},
    path::RelativePath,
    state::ParameterState,
};

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
