//! The ways of light to the pixels of a row: over one point of the body or over two.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use scattering::{Mueller, Stokes};

use super::{
    LampBasis, Scene,
    random::Random,
    shape::{Hit, Ray, leaving},
    turn::Turn,
};

/// Half the side of what the camera sees.
const HALF_VIEW: f64 = 1.0;
/// Where its rays start.
const FAR: f64 = 10.0;
const TO_CAMERA: DVec3 = DVec3::Z;

/// One way of light.
#[derive(Debug)]
pub(super) struct Path {
    /// Column.
    pub(super) pixel: usize,
    /// What its Stokes vector counts for.
    pub(super) weight: f64,
    /// The pair of directions at the point that the camera sees.
    last: usize,
    /// The pair at the point before, and the turn from there.
    before: Option<(usize, Turn)>,
    /// From the basis of the lamp to the first point; light of the sky has no polarization.
    lamp: Option<Turn>,
    camera: Turn,
}

impl Path {
    /// The Stokes vector at the camera, for the `matrices` of all pairs and the `light` of lamps.
    pub(super) fn seen(&self, matrices: &[Mueller], light: Stokes) -> Stokes {
        let mut stokes = self.lamp.map_or(Stokes::UNPOLARIZED, |turn| turn.apply(light));
        if let Some((pair, turn)) = self.before {
            stokes = turn.apply(matrices[pair] * stokes);
        }
        self.camera.apply(matrices[self.last] * stokes)
    }
}

/// All ways of light to a row of pixels.
#[derive(Debug, Default)]
pub(super) struct Row {
    /// Directions (to where the light comes from, to where it goes) in the frames of the surface.
    pub(super) pairs: Vec<(DVec3, DVec3)>,
    pub(super) paths: Vec<Path>,
}

impl Row {
    /// The ways of light to the pixels of row `y`, from the top.
    pub(super) fn trace(scene: &Scene, y: usize) -> Self {
        let mut row = Self::default();
        for x in 0..scene.size[0] {
            for sample in 0..scene.samples {
                row.sample(scene, [x, y], Random::new(x, y, sample));
            }
        }
        row
    }

    fn sample(&mut self, scene: &Scene, [x, y]: [usize; 2], random: Random) {
        let [width, height] = scene.size.map(|n| n as f64);
        let [dx, dy] = random.pair(0);
        let unit = 2.0 * HALF_VIEW / width.min(height);
        let across = (x as f64 + dx - 0.5 * width) * unit;
        let up = (0.5 * height - y as f64 - dy) * unit;
        let ray = Ray { from: DVec3::new(across, up, FAR), along: -TO_CAMERA };
        let Some(point) = scene.shape.hit(ray).and_then(Point::new) else { return };
        let seen = Seen { point: &point, pixel: x, weight: PI / scene.samples as f64 };
        for light in lit(scene, &point, random, 1) {
            let lamp = light.turn(scene, &point);
            self.push(&seen, light.weight, light.toward, None, Some(lamp));
        }
        if scene.sky > 0.0 || scene.bounce {
            self.around(scene, &seen, random);
        }
    }

    /// What comes from one direction that is not a lamp's: the sky, or another point.
    fn around(&mut self, scene: &Scene, seen: &Seen<'_>, random: Random) {
        let point = seen.point;
        let toward = point.cosine_direction(random.pair(100));
        if toward.dot(point.hit.true_normal) <= 0.0 {
            return;
        }
        match scene.shape.hit(leaving(&point.hit, toward)) {
            None if scene.sky > 0.0 => {
                // ∫ f L cos dω by a density cos/π, for L = sky/π.
                self.push(seen, scene.sky, toward, None, None);
            }
            Some(other) if scene.bounce => {
                let Some(other) = Point::new(other) else { return };
                for light in lit(scene, &other, random, 200) {
                    let first = self.pair(&other, light.toward, -toward);
                    let leaving = other.s(-toward, light.toward);
                    let turn = Turn::between(-toward, leaving, point.s(-toward, toward));
                    let lamp = light.turn(scene, &other);
                    self.push(seen, PI * light.weight, toward, Some((first, turn)), Some(lamp));
                }
            }
            _ => {}
        }
    }

    /// Adds the way of light from `toward` over the point that is seen to the camera.
    fn push(
        &mut self,
        seen: &Seen<'_>,
        weight: f64,
        toward: DVec3,
        before: Option<(usize, Turn)>,
        lamp: Option<Turn>,
    ) {
        let last = self.pair(seen.point, toward, TO_CAMERA);
        let camera = Turn::between(TO_CAMERA, seen.point.s(TO_CAMERA, toward), DVec3::X);
        let weight = seen.weight * weight;
        self.paths.push(Path { pixel: seen.pixel, weight, last, before, lamp, camera });
    }

    fn pair(&mut self, point: &Point, source: DVec3, viewer: DVec3) -> usize {
        self.pairs.push((point.local(source), point.local(viewer)));
        self.pairs.len() - 1
    }
}

/// What the ways of light over one sample of a pixel have in common.
struct Seen<'a> {
    point: &'a Point,
    pixel: usize,
    weight: f64,
}

/// A direction from which a lamp lights a point, and E cos θ_i there.
struct Light {
    toward: DVec3,
    weight: f64,
}

impl Light {
    /// From the basis of the lamp to that of the plane of incidence.
    fn turn(&self, scene: &Scene, point: &Point) -> Turn {
        match scene.light_basis {
            LampBasis::PlaneOfIncidence => Turn::NONE,
            LampBasis::Horizontal => {
                let k = -self.toward;
                let horizontal = DVec3::Y.cross(k).try_normalize().unwrap_or(DVec3::X);
                Turn::between(k, horizontal, point.s(k, self.toward))
            }
        }
    }
}

/// The lamps that reach a point; `dimension` tells random numbers apart.
fn lit(
    scene: &Scene,
    point: &Point,
    random: Random,
    dimension: u64,
) -> impl Iterator<Item = Light> {
    scene.lamps.iter().enumerate().filter_map(move |(number, lamp)| {
        let toward = if lamp.radius == 0.0 {
            lamp.toward
        } else {
            on_disc(lamp.toward, lamp.radius, random.pair(dimension + number as u64))
        };
        let cos = toward.dot(point.hit.normal);
        let is_lit = cos > 0.0
            && toward.dot(point.hit.true_normal) > 0.0
            && !scene.shape.shades(&point.hit, toward);
        is_lit.then_some(Light { toward, weight: lamp.irradiance * cos })
    })
}

/// A direction in the cone around `axis`, of equal density over its solid angle.
fn on_disc(axis: DVec3, radius: f64, [a, b]: [f64; 2]) -> DVec3 {
    let cos = 1.0 - a * (1.0 - radius.cos());
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let (x, y) = axis.any_orthonormal_pair();
    let (sin_phi, cos_phi) = (TAU * b).sin_cos();
    (sin * cos_phi * x + sin * sin_phi * y + cos * axis).normalize()
}

/// A point of the body with its frame: x the fiducial axis (horizontal), z the normal.
struct Point {
    hit: Hit,
    x: DVec3,
    y: DVec3,
}

impl Point {
    /// The frame of a point that is seen from outside.
    fn new(hit: Hit) -> Option<Self> {
        let x = DVec3::Y.cross(hit.normal).try_normalize().unwrap_or(DVec3::X);
        let is_sound = hit.normal.is_finite() && hit.true_normal.is_finite();
        is_sound.then(|| Self { hit, x, y: hit.normal.cross(x) })
    }

    fn local(&self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.x), v.dot(self.y), v.dot(self.hit.normal))
    }

    /// s of a beam along `k` in the plane of `source`: n × k, or its limit where k is along n.
    fn s(&self, k: DVec3, source: DVec3) -> DVec3 {
        let n = self.hit.normal;
        let forward = source.dot(n) * n - source;
        let limit = || n.cross(forward).try_normalize().unwrap_or(self.y);
        n.cross(k).try_normalize().unwrap_or_else(limit)
    }

    /// A direction with the density cos θ/π.
    fn cosine_direction(&self, [a, b]: [f64; 2]) -> DVec3 {
        let (sin_phi, cos_phi) = (TAU * b).sin_cos();
        let (sin, cos) = (a.sqrt(), (1.0 - a).sqrt());
        sin * cos_phi * self.x + sin * sin_phi * self.y + cos * self.hit.normal
    }
}
