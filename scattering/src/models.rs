//! BRDF models, one file each in a folder per group.

use crate::spec::{self, Member, Spec};

mod batch;
mod brdf;
pub mod coating;
pub mod diffuse;
pub mod facet;
pub mod grating;
pub mod instrument;
mod model;
pub mod particle;
pub mod roughness;
mod smooth_interface;
pub mod sum;

pub(crate) use brdf::{BATCH, sum_of};
pub use brdf::{Brdf, COMMON, CommonParameters, FAMILY, LobeSupport, nested};
pub use model::{Model, build};

/// All models, in the order they are listed to users.
pub fn all() -> impl Iterator<Item = &'static Spec<dyn Brdf>> {
    spec::specs::<dyn Brdf>()
}

/// Finds a model by its name in a program.
pub fn find(name: &str) -> Option<&'static Spec<dyn Brdf>> {
    all().find(|spec| spec.class.name == name)
}

impl Member for dyn Brdf {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[
        diffuse::ALL,
        facet::ALL,
        coating::ALL,
        sum::ALL,
        roughness::ALL,
        particle::ALL,
        grating::ALL,
        instrument::ALL,
    ];
}
