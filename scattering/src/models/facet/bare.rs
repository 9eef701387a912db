//! Reflection from and refraction through a distribution of specular facets.
//!
//! Reflection, with the facet normal n̂ along k_s − k_i and ι the angle of incidence on it:
//!
//! $$ \mathbf F = \frac{S(\zeta_x,\zeta_y)}{4 n_z^4\cos\theta_i\cos\theta_s}\,\mathbf M(J) \qquad (1) $$
//!
//! Refraction, with n̂ along ±(k_i − m k_t), m the index of the second medium over the first, and
//! c_i, c_t the cosines of incidence and refraction on the facet:
//!
//! $$ \mathbf F = \frac{S(\zeta_x,\zeta_y)}{n_z^4}\,
//!    \frac{m^3 c_t^2}{|k_i - m k_t|^2\cos\theta_i\cos\theta_s}\,\mathbf M(J) \qquad (2) $$
//!
//! S is the density of slopes ζ = (n_x, n_y)/n_z in the frame of the sample, J the Jones matrix of
//! the facet with its films ([`rotation`](super::rotation)). Shadowing and multiple reflections
//! between facets are left out, so energy can be gained at grazing incidence.
//!
//! NIST's library does not rotate the bases where light hits a facet exactly along its normal
//! ([`Defect::FacetRetro`]) and adds a loss to light from the substrate ([`Defect::TinyLoss`]).
//!
//! K. E. Torrance and E. M. Sparrow, J. Opt. Soc. Am. 57, 1105 (1967); with polarization
//! T. A. Germer and E. Marx, Appl. Opt. 43, 1266 (2004).

use glam::DVec3;
use num_complex::Complex64;

use super::{
    FACET,
    rotation::{FacetOrientation, FacetRotation},
};
use crate::{
    Defect, Direction, Incidence, Jones, Mueller, ParameterError, ParameterNode, Side,
    geometry::ScatteredRay,
    models::{Brdf, COMMON, CommonParameters},
    optics::film::{Films, SpAmplitudes},
    polarization::SignedWeights,
    slope::SlopeDistribution,
    spec::{Class, Laws, Spec},
    stack::Stack,
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Facet_BRDF_Model",
        parent: "BRDF_Model",
        summary: "Specular facets, reflection and refraction",
        equation: "F = S(zeta) M(J)/(4 nz^4 cos(ti) cos(ts))",
        source: "torrance-1967 germer-2004",
        params: &[COMMON, FACET],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| Ok(Box::new(Facet::read(node)?)),
};

/// Specular facets.
pub(crate) struct Facet {
    pub(super) common: CommonParameters,
    pub(super) slopes: Box<dyn SlopeDistribution>,
    pub(super) films: Films,
    /// Defect B5: no rotation of the bases at normal incidence on the facet.
    pub(super) unturned: bool,
}

/// sin² ι below which NIST's library does not rotate the bases, in reflection.
pub(super) const UNTURNED_REFLECTION: f64 = 1e-20;
/// The same limit in transmission.
const UNTURNED_TRANSMISSION: f64 = 1e-14;

impl Facet {
    pub(crate) fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        let stack = node.member::<Stack>("stack")?.at(common.lambda);
        let mut films = Films::new(&stack, Complex64::ONE, common.substrate, common.lambda);
        if common.side.from_below() && node.reproduces(Defect::TinyLoss) {
            films = films.with_tiny_loss();
        }
        let slopes = node.member::<dyn SlopeDistribution>("sdf")?;
        Ok(Self { common, slopes, films, unturned: node.reproduces(Defect::FacetRetro) })
    }

    /// The density of the facets' slopes.
    pub(crate) fn slopes(&self) -> &dyn SlopeDistribution {
        &*self.slopes
    }

    /// S of the facet whose normal lies along ±`normal`.
    #[inline]
    fn density(&self, incidence: &Incidence, normal: DVec3) -> f64 {
        let (x, y) = (normal.x / normal.z, normal.y / normal.z);
        let (sin, cos) = (incidence.sin_rotation, incidence.cos_rotation);
        self.slopes.density(x * cos + y * sin, y * cos - x * sin)
    }

    /// (J, w) with the BRDF w·M(J), or nothing where no facet connects the directions.
    #[inline]
    fn event(&self, incidence: &Incidence, direction: &Direction) -> Option<(Jones, f64)> {
        match self.common.side {
            Side::DownUp | Side::UpDown => Some(self.reflection(incidence, direction)),
            Side::DownDown | Side::UpUp => self.refraction(incidence, direction),
        }
    }

    #[inline]
    fn reflection(&self, incidence: &Incidence, direction: &Direction) -> (Jones, f64) {
        let facet = FacetOrientation::between(incidence, &ScatteredRay::single(direction));
        let from_below = self.common.side.from_below();
        let coefficients = if from_below {
            self.films.r21(self.films.kappa_inside(facet.sin2.sqrt()))
        } else {
            self.films.r12_known(facet.cos(), facet.sin2)
        };
        let unturned = self.unturned && facet.sin2 <= UNTURNED_REFLECTION;
        let (jones, norm) = turned(incidence, direction, direction.cos, coefficients, unturned);
        let [x, y] = facet.slopes;
        // (1)
        let weight =
            facet.weight(self.slopes.density(x, y), direction.cos * (4.0 * incidence.cos) * norm);
        (if from_below { jones.flipped() } else { jones }, weight)
    }

    fn refraction(&self, incidence: &Incidence, direction: &Direction) -> Option<(Jones, f64)> {
        let index = self.common.substrate.re;
        let from_below = self.common.side.from_below();
        let m = if from_below { 1.0 / index } else { index };
        let k_i = incidence.k();
        let mut k_t = direction.k();
        k_t.z = -k_t.z;
        // n̂ = ±v/|v| with v = k_i − m k_t.
        let v = k_i - m * k_t;
        let v2 = v.length_squared();
        let normal = v * (v.z.signum() / v2.sqrt());
        let (c_i, c_t) = (-k_i.dot(normal), -k_t.dot(normal));
        // v = 0 where both rays are parallel and m = 1: the cosines are NaN and there is no facet.
        let real = c_i >= 0.0 && c_t >= 0.0 && normal.z > 0.0;
        if !real {
            return None;
        }
        let sin2 = (1.0 - c_i * c_i).max(0.0);
        let coefficients = if from_below {
            self.films.t21(self.films.kappa_inside(sin2.sqrt()))
        } else {
            self.films.t12(sin2.sqrt().into())
        };
        let unturned = self.unturned && sin2 <= UNTURNED_TRANSMISSION;
        let (jones, norm) = turned(incidence, direction, k_t.z, coefficients, unturned);
        // (2)
        let z2 = normal.z * normal.z;
        let weight = self.density(incidence, normal) * m * m * m * c_t * c_t
            / (z2 * z2 * v2 * incidence.cos * direction.cos * norm);
        Some((if from_below { jones.flipped() } else { jones }, weight))
    }
}

/// (J √norm, norm) of a facet between the rays, the second one with the z component `z`.
#[inline]
pub(super) fn turned(
    incidence: &Incidence,
    direction: &Direction,
    z: f64,
    coefficients: SpAmplitudes,
    unturned: bool,
) -> (Jones, f64) {
    let mut turn = FacetRotation::new(incidence, &ScatteredRay::single(direction), z);
    let mut norm = turn.norm();
    if norm < f64::MIN_POSITIVE || unturned {
        turn = if unturned {
            FacetRotation::none()
        } else {
            FacetRotation::along_normal(direction, z)
        };
        norm = 1.0;
    }
    (turn.apply(coefficients), norm)
}

impl Brdf for Facet {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        match self.event(incidence, direction) {
            Some((jones, weight)) => jones.mueller() * weight,
            None => Mueller::ZERO,
        }
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        self.matrices(incidence, directions, out);
    }

    fn sum(
        &self,
        incidence: &Incidence,
        directions: &[Direction],
        weights: SignedWeights<'_>,
    ) -> Mueller {
        self.sum_of_matrices(incidence, directions, weights)
    }

    fn jones(&self, incidence: &Incidence, direction: &Direction) -> Option<Jones> {
        Some(match self.event(incidence, direction) {
            Some((jones, weight)) => jones.scaled(weight.sqrt()),
            None => Jones::default(),
        })
    }

    fn is_coherent(&self) -> bool {
        true
    }

    fn is_quick(&self) -> bool {
        self.films.is_bare()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    use super::*;
    use crate::{
        Basis, Geometry, Mode, Model, ParameterValue, models, optics::RefractiveIndex,
        special::gauss,
    };

    fn node(
        mode: Mode,
        index: RefractiveIndex,
        sdf: &str,
        params: &[(&str, f64)],
    ) -> ParameterNode {
        let slopes = ParameterNode::with_defaults(crate::registry::find_class(sdf).unwrap(), mode);
        let slopes = params
            .iter()
            .fold(slopes, |node, (name, x)| node.with(name, ParameterValue::Number(*x)).unwrap());
        ParameterNode::with_defaults(&SPEC.class, mode)
            .with("substrate", ParameterValue::Index(index))
            .unwrap()
            .with("sdf", ParameterValue::Member(slopes.into()))
            .unwrap()
    }

    fn gaussian(mode: Mode, index: RefractiveIndex, s: f64) -> ParameterNode {
        node(mode, index, "Gaussian_Slope_Distribution_Function", &[("s", s)])
    }

    /// ∫ F cos θ dΩ over the upper (or lower) half space.
    fn hemisphere(model: &Model, theta_i: f64) -> Mueller {
        let mut sum = Mueller::ZERO;
        let azimuths = 256;
        for (theta, weight) in gauss::legendre(200, 0.0, FRAC_PI_2) {
            for j in 0..azimuths {
                let phi_s = TAU * f64::from(j) / f64::from(azimuths);
                let at = Geometry { theta_i, theta_s: theta, phi_s, rotation: 0.0 };
                let omega = weight * theta.sin() * theta.cos() * TAU / f64::from(azimuths);
                sum += model.mueller(&at, Basis::Psps) * omega;
            }
        }
        sum
    }

    #[test]
    fn gently_sloped_glass_reflects_and_transmits_all_the_light() {
        let at = |side| {
            let node = gaussian(Mode::Sound, RefractiveIndex::constant(1.5, 0.0), 0.1)
                .with("type", ParameterValue::Integer(side))
                .unwrap();
            hemisphere(&models::build(&node).unwrap(), 0.4)[(0, 0)]
        };
        // Facets of slope 0.1 at 23°: shadowing and second reflections are below 10⁻¹¹ here.
        let total = at(0) + at(1);
        assert!((total - 1.0).abs() < 1e-9, "{total}");
    }

    #[test]
    fn unpolarized_light_at_brewsters_angle_leaves_with_q_equal_to_i() {
        let node = gaussian(Mode::Sound, RefractiveIndex::constant(1.5, 0.0), 0.1);
        let theta = 1.5f64.atan();
        let at = Geometry { theta_i: theta, theta_s: theta, phi_s: 0.0, rotation: 0.0 };
        let m = models::build(&node).unwrap().mueller(&at, Basis::Psps);
        assert!((m[(1, 0)] / m[(0, 0)] - 1.0).abs() < 1e-14);
    }

    #[test]
    fn metal_at_60_degrees_turns_plus_45_into_right_circular_light() {
        let node = gaussian(Mode::Sound, RefractiveIndex::constant(1.2, 7.0), 0.1);
        let theta = PI / 3.0;
        let at = Geometry { theta_i: theta, theta_s: theta, phi_s: 0.0, rotation: 0.0 };
        let m = models::build(&node).unwrap().mueller(&at, Basis::Psps);
        let intensity = m[(0, 0)] + m[(0, 2)];
        assert!(((m[(3, 0)] + m[(3, 2)]) / intensity + 0.3962).abs() < 5e-5);
        assert!((m[(2, 2)] / m[(0, 0)] + 0.9157).abs() < 5e-5);
    }

    #[test]
    fn close_to_retro_reflection_the_matrix_tends_to_its_limit() {
        let model = models::build(&gaussian(Mode::Sound, RefractiveIndex::constant(1.3, 1.2), 0.5))
            .unwrap();
        let at = |d: f64| {
            let at =
                Geometry { theta_i: 0.7, theta_s: 0.7 + d, phi_s: PI - 0.6 * d, rotation: 0.0 };
            model.mueller(&at, Basis::Psps)
        };
        let limit = at(0.0);
        for d in [1e-4, 1e-6, 1e-8, 1e-10, 1e-13] {
            // The density of slopes changes by a few times d.
            let difference = (at(d) - limit).largest() / limit.largest();
            assert!(difference < 20.0 * d + 1e-14, "{d:e}: {difference:e}");
        }
    }

    #[test]
    fn a_facet_met_along_its_normal_turns_the_bases_but_not_in_the_library() {
        let at = Geometry { theta_i: 0.0, theta_s: 0.0, phi_s: 0.7, rotation: 0.0 };
        let m = |mode| {
            let node = gaussian(mode, RefractiveIndex::constant(1.3, 1.2), 0.3);
            models::build(&node).unwrap().mueller(&at, Basis::Psps)
        };
        let (sound, compat) = (m(Mode::Sound), m(Mode::Compat));
        // The bases of the two rays are turned by φ against each other.
        assert!((sound[(1, 1)] / sound[(0, 0)] - 1.4f64.cos()).abs() < 1e-14);
        assert!((compat[(1, 1)] / compat[(0, 0)] - 1.0).abs() < 1e-14);
    }

    #[test]
    fn light_from_the_substrate_is_changed_by_1e_10_in_the_library() {
        let at = Geometry { theta_i: 0.5, theta_s: 0.6, phi_s: 0.7, rotation: 0.1 };
        let m = |mode| {
            let node = gaussian(mode, RefractiveIndex::constant(1.5, 0.0), 0.3)
                .with("type", ParameterValue::Integer(2))
                .unwrap();
            models::build(&node).unwrap().mueller(&at, Basis::Psps)
        };
        let difference = (m(Mode::Sound) - m(Mode::Compat)).largest() / m(Mode::Sound).largest();
        assert!(difference > 1e-12 && difference < 1e-8, "{difference:e}");
    }

    #[test]
    fn transmission_both_ways_obeys_reciprocity_with_the_index_squared() {
        // M₁(θ_i, θ_s, φ; r) = n² P M₃(θ_s, θ_i, −φ; r + π − φ)ᵀ P.
        let p = Mueller::diagonal([1.0, 1.0, -1.0, 1.0]);
        let model = |side| {
            let params = [("sx", 0.4), ("sy", 0.15)];
            let sdf = "Anisotropic_Exponential_Slope_Distribution_Function";
            let node = node(Mode::Sound, RefractiveIndex::constant(1.5, 0.0), sdf, &params)
                .with("type", ParameterValue::Integer(side))
                .unwrap();
            models::build(&node).unwrap()
        };
        let (down, up) = (model(1), model(3));
        for (theta_i, theta_s, phi_s, rotation) in
            [(0.5, 0.4, 0.7, 0.1), (1.1, 0.2, -2.3, 0.9), (0.3, 0.65, 0.2, -1.2)]
        {
            let there = Geometry { theta_i, theta_s, phi_s, rotation };
            let back = Geometry {
                theta_i: theta_s,
                theta_s: theta_i,
                phi_s: -phi_s,
                rotation: rotation + PI - phi_s,
            };
            let expected = p * up.mueller(&back, Basis::Psps).transposed() * p * 2.25;
            let got = down.mueller(&there, Basis::Psps);
            assert!((got - expected).largest() <= 1e-13 * expected.largest());
        }
    }
}
