//! A particle on the smooth face of a substrate, exact but for the truncation of its multipoles.
//!
//! Regular waves v, those of the incident light and of what the face makes of it, meet the
//! particle and its [image]; the multipoles w that they excite are summed in the direction of
//! scattering, again with what the face makes of them ([`waves`](crate::tmatrix::waves)).
//! With q the height of the origin times k and κ = n sin θ, c = √(1 − κ²) of light in the
//! substrate,
//!
//! | light | direct | mirrored |
//! |---|---|---|
//! | from or to outside | 1 | r12 e^{2iq cos θ} |
//! | out of the substrate | 0 | t21 n^{−1/2} e^{iq(c − n cos θ)} |
//! | into the substrate | t21 n^{1/2} e^{iq(c − n cos θ)} | 0 |
//!
//! where the wave in the substrate fades towards the particle beyond the critical angle.
//! F = N M(J)/(cos θ_i cos θ_s), J in µm. A particle in the substrate is one outside when all
//! indices are divided by n, λ too, and the films and the sides change places.

use std::f64::consts::TAU;

use num_complex::Complex64;

use self::image::{ImageMethod, ImageNodes, MultipoleResponse};
use super::small_sphere::not_negative;
use crate::{
    Defect, Direction, Incidence, Jones, Mueller, ParameterError, ParameterNode, Side,
    models::{Brdf, CommonParameters},
    optics::film::{Films, SpAmplitudes},
    spec::Parameter,
    special::harmonics::Harmonics,
    stack::Stack,
    tmatrix::{
        TMatrix,
        converged::{self, Level, Orders},
        mispairing,
        waves::{self, MirroredWave, OutgoingMultipoles},
    },
};

mod image;

/// True if the library moves angles this near to the normal to it.
const NORMAL: f64 = 1e-6;

/// The parameters of how the interaction with the face is computed, with the meaning of `order`.
pub(super) const fn interaction(order: &'static str) -> [Parameter; 3] {
    [
        Parameter::integer("order", -1, order),
        Parameter::integer(
            "Norm_Inc_Approx",
            0,
            "Reflection of the particle's own light: 0 exact, 1 as at normal incidence",
        ),
        Parameter::integer(
            "improve",
            3,
            "Steps of iterative improvement in NIST's library; no effect, the solution is exact",
        ),
    ]
}

/// The smooth face and where the particle is, as one outside in vacuum.
pub(super) struct SubstrateFace {
    common: CommonParameters,
    /// The side seen from the particle.
    side: Side,
    films: Films,
    /// Index of the substrate over that of the particle's medium, for light in it.
    n: f64,
    /// Wave number around the particle, 1/µm.
    pub k: f64,
    /// Index around the particle.
    pub medium: f64,
    delta: f64,
    density: f64,
    normal_only: bool,
    method: ImageMethod,
    nudges: bool,
    flips: bool,
}

impl SubstrateFace {
    /// Parameters of every model.
    pub(super) fn common(&self) -> &CommonParameters {
        &self.common
    }

    /// The same where every `order` above 0 stands for the exact answer.
    pub(super) fn without_series(mut self) -> Self {
        if let ImageMethod::Series(_) = self.method {
            self.method = ImageMethod::Exact;
        }
        self
    }

    /// Distance of a particle from the face, µm.
    pub(super) fn distance(&self) -> f64 {
        self.delta
    }

    /// Reads what all such models share; `buried` puts the particle into the substrate.
    pub(super) fn read(node: &ParameterNode, buried: bool) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        let substrate = common.substrate;
        if !(substrate.re > 0.0 && substrate.is_finite()) {
            return Err(ParameterError::new("substrate", format!("{substrate} is not an index")));
        }
        let mut layers = node.member::<Stack>("stack")?.at(common.lambda);
        let (medium, side) =
            if buried { (substrate.re, turned(common.side)) } else { (1.0, common.side) };
        let below = if buried { medium.recip().into() } else { substrate };
        if buried {
            layers.reverse();
            layers.iter_mut().for_each(|layer| layer.0 /= medium);
        }
        let lambda = common.lambda / medium;
        let method = match node.integer("order") {
            i32::MIN..0 => ImageMethod::Exact,
            0 => ImageMethod::Alone,
            terms if terms <= 1000 => ImageMethod::Series(terms as usize),
            terms => {
                return Err(ParameterError::new("order", format!("{terms} is more than 1000")));
            }
        };
        Ok(Self {
            side,
            films: Films::new(&layers, Complex64::ONE, below, lambda),
            n: below.re,
            k: TAU / lambda,
            medium,
            delta: not_negative(node, "delta")?,
            density: not_negative(node, "density")?,
            normal_only: node.integer("Norm_Inc_Approx") != 0,
            method,
            nudges: node.reproduces(Defect::Nudge),
            flips: buried,
            common,
        })
    }
}

/// The side of a particle whose substrate is on the other side.
fn turned(side: Side) -> Side {
    match side {
        Side::DownUp => Side::UpDown,
        Side::UpDown => Side::DownUp,
        Side::DownDown => Side::UpUp,
        Side::UpUp => Side::DownDown,
    }
}

/// A particle on or in a substrate.
pub(super) struct SupportedParticle {
    ground: SubstrateFace,
    response: MultipoleResponse,
    /// k times the height of the origin over the face.
    height: f64,
    incoming: Harmonics,
    outgoing: Harmonics,
    mispairs: bool,
}

impl SupportedParticle {
    /// The particle with this T-matrix as NIST's library computes it, its origin at `height` µm over the
    /// face if it touches it; light is summed over l up to `l_out`.
    pub(super) fn as_the_library(
        ground: SubstrateFace,
        particle: &TMatrix,
        height: f64,
        l_out: usize,
    ) -> Result<Self, ParameterError> {
        let l_out = l_out.min(particle.l_max);
        let response =
            ground.response(particle, height, ImageNodes::Library, l_out).ok_or_else(|| {
                let problem = "too many multipoles for this size and shape: they overflow";
                ParameterError::new("lmax", problem)
            })?;
        Ok(Self::new(ground, particle, response, height, l_out))
    }

    /// The particle with the T-matrix and the height of its origin that `particle` gives for as many
    /// orders as it takes to converge together with its image.
    ///
    /// # Errors
    ///
    /// If they do not.
    pub(super) fn converged(
        ground: SubstrateFace,
        node: &ParameterNode,
        orders: &Orders,
        particle: impl Fn(Level) -> Option<(TMatrix, f64)>,
    ) -> Result<Self, ParameterError> {
        let compute = |level: Level| {
            let (particle, height) = particle(level)?;
            let nodes = ImageNodes::Panels(if level.is_fine { 14 } else { 11 });
            let response = ground.response(&particle, height, nodes, particle.l_max)?;
            Some((particle, response, height))
        };
        let (particle, response, height) = converged::converged(node, orders, compute, |a, b| {
            converged::distance(a.1.matrices(), b.1.matrices())
        })?;
        let l_out = particle.l_max;
        Ok(Self::new(ground, &particle, response, height, l_out))
    }

    fn new(
        ground: SubstrateFace,
        particle: &TMatrix,
        response: MultipoleResponse,
        height: f64,
        l_out: usize,
    ) -> Self {
        Self {
            response,
            height: ground.k * (height + ground.delta),
            incoming: Harmonics::new(particle.l_max, particle.m_max()),
            outgoing: Harmonics::new(l_out, particle.m_max().min(l_out)),
            mispairs: false,
            ground,
        }
    }

    /// The same with the harmonics of NIST's library
    /// ([`Defect::AxisymmetricIndex`](crate::Defect::AxisymmetricIndex)).
    pub(super) fn mispairing(self) -> Self {
        Self { mispairs: true, ..self }
    }

    fn excited(&self, incidence: &Incidence) -> Excited {
        let below = self.ground.side.from_below();
        let (sin, cos) = self.ground.angle(incidence.theta(), incidence.sin, incidence.cos);
        let mut growth = 1.0;
        let beam = if below {
            let (mut cos, t) = self.ground.through(sin, cos, self.height);
            let factor = self.ground.n.sqrt().recip();
            let mut kappa = self.ground.n * sin;
            if self.ground.nudges && cos.im == 0.0 {
                let half = HalfAngle::of_the_library(kappa);
                (kappa, cos) = (half.sin, half.cos.into());
                growth = half.square;
            }
            MirroredWave {
                cos,
                sin: kappa,
                direct: SpAmplitudes::default(),
                mirrored: times(t, factor.into()),
            }
        } else {
            let mirrored = self.ground.reflected(sin, cos, self.height);
            MirroredWave { mirrored, ..MirroredWave::free(cos, sin) }
        };
        let mut regular = waves::regular(&self.incoming, &beam);
        if growth != 1.0 {
            self.incoming.visit(1.0, 0.0, |m, l, _, _| {
                let at = self.incoming.place(m, l);
                regular[at] = regular[at].scaled(growth.powi(l as i32));
            });
        }
        let w = self.response.apply(&regular);
        if !self.mispairs {
            Excited::Multipoles(OutgoingMultipoles::symmetric(w.into_iter()))
        } else if self.ground.side.to_below() {
            Excited::MispairedInside(mispairing::inside(&w, &self.outgoing))
        } else {
            Excited::Multipoles(mispairing::outside(&w, &self.outgoing))
        }
    }

    fn amplitude(&self, excited: &Excited, incidence: &Incidence, direction: &Direction) -> Jones {
        let ground = &self.ground;
        let (sin, cos) = ground.angle(direction.theta(), direction.sin, direction.cos);
        let beam = if ground.side.to_below() {
            let (inside, t) = ground.through(sin, cos, self.height);
            let direct = times(t, ground.n.sqrt().into());
            MirroredWave {
                cos: inside,
                sin: ground.n * sin,
                direct,
                mirrored: SpAmplitudes::default(),
            }
        } else {
            let mirrored = ground.reflected(sin, cos, self.height);
            MirroredWave { mirrored, ..MirroredWave::free(-cos, sin) }
        };
        // A negative polar angle stands for the azimuth on the other side.
        let side = if (direction.sin < 0.0) != (incidence.sin < 0.0) { -1.0 } else { 1.0 };
        let azimuth = (side * direction.cos_phi, side * direction.sin_phi);
        let area = ground.density / (incidence.cos * direction.cos).abs();
        let j = match excited {
            Excited::Multipoles(all) => all.amplitude(&self.outgoing, &beam, azimuth),
            Excited::MispairedInside(all) => all.amplitude(&beam, azimuth),
        };
        let j = j.scaled(area.sqrt() / ground.k);
        if ground.flips { j.flipped() } else { j }
    }
}

/// The angle of light out of the substrate as NIST's library rounds it
/// ([`Defect::HalfAngle`](crate::Defect::HalfAngle)).
///
/// The library computes the rotation matrices, of degree 2l in the sine and the cosine of half the
/// angle, from sin² = (1 − cos θ)/2 and cos = sin θ/(2 sin), whose squares do not sum to 1 at small
/// angles.
struct HalfAngle {
    /// Sine and cosine of the angle when both are divided by the root of their sum of squares.
    sin: f64,
    cos: f64,
    /// The sum of their squares.
    square: f64,
}

impl HalfAngle {
    fn of_the_library(kappa: f64) -> Self {
        let half_sin = (1.0 - (1.0 - kappa * kappa).sqrt()).sqrt() / 2f64.sqrt();
        let half_cos = kappa / 2.0 / half_sin;
        let (s, c) = (half_sin * half_sin, half_cos * half_cos);
        let square = s + c;
        Self { sin: kappa / square, cos: (c - s) / square, square }
    }
}

impl SubstrateFace {
    fn response(
        &self,
        particle: &TMatrix,
        height: f64,
        nodes: ImageNodes,
        l_out: usize,
    ) -> Option<MultipoleResponse> {
        let (films, q) = (&self.films, self.k * (height + self.delta));
        MultipoleResponse::new(particle, films, q, (self.normal_only, nodes), self.method, l_out)
    }

    /// Sine and cosine of a polar angle, which the library keeps away from 0.
    fn angle(&self, theta: f64, sin: f64, cos: f64) -> (f64, f64) {
        if self.nudges && theta.abs() < NORMAL { NORMAL.sin_cos() } else { (sin.abs(), cos) }
    }

    fn reflected(&self, sin: f64, cos: f64, height: f64) -> SpAmplitudes {
        let r = self.films.r12(sin.into());
        times(r, Complex64::cis(2.0 * height * cos))
    }

    /// Cosine outside of a beam in the substrate, and its t21 with the phase of its height.
    fn through(&self, sin: f64, cos: f64, height: f64) -> (Complex64, SpAmplitudes) {
        let kappa = self.n * sin;
        let squared = 1.0 - kappa * kappa;
        let outside = if squared < 0.0 {
            Complex64::new(0.0, (-squared).sqrt())
        } else {
            squared.sqrt().into()
        };
        let phase = (Complex64::I * height * (outside - self.n * cos)).exp();
        (outside, times(self.films.t21(kappa.into()), phase))
    }
}

fn times(pair: SpAmplitudes, factor: Complex64) -> SpAmplitudes {
    SpAmplitudes { s: pair.s * factor, p: pair.p * factor }
}

/// The multipoles that light has excited.
enum Excited {
    /// Each with its own harmonic.
    Multipoles(OutgoingMultipoles),
    /// Paired as in NIST's library, of light into the substrate.
    MispairedInside(mispairing::Inside),
}

impl Brdf for SupportedParticle {
    fn common(&self) -> &CommonParameters {
        &self.ground.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        self.amplitude(&self.excited(incidence), incidence, direction).mueller()
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let excited = self.excited(incidence);
        for (m, direction) in out.iter_mut().zip(directions) {
            *m = self.amplitude(&excited, incidence, direction).mueller();
        }
    }

    fn jones(&self, incidence: &Incidence, direction: &Direction) -> Option<Jones> {
        Some(self.amplitude(&self.excited(incidence), incidence, direction))
    }

    fn is_coherent(&self) -> bool {
        true
    }
}
