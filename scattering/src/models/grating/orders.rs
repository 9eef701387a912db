//! Diffracted orders as cones: what line and crossed gratings share as BRDF models.
//!
//! $$ \mathbf F = \sum_i \frac{\mathbf R_i}{\pi\alpha^2\cos\theta_s}
//! \quad\text{over the orders with}\quad \hat v_i\cdot\hat v \ge \cos\alpha $$
//!
//! R_i is the Mueller matrix of the diffraction efficiency, v_i the direction of the order, v that
//! of scattering, α (`alpha`) the half angle of the cone in radians.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use glam::DVec3;
use num_complex::Complex64;

use super::{cone::OrderCone, convergence::ConvergenceCheck};
use crate::{
    Direction, Incidence, Mueller, ParameterError, ParameterNode, Side,
    grating::positive,
    models::{Brdf, CommonParameters, LobeSupport},
    rcw::{IncidentWave, PeriodicStructure},
};

/// Largest number of harmonics of a problem; the matrices have its square elements.
const MOST_HARMONICS: usize = 1500;

/// The order `name` of a truncation.
pub(super) fn order(node: &ParameterNode, name: &str) -> Result<usize, ParameterError> {
    let order = node.integer(name);
    usize::try_from(order)
        .map_err(|_| ParameterError::new(name, format!("{order} is not 0 or greater")))
}

/// An error at `name` if there are too many harmonics.
pub(super) fn bounded(name: &str, harmonics: Option<usize>) -> Result<usize, ParameterError> {
    harmonics
        .filter(|n| *n <= MOST_HARMONICS)
        .ok_or_else(|| ParameterError::new(name, format!("more than {MOST_HARMONICS} harmonics")))
}

/// The cone's half angle `alpha`.
pub(super) fn half_angle(node: &ParameterNode) -> Result<f64, ParameterError> {
    let alpha = positive(node, "alpha")?;
    if alpha <= std::f64::consts::FRAC_PI_2 {
        return Ok(alpha);
    }
    Err(ParameterError::new("alpha", format!("{alpha} is more than a right angle")))
}

/// Errors unless the grating lies between vacuum and the substrate.
pub(super) fn media(
    common: &CommonParameters,
    above: Complex64,
    below: Complex64,
) -> Result<(), ParameterError> {
    if below != common.substrate {
        let problem = format!("{below} is not the substrate's index {}", common.substrate);
        return Err(ParameterError::new("grating.medium_t", problem));
    }
    if above != Complex64::ONE {
        let problem = format!("{above} is not 1: the model is lit from vacuum");
        return Err(ParameterError::new("grating.medium_i", problem));
    }
    Ok(())
}

/// A grating whose orders are cones.
pub(super) struct OrderConeModel {
    common: CommonParameters,
    /// The structure as the incident light meets it.
    structure: PeriodicStructure,
    /// The same with other harmonics, in sound runs.
    check: Option<ConvergenceCheck>,
    alpha: f64,
    cos_alpha: f64,
    /// A beam without a wave vector across the lines gets a small one.
    leans: bool,
    recent: Mutex<Vec<CachedOrders>>,
}

/// Sine across the lines that NIST's library gives to a beam without one.
const LEANING: f64 = 1e-7;

/// Number of beams whose orders are cached; a run uses a few beams many times.
const KEPT: usize = 32;

type SharedOrders = Arc<OnceLock<Vec<OrderCone>>>;

/// The orders of one beam, computed at the first use.
struct CachedOrders {
    theta: f64,
    rotation: f64,
    orders: SharedOrders,
}

impl OrderConeModel {
    /// `structure` and that of `check` as lit from above; they are turned over for light from the substrate.
    pub(super) fn new(
        common: CommonParameters,
        structure: PeriodicStructure,
        check: Option<ConvergenceCheck>,
        alpha: f64,
    ) -> Self {
        let lit = |structure: PeriodicStructure| {
            if common.side.from_below() { turned_over(structure) } else { structure }
        };
        let structure = lit(structure);
        let check = check.map(|mut check| {
            check.structure = lit(check.structure);
            check
        });
        Self {
            common,
            structure,
            check,
            alpha,
            cos_alpha: alpha.cos(),
            leans: false,
            recent: Mutex::default(),
        }
    }

    /// The same with NIST's beam at normal incidence, which leans by 10⁻⁷ across the lines and has
    /// its polarization in that plane ([`Defect::LineNormalBasis`](crate::Defect::LineNormalBasis)).
    pub(super) fn with_leaning_beam(self) -> Self {
        Self { leans: true, ..self }
    }

    fn orders(&self, incidence: &Incidence) -> SharedOrders {
        // A panic while the list was locked leaves a usable list.
        let mut recent = self.recent.lock().unwrap_or_else(PoisonError::into_inner);
        let (theta, rotation) = (incidence.theta(), incidence.rotation());
        if let Some(known) = recent.iter().find(|r| r.theta == theta && r.rotation == rotation) {
            return known.orders.clone();
        }
        if recent.len() == KEPT {
            recent.remove(0);
        }
        let orders = SharedOrders::default();
        recent.push(CachedOrders { theta, rotation, orders: orders.clone() });
        orders
    }

    fn cones(&self, incidence: &Incidence) -> Vec<OrderCone> {
        let cones = self.cones_of(&self.structure, incidence);
        if let Some(check) = &self.check {
            check.compare(&cones, &self.cones_of(&check.structure, incidence));
        }
        cones
    }

    fn cones_of(&self, structure: &PeriodicStructure, incidence: &Incidence) -> Vec<OrderCone> {
        let index = structure.incident;
        let lateral = incidence.to_sample(index * incidence.sin, 0.0);
        let normal_s = incidence.to_sample(0.0, 1.0);
        let wave = if self.leans && lateral.0.abs() < LEANING * index {
            let (x, y) = (LEANING, lateral.1 / index);
            let cos = (1.0 - x * x - y * y).sqrt();
            IncidentWave { lateral: (x * index, lateral.1), cos, normal_s }
        } else {
            IncidentWave { lateral, cos: incidence.cos, normal_s }
        };
        let side = self.common.side;
        let behind = matches!(side, Side::DownDown | Side::UpUp);
        let (sin, cos) = (incidence.sin_rotation, incidence.cos_rotation);
        let scale = 1.0 / (std::f64::consts::PI * self.alpha * self.alpha);
        structure
            .diffract(&wave, behind)
            .iter()
            .map(|order| {
                let (x, y) = order.lateral;
                // Turned over, p has the other sign on both sides.
                let jones = if side.from_below() { order.jones.flipped() } else { order.jones };
                OrderCone {
                    axis: DVec3::new(x * cos - y * sin, y * cos + x * sin, order.cos),
                    mueller: jones.mueller() * scale,
                }
            })
            .collect()
    }

    fn sum(&self, cones: &[OrderCone], direction: &Direction) -> Mueller {
        let v = direction.k();
        let mut sum = Mueller::ZERO;
        for cone in cones.iter().filter(|cone| cone.axis.dot(v) >= self.cos_alpha) {
            sum += cone.mueller * (1.0 / direction.cos);
        }
        sum
    }
}

/// The structure as light from the substrate meets it.
fn turned_over(structure: PeriodicStructure) -> PeriodicStructure {
    PeriodicStructure {
        layers: structure.layers.into_iter().rev().collect(),
        incident: structure.behind.re,
        behind: structure.incident.into(),
        ..structure
    }
}

impl Brdf for OrderConeModel {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn lobe_supports(&self, incidence: &Incidence) -> Vec<LobeSupport> {
        let orders = self.orders(incidence);
        let cones = orders.get_or_init(|| self.cones(incidence));
        cones.iter().map(|cone| LobeSupport { axis: cone.axis, half_angle: self.alpha }).collect()
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let orders = self.orders(incidence);
        self.sum(orders.get_or_init(|| self.cones(incidence)), direction)
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let orders = self.orders(incidence);
        let cones = orders.get_or_init(|| self.cones(incidence));
        for (m, direction) in out.iter_mut().zip(directions) {
            *m = self.sum(cones, direction);
        }
    }
}
