//! Slopes of ellipsoidal bumps that are spread over a plane.
//!
//! $$ S = \rho\left(\frac{r_x r_y r_z}{r_z^2 + r_x^2\zeta_x^2 + r_y^2\zeta_y^2}\right)^2 $$
//!
//! The integral over all slopes is π r_x r_y ρ: the fraction of the area that bumps cover.

use super::{SlopeDistribution, width};
use crate::spec::{Class, Laws, Parameter, ParameterError, Spec};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn SlopeDistribution> = Spec {
    class: Class {
        name: "Ellipsoid_Slope_Distribution_Function",
        parent: "Slope_Distribution_Function",
        summary: "Slopes of ellipsoidal bumps",
        equation: "S = density (rx ry rz/(rz^2 + rx^2 zeta_x^2 + ry^2 zeta_y^2))^2",
        source: "torrance-1967",
        params: &[&[
            Parameter::number("rx", 10.0, "um", "Half axis along x"),
            Parameter::number("ry", 10.0, "um", "Half axis along y"),
            Parameter::number("rz", 1.0, "um", "Half axis along z"),
            Parameter::number("density", 0.0001, "1/um^2", "Bumps per area"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let density = node.number("density");
        if !(density >= 0.0 && density.is_finite()) {
            return Err(ParameterError::new("density", format!("{density} is not a density")));
        }
        let (rx, ry, rz) = (width(node, "rx")?, width(node, "ry")?, width(node, "rz")?);
        Ok(Box::new(EllipsoidSlope { rx, ry, rz, density }))
    },
};

struct EllipsoidSlope {
    rx: f64,
    ry: f64,
    rz: f64,
    density: f64,
}

impl SlopeDistribution for EllipsoidSlope {
    fn density(&self, x: f64, y: f64) -> f64 {
        let Self { rx, ry, rz, density } = *self;
        let (u, v) = (rx * x, ry * y);
        let ratio = rx * ry * rz / (rz * rz + u * u + v * v);
        density * ratio * ratio
    }
}
