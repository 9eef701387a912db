//! Flakes in a slab: independent plates with Gaussian slopes.
//!
//! Both faces of a plate reflect. With `substrate` of the index of the slab a flake is its films
//! alone and light passes it; with any other substrate it is an opaque core with films.
//! `density` · `area` · thickness of the slab is the depth of coverage.

use num_complex::Complex64;

use crate::{
    ParameterError,
    doubling::{flakes::FlakeLayer, interface::SmoothFace, slopes::GaussianSlopes},
    optics::RefractiveIndex,
    slope::{self, SlopeDistribution},
    spec::{self, Class, Family, Laws, Member, Parameter, Spec},
    stack::{self, Stack},
};

/// Name, parameters and constructor of the class.
pub const NONE: Spec<PaintFlakes> = Spec {
    class: Class {
        name: "No_Flakes",
        parent: "Flakes",
        summary: "No flakes",
        equation: "a = 0",
        source: "germer-2001",
        params: &[],
        laws: Laws::NONE,
    },
    build: |_| Ok(Box::new(PaintFlakes::None)),
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<PaintFlakes> = Spec {
    class: Class {
        name: "Plate_Flakes",
        parent: "Flakes",
        summary: "Plates with Gaussian slopes and films",
        equation: "K = a int S |k.n|/n_z (1 - M_T), Z = a S/(4 n_z^4) M_R",
        source: "germer-2001",
        params: &[&[
            Parameter::number("density", 0.0001, "1/um^3", "Flakes per volume"),
            Parameter::number("area", 300.0, "um^2", "Area of a flake"),
            Parameter::index(
                "substrate",
                (1.2, 7.0),
                "Index of the core; that of the slab: no core, light passes",
            ),
            Parameter::member(
                "stack",
                &stack::FAMILY,
                "No_StackModel",
                "Films on the core, or all of a flake that light passes",
            ),
            Parameter::member(
                "sdf",
                &slope::FAMILY,
                "Gaussian_Slope_Distribution_Function",
                "Slopes of the flakes, Gaussian and isotropic, sigma at least 0.1",
            ),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let number = |name: &str| {
            let x = node.number(name);
            if x >= 0.0 && x.is_finite() {
                return Ok(x);
            }
            Err(ParameterError::new(name, format!("{x} is negative or not finite")))
        };
        let name = node.child("sdf").class.name;
        let gaussian = name == slope::gaussian::SPEC.class.name
            || name == slope::anisotropic_gaussian::SPEC.class.name;
        let deviations = node.member::<dyn SlopeDistribution>("sdf")?.deviations();
        let sigma = match deviations {
            Some((x, y)) if gaussian && (x - y).abs() <= 1e-12 * x => x,
            _ => {
                let problem = format!("{name}: flakes have isotropic Gaussian slopes");
                return Err(ParameterError::new("sdf", problem));
            }
        };
        if sigma < NARROWEST {
            let problem = format!(
                "a standard deviation of {sigma} along each axis is below {NARROWEST}: too narrow \
                 for the nodes"
            );
            return Err(ParameterError::new("sdf", problem));
        }
        Ok(Box::new(PaintFlakes::Plates {
            per_length: number("density")? * number("area")?,
            substrate: node.index("substrate").clone(),
            films: *node.member::<Stack>("stack")?,
            sigma,
        }))
    },
};

/// The narrowest slopes; a rounding error below counts.
const NARROWEST: f64 = 0.1 * (1.0 - 1e-9);
/// Indices closer than this are one.
const SAME: f64 = 1e-12;

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<PaintFlakes>] = &[&NONE, &SPEC];

impl Member for PaintFlakes {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}

/// The family of flakes in slabs.
pub static FAMILY: Family = Family::new("Flakes", "Flakes in slabs", spec::classes::<PaintFlakes>);

/// Flakes of a slab.
pub enum PaintFlakes {
    /// There are none.
    None,
    /// Plates.
    Plates {
        /// Coverage per length, 1/µm.
        per_length: f64,
        /// Index of the core.
        substrate: RefractiveIndex,
        /// Films.
        films: Stack,
        /// Standard deviation of the slope along each axis.
        sigma: f64,
    },
}

impl PaintFlakes {
    /// The flakes in a slab of this index and thickness (µm), at the vacuum wavelength `lambda` µm.
    pub(super) fn layer(&self, lambda: f64, n: f64, thickness: f64) -> Option<FlakeLayer> {
        let Self::Plates { per_length, substrate, films, sigma } = self else { return None };
        let depth = per_length * thickness;
        if depth == 0.0 {
            return None;
        }
        let core = substrate.at(lambda);
        let is_clear = (core / Complex64::from(n) - 1.0).norm() < SAME;
        let films = films.at(lambda).iter().map(|(index, t)| (*index, t / lambda)).collect();
        Some(FlakeLayer {
            depth,
            slopes: GaussianSlopes { sigma: *sigma },
            films: SmoothFace { films },
            core: (!is_clear).then_some(core),
        })
    }
}
