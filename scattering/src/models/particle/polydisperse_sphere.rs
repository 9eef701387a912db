//! Spheres of many sizes that lie on a smooth surface.
//!
//! $$ \mathbf{F} = \frac{1}{\cos\theta_i \cos\theta_s} \sum_j n(d_j)\,d_j\,\Delta\;
//!    \mathbf{M}(\mathbf{J}_j), \qquad d_j = d_0 (1 + \Delta)^j $$
//!
//! J_j is the matrix of the double-interaction model for a Mie sphere of diameter d_j whose centre
//! is half a diameter above the surface; n is the number per area and diameter, Δ the step
//! (`Dstep`). The absorption of the spheres is raised to k ≥ a λ/(4πd), a = `antirainbow`, which
//! damps the fringes that a sum over real sizes would average out. A `fractional_coverage` other
//! than 0 scales the numbers so that the spheres cover that fraction of the area.
//!
//! K. B. Nahm and W. L. Wolfe, Appl. Opt. 26, 2995 (1987).

use std::f64::consts::{FRAC_PI_4, PI};

use num_complex::Complex64;

use super::{
    double_interaction::HalfSpace,
    paths::{InteractionPath, InteractionPaths, parity},
};
use crate::{
    Direction, Incidence, Jones, Mueller, ParameterError, ParameterNode,
    models::{Brdf, COMMON, CommonParameters, smooth_interface::INTERFACE},
    scatterer::{
        HostMedium,
        mie::Mie,
        series::{AngularFunctions, MieSeries, terms},
    },
    size::{self, SurfaceSize},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of [`PolydisperseSphere`]s.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Polydisperse_Sphere_BRDF_Model",
        parent: "BRDF_Model",
        summary: "Spheres of many sizes on a smooth surface",
        equation: "F = sum(n(d) d step M(J_d))/(cos_i cos_s)",
        source: "nahm-wolfe-1987",
        params: &[
            COMMON,
            &[Parameter::member(
                "distribution",
                &size::SURFACE_FAMILY,
                "Regular_SurfaceParticleSizeDistribution",
                "Number of spheres per area and diameter",
            )],
            INTERFACE,
            &[
                Parameter::index("particle", (1.5, 0.0), "Index of the spheres"),
                Parameter::number("Dstart", 1.0, "um", "Smallest diameter"),
                Parameter::number("Dend", 1000.0, "um", "Largest diameter"),
                Parameter::number("Dstep", 0.01, "1", "Step of the diameter over the diameter"),
                Parameter::number(
                    "fractional_coverage",
                    0.0,
                    "1",
                    "Covered fraction of the area, or 0",
                ),
                Parameter::number("antirainbow", 0.0, "1", "Least absorption over a diameter"),
            ],
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| Ok(Box::new(PolydisperseSphere::read(node)?)),
};

/// The most terms of all series together: 1 GB of them.
const MOST_TERMS: usize = 30_000_000;

/// Spheres on a surface.
pub struct PolydisperseSphere {
    above: HalfSpace,
    spheres: Vec<SizeClass>,
    /// Terms of the longest series.
    longest: usize,
}

struct SizeClass {
    /// Number per area.
    number: f64,
    diameter: f64,
    series: MieSeries,
}

impl PolydisperseSphere {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let above = HalfSpace::read(node)?;
        let mut spheres = spheres(node, &above.common)?;
        let coverage = node.number("fractional_coverage");
        if coverage != 0.0 {
            let area = |s: &SizeClass| s.number * FRAC_PI_4 * s.diameter * s.diameter;
            let covered: f64 = spheres.iter().map(area).sum();
            if !(coverage > 0.0 && coverage <= 1.0 && covered > 0.0) {
                let problem = format!("{coverage} of the area is not to be covered");
                return Err(ParameterError::new("fractional_coverage", problem));
            }
            for sphere in &mut spheres {
                sphere.number *= coverage / covered;
            }
        }
        let longest = spheres.iter().map(|s| s.series.len()).max().unwrap_or(0);
        Ok(Self { above, spheres, longest })
    }

    /// Σ number M(J).
    fn sum(&self, paths: &InteractionPaths) -> Mueller {
        let angular = paths
            .cosines()
            .map(|cos| AngularFunctions::new(cos).take(self.longest).collect::<Vec<_>>());
        let turns =
            InteractionPath::ALL.map(|path| paths.is_open(path).then(|| paths.plane_turn(path)));
        let mut total = Mueller::ZERO;
        for sphere in &self.spheres {
            let amplitudes = [&angular[0], &angular[1]].map(|angular| {
                let (s1, s2) = sphere.series.amplitudes_from(angular);
                Jones::diagonal(s2, s1)
            });
            let jones = paths.jones(0.5 * sphere.diameter, |path| {
                let turn = turns[path as usize].expect("only open paths are asked for");
                turn.apply(&amplitudes[parity(path)])
            });
            total += jones.mueller() * sphere.number;
        }
        total
    }
}

/// The spheres of all sizes with their numbers.
fn spheres(
    node: &ParameterNode,
    common: &CommonParameters,
) -> Result<Vec<SizeClass>, ParameterError> {
    let numbers = node.member::<dyn SurfaceSize>("distribution")?;
    let around = HostMedium { lambda: common.lambda, medium: Complex64::ONE };
    let index = around.relative_index(node, "particle")?;
    let damping = node.number("antirainbow");
    let mut spheres = Vec::new();
    for (d, width) in ladder(node, around.wave_number())? {
        let number = numbers.density(d) * width;
        if number == 0.0 {
            continue;
        }
        let k = index.im.max(damping * common.lambda / (4.0 * PI * d));
        let sphere = Mie::homogeneous(node, around, Complex64::new(index.re, k), 0.5 * d);
        spheres.push(SizeClass { number, diameter: d, series: sphere.into_series() });
    }
    Ok(spheres)
}

/// Diameters with their widths, unless they are too many.
fn ladder(
    node: &ParameterNode,
    k: f64,
) -> Result<impl Iterator<Item = (f64, f64)> + use<>, ParameterError> {
    let [start, end, step] = ["Dstart", "Dend", "Dstep"].map(|name| node.number(name));
    if !size::is_ladder(start, end, step) {
        let problem =
            format!("{start} um to {end} um in steps of {step} is not a range of diameters");
        return Err(ParameterError::new("Dstep", problem));
    }
    let mut total = 0;
    for (d, _) in size::ladder(start, end, step) {
        total += terms(0.5 * k * d);
        if total > MOST_TERMS {
            return Err(ParameterError::new("Dend", "too many and too large spheres"));
        }
    }
    Ok(size::ladder(start, end, step))
}

impl Brdf for PolydisperseSphere {
    fn common(&self) -> &CommonParameters {
        &self.above.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        match self.above.paths(incidence, direction) {
            Some((_, paths)) => self.sum(&paths) * (1.0 / (incidence.cos * direction.cos).abs()),
            None => Mueller::ZERO,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{Basis, Geometry, Mode, ParameterValue, models, optics::RefractiveIndex};

    fn build(values: &[(&str, f64)]) -> models::Model {
        let mut node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound);
        for (name, value) in values {
            node = node.with(name, ParameterValue::Number(*value)).unwrap();
        }
        models::build(&node).unwrap()
    }

    const AT: Geometry = Geometry { theta_i: 0.7, theta_s: 0.4, phi_s: 1.0, rotation: 0.0 };

    #[test]
    fn one_size_is_the_double_interaction_model() {
        // Density n d Δ of a log-normal distribution at its median.
        let (d, step) = (1.0, 0.5);
        let many = build(&[("Dstart", d), ("Dend", 1.2), ("Dstep", step)]);
        let distribution = &crate::size::regular::SURFACE;
        let n =
            (distribution.build)(&ParameterNode::with_defaults(&distribution.class, Mode::Sound))
                .unwrap();
        let sphere = ParameterNode::with_defaults(&crate::scatterer::mie::SPEC.class, Mode::Sound)
            .with("radius", ParameterValue::Number(0.5 * d))
            .and_then(|node| {
                node.with("sphere", ParameterValue::Index(RefractiveIndex::constant(1.5, 0.0)))
            })
            .unwrap();
        let one = ParameterNode::with_defaults(
            &super::super::double_interaction::SPEC.class,
            Mode::Sound,
        )
        .with("distance", ParameterValue::Number(0.5 * d))
        .and_then(|node| node.with("density", ParameterValue::Number(n.density(d) * d * step)))
        .and_then(|node| node.with("scatterer", ParameterValue::Member(Arc::new(sphere))))
        .unwrap();
        let one = models::build(&one).unwrap().mueller(&AT, Basis::Psps);
        assert!((many.mueller(&AT, Basis::Psps) - one).largest() < 1e-12 * one.largest());
    }

    #[test]
    fn coverage_scales_the_numbers() {
        let range = [("Dend", 5.0), ("Dstep", 0.1)];
        let [a, b] = [0.02, 0.04].map(|coverage| {
            let values = [range[0], range[1], ("fractional_coverage", coverage)];
            build(&values).mueller(&AT, Basis::Psps)
        });
        assert!((b - a * 2.0).largest() < 1e-12 * b.largest());
    }

    #[test]
    fn antirainbow_darkens_the_spheres() {
        let range = [("Dstart", 20.0), ("Dend", 25.0), ("Dstep", 0.1)];
        let retro = Geometry { theta_s: 0.7, phi_s: 3.0, ..AT };
        let [clear, dark] = [0.0, 5.0].map(|a| {
            let values = [range[0], range[1], range[2], ("antirainbow", a)];
            build(&values).mueller(&retro, Basis::Psps)[(0, 0)]
        });
        assert!(dark < clear);
    }

    #[test]
    fn ranges_that_would_not_end_are_refused() {
        for (name, value, blamed) in [("Dstep", 0.0, "Dstep"), ("Dend", 1e9, "Dend")] {
            let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound)
                .with(name, ParameterValue::Number(value))
                .unwrap();
            assert_eq!((SPEC.build)(&node).err().unwrap().parameter, blamed);
        }
    }
}
