//! The directions that stand for a patch, with weights that sum to its mean.
//!
//! Patches are integrated adaptively. With a [`PlaneSampling`] cones, annuli
//! and polygons are laid out as the grids of programs, and cells and rings of grids are products of
//! Gauss–Legendre rules in θ and φ with cos θ sin θ in the weights.

use std::f64::consts::PI;

use scattering::{
    Basis, Direction, Incidence, Model, Mueller, polarization::DirectionWeights, special::gauss,
};

use crate::{
    region::{PolarAngles, PolarCell, Region, RegionError, unit},
    request::Patch,
    sampling::{
        Layout, PlaneSampling, Scale, Scratch,
        adaptive::{self, Accuracy, AdaptiveError, Domain, KnownPeaks},
        sensitivity_rotation::SensitivityRotation,
    },
};

/// Directions that are evaluated at a time.
const BATCH: usize = 128;
/// Directions of a piece of work.
const PIECE: usize = 2048;
/// Azimuths of a ring.
const RING: usize = 360;
/// About how many directions an adaptive patch has, at least.
const ADAPTIVE: usize = 64;
/// Accuracy of adaptive patches.
pub(super) const ACCURACY: Accuracy = Accuracy { budget: 400_000, ..Accuracy::DEFAULT };

/// The directions of many patches, one after the other.
#[derive(Debug, Default)]
pub(super) struct Probes {
    directions: Vec<Direction>,
    weights: DirectionWeights,
    /// Per patch the end of its directions.
    ends: Vec<usize>,
    /// Per patch its solid angle, if it is integrated adaptively: it has no directions then.
    domains: Vec<Option<Domain>>,
    /// Per patch about how many directions it and those before it have.
    costs: Vec<usize>,
    /// Per patch its projected solid angle, sr.
    pub(super) omegas: Vec<f64>,
}

/// Means of neighbouring patches.
pub(super) struct PatchMeans {
    pub(super) matrices: Vec<Mueller>,
    /// The patch that missed its tolerance by most, and the relative error reached.
    pub(super) unmet: Option<(usize, f64)>,
}

impl Probes {
    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    /// Number of directions of all patches that have some.
    pub(super) fn directions(&self) -> usize {
        self.directions.len()
    }

    /// About how many directions are evaluated, at least.
    pub(super) fn cost(&self) -> usize {
        self.costs.last().copied().unwrap_or(0)
    }

    /// Adds a patch around `center` (radians), laid out in `plane` or adaptive.
    pub(super) fn add(
        &mut self,
        center: PolarAngles,
        patch: &Patch,
        plane: Option<&PlaneSampling>,
    ) -> Result<(), RegionError> {
        if *patch == Patch::Point {
            self.push(Direction::new(center.0, center.1), 1.0, [1.0, 0.0]);
            self.finish(0.0);
            return Ok(());
        }
        let region = patch.region(center);
        match plane {
            Some(plane) => self.add_region(&region, plane),
            None => {
                let omega = region.projected_solid_angle();
                self.add_domain(Domain::region(region)?, omega);
                Ok(())
            }
        }
    }

    fn add_domain(&mut self, domain: Domain, omega: f64) {
        self.finish(omega);
        self.domains.pop();
        self.domains.push(Some(domain));
        if let Some(cost) = self.costs.last_mut() {
            *cost += ADAPTIVE;
        }
    }

    /// Adds a cell of a grid, as a product of rules or adaptive.
    pub(super) fn add_cell(&mut self, cell: PolarCell, is_adaptive: bool) {
        match cell.center {
            _ if is_adaptive => self.add_domain(Domain::Cell(cell), cell.projected_solid_angle()),
            Some(center) => self.add_product(&cell, center),
            None => self.add_ring(cell.theta),
        }
    }

    fn add_region(&mut self, region: &Region, plane: &PlaneSampling) -> Result<(), RegionError> {
        let layout = Layout::new(region, plane, None)?;
        let start = self.weights.count();
        let mut scratch = Scratch::default();
        for k in 0..layout.chunks() {
            let chunk = layout.chunk(k, &mut scratch);
            self.directions.extend(&chunk.directions);
            self.weights.extend(&chunk.weights);
        }
        let omega = region.projected_solid_angle();
        let factor = match layout.scale() {
            Scale::Fixed(factor) => factor / omega,
            Scale::Normalized(area) => area / omega / self.sum(start),
        };
        self.scale(start, factor);
        self.finish(omega);
        Ok(())
    }

    /// Adds a cell of a grid; its polarization is carried along from its centre.
    fn add_product(&mut self, cell: &PolarCell, center: PolarAngles) {
        let turn = SensitivityRotation::towards(center);
        let nodes = |(a, b): (f64, f64)| {
            let n = ((b - a).to_degrees().ceil() as usize + 2).clamp(3, 24);
            gauss::legendre(n, a, b)
        };
        let (thetas, phis) = (nodes(cell.theta), nodes(cell.phi));
        let start = self.weights.count();
        for &(theta, w) in &thetas {
            for &(phi, wp) in &phis {
                let weight = w * wp * theta.sin() * theta.cos();
                let turned = turn.at(unit((theta, phi)).to_array());
                self.push(Direction::new(theta, phi), weight, turned);
            }
        }
        self.normalize(start);
        self.finish(cell.projected_solid_angle());
    }

    /// Adds the ring between two polar angles (radians); each direction keeps its own s and p.
    fn add_ring(&mut self, theta: (f64, f64)) {
        let start = self.weights.count();
        let n = ((theta.1 - theta.0).to_degrees().ceil() as usize + 2).clamp(3, 24);
        for (theta, w) in gauss::legendre(n, theta.0, theta.1) {
            for k in 0..RING {
                let phi = 2.0 * PI * k as f64 / RING as f64 - PI;
                self.push(Direction::new(theta, phi), w * theta.sin() * theta.cos(), [1.0, 0.0]);
            }
        }
        self.normalize(start);
        let ring = PolarCell { theta, phi: (-PI, PI), center: None };
        self.finish(ring.projected_solid_angle());
    }

    fn push(&mut self, direction: Direction, weight: f64, turned: [f64; 2]) {
        self.directions.push(direction);
        self.weights.push(weight, turned);
    }

    fn sum(&self, start: usize) -> f64 {
        self.weights.weight[start..].iter().sum()
    }

    fn normalize(&mut self, start: usize) {
        let sum = self.sum(start);
        self.scale(start, 1.0 / sum);
    }

    fn scale(&mut self, start: usize, factor: f64) {
        self.weights.weight[start..].iter_mut().for_each(|weight| *weight *= factor);
    }

    fn finish(&mut self, omega: f64) {
        let start = self.ends.last().copied().unwrap_or(0);
        let cost = self.cost() + self.directions.len() - start;
        self.ends.push(self.directions.len());
        self.domains.push(None);
        self.costs.push(cost);
        self.omegas.push(omega);
    }

    /// Ranges of patches that make good pieces of work; they depend on nothing else.
    pub(super) fn pieces(&self) -> Vec<(usize, usize)> {
        let (mut pieces, mut first, mut start) = (Vec::new(), 0, 0);
        for (at, &end) in self.costs.iter().enumerate() {
            if end - start >= PIECE || at + 1 == self.costs.len() {
                pieces.push((first, at + 1));
                (first, start) = (at + 1, end);
            }
        }
        pieces
    }

    /// The mean Mueller BRDF (1/sr) of every patch from `first` to before `last`; nothing once `stop`
    /// says so.
    pub(super) fn means(
        &self,
        beam: (&Model, &Incidence, Basis),
        (first, last): (usize, usize),
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Option<PatchMeans> {
        let mut matrices = self.means_of_directions(beam, (first, last));
        let mut unmet: Option<(usize, f64)> = None;
        let mut peaks = None;
        for (at, domain) in self.domains[first..last].iter().enumerate() {
            let Some(domain) = domain else { continue };
            let peaks = peaks.get_or_insert_with(|| KnownPeaks::find(beam.0, beam.1, beam.2));
            matrices[at] = match adaptive::over(beam, domain, peaks, &ACCURACY, stop) {
                Ok(found) => {
                    let reached = found.relative_error();
                    if reached > unmet.map_or(ACCURACY.tolerance, |(_, worst)| worst) {
                        unmet = Some((first + at, reached));
                    }
                    found.matrix * (1.0 / self.omegas[first + at])
                }
                Err(AdaptiveError::Stopped) => return None,
                Err(_) => Mueller::ZERO * f64::NAN,
            };
        }
        Some(PatchMeans { matrices, unmet })
    }

    /// The means of the patches that have directions.
    fn means_of_directions(
        &self,
        (model, incidence, basis): (&Model, &Incidence, Basis),
        (first, last): (usize, usize),
    ) -> Vec<Mueller> {
        let weights = self.weights.signed(model.turn_sign());
        let mut means = vec![Mueller::ZERO; last - first];
        let mut at = if first == 0 { 0 } else { self.ends[first - 1] };
        let (end, mut patch) = (self.ends[last - 1], first);
        let mut matrices = [Mueller::ZERO; BATCH];
        while at < end {
            let count = BATCH.min(end - at);
            let matrices = &mut matrices[..count];
            model.evaluate(incidence, &self.directions[at..at + count], basis, matrices);
            for (offset, m) in matrices.iter().enumerate() {
                while at + offset >= self.ends[patch] {
                    patch += 1;
                }
                weights.add(at + offset, m, &mut means[patch - first]);
            }
            at += count;
        }
        means
    }
}

/// The Voronoi intervals of `nodes` (degrees, rising) in 0…90.
pub(super) fn polar_cells(nodes: &[f64]) -> Vec<(f64, f64)> {
    let middle = |a: f64, b: f64| (0.5 * (a + b)).clamp(0.0, 90.0);
    (0..nodes.len())
        .map(|k| {
            let low = if k == 0 { 0.0 } else { middle(nodes[k - 1], nodes[k]) };
            let high = nodes.get(k + 1).map_or(90.0, |next| middle(nodes[k], *next));
            (low, high)
        })
        .collect()
}

/// The Voronoi intervals of `nodes` (degrees) on the circle; with `mirror`, their mirror images
/// at −φ are nodes too.
pub(super) fn azimuth_cells(nodes: &[f64], mirror: bool) -> Vec<(f64, f64)> {
    let images = nodes.iter().filter(|_| mirror).map(|phi| -phi);
    let mut all: Vec<f64> =
        nodes.iter().copied().chain(images).map(|x| x.rem_euclid(360.0)).collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    let around = |phi: f64| {
        let phi = phi.rem_euclid(360.0);
        let distance = |other: f64| (other - phi).rem_euclid(360.0);
        let gaps = all.iter().map(|other| distance(*other));
        let gaps: Vec<f64> = gaps.filter(|gap| *gap > 1e-9 && *gap < 360.0 - 1e-9).collect();
        let after = gaps.iter().copied().fold(360.0, f64::min);
        let before = gaps.iter().map(|gap| 360.0 - gap).fold(360.0, f64::min);
        (before, after)
    };
    nodes
        .iter()
        .map(|&phi| {
            let (before, after) = around(phi);
            (phi - 0.5 * before, phi + 0.5 * after)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cells_of_a_mirrored_grid_cover_the_hemisphere_with_their_images() {
        let phis = [0.0, 10.0, 45.0, 100.0, 180.0];
        let mut sum = 0.0;
        for theta in polar_cells(&[5.0, 20.0, 90.0]) {
            for (phi, cell) in phis.iter().zip(azimuth_cells(&phis, true)) {
                let twice = if *phi == 0.0 || *phi == 180.0 { 1.0 } else { 2.0 };
                let rad = |(a, b): (f64, f64)| (a.to_radians(), b.to_radians());
                let (low, high) = rad(cell);
                let cell = PolarCell { theta: rad(theta), phi: (low, high), center: None };
                sum += twice * cell.projected_solid_angle();
            }
        }
        assert!((sum - PI).abs() < 1e-14, "{sum}");
    }

    #[test]
    fn the_two_ends_of_the_circle_are_one_direction() {
        let cells = azimuth_cells(&[-180.0, -90.0, 0.0, 90.0, 180.0], false);
        assert_eq!(cells[0], (-225.0, -135.0));
        assert_eq!(cells[4], (135.0, 225.0));
        assert_eq!(azimuth_cells(&[0.0], true), [(-180.0, 180.0)]);
    }
}
