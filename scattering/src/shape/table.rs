//! Outline from a table of distances from the origin over the polar angle in degrees.
//!
//! Slopes are central differences over 10⁻⁶ rad.

use std::f64::consts::PI;

use super::{SHAPE, Shape, points};
use crate::{
    scatterer::positive,
    spec::{Class, Laws, Parameter, Spec},
};

const STEP: f64 = 1e-6;

/// Name, parameters and constructor of a body from a table.
pub const SPEC: Spec<Shape> = Spec {
    class: Class {
        name: "Table_Axisymmetric_Shape",
        parent: "Axisymmetric_Shape",
        summary: "Body of revolution with a tabulated outline",
        equation: "r = scale table(theta)",
        source: "mishchenko-2002",
        params: &[
            &SHAPE,
            &[
                Parameter::table(
                    "table",
                    0.05,
                    "um",
                    "Distance from the origin over the angle, deg",
                ),
                Parameter::number("scale", 1.0, "1", "Factor of the distances"),
            ],
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let (table, scale) = (node.table("table"), positive(node, "scale")?);
        let r = |theta: f64| scale * table.at(theta.to_degrees());
        let outline = |_, theta| (r(theta), (r(theta + STEP) - r(theta - STEP)) / (2.0 * STEP));
        Shape::sample(points(node)?, &[0.0, PI], outline).checked("table")
    },
};
