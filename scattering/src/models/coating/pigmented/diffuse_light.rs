//! Means over the diffuse light inside a pigmented coating.

use std::f64::consts::FRAC_PI_2;

use super::super::{
    cover::FlakeCover,
    doubling::DiffuseSlab,
    flakes::Flakes,
    interface::{Interface, InterfaceRay},
    interreflection::DiffuseMeans,
};
use crate::special::gauss;

/// Nodes of the integrals over the polar angle.
const NODES: usize = 96;

/// The parts of a coating that diffuse light meets.
pub(super) struct DiffuseLight<'a> {
    /// Refractive index of the binder.
    pub(super) n: f64,
    pub(super) surface: &'a Interface,
    pub(super) flakes: &'a Flakes,
    pub(super) cover: &'a FlakeCover,
    pub(super) slab: &'a DiffuseSlab,
}

impl DiffuseLight<'_> {
    /// The means over diffuse light at flakes.
    pub(super) fn means(&self) -> DiffuseMeans {
        let level = self.cover.level();
        let internal = |ray: &InterfaceRay| {
            let back = self.surface.mean_sent_back(ray.sin * self.n);
            back.scaled(self.cover.left(2.0 * level, ray.cos))
        };
        // Transmittance between flakes and body: 1 way, or 2 ways (down and up again).
        let below = |ray: &InterfaceRay, ways: i32| {
            let left = self.cover.left(f64::from(ways) * (1.0 - level), ray.cos);
            left * self.slab.shape(ray.cos).powi(ways)
        };
        let both = |(s, p): (f64, f64)| 0.5 * (s + p);
        let with = |a: (f64, f64), b: (f64, f64)| 0.5 * (a.0 * b.0 + a.1 * b.1);
        let pair = |ray: &InterfaceRay| (internal(ray).s, internal(ray).p);
        let fractions = |ray: &InterfaceRay| self.flakes.fractions(ray.sin);
        let crossing = |ray: &InterfaceRay, of: &dyn Fn(&InterfaceRay) -> (f64, f64)| {
            let (through, inside) = (self.surface.mean_passage(ray.sin), ray.below(self.n));
            with((through.s, through.p), of(&inside))
        };
        let caught = |ray: &InterfaceRay| {
            let (s, p) = fractions(ray).caught;
            let left = self.cover.left(level, ray.cos);
            (s * left, p * left)
        };
        let passed = |ray: &InterfaceRay| {
            let (s, p) = fractions(ray).passed;
            let left = self.cover.left(1.0, ray.cos) * self.slab.shape(ray.cos);
            (s * left, p * left)
        };
        DiffuseMeans {
            internal_reflectance: self.inside(|ray| both(pair(ray))),
            caught_again: self.inside(|ray| with(pair(ray), fractions(ray).caught)),
            passed_down: self.inside(|ray| with(pair(ray), fractions(ray).passed) * below(ray, 1)),
            below: self.inside(|ray| both(fractions(ray).returned) * below(ray, 2)),
            escapes: (
                self.escaping(|ray| crossing(ray, &caught)),
                self.escaping(|ray| crossing(ray, &passed)),
            ),
        }
    }

    /// Internal reflectance of the surface for an unpolarized ray, the mean over azimuths.
    pub(super) fn internal_reflectance(&self, inside: &InterfaceRay) -> f64 {
        self.surface.mean_sent_back(inside.sin * self.n).row()[0]
    }

    /// ∫ f sin 2θ dθ/n² over the angles outside: the part of diffuse light inside that leaves the
    /// coat, for f the transmittance from outside.
    pub(super) fn escaping(&self, f: impl Fn(&InterfaceRay) -> f64) -> f64 {
        let n2 = self.n * self.n;
        gauss::integrate(NODES, 0.0, FRAC_PI_2, |t| {
            f(&InterfaceRay::mean(t.sin())) * (2.0 * t).sin()
        }) / n2
    }

    /// ∫ f sin 2θ' dθ' over the angles inside: the mean of f over diffuse light. The integral is split
    /// at the critical angle.
    pub(super) fn inside(&self, f: impl Fn(&InterfaceRay) -> f64) -> f64 {
        let n2 = self.n * self.n;
        let kink = n2.min(1.0);
        let piece = |from: f64, to: f64| {
            gauss::integrate(NODES, 0.0, FRAC_PI_2, |t| {
                let sin2 = (from + (to - from) * t.sin().powi(2)) / n2;
                f(&InterfaceRay::mean(sin2.sqrt().min(1.0))) * (2.0 * t).sin()
            }) * (to - from)
                / n2
        };
        piece(0.0, kink) + if n2 > kink { piece(kink, n2) } else { 0.0 }
    }
}
