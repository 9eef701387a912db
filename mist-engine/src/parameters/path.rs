//! Dotted names of parameters, resolved once against every class that can hold them.

use std::sync::Arc;

use scattering::{Class, Parameter, ParameterKind};

/// The dotted name of a parameter, such as `source1.sdf.s`.
///
/// Each part keeps its position in every class that can stand at its place, so the path stays
/// valid when a loop replaces an object by one of another class.
#[derive(Clone, Debug)]
pub struct ParameterPath {
    text: Arc<str>,
    parts: Arc<[PathPart]>,
}

#[derive(Debug)]
struct PathPart {
    /// Start of the part in the text.
    start: usize,
    /// End of the part in the text.
    end: usize,
    /// Position and description in each class that has a parameter of this name.
    positions: Vec<(&'static Class, usize, &'static Parameter)>,
}

impl ParameterPath {
    /// Resolves the dotted name `text`, seen from an object of `class`.
    ///
    /// A name that no class knows is an error when the parameter is set: only then is the class
    /// certain.
    pub fn resolve(class: &'static Class, text: &str) -> Self {
        let mut parts = Vec::new();
        let mut classes = vec![class];
        let mut start = 0;
        for name in text.split('.') {
            let found = |class: &'static Class| {
                class.parameter(name).map(|(position, param)| (class, position, param))
            };
            let positions: Vec<_> = classes.iter().copied().filter_map(found).collect();
            classes = members(positions.iter().map(|(_, _, param)| *param));
            parts.push(PathPart { start, end: start + name.len(), positions });
            start += name.len() + 1;
        }
        Self { text: text.into(), parts: parts.into() }
    }

    /// The dotted name.
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// True if the parameter belongs to the object that `object` names.
    pub(crate) fn is_inside(&self, object: &Self) -> bool {
        self.text.strip_prefix(&*object.text).is_some_and(|rest| rest.starts_with('.'))
    }

    /// True if the path names an object, so that setting it chooses a class.
    pub(crate) fn names_object(&self) -> bool {
        let last = self.parts.last();
        last.is_some_and(|part| {
            let is_object = |(_, _, param): &(_, _, &Parameter)| {
                matches!(param.kind, ParameterKind::Member { .. })
            };
            !part.positions.is_empty() && part.positions.iter().all(is_object)
        })
    }

    /// The whole path, seen from the model.
    pub(crate) fn relative_to_model(&self) -> RelativePath<'_> {
        RelativePath { path: self, at: 0 }
    }
}

/// All classes that the parameters `params` can hold.
fn members(params: impl Iterator<Item = &'static Parameter>) -> Vec<&'static Class> {
    let mut families = Vec::new();
    for param in params {
        if let ParameterKind::Member { family, .. } = param.kind
            && !families.contains(&family)
        {
            families.push(family);
        }
    }
    families.into_iter().flat_map(|family| family.classes()).collect()
}

/// A path as an object in the tree sees it: without the parts that lead to the object.
#[derive(Clone, Copy)]
pub(crate) struct RelativePath<'p> {
    path: &'p ParameterPath,
    at: usize,
}

impl<'p> RelativePath<'p> {
    /// The first part.
    pub(crate) fn name(self) -> &'p str {
        let part = self.part();
        &self.path.text[part.start..part.end]
    }

    /// The path behind the first part, if there is more.
    pub(crate) fn rest(self) -> Option<Self> {
        (self.at + 1 < self.path.parts.len()).then_some(Self { at: self.at + 1, ..self })
    }

    /// The text of the path.
    pub(crate) fn text(self) -> &'p str {
        &self.path.text[self.part().start..]
    }

    /// Position and description of the first part in `class`.
    pub(crate) fn find_in(self, class: &'static Class) -> Option<(usize, &'static Parameter)> {
        let mut known = self.part().positions.iter();
        let known = known.find(|(other, _, _)| std::ptr::eq(*other, class));
        match known {
            Some((_, position, param)) => Some((*position, param)),
            None => class.parameter(self.name()),
        }
    }

    fn part(self) -> &'p PathPart {
        &self.path.parts[self.at]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_finds_its_parameter_in_every_class_that_has_it() {
        let facet = scattering::models::find("Facet_BRDF_Model").unwrap();
        let path = ParameterPath::resolve(&facet.class, "sdf.s");
        let (position, param) = path.relative_to_model().find_in(&facet.class).unwrap();
        assert_eq!(facet.class.parameters().nth(position).unwrap().name, param.name);
        let rest = path.relative_to_model().rest().unwrap();
        assert_eq!((rest.name(), rest.text(), rest.rest().is_none()), ("s", "s", true));
        for name in
            ["Gaussian_Slope_Distribution_Function", "Exponential_Slope_Distribution_Function"]
        {
            let class = scattering::registry::find_class(name).unwrap();
            let (position, param) = rest.find_in(class).unwrap();
            assert_eq!(class.parameter("s").map(|(at, _)| at), Some(position));
            assert_eq!(param.name, "s");
        }
    }
}
