//! Product D: RISE finds what is seen and which lamps reach it, the optics are ours.
//!
//! A white Lambertian body under a directional light of power π has the radiance max(0, n·l). Six
//! renders with lights along ±x, ±y and ±z and without shadows are the normals; one render per lamp
//! of the scene, with shadows, tells what it reaches. With the camera that is all that direct light
//! needs: the model is asked for the Mueller matrix of every pixel, at every wavelength, with its
//! azimuth, and Stokes vectors come to the camera in its own frame. The renders have several times the
//! pixels of the picture in both directions and are averaged.

mod camera;
mod passes;

use std::{collections::BTreeMap, sync::Arc};

use glam::DVec3;
use mist_engine::{Control, Files};
use pictures::image::Image;
use preview::{DistantLamps, Film, LampBasis, SurfacePoint, shade};
use scattering::Mode;
use spectra::{ColourSettings, Xyz};

use super::{
    material::{Described, described},
    scene::chunks,
};
use crate::export::ExportError;

use camera::Camera;
use passes::Passes;

/// Renders that are wanted, and what is known for shading them.
#[derive(Clone, Debug)]
pub struct Deferred {
    /// Names and contents of the scenes.
    pub files: BTreeMap<String, Vec<u8>>,
    /// What is left as it is, with the reason; it is black in the picture.
    pub left: Vec<String>,
    materials: Vec<Described>,
    lamps: Vec<Lamp>,
    camera: Camera,
    /// Columns and rows of the picture.
    size: [usize; 2],
    /// Pixels of a render per pixel of the picture, in each direction.
    finer: usize,
    stem: String,
}

/// A directional light of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// Unit vector to it.
    pub toward: DVec3,
    /// Irradiance on a surface that faces it.
    pub irradiance: f64,
}

/// The light of the lamps and its colours.
#[derive(Clone, Debug)]
pub struct Lit {
    /// Wavelengths, nm, rising.
    pub wavelengths: Vec<f64>,
    /// How spectra become colours.
    pub settings: ColourSettings,
    /// Stokes vector; its first component is 1.
    pub light: [f64; 4],
    /// The basis of that vector.
    pub light_basis: LampBasis,
}

/// The axes along which normals are seen.
const AXES: [(&str, DVec3); 6] = [
    ("px", DVec3::X),
    ("nx", DVec3::NEG_X),
    ("py", DVec3::Y),
    ("ny", DVec3::NEG_Y),
    ("pz", DVec3::Z),
    ("nz", DVec3::NEG_Z),
];
/// Normals from 32-bit renders have the length 1 to 1e-6; anything else is no single point.
const LENGTH: f64 = 1e-3;

/// Plans the renders for the scene `text`, whose file is called `stem`.
///
/// # Errors
///
/// For scenes without materials for us, without lamps or with others than white directional lights,
/// with a camera that is no `pinhole_camera`, and for a `finer` that is not 1 to 8.
pub fn plan(
    text: &str,
    stem: &str,
    files: &dyn Files,
    derive: bool,
    finer: usize,
) -> Result<Deferred, ExportError> {
    if !(1..=8).contains(&finer) {
        return Err(ExportError::refused("finer", format!("it is 1 to 8, not {finer}")));
    }
    let chunks = chunks(text)?;
    let (materials, left) = described(&chunks, files, derive)?;
    if materials.is_empty() {
        let problem = format!("no material has a comment # mist: … for us {left:?}");
        return Err(ExportError::refused("scene", problem));
    }
    let passes = Passes::new(text, &chunks, finer)?;
    let lamps = passes.lamps()?;
    let mut plan = Deferred {
        files: BTreeMap::new(),
        left,
        camera: Camera::of(&chunks)?,
        size: passes.size,
        lamps,
        materials,
        finer,
        stem: stem.to_owned(),
    };
    for material in &plan.materials {
        for (axis, toward) in AXES {
            let name = plan.pass(&material.name, axis);
            let scene = passes.scene(&name, material.chunk, toward, false);
            plan.files.insert(format!("{name}.RISEscene"), scene.into_bytes());
        }
        for (k, lamp) in plan.lamps.iter().enumerate() {
            let name = plan.pass(&material.name, &format!("lamp{k}"));
            let scene = passes.scene(&name, material.chunk, lamp.toward, true);
            plan.files.insert(format!("{name}.RISEscene"), scene.into_bytes());
        }
    }
    plan.files.insert("rise.options".into(), b"force_number_of_threads 2\n".to_vec());
    Ok(plan)
}

impl Deferred {
    /// The scenes to render.
    pub fn scenes(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str).filter(|name| name.ends_with(".RISEscene"))
    }

    /// The name of a render, without its extension.
    fn pass(&self, material: &str, what: &str) -> String {
        format!("{}_d_{material}_{what}", self.stem)
    }

    /// The picture, from the renders: `image` reads `NAME.exr`. Progress starts anew with every
    /// material.
    ///
    /// # Errors
    ///
    /// For renders that are missing or do not fit, materials that no render shows, and everything
    /// that is wrong with a material.
    pub fn film(
        &self,
        image: impl Fn(&str) -> Result<Image, ExportError>,
        files: &Arc<dyn Files + Send + Sync>,
        lit: &Lit,
        control: &Control,
    ) -> Result<Film, ExportError> {
        let mut pixels = vec![[Xyz::default(); 4]; self.size[0] * self.size[1]];
        let toward: Vec<DVec3> = self.lamps.iter().map(|lamp| lamp.toward).collect();
        let lamps =
            DistantLamps { toward: &toward, light: lit.light, light_basis: lit.light_basis };
        for material in &self.materials {
            let buffers = self.buffers(&material.name, &image)?;
            let prepared = material.material.prepare(Mode::Sound, Some(files.clone()))?;
            let colours = (&*lit.wavelengths, lit.settings.clone());
            let points = |y| self.points(&buffers, y);
            let seen = shade(&prepared, self.size, points, &lamps, colours, control)?;
            for (sum, stokes) in pixels.iter_mut().flatten().zip(seen.iter().flatten()) {
                *sum += *stokes;
            }
        }
        Ok(Film { size: self.size, pixels, spectra: Vec::new() })
    }

    /// The renders of a material, read by `image`.
    fn buffers(
        &self,
        material: &str,
        image: &impl Fn(&str) -> Result<Image, ExportError>,
    ) -> Result<Buffers, ExportError> {
        let size = self.size.map(|n| n * self.finer);
        let render = |what: &str| {
            let name = format!("{}.exr", self.pass(material, what));
            let image = image(&name)?;
            if image.size() != size {
                let problem = format!("it has {:?} pixels, not {size:?}", image.size());
                return Err(ExportError::refused(&name, problem));
            }
            Ok(image.linear().map(|rgb| rgb[1] as f32).collect())
        };
        let faces = AXES.iter().map(|(axis, _)| render(axis)).collect::<Result<_, _>>()?;
        let lamps = (0..self.lamps.len()).map(|k| render(&format!("lamp{k}")));
        let buffers = Buffers { faces, lamps: lamps.collect::<Result<_, _>>()? };
        if !(0..size[0] * size[1]).any(|at| buffers.normal(at).is_some()) {
            let problem = "no render shows it: it is hidden, or RISE failed without saying so";
            return Err(ExportError::refused(material, problem));
        }
        Ok(buffers)
    }

    /// The points that row `y` of the picture shows.
    fn points(&self, buffers: &Buffers, y: usize) -> Vec<SurfacePoint> {
        let size = self.size.map(|n| n * self.finer);
        let pixels = y * self.finer * size[0]..(y + 1) * self.finer * size[0];
        let point = |at: usize| {
            let normal = buffers.normal(at)?;
            let [x, y] = [at % size[0], at / size[0]];
            let (to_camera, horizontal) = self.camera.sees([x, y], size);
            let irradiances = self.lamps.iter().zip(&buffers.lamps).map(|(lamp, lit)| {
                // One sample per pixel: all of the lamp or nothing of it.
                let lit = f64::from(lit[at]);
                let is_lit = lit > 0.0 && lit > 0.5 * normal.dot(lamp.toward);
                if is_lit { lamp.irradiance } else { 0.0 }
            });
            Some(SurfacePoint {
                column: x / self.finer,
                part: 1.0 / (self.finer * self.finer) as f64,
                normal,
                to_camera,
                horizontal,
                irradiances: irradiances.collect(),
            })
        };
        pixels.filter_map(point).collect()
    }
}

/// The renders of one material, one value per pixel.
struct Buffers {
    /// Of [`AXES`].
    faces: Vec<Vec<f32>>,
    lamps: Vec<Vec<f32>>,
}

impl Buffers {
    /// The normal of what a pixel shows, if it shows the material.
    fn normal(&self, at: usize) -> Option<DVec3> {
        let sums = self.faces.iter().zip(AXES).map(|(face, (_, axis))| axis * f64::from(face[at]));
        let normal: DVec3 = sums.sum();
        ((normal.length() - 1.0).abs() <= LENGTH).then(|| normal.normalize())
    }
}
