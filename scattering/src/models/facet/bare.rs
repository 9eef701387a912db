//! Reflection from and refraction through a distribution of specular facets.
//!
//! Reflection, with the facet normal n̂ along k_s − k_i and ι the angle of incidence on it:
//!
//! $$ \mathbf F = \frac{S(\zeta_x,\zeta_y)}{4 n_z^4\cos\theta_i\cos\theta_s}\,\mathbf M(J) $$
//!
//! Refraction, with n̂ along ±(k_i − m k_t), m the index of the second medium over the first, and
//! c_i, c_t the cosines of incidence and refraction on the facet:
//!
//! $$ \mathbf F = \frac{S(\zeta_x,\zeta_y)}{n_z^4}\,
//!    \frac{m^3 c_t^2}{|k_i - m k_t|^2\cos\theta_i\cos\theta_s}\,\mathbf M(J) $$
//!
//! S is the density of slopes ζ = (n_x, n_y)/n_z in the frame of the sample, J the Jones matrix of
//! the facet with its films. Shadowing and multiple reflections between facets are left out, so
//! that light can be gained at grazing incidence.
//!
//! NIST's library does not turn the bases of a facet that is met exactly along its normal
//! ([`Defect::FacetRetro`]) and adds a loss to light from the substrate ([`Defect::TinyLoss`]).
//!
//! K. E. Torrance and E. M. Sparrow, J. Opt. Soc. Am. 57, 1105 (1967); with polarization
//! T. A. Germer and E. Marx, Appl. Opt. 43, 1266 (2004).

use glam::DVec3;
use num_complex::Complex64;

use super::{
    FACET,
    turn::{Tilted, Turn},
};
use crate::{
    Defect, Direction, Incidence, Jones, Mueller, Node, ParamError, Side,
    geometry::Outgoing,
    lanes::{Batch, Complex, Vectors, WIDTH, with_widest},
    models::{Brdf, COMMON, Common},
    optics::film::{Films, Pair},
    polarization::{Signed, elements, muellers},
    slope::SlopeDistribution,
    spec::{Class, Laws, Spec},
    stack::Stack,
};

/// How programs name, parameterize and build it.
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
    common: Common,
    slopes: Box<dyn SlopeDistribution>,
    films: Films,
    /// Defect B5: no turn where the facet is met along its normal.
    unturned: bool,
}

/// The slopes of the facets that reflect a beam into directions.
struct Slopes<'a> {
    incidence: &'a Incidence,
    directions: &'a [[Direction; WIDTH]],
    out: &'a mut [[[f64; WIDTH]; 2]],
}

impl Batch for Slopes<'_> {
    #[inline(always)]
    fn run<V: Vectors>(self, vectors: V) {
        for (directions, out) in self.directions.iter().zip(self.out) {
            let to = Outgoing::several(vectors, directions);
            *out = Tilted::between(self.incidence, &to).slopes.map(|slope| vectors.store(slope));
        }
    }
}

/// The matrices of facets whose slopes have known densities.
struct Matrices<'a> {
    facet: &'a Facet,
    incidence: &'a Incidence,
    directions: &'a [[Direction; WIDTH]],
    densities: &'a [[f64; WIDTH]],
    out: &'a mut [[Mueller; WIDTH]],
}

impl Batch for Matrices<'_> {
    #[inline(always)]
    fn run<V: Vectors>(self, vectors: V) {
        let Self { facet, incidence, .. } = self;
        for ((directions, density), out) in self.directions.iter().zip(self.densities).zip(self.out)
        {
            let several = facet.several(vectors, incidence, directions, density);
            muellers(vectors, several.jones, several.weight, out);
            if several.is_delicate {
                for (m, direction) in out.iter_mut().zip(directions) {
                    *m = facet.mueller(incidence, direction);
                }
            }
        }
    }
}

/// The sum of such matrices, w R(β)ᵀ M, lane by lane.
struct Sums<'a> {
    facet: &'a Facet,
    incidence: &'a Incidence,
    directions: &'a [[Direction; WIDTH]],
    densities: &'a [[f64; WIDTH]],
    weights: Signed<'a>,
    sum: &'a mut Mueller,
}

impl Batch for Sums<'_> {
    #[inline(always)]
    fn run<V: Vectors>(self, vectors: V) {
        let Self { facet, incidence, directions, densities, weights, sum } = self;
        let [weight, cos2b, sin2b] =
            [weights.weight, weights.cos2b, weights.sin2b].map(|part| part.as_chunks().0);
        let zero = vectors.load(&[0.0; WIDTH]);
        let mut sums = [[zero; 4]; 4];
        for (group, (directions, density)) in directions.iter().zip(densities).enumerate() {
            let several = facet.several(vectors, incidence, directions, density);
            if several.is_delicate {
                for (k, direction) in directions.iter().enumerate() {
                    weights.add(group * WIDTH + k, &facet.mueller(incidence, direction), sum);
                }
                continue;
            }
            let m = elements(several.jones);
            let w = several.weight * vectors.load(&weight[group]);
            let (c, s) =
                (w * vectors.load(&cos2b[group]), w * (vectors.load(&sin2b[group]) * weights.sign));
            for k in 0..4 {
                sums[0][k] = sums[0][k] + w * m[0][k];
                sums[1][k] = sums[1][k] + (c * m[1][k] - s * m[2][k]);
                sums[2][k] = sums[2][k] + (s * m[1][k] + c * m[2][k]);
                sums[3][k] = sums[3][k] + w * m[3][k];
            }
        }
        for (row, sums) in sum.0.iter_mut().zip(sums) {
            for (element, lanes) in row.iter_mut().zip(sums) {
                *element += vectors.store(lanes).into_iter().sum::<f64>();
            }
        }
    }
}

/// Several bare facets met from above.
struct Several<R> {
    /// |w|² J.
    jones: [Complex<R>; 4],
    /// What M of it is to be multiplied by.
    weight: R,
    /// Whether one of them is met so close to its normal that it must be looked at alone.
    is_delicate: bool,
}

/// Squared sine of the local angle below which the library turns nothing, in reflection.
const UNTURNED_REFLECTION: f64 = 1e-20;
/// The same in transmission.
const UNTURNED_TRANSMISSION: f64 = 1e-14;

/// Groups of [`WIDTH`] directions whose slopes are held at a time.
const GROUPS: usize = 32;

impl Facet {
    pub(crate) fn read(node: &Node) -> Result<Self, ParamError> {
        let common = Common::read(node)?;
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
        let facet = Tilted::between(incidence, &Outgoing::one(direction));
        let from_below = self.common.side.from_below();
        let coefficients = if from_below {
            self.films.r21(self.films.kappa_inside(facet.sin2.sqrt()))
        } else {
            self.films.r12_known(facet.cos(), facet.sin2)
        };
        let unturned = self.unturned && facet.sin2 <= UNTURNED_REFLECTION;
        let (jones, norm) = turned(incidence, direction, direction.cos, coefficients, unturned);
        let [x, y] = facet.slopes;
        let weight = self.slopes.density(x, y) * facet.elongation()
            / (direction.cos * (4.0 * incidence.cos) * norm);
        (if from_below { jones.flipped() } else { jones }, weight)
    }

    /// Hands the densities of the slopes that reflect into several directions to `use_them`, with
    /// the number of the first group of directions, for at most [`GROUPS`] groups at a time.
    fn with_densities(
        &self,
        incidence: &Incidence,
        directions: &[[Direction; WIDTH]],
        mut use_them: impl FnMut(usize, &[[Direction; WIDTH]], &[[f64; WIDTH]]),
    ) {
        for (part, directions) in directions.chunks(GROUPS).enumerate() {
            let mut slopes = [[[0.0; WIDTH]; 2]; GROUPS];
            let mut densities = [[0.0; WIDTH]; GROUPS];
            let slopes = &mut slopes[..directions.len()];
            let densities = &mut densities[..directions.len()];
            with_widest(Slopes { incidence, directions, out: slopes });
            self.slopes.densities(slopes, densities);
            use_them(part * GROUPS, directions, densities);
        }
    }

    #[inline(always)]
    fn several<V: Vectors>(
        &self,
        vectors: V,
        incidence: &Incidence,
        directions: &[Direction; WIDTH],
        density: &[f64; WIDTH],
    ) -> Several<V::Real> {
        let to = Outgoing::several(vectors, directions);
        let facet = Tilted::between(incidence, &to);
        let turn = Turn::new(incidence, &to, to.cos);
        let norm = turn.norm();
        let weight =
            vectors.load(density) * facet.elongation() / (to.cos * (4.0 * incidence.cos) * norm);
        let mut is_delicate = false;
        let (norm, sin2) = (vectors.store(norm), vectors.store(facet.sin2));
        for (norm, sin2) in norm.into_iter().zip(sin2) {
            is_delicate |=
                norm < f64::MIN_POSITIVE || (self.unturned && sin2 <= UNTURNED_REFLECTION);
        }
        let jones = turn.elements(self.films.bare(facet.cos(), facet.sin2));
        Several { jones, weight, is_delicate }
    }

    /// How many of the first directions go through [`Facet::several`]: all but the last few where
    /// bare facets reflect from above.
    fn groups<'d>(&self, directions: &'d [Direction]) -> (&'d [[Direction; WIDTH]], usize) {
        if self.common.side == Side::DownUp && self.films.is_bare() {
            let (groups, rest) = directions.as_chunks();
            (groups, directions.len() - rest.len())
        } else {
            (&[], 0)
        }
    }

    fn refraction(&self, incidence: &Incidence, direction: &Direction) -> Option<(Jones, f64)> {
        let index = self.common.substrate.re;
        let from_below = self.common.side.from_below();
        let m = if from_below { 1.0 / index } else { index };
        let k_i = incidence.k();
        let mut k_t = direction.k();
        k_t.z = -k_t.z;
        let v = k_i - m * k_t;
        let v2 = v.length_squared();
        let normal = v * (v.z.signum() / v2.sqrt());
        let (c_i, c_t) = (-k_i.dot(normal), -k_t.dot(normal));
        // NaN, where both rays are one in media of one index, is no facet either.
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
    coefficients: Pair,
    unturned: bool,
) -> (Jones, f64) {
    let mut turn = Turn::new(incidence, &Outgoing::one(direction), z);
    let mut norm = turn.norm();
    if norm < f64::MIN_POSITIVE || unturned {
        turn = if unturned { Turn::none() } else { Turn::along_normal(direction, z) };
        norm = 1.0;
    }
    (turn.apply(coefficients), norm)
}

impl Brdf for Facet {
    fn common(&self) -> &Common {
        &self.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        match self.event(incidence, direction) {
            Some((jones, weight)) => jones.mueller() * weight,
            None => Mueller::ZERO,
        }
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let (groups, done) = self.groups(directions);
        let (to, left) = out.split_at_mut(done);
        let to = to.as_chunks_mut().0;
        self.with_densities(incidence, groups, |first, directions, densities| {
            let out = &mut to[first..first + directions.len()];
            with_widest(Matrices { facet: self, incidence, directions, densities, out });
        });
        for (m, direction) in left.iter_mut().zip(&directions[done..]) {
            *m = self.mueller(incidence, direction);
        }
    }

    fn sum(&self, incidence: &Incidence, directions: &[Direction], weights: Signed<'_>) -> Mueller {
        let mut sum = Mueller::ZERO;
        let (groups, done) = self.groups(directions);
        self.with_densities(incidence, groups, |first, directions, densities| {
            let weights = weights.part(first * WIDTH..(first + directions.len()) * WIDTH);
            let sum = &mut sum;
            with_widest(Sums { facet: self, incidence, directions, densities, weights, sum });
        });
        for (k, direction) in directions.iter().enumerate().skip(done) {
            weights.add(k, &self.mueller(incidence, direction), &mut sum);
        }
        sum
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
    use crate::{Basis, Geometry, Mode, Model, Value, models, optics::Index, spec, special::gauss};

    fn node(mode: Mode, index: Index, sdf: &str, params: &[(&str, f64)]) -> Node {
        let slopes = Node::with_defaults(spec::find_class(sdf).unwrap(), mode);
        let slopes = params
            .iter()
            .fold(slopes, |node, (name, x)| node.with(name, Value::Number(*x)).unwrap());
        Node::with_defaults(&SPEC.class, mode)
            .with("substrate", Value::Index(index))
            .unwrap()
            .with("sdf", Value::Member(slopes.into()))
            .unwrap()
    }

    fn gaussian(mode: Mode, index: Index, s: f64) -> Node {
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
            let node = gaussian(Mode::Sound, Index::constant(1.5, 0.0), 0.1)
                .with("type", Value::Integer(side))
                .unwrap();
            hemisphere(&models::build(&node).unwrap(), 0.4)[(0, 0)]
        };
        // Facets of slope 0.1 at 23°: shadowing and second reflections are below 10⁻¹¹ here.
        let total = at(0) + at(1);
        assert!((total - 1.0).abs() < 1e-9, "{total}");
    }

    #[test]
    fn unpolarized_light_at_brewsters_angle_leaves_with_q_equal_to_i() {
        let node = gaussian(Mode::Sound, Index::constant(1.5, 0.0), 0.1);
        let theta = 1.5f64.atan();
        let at = Geometry { theta_i: theta, theta_s: theta, phi_s: 0.0, rotation: 0.0 };
        let m = models::build(&node).unwrap().mueller(&at, Basis::Psps);
        assert!((m[(1, 0)] / m[(0, 0)] - 1.0).abs() < 1e-14);
    }

    #[test]
    fn metal_at_60_degrees_turns_plus_45_into_right_circular_light() {
        let node = gaussian(Mode::Sound, Index::constant(1.2, 7.0), 0.1);
        let theta = PI / 3.0;
        let at = Geometry { theta_i: theta, theta_s: theta, phi_s: 0.0, rotation: 0.0 };
        let m = models::build(&node).unwrap().mueller(&at, Basis::Psps);
        let intensity = m[(0, 0)] + m[(0, 2)];
        assert!(((m[(3, 0)] + m[(3, 2)]) / intensity + 0.3962).abs() < 5e-5);
        assert!((m[(2, 2)] / m[(0, 0)] + 0.9157).abs() < 5e-5);
    }

    #[test]
    fn close_to_retro_reflection_the_matrix_tends_to_its_limit() {
        let model = models::build(&gaussian(Mode::Sound, Index::constant(1.3, 1.2), 0.5)).unwrap();
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
            let node = gaussian(mode, Index::constant(1.3, 1.2), 0.3);
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
            let node = gaussian(mode, Index::constant(1.5, 0.0), 0.3)
                .with("type", Value::Integer(2))
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
            let node = node(Mode::Sound, Index::constant(1.5, 0.0), sdf, &params)
                .with("type", Value::Integer(side))
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
