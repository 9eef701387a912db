//! Descriptions of classes: families, classes, parameters with their defaults, and laws.
//!
//! A class is a BRDF model, a slope distribution, a film stack and so on. Classes that can replace
//! each other form a family. A parameter that holds an object points to the family of its classes.

use std::fmt;

/// A family of classes that can replace each other.
#[derive(Clone, Copy)]
pub struct Family {
    /// Name of the abstract base class.
    pub base: &'static str,
    /// Heading of the family in lists and in the manual.
    pub title: &'static str,
    /// Abstract classes between the base and the members: (name, parent).
    ///
    /// A parameter may accept only the classes below one of these.
    pub abstract_classes: &'static [(&'static str, &'static str)],
    /// Lists the members in the order in which users see them.
    list: fn() -> Vec<&'static Class>,
}

impl Family {
    /// A family without abstract classes whose members `list` returns.
    pub const fn new(
        base: &'static str,
        title: &'static str,
        list: fn() -> Vec<&'static Class>,
    ) -> Self {
        Self { base, title, abstract_classes: &[], list }
    }

    /// The family with these abstract classes, (name, parent) each.
    pub const fn with_abstract(
        self,
        abstract_classes: &'static [(&'static str, &'static str)],
    ) -> Self {
        Self { abstract_classes, ..self }
    }

    /// The members, in the order in which users see them.
    pub fn classes(&self) -> Vec<&'static Class> {
        (self.list)()
    }

    /// The member called `name`.
    pub fn class(&self, name: &str) -> Option<&'static Class> {
        self.classes().into_iter().find(|class| class.name == name)
    }

    /// True if the class called `name` is `base` or extends it, directly or indirectly.
    pub fn is_below(&self, name: &str, base: &str) -> bool {
        if name == base {
            return true;
        }
        let abstract_parent = || {
            self.abstract_classes.iter().find(|(this, _)| *this == name).map(|(_, parent)| *parent)
        };
        let parent = self.class(name).map(|class| class.parent).or_else(abstract_parent);
        parent.is_some_and(|parent| self.is_below(parent, base))
    }
}

impl PartialEq for Family {
    fn eq(&self, other: &Self) -> bool {
        self.base == other.base
    }
}

impl fmt::Debug for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.base)
    }
}

/// The type of a parameter with its default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterKind {
    /// A real number.
    Number(f64),
    /// An integer.
    Integer(i32),
    /// Text that the class parses; empty by default.
    Text,
    /// The text of a data file that the parameter names; none by default.
    File,
    /// A real function of `x`, written as an expression; a constant by default.
    Formula(f64),
    /// A complex index of refraction as a function of wavelength; the constant n + ik by default.
    Index {
        /// n.
        n: f64,
        /// k.
        k: f64,
    },
    /// A real function of one variable; a constant by default.
    Table(f64),
    /// Films as `material thickness` pairs; none by default.
    Films,
    /// An object of a class of `family` at or below the class `base`.
    Member {
        /// The family of the classes.
        family: &'static Family,
        /// The class that they extend.
        base: &'static str,
        /// The name of the default class.
        default: &'static str,
    },
}

impl ParameterKind {
    /// The default as a program writes it.
    pub fn default_text(&self) -> String {
        match *self {
            Self::Number(x) | Self::Formula(x) | Self::Table(x) => number_text(x),
            Self::Integer(i) => i.to_string(),
            Self::Index { n, k } => format!("({},{})", number_text(n), number_text(k)),
            Self::Text | Self::File | Self::Films => String::new(),
            Self::Member { default, .. } => default.to_owned(),
        }
    }
}

/// The shortest text of `x` that reads back as `x`, with an exponent for large and small numbers.
pub fn number_text(x: f64) -> String {
    if x != 0.0 && !(1e-4..1e6).contains(&x.abs()) { format!("{x:E}") } else { format!("{x}") }
}

/// One parameter of a class.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Name in a program.
    pub name: &'static str,
    /// Type and default.
    pub kind: ParameterKind,
    /// Unit; `1` for a pure number, empty where there is none.
    pub unit: &'static str,
    /// Meaning, for the manual.
    pub doc: &'static str,
}

impl Parameter {
    /// A real number.
    pub const fn number(
        name: &'static str,
        default: f64,
        unit: &'static str,
        doc: &'static str,
    ) -> Self {
        Self { name, kind: ParameterKind::Number(default), unit, doc }
    }

    /// An integer.
    pub const fn integer(name: &'static str, default: i32, doc: &'static str) -> Self {
        Self { name, kind: ParameterKind::Integer(default), unit: "", doc }
    }

    /// An index of refraction, by default n + ik.
    pub const fn index(name: &'static str, (n, k): (f64, f64), doc: &'static str) -> Self {
        Self { name, kind: ParameterKind::Index { n, k }, unit: "1", doc }
    }

    /// A function of one variable, by default a constant.
    pub const fn table(
        name: &'static str,
        default: f64,
        unit: &'static str,
        doc: &'static str,
    ) -> Self {
        Self { name, kind: ParameterKind::Table(default), unit, doc }
    }

    /// A data file.
    pub const fn file(name: &'static str, doc: &'static str) -> Self {
        Self { name, kind: ParameterKind::File, unit: "", doc }
    }

    /// An object of any class of a family.
    pub const fn member(
        name: &'static str,
        family: &'static Family,
        default: &'static str,
        doc: &'static str,
    ) -> Self {
        Self::member_below(name, family, family.base, default, doc)
    }

    /// An object of a class of a family at or below `base`.
    pub const fn member_below(
        name: &'static str,
        family: &'static Family,
        base: &'static str,
        default: &'static str,
        doc: &'static str,
    ) -> Self {
        Self { name, kind: ParameterKind::Member { family, base, default }, unit: "", doc }
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

/// The description of a class: name, parameters, equation, source, laws.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_print_as_programs_write_them() {
        for (kind, text) in [
            (ParameterKind::Number(0.532), "0.532"),
            (ParameterKind::Number(2.51e7), "2.51E7"),
            (ParameterKind::Number(1e-5), "1E-5"),
            (ParameterKind::Number(0.0), "0"),
            (ParameterKind::Integer(-3), "-3"),
            (ParameterKind::Index { n: 4.05, k: 0.05 }, "(4.05,0.05)"),
            (ParameterKind::Films, ""),
        ] {
            assert_eq!(kind.default_text(), text);
        }
    }
}
