//! Ellipsoid of revolution cut off by a plane near one pole.
//!
//! The plane lies d = `indent` from the pole, and the origin d/2 from the centre, away from it:
//!
//! $$ r(\theta) = \frac{v - d/2}{\cos\theta} \quad (\theta < \theta_0), \qquad
//!    \tan\theta_0 = \frac{2h\sqrt{d\,(2 - d/v)}}{\sqrt{v}\,(2v - d)} $$
//!
//! with v and h the vertical and the horizontal half axes, and beyond θ_0 the ellipsoid whose centre
//! lies d/2 from the origin. The flat face is down, or up if `updown` is 1.

use std::f64::consts::PI;

use super::{RENORM, SHAPE, Shape, ellipsoid, points};
use crate::{
    ParameterError,
    scatterer::positive,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<Shape> = Spec {
    class: Class {
        name: "Indented_Ellipsoid_Axisymmetric_Shape",
        parent: "Axisymmetric_Shape",
        summary: "Ellipsoid of revolution cut off by a plane",
        equation: "r = (v - d/2)/cos theta on the flat face, the ellipsoid elsewhere",
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
                Parameter::number("indent", 0.01, "um", "What the plane cuts off of the half axis"),
                Parameter::integer("updown", 0, "0 flat face below, 1 on top"),
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
        if !(0.0..vertical).contains(&depth) {
            let problem = format!("{depth} um is not from 0 to below the half axis {vertical} um");
            return Err(ParameterError::new("indent", problem));
        }
        let face = vertical - 0.5 * depth;
        let rim = horizontal * (depth * (2.0 - depth / vertical) / vertical).sqrt();
        let edge = rim.atan2(face);
        let cut = Shape::sample(points(node)?, &[0.0, edge, PI], |piece, theta| {
            let (sin, cos) = theta.sin_cos();
            match piece {
                0 => (face / cos, face * sin / (cos * cos)),
                _ => ellipsoid::radius(theta, vertical, horizontal, 0.5 * depth),
            }
        });
        let volume = 4.0 / 3.0 * PI * horizontal * horizontal * vertical;
        let cut = cut.renormalized(node, || volume);
        if node.integer("updown") == 0 { cut } else { cut.turned_over() }.checked("indent")
    },
};
