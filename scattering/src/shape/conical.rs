//! Upright cone with rounded edges.
//!
//! The origin lies a third of the height less `offset` above the base. The base is down, unless
//! `updown` is 1: that turns the body with its origin over.

use super::{
    RENORM, SHAPE, Shape,
    outline::{OutlineCorner, convex},
    points,
};
use crate::{
    scatterer::positive,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a cone.
pub const SPEC: Spec<Shape> = Spec {
    class: Class {
        name: "Conical_Axisymmetric_Shape",
        parent: "Axisymmetric_Shape",
        summary: "Cone with rounded edges",
        equation: "rho = R (z - z_apex)/H, z from the base to the apex",
        source: "mishchenko-2002",
        params: &[
            &SHAPE,
            &[
                Parameter::number("radius", 0.05, "um", "Radius of the base"),
                Parameter::number("height", 0.1, "um", "Height"),
                Parameter::number(
                    "offset",
                    0.0,
                    "um",
                    "Origin below a third of the height over the base",
                ),
                Parameter::number("corner_base", 0.0, "um", "Radius of the edge of the base"),
                Parameter::number("corner_apex", 0.0, "um", "Radius of the apex"),
                Parameter::integer("updown", 0, "0 base down, 1 apex down"),
            ],
            &RENORM,
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let (radius, height) = (positive(node, "radius")?, positive(node, "height")?);
        let turned = node.integer("updown") != 0;
        let base = height / 3.0 - node.number("offset");
        let corners = [
            OutlineCorner::new(0.0, base, 0.0, "offset"),
            OutlineCorner::new(radius, base, node.number("corner_base"), "corner_base"),
            OutlineCorner::new(0.0, base - height, node.number("corner_apex"), "corner_apex"),
        ];
        let volume = std::f64::consts::PI / 3.0 * radius * radius * height;
        let shape = convex(points(node)?, &corners)?.renormalized(node, || volume);
        if turned { shape.turned_over() } else { shape }.checked("offset")
    },
};
