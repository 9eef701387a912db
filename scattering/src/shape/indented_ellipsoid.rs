//! Ellipsoid of revolution with a smooth dent at one pole.
//!
//! $$ r(\theta) = r_e(\theta) - d \cos^4(\theta_p/2) $$
//!
//! with r_e the ellipsoid about the origin and θ_p the angle from the pole with the dent of the
//! depth d: the upper one, or the lower one if `updown` is 1.

use std::f64::consts::PI;

use super::{RENORM, SHAPE, Shape, ellipsoid, points};
use crate::{
    ParameterError,
    scatterer::positive,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of an ellipsoid with a dent.
pub const SPEC: Spec<Shape> = Spec {
    class: Class {
        name: "Indented_Ellipsoid_Axisymmetric_Shape",
        parent: "Axisymmetric_Shape",
        summary: "Ellipsoid of revolution with a dent at one pole",
        equation: "r = r_ellipsoid - d cos^4(theta/2)",
        source: "mishchenko-2002",
        params: &[
            &SHAPE,
            &[
                Parameter::number("vertical", 0.05, "um", "Half axis along the axis of revolution"),
                Parameter::number(
                    "horizontal",
                    0.0,
                    "um",
                    "Half axis across it; 0: the vertical one",
                ),
                Parameter::number("indent", 0.01, "um", "Depth of the dent"),
                Parameter::integer("updown", 0, "0 dent on top, 1 dent below"),
            ],
            &RENORM,
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let vertical = positive(node, "vertical")?;
        let horizontal = match node.number("horizontal") {
            0.0 => vertical,
            _ => positive(node, "horizontal")?,
        };
        let depth = node.number("indent");
        if !(depth.is_finite() && depth < vertical) {
            let problem = format!("{depth} um is not less than the half axis {vertical} um");
            return Err(ParameterError::new("indent", problem));
        }
        let dented = Shape::sample(points(node)?, &[0.0, PI], |_, theta| {
            let (r, slope) = ellipsoid::radius(theta, vertical, horizontal, 0.0);
            let (sin, cos) = (0.5 * theta).sin_cos();
            (r - depth * cos.powi(4), slope + 2.0 * depth * cos.powi(3) * sin)
        });
        let volume = 4.0 / 3.0 * PI * horizontal * horizontal * vertical;
        let dented = dented.renormalized(node, || volume);
        if node.integer("updown") == 0 { dented.turned_over() } else { dented }.checked("indent")
    },
};
