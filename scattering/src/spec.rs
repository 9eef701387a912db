//! The registry: how a class of models describes itself, and the typed values it is built from.
//!
//! Every class (a BRDF model, a slope distribution, a film stack, …) is one `SPEC` in one file:
//! its name, its parameters with unit and default, its source and the function that builds it.
//! The manual, the JSON schema, the parameter tree of programs and the contract tests read
//! these lists and nothing else.

pub(crate) mod range;

use std::{
    collections::BTreeSet,
    fmt,
    sync::{Arc, Mutex},
};

use crate::{
    Defect, Mode, ModelLimit, Notice,
    optics::{RealFunction, RefractiveIndex},
    stack::Film,
};

/// A family of classes that can stand in for each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Family {
    /// BRDF models.
    Brdf,
    /// Densities of facet slopes.
    Slope,
    /// Shadowing functions.
    Shadow,
    /// Power spectral densities of surface height.
    Psd,
    /// Film stacks.
    Stack,
    /// Spectral reflectances.
    Reflectance,
    /// Scalar phase functions.
    Phase,
    /// Mueller-valued phase functions with absorption and scattering coefficients.
    PolarizedPhase,
    /// Particles in free space.
    Scatterer,
    /// Densities of a diameter.
    Distribution,
    /// Numbers of particles per volume and diameter.
    VolumeSize,
    /// Numbers of particles per area and diameter.
    SurfaceSize,
    /// Line gratings.
    Grating,
    /// Crossed gratings.
    CrossGrating,
    /// Bodies of revolution.
    Shape,
    /// Thick layers of a coating.
    Layer,
}

impl Family {
    /// Every family, in the order of the manual.
    pub const ALL: &'static [Self] = &[
        Self::Brdf,
        Self::Slope,
        Self::Shadow,
        Self::Psd,
        Self::Stack,
        Self::Reflectance,
        Self::Phase,
        Self::PolarizedPhase,
        Self::Scatterer,
        Self::Distribution,
        Self::VolumeSize,
        Self::SurfaceSize,
        Self::Grating,
        Self::CrossGrating,
        Self::Shape,
        Self::Layer,
    ];

    /// The name of the family's abstract base class.
    pub fn base(self) -> &'static str {
        match self {
            Self::Brdf => "BRDF_Model",
            Self::Slope => "Slope_Distribution_Function",
            Self::Shadow => "Shadow_Function",
            Self::Psd => "PSD_Function",
            Self::Stack => "StackModel",
            Self::Reflectance => "Reflectance",
            Self::Phase => "Phase_Function",
            Self::PolarizedPhase => "Polarized_Phase_Function",
            Self::Scatterer => "Free_Space_Scatterer",
            Self::Distribution => "Distribution",
            Self::VolumeSize => "VolumeParticleSizeDistribution",
            Self::SurfaceSize => "SurfaceParticleSizeDistribution",
            Self::Grating => "Grating",
            Self::CrossGrating => "CrossGrating",
            Self::Shape => "Axisymmetric_Shape",
            Self::Layer => "Layer",
        }
    }

    /// The classes of this family, in the order they are listed to users.
    pub fn classes(self) -> Vec<&'static Class> {
        fn list<T: ?Sized + Member>() -> Vec<&'static Class> {
            T::specs().map(|spec| &spec.class).collect()
        }
        match self {
            Self::Brdf => list::<dyn crate::Brdf>(),
            Self::Slope => list::<dyn crate::slope::SlopeDistribution>(),
            Self::Shadow => list::<dyn crate::shadow::Shadow>(),
            Self::Psd => list::<dyn crate::psd::Psd>(),
            Self::Stack => list::<crate::stack::Stack>(),
            Self::Reflectance => list::<dyn crate::reflectance::Reflectance>(),
            Self::Phase => list::<dyn crate::phase::Phase>(),
            Self::PolarizedPhase => list::<dyn crate::polarized_phase::PolarizedPhase>(),
            Self::Scatterer => list::<dyn crate::scatterer::Scatterer>(),
            Self::Distribution => list::<dyn crate::distribution::Distribution>(),
            Self::VolumeSize => list::<dyn crate::size::VolumeSize>(),
            Self::SurfaceSize => list::<dyn crate::size::SurfaceSize>(),
            Self::Grating => list::<dyn crate::grating::Grating>(),
            Self::CrossGrating => list::<dyn crate::cross_grating::CrossGrating>(),
            Self::Shape => list::<crate::shape::Shape>(),
            Self::Layer => list::<crate::models::coating::layer::CoatingLayer>(),
        }
    }
}

/// Abstract classes between a family's base and its members: (name, parent).
///
/// A parameter may accept only the classes below one of these, and naming one of them where a
/// class is wanted gets an answer of its own.
pub const ABSTRACT: &[(&str, &str)] = &[
    ("Roughness_BRDF_Model", "BRDF_Model"),
    ("Local_BRDF_Model", "BRDF_Model"),
    ("Instrument_BRDF_Model", "BRDF_Model"),
    ("Angle_Distribution_Function", "Slope_Distribution_Function"),
    ("SphericalScatterer", "Free_Space_Scatterer"),
    ("Gridded_CrossGrating", "CrossGrating"),
];

/// Kind of the value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterKind {
    /// A real number.
    Number,
    /// An integer.
    Integer,
    /// Text that the class reads itself.
    Text,
    /// The text of a data file that the parameter names.
    File,
    /// A real function of `x`, written as an expression.
    Formula,
    /// A complex index of refraction as a function of wavelength.
    Index,
    /// A real function of one variable.
    Table,
    /// Films as `material thickness` pairs.
    Films,
    /// A member of a family, at or below the named base class.
    Member(Family, &'static str),
}

/// One parameter of a class.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Name in a program.
    pub name: &'static str,
    /// Kind of its value.
    pub kind: ParameterKind,
    /// Default, as a program would write it.
    pub default: &'static str,
    /// Unit; `1` for a pure number, empty where there is none.
    pub unit: &'static str,
    /// Meaning.
    pub doc: &'static str,
}

impl Parameter {
    /// A real number.
    pub const fn number(
        name: &'static str,
        default: &'static str,
        unit: &'static str,
        doc: &'static str,
    ) -> Self {
        Self { name, kind: ParameterKind::Number, default, unit, doc }
    }

    /// An integer.
    pub const fn integer(name: &'static str, default: &'static str, doc: &'static str) -> Self {
        Self { name, kind: ParameterKind::Integer, default, unit: "", doc }
    }

    /// An index of refraction.
    pub const fn index(name: &'static str, default: &'static str, doc: &'static str) -> Self {
        Self { name, kind: ParameterKind::Index, default, unit: "1", doc }
    }

    /// A function of one variable.
    pub const fn table(
        name: &'static str,
        default: &'static str,
        unit: &'static str,
        doc: &'static str,
    ) -> Self {
        Self { name, kind: ParameterKind::Table, default, unit, doc }
    }

    /// Any member of a family.
    pub const fn member(
        name: &'static str,
        family: Family,
        base: &'static str,
        default: &'static str,
        doc: &'static str,
    ) -> Self {
        Self { name, kind: ParameterKind::Member(family, base), default, unit: "", doc }
    }
}

/// The laws that a class obeys; one contract test per law checks every such class.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Laws {
    /// M(θ_s, θ_i, −φ; r+π−φ) = P·M(θ_i, θ_s, φ; r)ᵀ·P with P = diag(1, 1, −1, 1).
    pub reciprocal: bool,
    /// M(−φ, −r) = Q·M·Q with Q = diag(1, 1, −1, −1).
    pub mirror: bool,
    /// Coherency eigenvalues ≥ −10⁻¹²·M00.
    pub realizable: bool,
    /// Never returns more light than came, for any incident polarization.
    pub passive: bool,
}

impl Laws {
    /// Reciprocal, mirror symmetric, realizable and passive.
    pub const ALL: Self = Self { reciprocal: true, mirror: true, realizable: true, passive: true };
    /// All but energy: single scattering without a bound on its sum.
    pub const NOT_PASSIVE: Self = Self { passive: false, ..Self::ALL };
    /// None.
    pub const NONE: Self =
        Self { reciprocal: false, mirror: false, realizable: false, passive: false };
}

/// Description of a class.
#[derive(Debug)]
pub struct Class {
    /// Name in a program.
    pub name: &'static str,
    /// Name of the class it extends.
    pub parent: &'static str,
    /// One line for lists.
    pub summary: &'static str,
    /// The equation in one line of plain text.
    pub equation: &'static str,
    /// Key in `docs/references.bib`; several are separated by blanks.
    pub source: &'static str,
    /// Parameters: inherited groups first, as users see them.
    pub params: &'static [&'static [Parameter]],
    /// The laws it claims.
    pub laws: Laws,
}

impl Class {
    /// All parameters, inherited ones first.
    pub fn parameters(&self) -> impl Iterator<Item = &'static Parameter> + use<> {
        self.params.iter().flat_map(|group| group.iter())
    }

    /// Position and description of the parameter `name`.
    pub fn parameter(&self, name: &str) -> Option<(usize, &'static Parameter)> {
        self.parameters().enumerate().find(|(_, param)| param.name == name)
    }
}

/// A class together with the function that builds it.
#[derive(Debug)]
pub struct Spec<T: ?Sized> {
    /// Description of the class.
    pub class: Class,
    /// Builds a prepared instance; nothing that depends on parameters alone is left for later.
    pub build: fn(&ParameterNode) -> Result<Box<T>, ParameterError>,
}

/// A type whose instances are built from the specs of one family.
pub trait Member: 'static {
    /// The family.
    const FAMILY: Family;
    /// Its specs, in the order they are listed to users.
    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>>;
}

/// A function of one variable given by a formula.
pub type FormulaFn = Arc<dyn Fn(f64) -> f64 + Send + Sync>;

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

/// Notices of a build, shared by a node and all below it.
pub type SharedNotices = Arc<Mutex<BTreeSet<Notice>>>;

/// A class with a typed value for each of its parameters: all that is needed to build it.
#[derive(Clone, Debug)]
pub struct ParameterNode {
    /// The class.
    pub class: &'static Class,
    /// One value per parameter, in the order of [`Class::parameters`].
    pub values: Vec<ParameterValue>,
    /// Sound or compat.
    pub mode: Mode,
    /// Collects the defects that a build avoided and the limits that it exceeded.
    pub met: SharedNotices,
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
    ///
    /// # Panics
    ///
    /// If a default in the registry is not a value of its kind; a test builds every class.
    pub fn with_defaults(class: &'static Class, mode: Mode) -> Self {
        Self::with_defaults_noting(class, mode, SharedNotices::default())
    }

    /// The same, noting the defects it steps around in `met`.
    ///
    /// # Panics
    ///
    /// As [`ParameterNode::with_defaults`].
    pub fn with_defaults_noting(class: &'static Class, mode: Mode, met: SharedNotices) -> Self {
        let values = class.parameters().map(|p| default_value(p, mode, &met)).collect();
        Self { class, values, mode, met }
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

    /// True if this build reproduces `defect`; a sound build notes that it met it.
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

    /// Notes that the parameters lie beyond `limit`.
    pub fn passes(&self, limit: ModelLimit) {
        self.note(limit.into());
    }

    fn note(&self, notice: Notice) {
        self.met.lock().expect("no build panics while it notes one").insert(notice);
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
            ParameterValue::Number(x) if self.mode == Mode::Sound && x.abs() < range::LEAST => 0.0,
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

    /// The nested instance `name`, built.
    ///
    /// # Errors
    ///
    /// What the instance's own parameters get wrong, with `name` before their names.
    pub fn member<T: ?Sized + Member>(&self, name: &str) -> Result<Box<T>, ParameterError> {
        build::<T>(self.child(name)).map_err(|error| error.inside(name))
    }
}

/// Builds the instance that `node` describes.
///
/// # Errors
///
/// What its parameters get wrong.
///
/// # Panics
///
/// If the node's class is not of the family `T`.
pub fn build<T: ?Sized + Member>(node: &ParameterNode) -> Result<Box<T>, ParameterError> {
    let spec = T::specs()
        .find(|spec| spec.class.name == node.class.name)
        .unwrap_or_else(|| panic!("{} is not a {}", node.class.name, T::FAMILY.base()));
    (spec.build)(node)
}

/// The class called `name`, in any family.
pub fn find_class(name: &str) -> Option<&'static Class> {
    Family::ALL.iter().flat_map(|family| family.classes()).find(|class| class.name == name)
}

/// True if the class called `name` is `base` or stands below it.
pub fn is_below(name: &str, base: &str) -> bool {
    if name == base {
        return true;
    }
    let parent = find_class(name)
        .map(|class| class.parent)
        .or_else(|| ABSTRACT.iter().find(|(this, _)| *this == name).map(|(_, parent)| *parent));
    parent.is_some_and(|parent| is_below(parent, base))
}

/// The default of `param` as a typed value; defaults in the registry are numbers, constants and
/// class names, never files.
fn default_value(param: &Parameter, mode: Mode, met: &SharedNotices) -> ParameterValue {
    let number = |text: &str| -> f64 {
        text.parse().unwrap_or_else(|_| panic!("default {text:?} of {}", param.name))
    };
    match param.kind {
        ParameterKind::Number => ParameterValue::Number(number(param.default)),
        ParameterKind::Integer => ParameterValue::Integer(
            param.default.parse().unwrap_or_else(|_| panic!("default of {}", param.name)),
        ),
        ParameterKind::Text | ParameterKind::File => ParameterValue::Text(param.default.into()),
        ParameterKind::Formula => {
            let value = number(param.default);
            ParameterValue::Formula(Arc::new(move |_| value))
        }
        ParameterKind::Index => {
            let inner = param.default.trim_start_matches('(').trim_end_matches(')');
            let (n, k) = inner.split_once(',').unwrap_or((inner, "0"));
            ParameterValue::Index(RefractiveIndex::constant(number(n), number(k)))
        }
        ParameterKind::Table => {
            ParameterValue::Table(RealFunction::constant(number(param.default)))
        }
        ParameterKind::Films => ParameterValue::Films(Vec::new()),
        ParameterKind::Member(..) => {
            let class = find_class(param.default)
                .unwrap_or_else(|| panic!("no class {:?} for {}", param.default, param.name));
            ParameterValue::Member(Arc::new(ParameterNode::with_defaults_noting(
                class,
                mode,
                met.clone(),
            )))
        }
    }
}
