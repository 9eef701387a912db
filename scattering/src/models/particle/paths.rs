//! Paths of light between a particle and the face of a substrate.
//!
//! Light comes to the particle straight or after a reflection, and leaves it straight or by way
//! of a reflection: four paths that interfere,
//!
//! $$ \mathbf{J} = \mathbf{t}_o e^{i\phi h} \left[ \mathbf{S}(k_i,k_s)
//!    + \mathbf{S}(k_i^r,k_s)\,\mathbf{r}_i + \mathbf{r}_s\,\mathbf{S}(k_i,k_s^r)
//!    + \mathbf{r}_s\,\mathbf{S}(k_i^r,k_s^r)\,\mathbf{r}_i \right] \mathbf{t}_i $$
//!
//! k^r is k mirrored at the face, h the distance of the particle from it; r carry the phase of
//! their detour. Transmissions t enter where the light crosses the face.

use glam::{DMat3, DVec3};
use num_complex::Complex64;

use crate::{
    Direction, Incidence, Jones, ParameterError, ParameterNode,
    optics::film::SpAmplitudes,
    polarization::TransverseFrame,
    scatterer::{Scatterer, ScatteringPlaneRotation},
    spec::Parameter,
};

/// The parameters that turn a particle.
pub(super) const ORIENTATION: [Parameter; 2] = [
    Parameter::number("alpha", 0.0, "rad", "First Euler angle of the particle"),
    Parameter::number("beta", 0.0, "rad", "Second Euler angle of the particle"),
];

/// A beam with its s and p vectors.
#[derive(Clone, Copy, Debug)]
pub(super) struct PolarizedBeam {
    pub k: DVec3,
    pub frame: TransverseFrame,
}

impl PolarizedBeam {
    /// The beam along `k` with this s.
    pub(super) fn new(k: DVec3, s: DVec3) -> Self {
        Self { k, frame: TransverseFrame::with_s(k, s) }
    }

    /// The beam mirrored at the face: the same s, p = k × s.
    fn mirrored(&self) -> Self {
        let k = DVec3::new(self.k.x, self.k.y, -self.k.z);
        let first = self.frame.first;
        Self { k, frame: TransverseFrame { first, second: k.cross(first) } }
    }

    fn turned(&self, turn: &DMat3) -> Self {
        let TransverseFrame { first, second } = self.frame;
        Self {
            k: *turn * self.k,
            frame: TransverseFrame { first: *turn * first, second: *turn * second },
        }
    }
}

/// A reflection on the way, with the phase of the detour per µm of distance from the face.
#[derive(Clone, Copy, Debug)]
pub(super) struct FaceReflection {
    pub r: SpAmplitudes,
    pub phase: f64,
}

impl FaceReflection {
    fn at(&self, distance: f64) -> SpAmplitudes {
        let turn = Complex64::cis(self.phase * distance);
        SpAmplitudes { s: self.r.s * turn, p: self.r.p * turn }
    }
}

/// One of the four paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum InteractionPath {
    /// No reflection.
    Straight,
    /// The light is reflected before it meets the particle.
    Before,
    /// Light is reflected by the face after the particle scatters it.
    After,
    /// Both.
    Both,
}

impl InteractionPath {
    pub(super) const ALL: [Self; 4] = [Self::Straight, Self::Before, Self::After, Self::Both];
}

/// Interactions of the light on its paths, for one pair of directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct InteractionPaths {
    pub incoming: PolarizedBeam,
    pub outgoing: PolarizedBeam,
    pub before: Option<FaceReflection>,
    pub after: Option<FaceReflection>,
    /// Crossing of the face on the way in.
    pub t_in: SpAmplitudes,
    /// Crossing of the face on the way out.
    pub t_out: SpAmplitudes,
    /// Real factor of all paths, with 1/k of the medium of the particle.
    pub scale: f64,
    /// Phase of all paths per µm of distance.
    pub phase: f64,
}

impl InteractionPaths {
    /// Paths that cross no face and bounce nowhere, scattered in a medium of wave number `k`.
    pub(super) fn new(incoming: PolarizedBeam, outgoing: PolarizedBeam, k: f64) -> Self {
        let one = SpAmplitudes { s: Complex64::ONE, p: Complex64::ONE };
        Self {
            incoming,
            outgoing,
            before: None,
            after: None,
            t_in: one,
            t_out: one,
            scale: 1.0 / k,
            phase: 0.0,
        }
    }

    /// The beams that the particle sees on a path.
    fn beams(&self, path: InteractionPath) -> (PolarizedBeam, PolarizedBeam) {
        let (i, s) = (self.incoming, self.outgoing);
        match path {
            InteractionPath::Straight => (i, s),
            InteractionPath::Before => (i.mirrored(), s),
            InteractionPath::After => (i, s.mirrored()),
            InteractionPath::Both => (i.mirrored(), s.mirrored()),
        }
    }

    /// True if light goes this way.
    pub(super) fn is_open(&self, path: InteractionPath) -> bool {
        match path {
            InteractionPath::Straight => true,
            InteractionPath::Before => self.before.is_some(),
            InteractionPath::After => self.after.is_some(),
            InteractionPath::Both => self.before.is_some() && self.after.is_some(),
        }
    }

    /// Cosines of the scattering angle with an even and with an odd number of reflections.
    pub(super) fn cosines(&self) -> [f64; 2] {
        let (straight, mirrored) = (self.incoming, self.incoming.mirrored());
        [straight, mirrored].map(|beam| beam.k.dot(self.outgoing.k).clamp(-1.0, 1.0))
    }

    /// The turns into and out of the scattering plane of a path.
    pub(super) fn plane_turn(&self, path: InteractionPath) -> ScatteringPlaneRotation {
        let (i, s) = self.beams(path);
        ScatteringPlaneRotation::new(i.k, s.k, &i.frame, &s.frame)
    }

    /// J with M(J) the differential cross-section, at a distance from the face, of a particle
    /// with the matrix `scatter(path)`.
    pub(super) fn jones(&self, distance: f64, scatter: impl Fn(InteractionPath) -> Jones) -> Jones {
        let before = self.before.map(|bounce| bounce.at(distance));
        let after = self.after.map(|bounce| bounce.at(distance));
        let mut total = scatter(InteractionPath::Straight);
        if let Some(r) = before {
            total = total + first(r, scatter(InteractionPath::Before));
        }
        if let Some(r) = after {
            let mut rest = scatter(InteractionPath::After);
            if let Some(earlier) = before {
                rest = rest + first(earlier, scatter(InteractionPath::Both));
            }
            total = total + last(r, rest);
        }
        let common = Complex64::from_polar(self.scale, self.phase * distance);
        last(self.t_out, first(self.t_in, total)) * common
    }
}

/// J after the diagonal matrix `d`.
fn first(d: SpAmplitudes, j: Jones) -> Jones {
    Jones { ss: j.ss * d.s, ps: j.ps * d.p, sp: j.sp * d.s, pp: j.pp * d.p }
}

/// The diagonal matrix `d` after J.
fn last(d: SpAmplitudes, j: Jones) -> Jones {
    Jones { ss: j.ss * d.s, ps: j.ps * d.s, sp: j.sp * d.p, pp: j.pp * d.p }
}

/// True if a path has an odd number of reflections, as an index of [`InteractionPaths::cosines`].
pub(super) fn parity(path: InteractionPath) -> usize {
    usize::from(matches!(path, InteractionPath::Before | InteractionPath::After))
}

/// A particle in its orientation.
pub(super) struct OrientedParticle {
    particle: Box<dyn Scatterer>,
    euler: DMat3,
}

impl OrientedParticle {
    /// The particle with the node's `alpha` and `beta`.
    pub(super) fn read(
        node: &ParameterNode,
        particle: Box<dyn Scatterer>,
    ) -> Result<Self, ParameterError> {
        let angle = |name| {
            let value = node.number(name);
            let problem = || ParameterError::new(name, format!("{value} is not an angle"));
            if value.is_finite() { Ok(value.sin_cos()) } else { Err(problem()) }
        };
        let ((sin_a, cos_a), (sin_b, cos_b)) = (angle("alpha")?, angle("beta")?);
        let euler = DMat3::from_cols(
            DVec3::new(cos_a * cos_b, -cos_b * sin_a, sin_b),
            DVec3::new(sin_a, cos_a, 0.0),
            DVec3::new(-cos_a * sin_b, sin_a * sin_b, cos_b),
        );
        Ok(Self { particle, euler })
    }

    /// J with M(J) the differential cross-section in µm²/sr.
    pub(super) fn jones(
        &self,
        paths: &InteractionPaths,
        incidence: &Incidence,
        distance: f64,
    ) -> Jones {
        if let Some(round) = self.particle.round() {
            let [even, odd] = paths.cosines();
            let bounces = paths.before.is_some() || paths.after.is_some();
            let straight = round.amplitudes(even);
            let reflected = if bounces { round.amplitudes(odd) } else { straight };
            return paths.jones(distance, |path| {
                paths.plane_turn(path).apply(&[straight, reflected][parity(path)])
            });
        }
        let turn = self.euler * rotation(incidence);
        paths.jones(distance, |path| {
            let (i, s) = paths.beams(path);
            let (i, s) = (i.turned(&turn), s.turned(&turn));
            self.particle.jones(i.k, s.k, &i.frame, &s.frame)
        })
    }
}

/// From the laboratory to the frame of the sample.
fn rotation(incidence: &Incidence) -> DMat3 {
    let (s, c) = (incidence.sin_rotation, incidence.cos_rotation);
    DMat3::from_cols(DVec3::new(c, -s, 0.0), DVec3::new(s, c, 0.0), DVec3::Z)
}

/// The geometry moved away from the specular, retro and, if `normal`, normal directions, as
/// NIST's library does ([`Defect::Nudge`](crate::Defect::Nudge)).
pub(super) fn nudged(
    incidence: &Incidence,
    direction: &Direction,
    normal: bool,
) -> (Incidence, Direction) {
    const NEAR: f64 = 1e-5;
    const STEP: f64 = 2.5e-5;
    let (mut theta_i, mut theta_s) = (incidence.theta(), direction.theta());
    for sign in [-1.0, 1.0] {
        if (theta_i.sin() + sign * theta_s.sin() * direction.cos_phi).abs() < NEAR {
            theta_i += STEP;
        }
    }
    if normal && theta_i.abs() < NEAR {
        theta_i = NEAR;
    }
    if normal && theta_s.abs() < NEAR {
        theta_s = NEAR;
    }
    (Incidence::new(theta_i, incidence.rotation()), Direction::new(theta_s, direction.phi()))
}
