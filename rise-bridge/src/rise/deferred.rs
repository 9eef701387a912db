//! Product D: RISE renders visibility and shadows, mist computes the light.
//!
//! A white Lambertian body under a directional light of power π has the radiance max(0, n·l). Six
//! renders with lights along ±x, ±y and ±z and without shadows give the normals; one render per lamp
//! of the scene, with shadows, gives the lit points. With the camera these are all inputs of direct
//! light: the Mueller matrix of the model is evaluated for every pixel, at every wavelength and
//! azimuth, and Stokes vectors are expressed in the basis of the camera. The renders have several
//! times the pixels of the picture in both directions and are averaged.

mod camera;
mod lamp;
mod passes;

use std::{collections::BTreeMap, sync::Arc};

use glam::DVec3;
use mist_engine::{Control, Files};
use pictures::image::Image;
use preview::{DistantLamps, LampBasis, RenderedFilm, SurfacePoint, shade};
use scattering::Mode;
use spectra::{ColourSettings, Xyz};

use super::{
    material::{SceneMaterial, scene_materials},
    scene::chunks,
};
use crate::export::ExportError;

use camera::Camera;
pub use lamp::DirectionalLamp;
use passes::Passes;

/// The renders to make, and the data for shading them.
#[derive(Clone, Debug)]
pub struct DeferredPlan {
    /// Names and contents of the scenes.
    pub files: BTreeMap<String, Vec<u8>>,
    /// Materials that are not converted, with the reason; they are black in the picture.
    pub skipped: Vec<String>,
    materials: Vec<SceneMaterial>,
    lamps: Vec<DirectionalLamp>,
    camera: Camera,
    /// Columns and rows of the picture.
    size: [usize; 2],
    /// Pixels of a render per pixel of the picture, in each direction.
    supersampling: usize,
    stem: String,
}

/// The light of the lamps and its colours.
#[derive(Clone, Debug)]
pub struct Illumination {
    /// Wavelengths, nm, rising.
    pub wavelengths: Vec<f64>,
    /// The settings of the conversion from spectra to colours.
    pub settings: ColourSettings,
    /// Stokes vector of the lamps; its first component is 1.
    pub light: [f64; 4],
    /// The basis of that vector.
    pub light_basis: LampBasis,
}

/// The directions of the lights for the normals.
const AXES: [(&str, DVec3); 6] = [
    ("px", DVec3::X),
    ("nx", DVec3::NEG_X),
    ("py", DVec3::Y),
    ("ny", DVec3::NEG_Y),
    ("pz", DVec3::Z),
    ("nz", DVec3::NEG_Z),
];
/// Tolerance of the length of a normal. Normals of 32-bit renders have the length 1 to 1e-6; a pixel
/// that shows several points has another length.
const LENGTH_TOLERANCE: f64 = 1e-3;

/// Plans the renders for the scene `text`, whose file is called `stem`.
///
/// # Errors
///
/// If the scene has no material for mist, no lamp, a lamp other than a white directional light, or
/// a camera other than a `pinhole_camera`, and if `supersampling` is not 1 to 8.
pub fn plan(
    text: &str,
    stem: &str,
    files: &dyn Files,
    derive: bool,
    supersampling: usize,
) -> Result<DeferredPlan, ExportError> {
    if !(1..=8).contains(&supersampling) {
        return Err(ExportError::refused("finer", format!("it is 1 to 8, not {supersampling}")));
    }
    let chunks = chunks(text)?;
    let (materials, skipped) = scene_materials(&chunks, files, derive)?;
    if materials.is_empty() {
        let problem = format!("no material has a comment # mist: … {skipped:?}");
        return Err(ExportError::refused("scene", problem));
    }
    let passes = Passes::new(text, &chunks, supersampling)?;
    let lamps = passes.lamps()?;
    let mut plan = DeferredPlan {
        files: BTreeMap::new(),
        skipped,
        camera: Camera::of(&chunks)?,
        size: passes.size,
        lamps,
        materials,
        supersampling,
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

impl DeferredPlan {
    /// Values that were invented, after the name of the material.
    pub fn invented(&self) -> impl Iterator<Item = String> {
        let notes = |material: &SceneMaterial| {
            let name = material.name.clone();
            material.invented.clone().into_iter().map(move |note| format!("{name}: {note}"))
        };
        self.materials.iter().flat_map(notes)
    }

    /// The scenes to render.
    pub fn scenes(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str).filter(|name| name.ends_with(".RISEscene"))
    }

    /// The name of a render, without its extension.
    fn pass(&self, material: &str, what: &str) -> String {
        format!("{}_d_{material}_{what}", self.stem)
    }

    /// The picture, from the renders: `image` reads `NAME.exr`. Progress restarts with every
    /// material.
    ///
    /// # Errors
    ///
    /// If a render is missing or has another size, if no render shows a material, and if a material
    /// is invalid.
    pub fn film(
        &self,
        image: impl Fn(&str) -> Result<Image, ExportError>,
        files: &Arc<dyn Files + Send + Sync>,
        illumination: &Illumination,
        control: &Control,
    ) -> Result<RenderedFilm, ExportError> {
        let mut pixels = vec![[Xyz::default(); 4]; self.size[0] * self.size[1]];
        let toward: Vec<DVec3> = self.lamps.iter().map(|lamp| lamp.toward).collect();
        let lamps = DistantLamps {
            toward: &toward,
            light: illumination.light,
            light_basis: illumination.light_basis,
        };
        for material in &self.materials {
            let buffers = self.buffers(&material.name, &image)?;
            let prepared = material.material.prepare(Mode::Sound, Some(files.clone()))?;
            let colours = (&*illumination.wavelengths, illumination.settings.clone());
            let points = |y| self.points(&buffers, y);
            let shaded = shade(&prepared, self.size, points, &lamps, colours, control)?;
            for (sum, stokes) in pixels.iter_mut().flatten().zip(shaded.iter().flatten()) {
                *sum += *stokes;
            }
        }
        Ok(RenderedFilm { size: self.size, pixels, spectra: Vec::new() })
    }

    /// The renders of a material, read by `image`.
    fn buffers(
        &self,
        material: &str,
        image: &impl Fn(&str) -> Result<Image, ExportError>,
    ) -> Result<PassBuffers, ExportError> {
        let size = self.size.map(|n| n * self.supersampling);
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
        let buffers = PassBuffers { faces, lamps: lamps.collect::<Result<_, _>>()? };
        if !(0..size[0] * size[1]).any(|at| buffers.normal(at).is_some()) {
            let problem = "no render shows it: it is hidden, or RISE failed without a message";
            return Err(ExportError::refused(material, problem));
        }
        Ok(buffers)
    }

    /// The surface points in row `y` of the picture.
    fn points(&self, buffers: &PassBuffers, y: usize) -> Vec<SurfacePoint> {
        let size = self.size.map(|n| n * self.supersampling);
        let pixels = y * self.supersampling * size[0]..(y + 1) * self.supersampling * size[0];
        let point = |at: usize| {
            let normal = buffers.normal(at)?;
            let [x, y] = [at % size[0], at / size[0]];
            let (to_camera, horizontal) = self.camera.beam([x, y], size);
            let irradiances = self.lamps.iter().zip(&buffers.lamps).map(|(lamp, lit)| {
                // One sample per pixel: the point is lit or in shadow.
                let lit = f64::from(lit[at]);
                let is_lit = lit > 0.0 && lit > 0.5 * normal.dot(lamp.toward);
                if is_lit { lamp.irradiance } else { 0.0 }
            });
            Some(SurfacePoint {
                column: x / self.supersampling,
                part: 1.0 / (self.supersampling * self.supersampling) as f64,
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
struct PassBuffers {
    /// The renders of [`AXES`].
    faces: Vec<Vec<f32>>,
    lamps: Vec<Vec<f32>>,
}

impl PassBuffers {
    /// The normal at a pixel; none if the pixel does not show the material.
    fn normal(&self, at: usize) -> Option<DVec3> {
        let sums = self.faces.iter().zip(AXES).map(|(face, (_, axis))| axis * f64::from(face[at]));
        let normal: DVec3 = sums.sum();
        ((normal.length() - 1.0).abs() <= LENGTH_TOLERANCE).then(|| normal.normalize())
    }
}
