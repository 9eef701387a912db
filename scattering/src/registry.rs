//! The registry: every family of classes, in the order of the manual.

use crate::{
    cross_grating, distribution, grating, models, phase, polarized_phase, psd, reflectance,
    scatterer, shadow, shape, size, slope,
    spec::{Class, Family},
    stack,
};

/// Every family, in the order of the manual.
pub static FAMILIES: &[&Family] = &[
    &models::FAMILY,
    &slope::FAMILY,
    &shadow::FAMILY,
    &psd::FAMILY,
    &stack::FAMILY,
    &reflectance::FAMILY,
    &phase::FAMILY,
    &polarized_phase::FAMILY,
    &scatterer::FAMILY,
    &distribution::FAMILY,
    &size::VOLUME_FAMILY,
    &size::SURFACE_FAMILY,
    &grating::FAMILY,
    &cross_grating::FAMILY,
    &shape::FAMILY,
    &models::coating::layer::FAMILY,
    &models::coating::paint::FAMILY,
    &models::coating::paint_face::FAMILY,
    &models::coating::paint_flakes::FAMILY,
];

/// All classes, family by family.
pub fn classes() -> impl Iterator<Item = &'static Class> {
    FAMILIES.iter().flat_map(|family| family.classes())
}

/// The class called `name`, in any family.
pub fn find_class(name: &str) -> Option<&'static Class> {
    classes().find(|class| class.name == name)
}

/// True if `name` is an abstract class between the base of a family and its members.
pub fn is_abstract(name: &str) -> bool {
    FAMILIES.iter().any(|family| family.abstract_classes.iter().any(|(this, _)| *this == name))
}
