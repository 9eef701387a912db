//! Upright cylinder with rounded edges.

use super::{
    RENORM, SHAPE, Shape,
    outline::{OutlineCorner, convex},
    points,
};
use crate::{
    scatterer::positive,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a cylinder.
pub const SPEC: Spec<Shape> = Spec {
    class: Class {
        name: "Cylinder_Axisymmetric_Shape",
        parent: "Axisymmetric_Shape",
        summary: "Upright cylinder with rounded edges",
        equation: "r = L/(2 cos) on the bases, R/sin on the side, a circle between them",
        source: "mishchenko-2002",
        params: &[
            &SHAPE,
            &[
                Parameter::number("radius", 0.05, "um", "Radius"),
                Parameter::number("length", 0.1, "um", "Length"),
                Parameter::number("corner", 0.0, "um", "Radius of the edges"),
            ],
            &RENORM,
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let (radius, length) = (positive(node, "radius")?, positive(node, "length")?);
        let z = 0.5 * length;
        let outline = |corner: f64| {
            let corners =
                [(0.0, z, 0.0), (radius, z, corner), (radius, -z, corner), (0.0, -z, 0.0)]
                    .map(|(rho, z, corner)| OutlineCorner::new(rho, z, corner, "corner"));
            convex(points(node)?, &corners)
        };
        let volume = std::f64::consts::PI * radius * radius * length;
        outline(node.number("corner"))?.renormalized(node, || volume).checked("corner")
    },
};
