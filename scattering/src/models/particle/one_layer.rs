//! Small spheres in a single film.
//!
//! $$ \mathbf{F} = \frac{N}{\cos\theta_i \cos\theta_s}\,\mathbf{M}(\mathbf{J}), \quad
//!    J_{ss} = \alpha E_i E_s \cos\varphi, \ldots $$
//!
//! N is the `density`, α the polarizability, E the fields at the `depth` of the centre below the
//! outer face of the film (`small_sphere.rs`). Reflection from outside only.
//!
//! T. A. Germer, *Polarized light scattering by microroughness and small defects in dielectric
//! layers*, J. Opt. Soc. Am. A 18, 1279 (2001).

use super::{
    LOCAL,
    small_sphere::{SmallSphere, SpherePosition},
};
use crate::{
    ParameterError,
    models::{Brdf, COMMON, CommonParameters},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "OneLayer_BRDF_Model",
        parent: "Local_BRDF_Model",
        summary: "Small spheres in a single film",
        equation: "F = density/(cos_i cos_s) M(J), J = alpha E_i E_s",
        source: "germer-2001-layers",
        params: &[
            COMMON,
            LOCAL,
            &[
                Parameter::number("radius", 0.01, "um", "Radius of the sphere"),
                Parameter::index("defect", (1.0, 0.0), "Index of the sphere"),
                Parameter::index("film", (1.59, 0.0), "Index of the film"),
                Parameter::number("tau", 0.05, "um", "Thickness of the film"),
                Parameter::number("depth", 0.0, "um", "Depth of the centre below the outer face"),
            ],
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| {
        let common = CommonParameters::read(node)?;
        common.only_reflection("OneLayer_BRDF_Model")?;
        let (tau, depth) = (node.number("tau"), node.number("depth"));
        if !(tau >= 0.0 && tau.is_finite()) {
            return Err(ParameterError::new(
                "tau",
                format!("{tau} um is not the thickness of a film"),
            ));
        }
        if !(0.0..=tau).contains(&depth) {
            let problem = format!("{depth} um is not in the film, 0 to {tau} um");
            return Err(ParameterError::new("depth", problem));
        }
        let film = node.index("film").at(common.lambda);
        let place = SpherePosition { depth, medium: film };
        let defect = node.index("defect").at(common.lambda);
        Ok(Box::new(SmallSphere::new(node, common, &[(film, tau)], place, defect)?))
    },
};
