//! Chebyshev particle: an ellipsoid with waves between two polar angles.
//!
//! $$ r(\theta) = r_e(\theta)\left[1 + a\cos\left(n\pi\frac{\theta-\theta_0}{\theta_1-\theta_0}\right)\right] $$
//!
//! from θ_0 = `start` to θ_1 = `end`; beyond, the factor keeps its value at the end, 1 + a before
//! and 1 + a cos(nπ) after. The ends cut the outline into pieces.
//!
//! A. Mugnai and W. J. Wiscombe, Appl. Opt. 25, 1235 (1986).

use std::f64::consts::PI;

use super::{RENORM, SHAPE, Shape, ellipsoid, points};
use crate::{
    ParameterError,
    scatterer::positive,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a Chebyshev particle.
pub const SPEC: Spec<Shape> = Spec {
    class: Class {
        name: "Chebyshev_Axisymmetric_Shape",
        parent: "Axisymmetric_Shape",
        summary: "Ellipsoid of revolution with waves along its outline",
        equation: "r = r_ellipsoid [1 + a cos(n pi (theta - start)/(end - start))]",
        source: "mugnai-wiscombe-1986",
        params: &[
            &SHAPE,
            &ellipsoid::AXES,
            &[
                Parameter::number("amplitude", 0.01, "1", "Amplitude relative to the ellipsoid"),
                Parameter::integer("n", 8, "Half waves from start to end"),
                Parameter::number("start", 0.0, "rad", "Polar angle at which the waves start"),
                Parameter::number("end", 3.14159265, "rad", "Polar angle at which they end"),
            ],
            &RENORM,
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let (vertical, horizontal) = (positive(node, "vertical")?, positive(node, "horizontal")?);
        let (start, end) = (node.number("start"), node.number("end"));
        if !(0.0 <= start && start < end && end <= PI + 1e-5) {
            let problem = format!("{end} rad is not between start = {start} rad and pi");
            return Err(ParameterError::new("end", problem));
        }
        let (amplitude, waves) = (node.number("amplitude"), f64::from(node.integer("n")));
        let rate = waves * PI / (start - end);
        let breaks = [0.0, start, end.min(PI), PI];
        let shape = Shape::sample(points(node)?, &breaks, |piece, theta| {
            let (r, slope) = ellipsoid::radius(theta, vertical, horizontal, 0.0);
            let phase = match piece {
                0 => 0.0,
                1 => rate * (theta - start),
                _ => waves * PI,
            };
            let (sin, cos) = phase.sin_cos();
            let rate = if piece == 1 { rate } else { 0.0 };
            let factor = 1.0 + amplitude * cos;
            (r * factor, slope * factor - r * amplitude * rate * sin)
        });
        let volume = 4.0 / 3.0 * PI * horizontal * horizontal * vertical;
        shape.renormalized(node, || volume).checked("amplitude")
    },
};
