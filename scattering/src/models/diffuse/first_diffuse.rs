//! Light scattered once in a thick body under a smooth interface.
//!
//! $$ \mathbf{F} = \mathbf{D}_s \left[ \frac{1}{n^2}\,
//!    \frac{\kappa_s}{(\kappa_h + \kappa_a + \kappa_s)(\mu_i + \mu_s)}\,
//!    \mathbf{T}_s \mathbf{R}_{out} \mathbf{P}(\Theta) \mathbf{R}_{in} \mathbf{T}_i
//!    \right] \mathbf{D}_i \qquad (1) $$
//!
//! μ = √(1 − sin²θ/n²) are the cosines inside, T = (nμ/cos θ) M(t12) the transmittances of the
//! filmed interface, κ_h = 4πk/λ the absorption coefficient of the host, κ_a and κ_s the coefficients
//! of absorption and scattering of the phase matrix P. R rotate Stokes vectors into and out of the
//! scattering plane. D_i describes depolarization on the way in,
//!
//! $$ \mathbf D_i = \mathrm{diag}(1, u, u, v), \qquad u = 1 - \frac{d_l \mu_s}{\mu_i + \mu_s}, \qquad
//!    v = 1 - \frac{d_c \mu_s}{\mu_i + \mu_s} \qquad (2) $$
//!
//! and D_s the same on the way out, with μ_i in the numerators; d_l (`depoll`) and d_c (`depolc`) lie
//! between 0 and 1.
//!
//! S. Chandrasekhar, *Radiative Transfer* (Dover, 1960), §§20, 47.

use std::f64::consts::PI;

use glam::DVec3;

use crate::{
    Defect, Direction, Incidence, Mueller, ParameterError, ParameterNode,
    models::{
        Brdf, COMMON, CommonParameters,
        smooth_interface::{INTERFACE, interface},
    },
    optics::film::Films,
    polarization::{TransverseFrame, perp},
    polarized_phase::{self, PolarizedPhase},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`FirstDiffuse`] body.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "First_Diffuse_BRDF_Model",
        parent: "BRDF_Model",
        summary: "Single scattering in a thick body under a smooth interface",
        equation: "F = D 1/n^2 ks/((kh+ka+ks)(mui+mus)) T Rout P Rin T D",
        source: "chandrasekhar-1960",
        params: &[COMMON, OWN, INTERFACE],
        laws: Laws::ALL,
    },
    build: |node| Ok(Box::new(FirstDiffuse::read(node)?)),
};

const OWN: &[Parameter] = &[
    Parameter::number("depoll", 0.0, "1", "Loss of linear polarization on the way, 0 to 1"),
    Parameter::number("depolc", 0.0, "1", "Loss of circular polarization on the way, 0 to 1"),
    Parameter::member(
        "phase_function",
        &polarized_phase::FAMILY,
        "Unpolarized_Phase_Function",
        "Phase matrix with the coefficients of scattering and absorption",
    ),
];

/// A thick body that scatters once.
pub struct FirstDiffuse {
    common: CommonParameters,
    films: Films,
    phase: Box<dyn PolarizedPhase>,
    /// Real part of the index of the host.
    n: f64,
    /// κ_s/((κ_h + κ_a + κ_s) n²).
    albedo: f64,
    linear_loss: f64,
    circular_loss: f64,
    /// s of a beam along the normal is ŷ.
    normal_is_y: bool,
}

impl FirstDiffuse {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        common.only_reflection(SPEC.class.name)?;
        let films = interface(node, &common, common.substrate)?;
        let phase = node.member::<dyn PolarizedPhase>("phase_function")?;
        let n = common.substrate.re;
        let host = 4.0 * PI * common.substrate.im / common.lambda;
        let total = host + phase.absorption() + phase.scattering();
        Ok(Self {
            common,
            films,
            n,
            // Without particles nothing is scattered; in a clear host the quotient would be 0/0.
            albedo: if phase.scattering() > 0.0 {
                phase.scattering() / (total * n * n)
            } else {
                0.0
            },
            phase,
            linear_loss: node.number("depoll"),
            circular_loss: node.number("depolc"),
            normal_is_y: node.reproduces(Defect::NormalBasis),
        })
    }

    /// T and μ of a beam at an angle from outside.
    fn crossing(&self, sin: f64, cos: f64) -> (Mueller, f64) {
        let inside = sin / self.n;
        let mu = (1.0 - inside * inside).max(0.0).sqrt();
        let t = self.films.t12(sin.into()).jones().mueller();
        (t * (self.n * mu / cos), mu)
    }

    /// The part inside: R_out P R_in between two directions inside.
    fn scattered(&self, k_i: DVec3, k_s: DVec3, s: DVec3) -> Mueller {
        let across = perp(k_i, k_s);
        let into = PlaneRotation::new(k_i, DVec3::Y, across);
        let out = PlaneRotation::new(k_s, s, across);
        out.after(into.before(self.phase.at_cosine(k_i.dot(k_s).clamp(-1.0, 1.0))))
    }

    fn matrix(&self, sin_i: f64, (t_i, mu_i): &(Mueller, f64), direction: &Direction) -> Mueller {
        let (t_s, mu_s) = self.crossing(direction.sin, direction.cos);
        let sum = mu_i + mu_s;
        if sum == 0.0 {
            return Mueller::ZERO;
        }
        let k_i = DVec3::new(sin_i / self.n, 0.0, -mu_i);
        let sin_s = direction.sin / self.n;
        let k_s = DVec3::new(sin_s * direction.cos_phi, sin_s * direction.sin_phi, mu_s);
        let s = if self.normal_is_y { direction.nists_s() } else { direction.s() };
        // (1)
        let mut m = t_s * self.scattered(k_i, k_s, s) * *t_i * (self.albedo / sum);
        self.depolarize(&mut m, mu_s / sum, mu_i / sum);
        m
    }

    /// D_s m D_i of (1) and (2); `into` is μ_s/(μ_i + μ_s), `out` is μ_i/(μ_i + μ_s).
    fn depolarize(&self, m: &mut Mueller, into: f64, out: f64) {
        if self.linear_loss == 0.0 && self.circular_loss == 0.0 {
            return;
        }
        let diagonal = |share: f64| {
            let (u, v) = (1.0 - self.linear_loss * share, 1.0 - self.circular_loss * share);
            [1.0, u, u, v]
        };
        let (d_i, d_s) = (diagonal(into), diagonal(out));
        for (row, s) in m.0.iter_mut().zip(d_s) {
            for (x, i) in row.iter_mut().zip(d_i) {
                *x *= s * i;
            }
        }
    }
}

impl Brdf for FirstDiffuse {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let entering = self.crossing(incidence.sin, incidence.cos);
        self.matrix(incidence.sin, &entering, direction)
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let entering = self.crossing(incidence.sin, incidence.cos);
        for (m, direction) in out.iter_mut().zip(directions) {
            *m = self.matrix(incidence.sin, &entering, direction);
        }
    }
}

/// The change between (s, p) and (∥, ⊥) of one beam. The two pairs have opposite handedness, so
/// its Jones matrix [[c, d], [d, −c]] is a reflection and its own inverse.
struct PlaneRotation {
    cos: f64,
    sin: f64,
}

impl PlaneRotation {
    fn new(k: DVec3, s: DVec3, across: DVec3) -> Self {
        let frame = TransverseFrame::with_s(k, s);
        let along = k.cross(across);
        let (c, d) = (along.dot(frame.first), along.dot(frame.second));
        Self { cos: c * c - d * d, sin: 2.0 * c * d }
    }

    /// P times this change: the columns.
    fn before(&self, mut p: Mueller) -> Mueller {
        for row in &mut p.0 {
            let (q, u) = (row[1], row[2]);
            (row[1], row[2]) = (q * self.cos + u * self.sin, q * self.sin - u * self.cos);
            row[3] = -row[3];
        }
        p
    }

    /// This change times P: the rows.
    fn after(&self, p: Mueller) -> Mueller {
        let [i, q, u, v] = p.0;
        let mix = |a: f64, b: f64| std::array::from_fn(|j| a * q[j] + b * u[j]);
        Mueller([i, mix(self.cos, self.sin), mix(self.sin, -self.cos), v.map(|x| -x)])
    }
}

#[cfg(test)]
mod tests {
    use std::{f64::consts::TAU, sync::Arc};

    use super::*;
    use crate::{
        Basis, Geometry, Mode, ParameterValue, models, optics::RefractiveIndex, special::gauss,
    };

    fn isotropic(n: f64) -> models::Model {
        let class = |name| crate::registry::find_class(name).unwrap();
        let scalar = ParameterNode::with_defaults(class("Isotropic_Phase_Function"), Mode::Sound);
        let phase = ParameterNode::with_defaults(class("Unpolarized_Phase_Function"), Mode::Sound)
            .with("phase_function", ParameterValue::Member(Arc::new(scalar)))
            .and_then(|node| node.with("log_absorption", ParameterValue::Number(-300.0)))
            .unwrap();
        let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound)
            .with("substrate", ParameterValue::Index(RefractiveIndex::constant(n, 0.0)))
            .and_then(|node| node.with("phase_function", ParameterValue::Member(Arc::new(phase))))
            .unwrap();
        models::build(&node).unwrap()
    }

    #[test]
    fn without_an_interface_it_is_chandrasekhars_law_of_single_scattering() {
        // f = 1/(4π(μ + μ₀)) for a lossless isotropic body of index 1.
        let at = Geometry { theta_i: 0.5, theta_s: 1.1, phi_s: 2.0, rotation: 0.0 };
        let f = isotropic(1.0).mueller(&at, Basis::Psps)[(0, 0)];
        let expected = 0.25 / (PI * (0.5f64.cos() + 1.1f64.cos()));
        assert!((f - expected).abs() < 1e-15);
    }

    #[test]
    fn an_isotropic_body_of_index_1_5_returns_a_twentieth_of_the_light() {
        let model = isotropic(1.5);
        // Three angles computed by a second program: four digits.
        for (theta_i, expected) in [(0.0, 0.0515), (PI / 4.0, 0.0543), (70.0 * PI / 180.0, 0.0504)]
        {
            let total = gauss::integrate(64, 0.0, 0.5 * PI, |t| {
                let at = Geometry { theta_i, theta_s: t, phi_s: 0.3, rotation: 0.0 };
                TAU * t.sin() * t.cos() * model.mueller(&at, Basis::Psps)[(0, 0)]
            });
            assert!((total - expected).abs() < 6e-5, "{theta_i}: {total}");
        }
    }

    #[test]
    fn turning_into_and_out_of_the_scattering_plane_is_its_own_inverse() {
        let k = DVec3::new(0.48, 0.6, 0.64);
        let s = perp(DVec3::Z, k);
        let turn = PlaneRotation::new(k, s, perp(k, DVec3::new(0.3, -0.2, -0.9)));
        let p = Mueller::from_row_major(std::array::from_fn(|j| (j as f64).sin()));
        assert!((turn.after(turn.after(p)) - p).largest() < 1e-15);
        assert!((turn.before(turn.before(p)) - p).largest() < 1e-15);
    }
}
