//! Ideal diffuse reflector that depolarizes completely.
//!
//! $$ \mathbf{F} = \frac{R(\lambda)}{\pi}\,\mathrm{diag}(1, 0, 0, 0) $$
//!
//! R is the directional-hemispherical reflectance, the same for every angle of incidence. The
//! side of the surface does not matter.
//!
//! F. E. Nicodemus et al., *Geometrical Considerations and Nomenclature for Reflectance*,
//! NBS Monograph 160 (1977).

use std::f64::consts::FRAC_1_PI;

use crate::{
    Direction, Incidence, Mueller,
    models::{Brdf, COMMON, CommonParameters},
    reflectance,
    spec::{Class, Laws, Parameter, Spec},
};

/// The parameter of a diffuse body: its reflectance.
pub const BODY: &[Parameter] = &[Parameter::member(
    "reflectance",
    &reflectance::FAMILY,
    "Table_Reflectance",
    "Reflectance of the body as a function of wavelength",
)];

/// Name, parameters and constructor of a [`Lambertian`].
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Lambertian_BRDF_Model",
        parent: "BRDF_Model",
        summary: "Ideal diffuse, fully depolarizing reflector",
        equation: "F = R/pi diag(1,0,0,0)",
        source: "nicodemus-1977",
        params: &[COMMON, BODY],
        laws: Laws::ALL,
    },
    build: |node| {
        let common = CommonParameters::read(node)?;
        let reflectance = reflectance::read(node, "reflectance", common.lambda)?;
        Ok(Box::new(Lambertian { common, reflectance }))
    },
};

/// An ideal diffuse reflector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lambertian {
    common: CommonParameters,
    reflectance: f64,
}

impl Brdf for Lambertian {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn mueller(&self, _: &Incidence, _: &Direction) -> Mueller {
        Mueller::depolarizer(self.reflectance * FRAC_1_PI)
    }

    fn is_quick(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use crate::{Basis, Geometry, Mode, ParameterNode, models};

    #[test]
    fn hemisphere_returns_the_reflectance() {
        // ∫ f cos θ dΩ over the hemisphere is π f for a constant f.
        let at = Geometry { theta_i: 0.7, theta_s: 0.2, phi_s: 1.0, rotation: 0.0 };
        let model =
            models::build(&ParameterNode::with_defaults(&super::SPEC.class, Mode::Sound)).unwrap();
        let f = model.mueller(&at, Basis::Psps)[(0, 0)];
        assert!((f * std::f64::consts::PI - 1.0).abs() < 1e-15);
    }
}
