//! The ways of light to the pixels of a row: over one point of the body or over two.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use scattering::{Mueller, Stokes};
use spectra::Xyz;

use super::{
    LampBasis, Scene,
    frame::Frame,
    points::{DistantLamps, SurfacePoint},
    random::Random,
    response::Response,
    shape::{Hit, Ray, leaving},
    turn::Turn,
};

/// Half the side of what the camera sees.
const HALF_VIEW: f64 = 1.0;
/// Where its rays start.
const FAR: f64 = 10.0;
const TO_CAMERA: DVec3 = DVec3::Z;

/// How the camera sees a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) to_camera: DVec3,
    /// Unit vector across the beam that is horizontal in the picture: s of what the camera sees.
    pub(super) horizontal: DVec3,
}

/// From far away, along −z.
const FAR_AWAY: View = View { to_camera: TO_CAMERA, horizontal: DVec3::X };

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
    /// Light that is known already, by column.
    pub(super) known: Vec<(usize, [Xyz; 4])>,
}

impl Row {
    /// The ways of light to the pixels of row `y`, from the top; one response per lamp, if any.
    pub(super) fn trace(scene: &Scene, responses: &[Option<Response>], y: usize) -> Self {
        let mut row = Self::default();
        for x in 0..scene.size[0] {
            for sample in 0..scene.samples {
                row.sample(scene, responses, [x, y], Random::new(x, y, sample));
            }
        }
        row
    }

    /// One way from a lamp in the direction `toward` over each of the normals, of weight 1.
    pub(super) fn over_normals(scene: &Scene, toward: DVec3, normals: &[DVec3]) -> Self {
        let mut row = Self::default();
        for (pixel, normal) in normals.iter().enumerate() {
            let frame = Frame::of(*normal);
            let seen = Seen { frame: &frame, pixel, weight: 1.0, view: FAR_AWAY };
            let lamp = lamp_turn(scene.light_basis, &frame, toward);
            row.push(&seen, 1.0, toward, None, Some(lamp));
        }
        row
    }

    /// One way from each lamp that reaches a point.
    pub(super) fn over_points(points: &[SurfacePoint], lamps: &DistantLamps<'_>) -> Self {
        let mut row = Self::default();
        for point in points {
            let frame = Frame::of(point.normal);
            let (pixel, weight, view) = (point.column, point.part, point.view());
            let seen = Seen { frame: &frame, pixel, weight, view };
            for (toward, irradiance) in lamps.toward.iter().zip(&point.irradiances) {
                let weight = irradiance * toward.dot(point.normal);
                if weight > 0.0 {
                    let lamp = lamp_turn(lamps.light_basis, &frame, *toward);
                    row.push(&seen, weight, *toward, None, Some(lamp));
                }
            }
        }
        row
    }

    fn sample(
        &mut self,
        scene: &Scene,
        responses: &[Option<Response>],
        [x, y]: [usize; 2],
        random: Random,
    ) {
        let [width, height] = scene.size.map(|n| n as f64);
        let [dx, dy] = random.pair(0);
        let unit = 2.0 * HALF_VIEW / width.min(height);
        let across = (x as f64 + dx - 0.5 * width) * unit;
        let up = (0.5 * height - y as f64 - dy) * unit;
        let ray = Ray { from: DVec3::new(across, up, FAR), along: -TO_CAMERA };
        let Some(point) = scene.shape.hit(ray).and_then(Point::new) else { return };
        let Point { hit, frame } = &point;
        let weight = PI / scene.samples as f64;
        let seen = Seen { frame, pixel: x, weight, view: FAR_AWAY };
        for light in lit(scene, &point, random, 1) {
            let response = responses.get(light.lamp).and_then(Option::as_ref);
            if let Some(value) = response.and_then(|response| response.at(frame.normal)) {
                let weight = seen.weight * scene.lamps[light.lamp].irradiance;
                self.known.push((x, value.map(|xyz| xyz * weight)));
                continue;
            }
            let lamp = lamp_turn(scene.light_basis, frame, light.toward);
            self.push(&seen, light.weight, light.toward, None, Some(lamp));
        }
        if scene.sky.is_light() || scene.bounce {
            self.around(scene, hit, &seen, random);
        }
    }

    /// What comes from one direction that is not a lamp's: the sky, or another point.
    fn around(&mut self, scene: &Scene, hit: &Hit, seen: &Seen<'_>, random: Random) {
        let frame = seen.frame;
        let toward = frame.cosine_direction(random.pair(100));
        if toward.dot(hit.true_normal) <= 0.0 {
            return;
        }
        match scene.shape.hit(leaving(hit, toward)) {
            None if scene.sky.is_light() => {
                // ∫ f L cos dω by a density cos/π, for L = sky/π.
                self.push(seen, scene.sky.toward(toward), toward, None, None);
            }
            Some(other) if scene.bounce => {
                let Some(other) = Point::new(other) else { return };
                for light in lit(scene, &other, random, 200) {
                    let first = self.pair(&other.frame, light.toward, -toward);
                    let leaving = other.frame.s(-toward, light.toward);
                    let turn = Turn::between(-toward, leaving, frame.s(-toward, toward));
                    let lamp = lamp_turn(scene.light_basis, &other.frame, light.toward);
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
        let View { to_camera, horizontal } = seen.view;
        let last = self.pair(seen.frame, toward, to_camera);
        let camera = Turn::between(to_camera, seen.frame.s(to_camera, toward), horizontal);
        let weight = seen.weight * weight;
        self.paths.push(Path { pixel: seen.pixel, weight, last, before, lamp, camera });
    }

    fn pair(&mut self, frame: &Frame, source: DVec3, viewer: DVec3) -> usize {
        self.pairs.push((frame.local(source), frame.local(viewer)));
        self.pairs.len() - 1
    }
}

/// What the ways of light over one sample of a pixel have in common.
struct Seen<'a> {
    frame: &'a Frame,
    pixel: usize,
    weight: f64,
    view: View,
}

/// A direction from which a lamp lights a point, and E cos θ_i there.
struct Light {
    /// Its number.
    lamp: usize,
    toward: DVec3,
    weight: f64,
}

/// From the basis of the lamps to that of the plane of incidence of light from `toward`.
fn lamp_turn(basis: LampBasis, frame: &Frame, toward: DVec3) -> Turn {
    match basis {
        LampBasis::PlaneOfIncidence => Turn::NONE,
        LampBasis::Horizontal => {
            let k = -toward;
            let horizontal = DVec3::Y.cross(k).try_normalize().unwrap_or(DVec3::X);
            Turn::between(k, horizontal, frame.s(k, toward))
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
        is_lit.then_some(Light { lamp: number, toward, weight: lamp.irradiance * cos })
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

/// A point of the body with its frame.
struct Point {
    hit: Hit,
    frame: Frame,
}

impl Point {
    /// The frame of a point that is seen from outside.
    fn new(hit: Hit) -> Option<Self> {
        let is_sound = hit.normal.is_finite() && hit.true_normal.is_finite();
        is_sound.then(|| Self { hit, frame: Frame::of(hit.normal) })
    }
}
