//! The light paths to the pixels of a row: over one point of the body or over two.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use scattering::{Mueller, Stokes};
use spectra::Xyz;

use crate::{
    frame::SurfaceFrame,
    random::SampleRandom,
    ray::{SceneRay, SurfaceHit},
    response::NormalResponse,
    rotation::StokesRotation,
    scene::{LampBasis, Scene},
    surface_point::{DistantLamps, SurfacePoint},
};

/// Half the side of the visible square.
const HALF_VIEW: f64 = 1.0;
/// The height at which camera rays start.
const FAR: f64 = 10.0;
const TO_CAMERA: DVec3 = DVec3::Z;

/// The basis of the beam from a point to the camera.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CameraBasis {
    pub(crate) to_camera: DVec3,
    /// Unit vector across the beam, horizontal in the picture: s of the beam.
    pub(crate) horizontal: DVec3,
}

/// The basis of a distant camera that looks along −z.
const DISTANT_CAMERA: CameraBasis = CameraBasis { to_camera: TO_CAMERA, horizontal: DVec3::X };

/// A light path from a lamp or the sky to a pixel.
#[derive(Debug)]
pub(crate) struct LightPath {
    /// Column of the pixel.
    pub(crate) pixel: usize,
    /// Weight of its Stokes vector in the pixel.
    pub(crate) weight: f64,
    /// The index of the pair of directions at the visible point.
    last: usize,
    /// The index of the pair at the point before, and the rotation from its basis.
    before: Option<(usize, StokesRotation)>,
    /// The rotation from the basis of the lamp to that of the first point; none for the sky, whose
    /// light is unpolarized.
    lamp: Option<StokesRotation>,
    camera: StokesRotation,
}

impl LightPath {
    /// The Stokes vector at the camera, for the `matrices` of all pairs and the `light` of lamps.
    pub(crate) fn stokes_at_camera(&self, matrices: &[Mueller], light: Stokes) -> Stokes {
        let mut stokes = self.lamp.map_or(Stokes::UNPOLARIZED, |rotation| rotation.apply(light));
        if let Some((pair, rotation)) = self.before {
            stokes = rotation.apply(matrices[pair] * stokes);
        }
        self.camera.apply(matrices[self.last] * stokes)
    }
}

/// All light paths to a row of pixels.
#[derive(Debug, Default)]
pub(crate) struct RowPaths {
    /// Directions to the source and to the viewer, in the frames of the surface.
    pub(crate) pairs: Vec<(DVec3, DVec3)>,
    pub(crate) paths: Vec<LightPath>,
    /// Contributions from interpolated responses, by column.
    pub(crate) known: Vec<(usize, [Xyz; 4])>,
}

impl RowPaths {
    /// The light paths to the pixels of row `y`, counted from the top; `responses` has one entry per
    /// lamp or is empty.
    pub(crate) fn trace(scene: &Scene, responses: &[Option<NormalResponse>], y: usize) -> Self {
        let mut row = Self::default();
        for x in 0..scene.size[0] {
            for sample in 0..scene.samples {
                row.sample(scene, responses, [x, y], SampleRandom::new(x, y, sample));
            }
        }
        row
    }

    /// One path of weight 1 from a lamp in the direction `toward` over each of the normals.
    pub(crate) fn over_normals(scene: &Scene, toward: DVec3, normals: &[DVec3]) -> Self {
        let mut row = Self::default();
        for (pixel, normal) in normals.iter().enumerate() {
            let frame = SurfaceFrame::of(*normal);
            let sample = PixelSample { frame: &frame, pixel, weight: 1.0, camera: DISTANT_CAMERA };
            let lamp = lamp_rotation(scene.light_basis, &frame, toward);
            row.push(&sample, 1.0, toward, None, Some(lamp));
        }
        row
    }

    /// One path from each lamp that reaches a point.
    pub(crate) fn over_points(points: &[SurfacePoint], lamps: &DistantLamps<'_>) -> Self {
        let mut row = Self::default();
        for point in points {
            let frame = SurfaceFrame::of(point.normal);
            let SurfacePoint { column: pixel, part: weight, to_camera, horizontal, .. } = *point;
            let camera = CameraBasis { to_camera, horizontal };
            let sample = PixelSample { frame: &frame, pixel, weight, camera };
            for (toward, irradiance) in lamps.toward.iter().zip(&point.irradiances) {
                let weight = irradiance * toward.dot(point.normal);
                if weight > 0.0 {
                    let lamp = lamp_rotation(lamps.light_basis, &frame, *toward);
                    row.push(&sample, weight, *toward, None, Some(lamp));
                }
            }
        }
        row
    }

    fn sample(
        &mut self,
        scene: &Scene,
        responses: &[Option<NormalResponse>],
        [x, y]: [usize; 2],
        random: SampleRandom,
    ) {
        let [width, height] = scene.size.map(|n| n as f64);
        let [dx, dy] = random.pair(0);
        let unit = 2.0 * HALF_VIEW / width.min(height);
        let across = (x as f64 + dx - 0.5 * width) * unit;
        let up = (0.5 * height - y as f64 - dy) * unit;
        let ray = SceneRay { from: DVec3::new(across, up, FAR), along: -TO_CAMERA };
        let Some(point) = scene.shape.hit(ray).and_then(FramedHit::new) else { return };
        let FramedHit { hit, frame } = &point;
        let weight = PI / scene.samples as f64;
        let pixel = PixelSample { frame, pixel: x, weight, camera: DISTANT_CAMERA };
        for light in lamp_samples(scene, &point, random, 1) {
            let response = responses.get(light.lamp).and_then(Option::as_ref);
            if let Some(value) = response.and_then(|response| response.at(frame.normal)) {
                let weight = pixel.weight * scene.lamps[light.lamp].irradiance;
                self.known.push((x, value.map(|xyz| xyz * weight)));
                continue;
            }
            let lamp = lamp_rotation(scene.light_basis, frame, light.toward);
            self.push(&pixel, light.weight, light.toward, None, Some(lamp));
        }
        if scene.sky.is_light() || scene.bounce {
            self.add_surroundings(scene, hit, &pixel, random);
        }
    }

    /// Adds the light from one random direction: of the sky, or of another point of the body.
    fn add_surroundings(
        &mut self,
        scene: &Scene,
        hit: &SurfaceHit,
        sample: &PixelSample<'_>,
        random: SampleRandom,
    ) {
        let frame = sample.frame;
        let toward = frame.cosine_direction(random.pair(100));
        if toward.dot(hit.true_normal) <= 0.0 {
            return;
        }
        match scene.shape.hit(hit.leaving(toward)) {
            None if scene.sky.is_light() => {
                // ∫ f L cos dω by a density cos/π, for L = sky/π.
                self.push(sample, scene.sky.radiance_factor(toward), toward, None, None);
            }
            Some(other) if scene.bounce => {
                let Some(other) = FramedHit::new(other) else { return };
                for light in lamp_samples(scene, &other, random, 200) {
                    let first = self.pair(&other.frame, light.toward, -toward);
                    let leaving = other.frame.s(-toward, light.toward);
                    let rotation =
                        StokesRotation::between(-toward, leaving, frame.s(-toward, toward));
                    let lamp = lamp_rotation(scene.light_basis, &other.frame, light.toward);
                    self.push(
                        sample,
                        PI * light.weight,
                        toward,
                        Some((first, rotation)),
                        Some(lamp),
                    );
                }
            }
            _ => {}
        }
    }

    /// Adds the path from the direction `toward` over the visible point to the camera.
    fn push(
        &mut self,
        sample: &PixelSample<'_>,
        weight: f64,
        toward: DVec3,
        before: Option<(usize, StokesRotation)>,
        lamp: Option<StokesRotation>,
    ) {
        let CameraBasis { to_camera, horizontal } = sample.camera;
        let last = self.pair(sample.frame, toward, to_camera);
        let camera =
            StokesRotation::between(to_camera, sample.frame.s(to_camera, toward), horizontal);
        let weight = sample.weight * weight;
        self.paths.push(LightPath { pixel: sample.pixel, weight, last, before, lamp, camera });
    }

    fn pair(&mut self, frame: &SurfaceFrame, source: DVec3, viewer: DVec3) -> usize {
        self.pairs.push((frame.local(source), frame.local(viewer)));
        self.pairs.len() - 1
    }
}

/// The common part of the paths through one sample of a pixel.
struct PixelSample<'a> {
    frame: &'a SurfaceFrame,
    pixel: usize,
    weight: f64,
    camera: CameraBasis,
}

/// A direction from which a lamp lights a point, and E cos θ_i there.
struct LampSample {
    /// Index of the lamp.
    lamp: usize,
    toward: DVec3,
    weight: f64,
}

/// The rotation from the basis of the lamps to that of the plane of incidence of light from
/// `toward`.
fn lamp_rotation(basis: LampBasis, frame: &SurfaceFrame, toward: DVec3) -> StokesRotation {
    match basis {
        LampBasis::PlaneOfIncidence => StokesRotation::IDENTITY,
        LampBasis::Horizontal => {
            let k = -toward;
            let horizontal = DVec3::Y.cross(k).try_normalize().unwrap_or(DVec3::X);
            StokesRotation::between(k, horizontal, frame.s(k, toward))
        }
    }
}

/// The lamps that reach a point; `dimension` selects the random numbers.
fn lamp_samples(
    scene: &Scene,
    point: &FramedHit,
    random: SampleRandom,
    dimension: u64,
) -> impl Iterator<Item = LampSample> {
    scene.lamps.iter().enumerate().filter_map(move |(number, lamp)| {
        let toward = if lamp.radius == 0.0 {
            lamp.toward
        } else {
            cone_direction(lamp.toward, lamp.radius, random.pair(dimension + number as u64))
        };
        let cos = toward.dot(point.hit.normal);
        let is_lit = cos > 0.0
            && toward.dot(point.hit.true_normal) > 0.0
            && !scene.shape.shades(&point.hit, toward);
        is_lit.then_some(LampSample { lamp: number, toward, weight: lamp.irradiance * cos })
    })
}

/// A random direction in the cone of half-angle `radius` around `axis`, uniform in solid angle.
fn cone_direction(axis: DVec3, radius: f64, [a, b]: [f64; 2]) -> DVec3 {
    let cos = 1.0 - a * (1.0 - radius.cos());
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let (x, y) = axis.any_orthonormal_pair();
    let (sin_phi, cos_phi) = (TAU * b).sin_cos();
    (sin * cos_phi * x + sin * sin_phi * y + cos * axis).normalize()
}

/// A point of the body with its local frame.
struct FramedHit {
    hit: SurfaceHit,
    frame: SurfaceFrame,
}

impl FramedHit {
    /// The point with its frame; none if a normal is not finite.
    fn new(hit: SurfaceHit) -> Option<Self> {
        let is_sound = hit.normal.is_finite() && hit.true_normal.is_finite();
        is_sound.then(|| Self { hit, frame: SurfaceFrame::of(hit.normal) })
    }
}
