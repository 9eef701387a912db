//! Bodies of revolution: their outline r(θ) at the nodes of a quadrature.
//!
//! θ = 0 points down, to the substrate of a model with one. The outline is cut into smooth
//! pieces, each with ⌊n Δθ/π⌋ nodes of a Gauss–Legendre rule in θ, n = `npoints`; a piece too
//! short for a node is left out.

use crate::spec::{Member, Spec};

pub mod chebyshev;
pub mod conical;
pub mod cylinder;
pub mod double_conical;
pub mod ellipsoid;
mod family;
pub mod indented_ellipsoid;
mod outline;
pub mod table;

pub use family::{FAMILY, Shape, Spheroid, SurfaceNode};
pub(crate) use family::{RENORM, SHAPE, points};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<Shape>] = &[
    &ellipsoid::SPEC,
    &cylinder::SPEC,
    &conical::SPEC,
    &double_conical::SPEC,
    &indented_ellipsoid::SPEC,
    &chebyshev::SPEC,
    &table::SPEC,
];

impl Member for Shape {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::{Mode, ParameterError, ParameterNode, ParameterValue, optics::RealFunction, spec};

    fn build(name: &str, values: &[(&str, ParameterValue)]) -> Result<Box<Shape>, ParameterError> {
        let node =
            ParameterNode::with_defaults(crate::registry::find_class(name).unwrap(), Mode::Sound);
        let node =
            values.iter().try_fold(node, |node, (name, value)| node.with(name, value.clone()))?;
        spec::build::<Shape>(&node)
    }

    #[test]
    fn slopes_are_the_derivatives_of_the_outlines() {
        for spec in ALL {
            let values = match spec.class.name {
                "Cylinder_Axisymmetric_Shape" => vec![("corner", ParameterValue::Number(0.01))],
                "Conical_Axisymmetric_Shape" => vec![
                    ("corner_base", ParameterValue::Number(0.005)),
                    ("corner_apex", ParameterValue::Number(0.01)),
                ],
                _ => vec![],
            };
            let shape = build(spec.class.name, &values).unwrap();
            // Closed outlines return to their start: ∫ r' dθ = r(π) − r(0), here from the
            // neighbours of the poles, and each step follows its slope up to curvature.
            for pair in shape.nodes().windows(2) {
                let step = pair[1].theta - pair[0].theta;
                let linear = pair[0].r + 0.5 * step * (pair[0].slope + pair[1].slope);
                assert!((pair[1].r - linear).abs() < 2e-3 * pair[1].r, "{}", spec.class.name);
            }
        }
    }

    #[test]
    fn volumes_are_those_of_geometry() {
        let close = |shape: Box<Shape>, expected: f64| {
            // The piece next to the cut of a node count differs by rounding of the count only.
            assert!((shape.volume() / expected - 1.0).abs() < 1e-6, "{}", shape.volume());
        };
        let [r, h] = [0.05f64, 0.1f64];
        close(build("Ellipsoid_Axisymmetric_Shape", &[]).unwrap(), 4.0 / 3.0 * PI * r.powi(3));
        close(build("Cylinder_Axisymmetric_Shape", &[]).unwrap(), PI * r * r * h);
        close(build("Conical_Axisymmetric_Shape", &[]).unwrap(), PI * r * r * h / 3.0);
        close(build("Double_Conical_Axisymmetric_Shape", &[]).unwrap(), PI * r * r * h / 3.0);
    }

    #[test]
    fn renormalized_bodies_have_the_volume_of_the_plain_ones() {
        for (name, values, plain) in [
            ("Cylinder_Axisymmetric_Shape", vec![("corner", 0.02)], PI * 0.05 * 0.05 * 0.1),
            ("Double_Conical_Axisymmetric_Shape", vec![("corner_waist", 0.01)], PI * 2.5e-4 / 3.0),
            ("Chebyshev_Axisymmetric_Shape", vec![], 4.0 / 3.0 * PI * 0.05f64.powi(3)),
        ] {
            let mut values: Vec<_> =
                values.into_iter().map(|(name, x)| (name, ParameterValue::Number(x))).collect();
            values.push(("renorm", ParameterValue::Integer(1)));
            let volume = build(name, &values).unwrap().volume();
            assert!((volume / plain - 1.0).abs() < 1e-4, "{name} {volume} {plain}");
        }
    }

    #[test]
    fn impossible_bodies_are_refused() {
        for (name, parameter, value) in [
            ("Ellipsoid_Axisymmetric_Shape", "vertical", 0.0),
            ("Ellipsoid_Axisymmetric_Shape", "offset", 0.06),
            ("Cylinder_Axisymmetric_Shape", "corner", 0.06),
            ("Cylinder_Axisymmetric_Shape", "radius", f64::NAN),
            ("Conical_Axisymmetric_Shape", "corner_apex", 1.0),
            ("Conical_Axisymmetric_Shape", "offset", 0.1),
            ("Double_Conical_Axisymmetric_Shape", "height", -1.0),
            ("Indented_Ellipsoid_Axisymmetric_Shape", "indent", 0.05),
            ("Chebyshev_Axisymmetric_Shape", "amplitude", 2.0),
            ("Table_Axisymmetric_Shape", "scale", -1.0),
        ] {
            let error = build(name, &[(parameter, ParameterValue::Number(value))]).unwrap_err();
            assert!(!error.problem.is_empty(), "{name}");
        }
        let table = [("table", ParameterValue::Table(RealFunction::constant(0.0)))];
        assert_eq!(build("Table_Axisymmetric_Shape", &table).unwrap_err().parameter, "table");
        let none = [("npoints", ParameterValue::Integer(0))];
        assert_eq!(build("Table_Axisymmetric_Shape", &none).unwrap_err().parameter, "npoints");
    }
}
