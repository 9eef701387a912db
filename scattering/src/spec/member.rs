//! Classes with their builders, and the way from a parameter node to an object.

use super::{
    class::Class,
    node::{ParameterError, ParameterNode},
};

/// A class together with the function that builds its objects.
#[derive(Debug)]
pub struct Spec<T: ?Sized> {
    /// The description of the class.
    pub class: Class,
    /// Builds a prepared object: everything that depends on parameters alone is computed here.
    pub build: fn(&ParameterNode) -> Result<Box<T>, ParameterError>,
}

/// A type whose objects are built from the classes of one family.
pub trait Member: 'static {
    /// The classes of the family in groups, in the order in which users see them.
    const CLASSES: &'static [&'static [&'static Spec<Self>]];
}

/// The specs of the family of `T`, in the order in which users see them.
pub fn specs<T: ?Sized + Member>() -> impl Iterator<Item = &'static Spec<T>> {
    T::CLASSES.iter().flat_map(|group| group.iter().copied())
}

/// The classes of the family of `T`, in the order in which users see them.
pub fn classes<T: ?Sized + Member>() -> Vec<&'static Class> {
    specs::<T>().map(|spec| &spec.class).collect()
}

/// Builds the object that `node` describes.
///
/// # Errors
///
/// If the class refuses the value of a parameter.
///
/// # Panics
///
/// If the node's class is not of the family of `T`.
pub fn build<T: ?Sized + Member>(node: &ParameterNode) -> Result<Box<T>, ParameterError> {
    let spec = specs::<T>()
        .find(|spec| spec.class.name == node.class.name)
        .unwrap_or_else(|| panic!("{} is not a class of this family", node.class.name));
    (spec.build)(node)
}

impl ParameterNode {
    /// Builds the object that the parameter `name` holds.
    ///
    /// # Errors
    ///
    /// The error of the object with `name` before the name of its parameter.
    pub fn member<T: ?Sized + Member>(&self, name: &str) -> Result<Box<T>, ParameterError> {
        build::<T>(self.child(name)).map_err(|error| error.inside(name))
    }
}
