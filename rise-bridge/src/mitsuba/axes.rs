//! The nodes of a table in half and difference angles, and their directions.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::frame::HalfAngles;
use crate::export::ExportError;

/// The lowest z of a direction; nodes below it are evaluated at this height.
pub const LOWEST: f64 = 0.02;
/// Replaces θ_d = 0 and θ_h = 0, where directions have no azimuth; radians.
const OFF_AXIS: f64 = 1e-4;
/// Maximum number of nodes per axis.
const MAX_NODES: usize = 4096;

/// Nodes in radians, rising; they are 32-bit numbers, as the file holds them.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfAngleAxes {
    /// From −π to π, both included.
    pub phi_d: Vec<f32>,
    /// From 0 to π/2.
    pub theta_d: Vec<f32>,
    /// From 0 to π/2.
    pub theta_h: Vec<f32>,
}

impl HalfAngleAxes {
    /// Axes with `counts` nodes of φ_d, θ_d and θ_h; θ_h is quadratic, (i/(n − 1))²·π/2, or uniform.
    ///
    /// # Errors
    ///
    /// If an axis has fewer than 2 or more than 4096 nodes.
    pub fn new(counts: [usize; 3], uniform: bool) -> Result<Self, ExportError> {
        if counts.iter().any(|n| !(2..=MAX_NODES).contains(n)) {
            let problem = format!("every axis has from 2 to {MAX_NODES} nodes, not {counts:?}");
            return Err(ExportError::refused("grid", problem));
        }
        let part = |n: usize| (0..n).map(move |i| i as f64 / (n - 1) as f64);
        let polar = |part: f64| (part * FRAC_PI_2) as f32;
        Ok(Self {
            phi_d: part(counts[0]).map(|x| ((2.0 * x - 1.0) * PI) as f32).collect(),
            theta_d: part(counts[1]).map(polar).collect(),
            theta_h: part(counts[2]).map(|x| polar(if uniform { x } else { x * x })).collect(),
        })
    }

    /// Parses numbers of nodes such as `37x46x91` (φ_d, θ_d, θ_h).
    ///
    /// # Errors
    ///
    /// If the text has another form, and as [`HalfAngleAxes::new`].
    pub fn parse(text: &str, uniform: bool) -> Result<Self, ExportError> {
        let numbers: Result<Vec<usize>, _> =
            text.split('x').map(|word| word.trim().parse()).collect();
        match numbers.as_deref() {
            Ok(&[phi_d, theta_d, theta_h]) => Self::new([phi_d, theta_d, theta_h], uniform),
            _ => {
                let problem = format!(
                    "{text:?}: expected the numbers of nodes of phi_d, theta_d and theta_h, such \
                     as 37x46x91"
                );
                Err(ExportError::refused("grid", problem))
            }
        }
    }

    /// Nodes per axis: φ_d, θ_d, θ_h.
    pub fn counts(&self) -> [usize; 3] {
        [self.phi_d.len(), self.theta_d.len(), self.theta_h.len()]
    }

    /// The number of nodes.
    pub fn nodes(&self) -> usize {
        self.counts().iter().product()
    }

    /// The angles of the node `[i, j, k]`.
    pub fn node(&self, [i, j, k]: [usize; 3]) -> HalfAngles {
        HalfAngles {
            phi_d: self.phi_d[i].into(),
            theta_d: self.theta_d[j].into(),
            theta_h: self.theta_h[k].into(),
        }
    }
}

/// The directions (l, v) at which a material is evaluated for the node `at`.
///
/// Nodes without azimuth are moved by 10⁻⁴ rad; a direction below [`LOWEST`] is raised to it at its
/// azimuth.
pub fn node_directions(at: &HalfAngles) -> (DVec3, DVec3) {
    let moved =
        HalfAngles { theta_d: at.theta_d.max(OFF_AXIS), theta_h: at.theta_h.max(OFF_AXIS), ..*at };
    let (l, v) = moved.directions();
    (lifted(l), lifted(v))
}

/// The direction `w`, raised to [`LOWEST`] at its azimuth if it is lower.
pub fn lifted(w: DVec3) -> DVec3 {
    if w.z >= LOWEST {
        return w;
    }
    let horizontal = w.truncate().try_normalize().unwrap_or(glam::DVec2::X);
    (horizontal * (1.0 - LOWEST * LOWEST).sqrt()).extend(LOWEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn azimuths_reach_both_ends_and_half_angles_are_dense_at_the_normal() {
        let axes = HalfAngleAxes::parse("37x46x91", false).unwrap();
        assert_eq!(axes.counts(), [37, 46, 91]);
        assert_eq!((axes.phi_d[0], axes.phi_d[36]), (-(PI as f32), PI as f32));
        assert_eq!(axes.phi_d[18], 0.0);
        assert_eq!(axes.theta_h[90], FRAC_PI_2 as f32);
        assert!(axes.theta_h[1] < 2e-4 && axes.theta_h[90] - axes.theta_h[89] > 0.03);
        assert!(HalfAngleAxes::parse("37x46", false).is_err());
        assert!(HalfAngleAxes::parse("37x1x91", false).is_err());
        assert!(HalfAngleAxes::parse("37x46x1e9", true).is_err());
    }

    #[test]
    fn every_node_has_two_directions_above_the_horizon() {
        let axes = HalfAngleAxes::parse("5x4x4", true).unwrap();
        for i in 0..5 {
            for j in 0..4 {
                for k in 0..4 {
                    let (l, v) = node_directions(&axes.node([i, j, k]));
                    for w in [l, v] {
                        assert!(w.z >= LOWEST && (w.length() - 1.0).abs() < 1e-12, "{w}");
                    }
                }
            }
        }
    }
}
