//! Two equal cones base to base, with rounded edges.

use super::{
    RENORM, SHAPE, Shape,
    outline::{OutlineCorner, convex},
    points,
};
use crate::{
    scatterer::positive,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a double cone.
pub const SPEC: Spec<Shape> = Spec {
    class: Class {
        name: "Double_Conical_Axisymmetric_Shape",
        parent: "Axisymmetric_Shape",
        summary: "Two cones base to base, with rounded edges",
        equation: "rho = R (1 - 2|z|/H)",
        source: "mishchenko-2002",
        params: &[
            &SHAPE,
            &[
                Parameter::number("height", 0.1, "um", "Height from apex to apex"),
                Parameter::number("radius", 0.05, "um", "Radius of the waist"),
                Parameter::number("corner_apex", 0.0, "um", "Radius of both apices"),
                Parameter::number("corner_waist", 0.0, "um", "Radius of the edge of the waist"),
            ],
            &RENORM,
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let (radius, height) = (positive(node, "radius")?, positive(node, "height")?);
        let apex = node.number("corner_apex");
        let corners = [
            OutlineCorner::new(0.0, 0.5 * height, apex, "corner_apex"),
            OutlineCorner::new(radius, 0.0, node.number("corner_waist"), "corner_waist"),
            OutlineCorner::new(0.0, -0.5 * height, apex, "corner_apex"),
        ];
        let volume = std::f64::consts::PI / 3.0 * radius * radius * height;
        convex(points(node)?, &corners)?.renormalized(node, || volume).checked("corner_waist")
    },
};
