//! Density tabulated against the tilt angle.
//!
//! $$ S = \frac{T(\theta_n)}{(1+\zeta^2)^2}, \qquad \theta_n = \arctan\zeta $$
//!
//! The table is a function of the angle in degrees; nothing is normalized. NIST's library
//! multiplies radians by π/180 where it should divide ([`Defect::TableAngleUnit`]), so that it
//! reads its tables near their first point.

use super::{SlopeDistribution, by_angle};
use crate::{
    Defect,
    optics::RealFunction,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn SlopeDistribution> = Spec {
    class: Class {
        name: "Table_Angle_Distribution_Function",
        parent: "Angle_Distribution_Function",
        summary: "Density tabulated against the tilt angle",
        equation: "S = T(theta)/(1+zeta^2)^2, theta in degrees",
        source: "torrance-1967",
        params: &[&[Parameter::table(
            "T",
            1.0,
            "1",
            "Density as a function of the tilt angle in degrees",
        )]],
        laws: Laws::NONE,
    },
    build: |node| {
        let degrees = if node.reproduces(Defect::TableAngleUnit) {
            1f64.to_radians()
        } else {
            1f64.to_degrees()
        };
        Ok(Box::new(TableAngle { table: node.table("T").clone(), degrees }))
    },
};

struct TableAngle {
    table: RealFunction,
    /// From radians to the argument of the table.
    degrees: f64,
}

impl SlopeDistribution for TableAngle {
    fn density(&self, x: f64, y: f64) -> f64 {
        by_angle(x, y, |theta_n| self.table.at(theta_n * self.degrees))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Mode, ParameterNode, ParameterValue,
        optics::{AbscissaScale, TableInterpolation},
        spec,
    };

    fn density(mode: Mode) -> f64 {
        let table = RealFunction::points(
            &[(0.0, 0.0), (90.0, 90.0)],
            AbscissaScale::Linear,
            TableInterpolation::Linear,
        );
        let node = ParameterNode::with_defaults(&SPEC.class, mode)
            .with("T", ParameterValue::Table(table))
            .unwrap();
        spec::build::<dyn SlopeDistribution>(&node).unwrap().density(1.0, 0.0)
    }

    #[test]
    fn the_table_is_read_in_degrees_and_by_the_library_in_degrees_over_57_squared() {
        // Slope 1 is 45 degrees; (1 + ζ²)² = 4.
        assert!((density(Mode::Sound) - 45.0 / 4.0).abs() < 1e-13);
        let wrong = std::f64::consts::FRAC_PI_4.to_radians();
        assert!((density(Mode::Compat) - wrong / 4.0).abs() < 1e-15);
    }
}
