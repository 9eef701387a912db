//! A number of particles times a density of the diameter: n(d) = N p(d).

use super::{SurfaceSize, VolumeSize};
use crate::{
    ParameterNode,
    distribution::{self, Distribution},
    spec::{Class, Laws, Parameter, ParameterError, Spec},
};

/// Name, parameters and constructor of a [`Regular`] distribution over a volume.
pub const VOLUME: Spec<dyn VolumeSize> = Spec {
    class: Class {
        name: "Regular_VolumeParticleSizeDistribution",
        parent: "VolumeParticleSizeDistribution",
        summary: "Number per volume times a density of the diameter",
        equation: "n = N p(d)",
        source: "deirmendjian-1969",
        params: &[&[
            DISTRIBUTION,
            Parameter::number("numberdensity", 1e-5, "1/um^3", "Number of particles per volume"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(Regular::read(node)?)),
};

/// Name, parameters and constructor of a [`Regular`] distribution over an area.
pub const SURFACE: Spec<dyn SurfaceSize> = Spec {
    class: Class {
        name: "Regular_SurfaceParticleSizeDistribution",
        parent: "SurfaceParticleSizeDistribution",
        summary: "Number per area times a density of the diameter",
        equation: "n = N p(d)",
        source: "deirmendjian-1969",
        params: &[&[
            DISTRIBUTION,
            Parameter::number("numberdensity", 0.001, "1/um^2", "Number of particles per area"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(Regular::read(node)?)),
};

const DISTRIBUTION: Parameter = Parameter::member(
    "distribution",
    &distribution::FAMILY,
    "Log_Normal_Distribution",
    "Density of the diameter",
);

/// A number of particles with a density of the diameter.
pub struct Regular {
    distribution: Box<dyn Distribution>,
    number: f64,
}

impl Regular {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let number = node.number("numberdensity");
        if !(number >= 0.0 && number.is_finite()) {
            return Err(ParameterError::new("numberdensity", format!("{number} is not a density")));
        }
        Ok(Self { distribution: node.member::<dyn Distribution>("distribution")?, number })
    }
}

impl VolumeSize for Regular {
    fn density(&self, d: f64) -> f64 {
        self.number * self.distribution.density(d)
    }
}

impl SurfaceSize for Regular {
    fn density(&self, d: f64) -> f64 {
        self.number * self.distribution.density(d)
    }
}
