//! Line grating by rigorous coupled waves, every order a cone of light.
//!
//! $$ \mathbf F = \sum_i \frac{\mathbf R_i}{\pi\alpha^2\cos\theta_s} $$
//!
//! over the orders i within α (`alpha`) of the direction of scattering, whose lateral wave
//! vectors are sin θ_i + (iλ/d) cos r and (iλ/d) sin r, d the period, r the rotation of the
//! sample. Harmonics −`order`…`order` are kept. The medium above is vacuum. At normal incidence NIST's
//! library takes s along y of the grating ([`Defect::LineNormalBasis`]).
//!
//! M. G. Moharam, E. B. Grann, D. A. Pommet, T. K. Gaylord, J. Opt. Soc. Am. A 12, 1068 (1995).

use std::f64::consts::TAU;

use super::{
    convergence::{ConvergenceCheck, other_order},
    orders::{OrderConeModel, bounded, half_angle, media, order},
};
use crate::{
    Brdf, Defect,
    grating::{self, Grating, LineProfile},
    models::{COMMON, CommonParameters},
    rcw::PeriodicStructure,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::number("alpha", 0.0175, "rad", "Half angle of the cone of every order"),
    Parameter::integer("order", 25, "Highest harmonic that is kept"),
    Parameter::member("grating", &grating::FAMILY, "Single_Line_Grating", "The grating"),
];

/// Name, parameters and constructor of the model.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "RCW_BRDF_Model",
        parent: "BRDF_Model",
        summary: "Line grating by coupled waves, orders given a finite cone",
        equation: "F = sum_i R_i/(pi alpha^2 cos(theta_s)) within alpha of order i",
        source: "moharam-1995 moharam-1995b li-1996 lalanne-1996",
        params: &[COMMON, OWN],
        laws: Laws { realizable: true, ..Laws::NONE },
    },
    build: |node| {
        let common = CommonParameters::read(node)?;
        let order = order(node, "order")?;
        bounded("order", order.checked_mul(2))?;
        let profile = profile(node, &common)?;
        let structure = structure(&profile, &common, order);
        let check = ConvergenceCheck::new(node, || {
            Some(self::structure(&profile, &common, other_order(order)))
        });
        let model = OrderConeModel::new(common, structure, check, half_angle(node)?);
        if node.reproduces(Defect::LineNormalBasis) {
            return Ok(Box::new(model.with_leaning_beam()));
        }
        Ok(Box::new(model))
    },
};

fn profile(node: &ParameterNode, common: &CommonParameters) -> Result<LineProfile, ParameterError> {
    let grating = node.member::<dyn Grating>("grating")?;
    let profile = grating.at(common.lambda).map_err(|error| error.inside("grating"))?;
    media(common, profile.above, profile.below)?;
    Ok(profile)
}

fn structure(profile: &LineProfile, common: &CommonParameters, order: usize) -> PeriodicStructure {
    let k0 = TAU / common.lambda;
    let slices = profile.slices.iter().filter(|slice| slice.thickness > 0.0);
    let last = order as isize;
    PeriodicStructure {
        layers: slices.map(|s| s.pattern.operators(order, k0 * s.thickness)).collect(),
        incident: 1.0,
        behind: profile.below,
        harmonics: (-last..=last)
            .map(|m| (m as f64 * common.lambda / profile.period, 0.0))
            .collect(),
        zeroth: order,
    }
}
