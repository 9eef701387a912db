//! The nodes of a table of half and difference angles, and the directions that stand for them.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::frame::HalfAngles;
use crate::export::ExportError;

/// Directions lower than this z are lifted to it: the nodes there are filled.
pub const LOWEST: f64 = 0.02;
/// In the place of θ_d = 0 and θ_h = 0, where directions lose their azimuth; radians.
const AWAY: f64 = 1e-4;
/// Nodes of one axis, at most.
const MOST: usize = 4096;

/// Nodes in radians, rising; they are 32-bit numbers, as the file holds them.
#[derive(Clone, Debug, PartialEq)]
pub struct Axes {
    /// From −π to π, both included.
    pub phi_d: Vec<f32>,
    /// From 0 to π/2.
    pub theta_d: Vec<f32>,
    /// From 0 to π/2.
    pub theta_h: Vec<f32>,
}

impl Axes {
    /// So many nodes per axis; θ_h quadratic (i/(n − 1))²·π/2, or evenly spaced.
    ///
    /// # Errors
    ///
    /// For axes of less than two nodes or absurdly many.
    pub fn new(counts: [usize; 3], uniform: bool) -> Result<Self, ExportError> {
        if counts.iter().any(|n| !(2..=MOST).contains(n)) {
            let problem = format!("every axis has from 2 to {MOST} nodes, not {counts:?}");
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

    /// From `37x46x91`: the nodes of φ_d, θ_d and θ_h.
    ///
    /// # Errors
    ///
    /// For other texts, and as [`Axes::new`].
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

    /// All nodes.
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

/// The directions (l, v) in which a material is asked for the node `at`.
///
/// Where they have no azimuth the node stands aside by 10⁻⁴ rad; a direction that is lower than
/// [`LOWEST`] is lifted to it at its azimuth.
pub fn asked_directions(at: &HalfAngles) -> (DVec3, DVec3) {
    let aside = HalfAngles { theta_d: at.theta_d.max(AWAY), theta_h: at.theta_h.max(AWAY), ..*at };
    let (l, v) = aside.directions();
    (lifted(l), lifted(v))
}

/// `w` at its azimuth, but not lower than [`LOWEST`].
pub fn lifted(w: DVec3) -> DVec3 {
    if w.z >= LOWEST {
        return w;
    }
    let level = w.truncate().try_normalize().unwrap_or(glam::DVec2::X);
    (level * (1.0 - LOWEST * LOWEST).sqrt()).extend(LOWEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn azimuths_reach_both_ends_and_half_angles_are_dense_at_the_normal() {
        let axes = Axes::parse("37x46x91", false).unwrap();
        assert_eq!(axes.counts(), [37, 46, 91]);
        assert_eq!((axes.phi_d[0], axes.phi_d[36]), (-(PI as f32), PI as f32));
        assert_eq!(axes.phi_d[18], 0.0);
        assert_eq!(axes.theta_h[90], FRAC_PI_2 as f32);
        assert!(axes.theta_h[1] < 2e-4 && axes.theta_h[90] - axes.theta_h[89] > 0.03);
        assert!(Axes::parse("37x46", false).is_err());
        assert!(Axes::parse("37x1x91", false).is_err());
        assert!(Axes::parse("37x46x1e9", true).is_err());
    }

    #[test]
    fn every_node_has_two_directions_above_the_horizon() {
        let axes = Axes::parse("5x4x4", true).unwrap();
        for i in 0..5 {
            for j in 0..4 {
                for k in 0..4 {
                    let (l, v) = asked_directions(&axes.node([i, j, k]));
                    for w in [l, v] {
                        assert!(w.z >= LOWEST && (w.length() - 1.0).abs() < 1e-12, "{w}");
                    }
                }
            }
        }
    }
}
