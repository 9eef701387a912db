//! A sphere much smaller than the wavelength, anywhere in, above or below a stack of films.
//!
//! Its dipole moment is the perturbation of [`FirstOrder`] with the permittivity ε_p of the
//! sphere, ε_m of the medium around it, its radius r and
//!
//! $$ C = r^3 \frac{\varepsilon_p - \varepsilon_m}{\varepsilon_p + 2\varepsilon_m}
//!        \left(\frac{2\pi}{\lambda}\right)^2 \varepsilon_m, \quad \varepsilon = \varepsilon_m $$
//!
//! The sphere's own light that the interfaces return to it is neglected.
//!
//! T. A. Germer, *Polarized light scattering by microroughness and small defects in dielectric
//! layers*, J. Opt. Soc. Am. A 18, 1279 (2001).

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::{
    Direction, Incidence, Jones, Mueller, ParameterError, ParameterNode,
    geometry::ScatteredRay,
    lanes::{Real, SimdLevel, WIDTH},
    models::{
        Brdf, CommonParameters,
        batch::{BatchKernel, evaluate},
    },
    optics::{
        film::{Films, IncidentSide, TangentialFields, decaying_root},
        first_order::{Drive, FirstOrder},
    },
    polarization::muellers,
};

/// Position of a sphere.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpherePosition {
    /// Depth of its centre below the outer face of the films, µm.
    pub depth: f64,
    /// Index of the medium around it.
    pub medium: Complex64,
}

/// The waves at a sphere that are known from the face of the substrate: those of a sphere above
/// the face, and NIST's with its tiny loss ([`Defect::TinyLoss`](crate::Defect::TinyLoss)).
struct FaceWaves {
    films: Films,
    /// Distance of the sphere from the face of the substrate, µm.
    distance: f64,
}

/// Small spheres, all in the same place.
pub(super) struct SmallSphere {
    common: CommonParameters,
    stack: FirstOrder,
    /// Depth in the stack as the light meets it, µm.
    depth: f64,
    /// C√density.
    coupling: Complex64,
    inverse_product: Complex64,
    from_face: Option<FaceWaves>,
}

impl SmallSphere {
    /// Spheres of index `sphere` and the node's `radius` and `density` among `films`.
    pub(super) fn new(
        node: &ParameterNode,
        common: CommonParameters,
        films: &[(Complex64, f64)],
        place: SpherePosition,
        sphere: Complex64,
    ) -> Result<Self, ParameterError> {
        let radius = not_negative(node, "radius")?;
        let density = not_negative(node, "density")?;
        let stack = FirstOrder::new(common.side, films, common.substrate, common.lambda);
        let depth = if stack.is_turned_over() { total(films) - place.depth } else { place.depth };
        let [inside, around] = [sphere, place.medium].map(|index| (index / stack.unit()).powi(2));
        let k = TAU / stack.lambda();
        let dipole = (inside - around) / (inside + 2.0 * around) * radius.powi(3);
        Ok(Self {
            common,
            depth,
            coupling: dipole * around * (k * k * density.sqrt()),
            inverse_product: 1.0 / (around * around),
            stack,
            from_face: None,
        })
    }

    /// The same for a sphere at `distance` below the face of the substrate, which may be
    /// negative; with NIST's loss at the face if it is `lossy`.
    pub(super) fn in_substrate(
        self,
        films: &[(Complex64, f64)],
        distance: f64,
        lossy: bool,
    ) -> Self {
        let CommonParameters { lambda, substrate, .. } = self.common;
        let stack = Films::new(films, Complex64::ONE, substrate, lambda);
        let stack = if lossy { stack.with_tiny_loss() } else { stack };
        Self { from_face: Some(FaceWaves { films: stack, distance }), ..self }
    }

    /// Fields at the sphere for a wave with this sine of its angle and this tangential index.
    fn fields(&self, from: IncidentSide, sin: f64, kappa: Complex64) -> TangentialFields {
        let films = self.stack.films();
        let (own_side, index) = if self.stack.is_turned_over() {
            (IncidentSide::FromOutside, films.outer())
        } else {
            (IncidentSide::FromSubstrate, films.substrate())
        };
        match &self.from_face {
            Some(face) if from == own_side => face.fields(sin, index, self.stack.lambda()),
            Some(face) if face.distance < 0.0 => {
                // The wave in the substrate is a single one: continued from the face.
                let upwards = -face.distance;
                let at_face =
                    self.depth + if self.stack.is_turned_over() { -upwards } else { upwards };
                let q = decaying_root(index * index - kappa * kappa);
                let phase = (Complex64::I * q * (TAU / self.stack.lambda() * face.distance)).exp();
                let TangentialFields { e, u, w } = films.fields_at_depth(from, kappa, at_face);
                TangentialFields { e: e * phase, u: u * phase, w: w * phase }
            }
            _ => films.fields_at_depth(from, kappa, self.depth),
        }
    }

    fn drive(&self, incidence: &Incidence) -> Drive {
        let kappa = self.stack.kappa_in(incidence);
        let fields = self.fields(IncidentSide::FromOutside, incidence.sin, kappa);
        self.stack.drive(incidence, &fields, self.coupling, self.inverse_product)
    }

    /// The squared tangential indices of several directions, if waves pass all films without
    /// loss there.
    #[inline(always)]
    fn clear(&self, directions: &[Direction; WIDTH]) -> Option<[f64; WIDTH]> {
        let kappa_squared = directions.each_ref().map(|to| {
            let (_, kappa) = self.stack.kappa_out(to);
            kappa.re * kappa.re
        });
        let films = self.stack.films();
        let is_clear = |&squared: &f64| films.is_clear_at(squared, self.depth);
        let are_clear = self.from_face.is_none() && kappa_squared.iter().all(is_clear);
        are_clear.then_some(kappa_squared)
    }

    fn amplitude(&self, drive: &Drive, direction: &Direction) -> Jones {
        let (from, kappa) = self.stack.kappa_out(direction);
        let seen = self.fields(from, direction.sin, kappa);
        self.stack.scatter(drive, &seen, direction)
    }
}

/// The sphere under a beam.
struct IlluminatedSphere<'a> {
    sphere: &'a SmallSphere,
    drive: Drive,
}

impl BatchKernel for IlluminatedSphere<'_> {
    #[inline(always)]
    fn batch<V: SimdLevel>(
        &self,
        vectors: V,
        directions: &[Direction; WIDTH],
        out: &mut [Mueller; WIDTH],
    ) {
        let Self { sphere, drive } = self;
        let Some(kappa_squared) = sphere.clear(directions) else {
            *out = directions.each_ref().map(|to| self.one(to));
            return;
        };
        let (from, _) = sphere.stack.kappa_out(&directions[0]);
        let kappa_squared = vectors.load(&kappa_squared);
        let seen = sphere.stack.films().clear_fields(from, kappa_squared, sphere.depth);
        let to = ScatteredRay::batch(vectors, directions);
        let jones = sphere.stack.elements(drive, seen, &to);
        muellers(vectors, jones, kappa_squared.splat(1.0), out);
    }

    fn one(&self, direction: &Direction) -> Mueller {
        self.sphere.amplitude(&self.drive, direction).mueller()
    }
}

impl FaceWaves {
    /// Fields of a unit wave from the sphere's own medium, of index `index` at the wavelength
    /// `lambda`, and of its reflection.
    fn fields(&self, sin: f64, index: Complex64, lambda: f64) -> TangentialFields {
        let r = self.films.r21(self.films.kappa_inside(sin));
        let cos = (1.0 - sin * sin).sqrt();
        let back = (Complex64::I * index * (TAU / lambda * self.distance * cos)).exp();
        let forth = 1.0 / back;
        TangentialFields {
            e: forth + r.s * back,
            u: forth + r.p * back,
            w: (forth - r.p * back) * (cos / index),
        }
    }
}

impl Brdf for SmallSphere {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        self.amplitude(&self.drive(incidence), direction).mueller()
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let lit = IlluminatedSphere { sphere: self, drive: self.drive(incidence) };
        evaluate(&lit, directions, out);
    }

    fn jones(&self, incidence: &Incidence, direction: &Direction) -> Option<Jones> {
        Some(self.amplitude(&self.drive(incidence), direction))
    }

    fn is_coherent(&self) -> bool {
        true
    }
}

/// The thickness of all films, µm.
pub(super) fn total(films: &[(Complex64, f64)]) -> f64 {
    films.iter().map(|&(_, thickness)| thickness).sum()
}

/// The number `name`, which has to be finite and not negative.
pub(super) fn not_negative(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let value = node.number(name);
    if value >= 0.0 && value.is_finite() {
        return Ok(value);
    }
    Err(ParameterError::new(name, format!("{value} is not a finite number from 0 up")))
}
