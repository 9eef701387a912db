//! The typed parameter values from which an object is built.

use std::{
    collections::BTreeSet,
    fmt,
    sync::{Arc, Mutex},
};

use super::class::{Class, Parameter, ParameterKind};
use crate::{
    defect::{Defect, Mode},
    notice::{ModelLimit, Notice},
    optics::{Film, FormulaFn, RealFunction, RefractiveIndex},
};

/// Magnitude below which a number counts as 0 in every unit that parameters have; powers of smaller
/// numbers underflow.
pub(super) const NEGLIGIBLE: f64 = 1e-30;

/// The typed value of a parameter.
#[derive(Clone)]
pub enum ParameterValue {
    /// A real number.
    Number(f64),
    /// An integer.
    Integer(i32),
    /// Text, or the text of a file.
    Text(Arc<str>),
    /// A function of `x`.
    Formula(FormulaFn),
    /// An index of refraction.
    Index(RefractiveIndex),
    /// A function of one variable.
    Table(RealFunction),
    /// Films, the one next to the substrate first.
    Films(Vec<Film>),
    /// A nested instance.
    Member(Arc<ParameterNode>),
}

impl fmt::Debug for ParameterValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(x) => write!(f, "{x}"),
            Self::Integer(i) => write!(f, "{i}"),
            Self::Text(text) => write!(f, "{text:?}"),
            Self::Formula(_) => write!(f, "formula"),
            Self::Index(index) => write!(f, "{index:?}"),
            Self::Table(table) => write!(f, "{table:?}"),
            Self::Films(films) => write!(f, "{films:?}"),
            Self::Member(node) => write!(f, "{node:?}"),
        }
    }
}

/// The notices of a build, shared by a node and all nodes below it.
pub type SharedNotices = Arc<Mutex<BTreeSet<Notice>>>;

/// A node of the parameter tree: a class with a typed value for each of its parameters.
#[derive(Clone, Debug)]
pub struct ParameterNode {
    /// The class.
    pub class: &'static Class,
    /// One value per parameter, in the order of [`Class::parameters`].
    pub values: Vec<ParameterValue>,
    /// Sound or compat.
    pub mode: Mode,
    /// Notices of the build: defects that it did not reproduce and limits that it exceeded.
    pub notices: SharedNotices,
}

/// A parameter with a value that the class cannot take.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("parameter {parameter}: {problem}")]
pub struct ParameterError {
    /// Dotted name, from the model on which the build started.
    pub parameter: String,
    /// Description of the error and of accepted values.
    pub problem: String,
}

impl ParameterError {
    /// An error at the parameter `name` of the class that is being built.
    pub fn new(name: &str, problem: impl Into<String>) -> Self {
        Self { parameter: name.to_owned(), problem: problem.into() }
    }

    /// The same error seen from the class whose parameter `parent` the instance is.
    pub fn inside(mut self, parent: &str) -> Self {
        self.parameter = format!("{parent}.{}", self.parameter);
        self
    }
}

impl ParameterNode {
    /// The class with every parameter at its default.
    pub fn with_defaults(class: &'static Class, mode: Mode) -> Self {
        Self::with_defaults_noting(class, mode, SharedNotices::default())
    }

    /// The class with every parameter at its default; its build adds to `notices`.
    pub fn with_defaults_noting(class: &'static Class, mode: Mode, notices: SharedNotices) -> Self {
        let values = class.parameters().map(|p| default_value(p, mode, &notices)).collect();
        Self { class, values, mode, notices }
    }

    /// The node with the parameter `name` replaced.
    ///
    /// # Errors
    ///
    /// If the class has no such parameter.
    pub fn with(mut self, name: &str, value: ParameterValue) -> Result<Self, ParameterError> {
        let (at, _) = self.class.parameter(name).ok_or_else(|| {
            ParameterError::new(name, format!("not a parameter of {}", self.class.name))
        })?;
        self.values[at] = value;
        Ok(self)
    }

    /// True if this build reproduces `defect`; a sound build notes a noticeable defect.
    pub fn reproduces(&self, defect: Defect) -> bool {
        match self.mode {
            Mode::Compat => true,
            Mode::Sound => {
                if defect.is_noticeable() {
                    self.note(defect.into());
                }
                false
            }
        }
    }

    /// Notes that the parameters exceed `limit`.
    pub fn note_limit(&self, limit: ModelLimit) {
        self.note(limit.into());
    }

    fn note(&self, notice: Notice) {
        self.notices.lock().expect("no build panics while it notes one").insert(notice);
    }

    fn value(&self, name: &str) -> &ParameterValue {
        let (at, _) = self
            .class
            .parameter(name)
            .unwrap_or_else(|| panic!("{} asks for its parameter {name}", self.class.name));
        &self.values[at]
    }

    fn wrong(&self, name: &str) -> ! {
        panic!("parameter {name} of {} holds {:?}", self.class.name, self.value(name))
    }

    /// The real number `name`; 0 in a sound build if it is below 10⁻³⁰.
    ///
    /// # Panics
    ///
    /// This and the getters below: if the class does not declare the parameter with this kind.
    pub fn number(&self, name: &str) -> f64 {
        match self.value(name) {
            ParameterValue::Number(x) if self.mode == Mode::Sound && x.abs() < NEGLIGIBLE => 0.0,
            ParameterValue::Number(x) => *x,
            _ => self.wrong(name),
        }
    }

    /// The integer `name`.
    pub fn integer(&self, name: &str) -> i32 {
        match self.value(name) {
            ParameterValue::Integer(i) => *i,
            _ => self.wrong(name),
        }
    }

    /// The text `name`, or the text of the file it names.
    pub fn text(&self, name: &str) -> &str {
        match self.value(name) {
            ParameterValue::Text(text) => text,
            _ => self.wrong(name),
        }
    }

    /// The formula `name`.
    pub fn formula(&self, name: &str) -> &FormulaFn {
        match self.value(name) {
            ParameterValue::Formula(f) => f,
            _ => self.wrong(name),
        }
    }

    /// The index of refraction `name`.
    #[allow(clippy::should_implement_trait)] // The getters are called like their kinds.
    pub fn index(&self, name: &str) -> &RefractiveIndex {
        match self.value(name) {
            ParameterValue::Index(index) => index,
            _ => self.wrong(name),
        }
    }

    /// The function of one variable `name`.
    pub fn table(&self, name: &str) -> &RealFunction {
        match self.value(name) {
            ParameterValue::Table(table) => table,
            _ => self.wrong(name),
        }
    }

    /// The films `name`.
    pub fn films(&self, name: &str) -> &[Film] {
        match self.value(name) {
            ParameterValue::Films(films) => films,
            _ => self.wrong(name),
        }
    }

    /// The node of the nested instance `name`, not yet built.
    pub fn child(&self, name: &str) -> &ParameterNode {
        match self.value(name) {
            ParameterValue::Member(node) => node,
            _ => self.wrong(name),
        }
    }
}

/// The default of `param` as a typed value.
fn default_value(param: &Parameter, mode: Mode, notices: &SharedNotices) -> ParameterValue {
    match param.kind {
        ParameterKind::Number(x) => ParameterValue::Number(x),
        ParameterKind::Integer(i) => ParameterValue::Integer(i),
        ParameterKind::Text | ParameterKind::File => ParameterValue::Text("".into()),
        ParameterKind::Formula(x) => ParameterValue::Formula(Arc::new(move |_| x)),
        ParameterKind::Index { n, k } => ParameterValue::Index(RefractiveIndex::constant(n, k)),
        ParameterKind::Table(x) => ParameterValue::Table(RealFunction::constant(x)),
        ParameterKind::Films => ParameterValue::Films(Vec::new()),
        ParameterKind::Member { family, default, .. } => {
            let class = family.class(default).unwrap_or_else(|| {
                panic!("no class {default:?} for {}; a test builds every class", param.name)
            });
            let node = ParameterNode::with_defaults_noting(class, mode, notices.clone());
            ParameterValue::Member(Arc::new(node))
        }
    }
}
