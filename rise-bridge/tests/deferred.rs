//! Product D for RISE: scenes of geometry alone, and their shading. A tracer of spheres stands in
//! for RISE: it renders the scenes that are written, by the rules that RISE's documents state.

use std::{
    collections::BTreeMap,
    f64::consts::{FRAC_1_PI, PI},
    sync::Arc,
};

use glam::DVec3;
use mist_engine::{
    Control, Files, MemoryFiles,
    material::{Material, PreparedMaterial},
    request::ColourQuery,
};
use pictures::image::{Encoding, Image};
use preview::{BodyShape, Lamp, LampBasis, RenderedFilm, Scene, Sky};
use rise_bridge::{
    export::ExportError,
    rise::{
        deferred::{self, DeferredPlan, Illumination},
        scene::{SceneChunk, chunks},
    },
};
use scattering::{Basis, Geometry, Mode};

const TEMPLATE: &str = include_str!("data/balls_deferred.RISEscene");
const NM: [f64; 3] = [450.0, 550.0, 650.0];

/// The variable parts of the tests: pixels, camera, fov, the small ball, and where the lamp is.
fn scene(width: usize, camera: DVec3, fov: f64, bead: DVec3, lamp: DVec3) -> String {
    let vector = |v: DVec3| format!("{:?} {:?} {:?}", v.x, v.y, v.z);
    TEMPLATE
        .replace("WIDTH", &width.to_string())
        .replace("CAMERA", &vector(camera))
        .replace("FOV", &format!("{fov:?}"))
        .replace("BEAD", &vector(bead))
        .replace("LAMP", &vector(lamp))
}

/// Far away from everything.
const AWAY: DVec3 = DVec3::new(0.0, 0.0, -50.0);

fn files() -> Arc<dyn Files + Send + Sync> {
    Arc::new(MemoryFiles(BTreeMap::new()))
}

fn lit(light: [f64; 4]) -> Illumination {
    let settings = ColourQuery::of_factors("D65").settings(None).unwrap();
    let light_basis = LampBasis::PlaneOfIncidence;
    Illumination { wavelengths: NM.to_vec(), settings, light, light_basis }
}

fn plan(text: &str, finer: usize) -> Result<DeferredPlan, ExportError> {
    deferred::plan(text, "balls", &MemoryFiles(BTreeMap::new()), false, finer)
}

fn film(text: &str, finer: usize, light: [f64; 4]) -> RenderedFilm {
    let plan = plan(text, finer).unwrap();
    let image = |name: &str| {
        let scene = &plan.files[&name.replace(".exr", ".RISEscene")];
        Ok(rendered(std::str::from_utf8(scene).unwrap()))
    };
    plan.film(image, &files(), &lit(light), &Control::default()).unwrap()
}

fn gold() -> PreparedMaterial {
    let json = r#"{"model": "Facet_BRDF_Model", "parameters": {"substrate": "(0.2,3.1)",
        "sdf": "Gaussian_Slope_Distribution_Function", "sdf.s": 0.4}}"#;
    Material::from_json(json).unwrap().prepare(Mode::Sound, None).unwrap()
}

struct Ball {
    centre: DVec3,
    radius: f64,
    is_white: bool,
    receives_shadows: bool,
}

/// The stand-in for RISE: direct light on white and black spheres.
fn rendered(text: &str) -> Image {
    let chunks = chunks(text).unwrap();
    let named = |keyword: &str, name: &str| {
        chunks.iter().find(|c| c.keyword == keyword && c.name() == name).unwrap()
    };
    let only = |keyword: &str| {
        let mut found = chunks.iter().filter(|c| c.keyword == keyword);
        let first = found.next().unwrap();
        assert!(found.next().is_none(), "one {keyword}");
        first
    };
    let vector = |chunk: &SceneChunk, name: &str| {
        let mut words = chunk.get(name).unwrap().split_whitespace().map(|x| x.parse().unwrap());
        DVec3::from_array(std::array::from_fn(|_| words.next().unwrap()))
    };
    let number = |chunk: &SceneChunk, name: &str| chunk.get(name).unwrap().parse::<f64>().unwrap();
    assert_eq!(only("standard_shader").get("shaderop"), Some("DefaultDirectLighting"));
    let rasterizer = only("pixelpel_rasterizer");
    assert_eq!(
        (rasterizer.get("samples"), rasterizer.get("pixel_filter")),
        (Some("1"), Some("box"))
    );
    let output = only("file_rasterizeroutput");
    assert_eq!((output.get("type"), output.get("bpp")), (Some("EXR"), Some("32")));
    let balls: Vec<Ball> = chunks
        .iter()
        .filter(|c| c.keyword == "standard_object")
        .map(|object| {
            let material = named("lambertian_material", object.get("material").unwrap());
            let painter = named("uniformcolor_painter", material.get("reflectance").unwrap());
            let geometry = named("sphere_geometry", object.get("geometry").unwrap());
            Ball {
                centre: vector(object, "position"),
                radius: number(geometry, "radius"),
                is_white: vector(painter, "color") == DVec3::ONE,
                receives_shadows: object.get("receives_shadows") != Some("FALSE"),
            }
        })
        .collect();
    let light = only("directional_light");
    let toward = vector(light, "direction").normalize();
    let irradiance = number(light, "power");
    let (film, camera) = (only("film"), only("pinhole_camera"));
    let [width, height] = ["width", "height"].map(|name| number(film, name) as usize);
    let from = vector(camera, "location");
    let forward = (vector(camera, "lookat") - from).normalize();
    let right = forward.cross(vector(camera, "up")).normalize();
    let up = right.cross(forward);
    let pixel = 2.0 * (0.5 * number(camera, "fov").to_radians()).tan() / height as f64;
    let mut values = Vec::new();
    for k in 0..width * height {
        let x = (k % width) as f64 + 0.5 - 0.5 * width as f64;
        let y = 0.5 * height as f64 - (k / width) as f64 - 0.5;
        let along = (forward + pixel * (x * right + y * up)).normalize();
        let nearest = balls
            .iter()
            .filter_map(|ball| Some((hit(ball, from, along)?, ball)))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let value = nearest.map_or(0.0, |(distance, ball)| {
            let point = from + distance * along;
            let normal = (point - ball.centre) / ball.radius;
            let start = point + 1e-6 * normal;
            let in_shadow = balls.iter().any(|other| hit(other, start, toward).is_some());
            let is_lit = ball.is_white && !(ball.receives_shadows && in_shadow);
            if is_lit { FRAC_1_PI * irradiance * normal.dot(toward).max(0.0) } else { 0.0 }
        });
        values.extend([value as f32; 3]);
    }
    Image::new([width, height], 3, values, Encoding::Linear).unwrap()
}

fn hit(ball: &Ball, from: DVec3, along: DVec3) -> Option<f64> {
    let offset = from - ball.centre;
    // From the point of the ray nearest to the centre: exact from far away too.
    let nearest = -offset.dot(along);
    let aside = (offset + nearest * along).length_squared();
    let half = (ball.radius * ball.radius - aside).sqrt();
    (nearest - half > 0.0).then_some(nearest - half)
}

#[test]
fn a_pixel_is_the_mueller_matrix_of_its_angles_in_the_frame_of_the_camera() {
    // Camera and lamp lie in the plane y = 0, and so do the normals of the middle row.
    let camera = DVec3::new(2.0, 0.0, 5.0);
    let lamp = DVec3::new(-0.8, 0.0, 0.6);
    let film = film(&scene(33, camera, 24.0, AWAY, lamp), 1, [1.0, 0.2, 0.3, -0.1]);
    let model = gold().at(0.55).model().unwrap().0;
    let forward = -camera.normalize();
    let right = forward.cross(DVec3::Y);
    let mut compared = 0;
    for x in 0..33 {
        let across = (f64::from(x) - 16.0) * 2.0 * 12_f64.to_radians().tan() / 33.0;
        let along = (forward + across * right).normalize();
        let ball =
            Ball { centre: DVec3::ZERO, radius: 0.95, is_white: true, receives_shadows: true };
        let Some(distance) = hit(&ball, camera, along) else { continue };
        let normal = (camera + distance * along) / 0.95;
        if normal.dot(lamp) <= 0.0 {
            continue;
        }
        let angle = |v: DVec3| normal.cross(v).y.atan2(normal.dot(v));
        let (i, s) = (angle(lamp), angle(-along));
        let phi_s = if i * s < 0.0 { 0.0 } else { PI };
        let geometry = Geometry { theta_i: i.abs(), theta_s: s.abs(), phi_s, rotation: 0.0 };
        let m = model.mueller(&geometry, Basis::Psps);
        // s is along y, which is vertical in the picture: Q and U have the other sign there.
        let light = [1.0, 0.2, 0.3, -0.1];
        let row = |k: usize| (0..4).map(|j| m[(k, j)] * light[j]).sum::<f64>() * 2.5 * i.cos();
        let expected = [row(0), -row(1), -row(2), row(3)];
        let found = film.pixels[16 * 33 + x as usize].map(|xyz| xyz.y);
        for (found, expected) in found.iter().zip(expected) {
            // Normals and white come of 32-bit numbers.
            assert!(
                (found - expected).abs() < 2e-6 * row(0).abs().max(1e-3),
                "{x}: {found} {expected}"
            );
        }
        compared += 1;
    }
    assert!(compared > 10, "{compared}");
}

#[test]
fn seen_from_far_away_it_is_the_picture_of_the_preview() {
    let (toward, size, distance) = (Lamp::at(0.7, 2.1, 0.0, 1.0), 12, 1e4_f64);
    let fov = 2.0 * (1.0 / distance).atan().to_degrees();
    let text = scene(size, DVec3::new(0.0, 0.0, distance), fov, AWAY, toward.toward);
    let light = [1.0, 0.3, 0.2, 0.1];
    let deferred = film(&text, 8, light);
    let scene = Scene {
        shape: BodyShape::Sphere,
        lamps: vec![Lamp { irradiance: 2.5 * FRAC_1_PI, ..toward }],
        light,
        light_basis: LampBasis::PlaneOfIncidence,
        sky: Sky::Dark,
        bounce: false,
        size: [size; 2],
        samples: 256,
        exact: true,
        spectra: false,
    };
    let settings = lit(light).settings;
    let expected = preview::render(&gold(), &scene, &NM, settings, &Control::default()).unwrap();
    let most = expected.pixels.iter().map(|p| p[0].y).fold(0.0, f64::max);
    for (k, (found, expected)) in deferred.pixels.iter().zip(&expected.pixels).enumerate() {
        for (found, expected) in found.iter().zip(expected) {
            // 64 and 256 samples in a pixel of a highlight.
            assert!((found.y - expected.y).abs() < 0.03 * most, "{k}: {found:?} {expected:?}");
        }
    }
    let seen = |film: &RenderedFilm| film.pixels.iter().map(|p| p[2].y.abs()).sum::<f64>();
    assert!((seen(&deferred) / seen(&expected) - 1.0).abs() < 0.02 && seen(&expected) > 0.1 * most);
}

#[test]
fn the_shadow_of_a_body_is_dark_and_other_materials_are_black() {
    let lamp = DVec3::new(0.0, 0.0, 1.0);
    let camera = DVec3::new(2.0, 0.0, 5.0);
    let free = film(&scene(32, camera, 24.0, AWAY, lamp), 2, [1.0, 0.0, 0.0, 0.0]);
    let bead = DVec3::new(-0.1, 0.1, 2.0);
    let shaded = film(&scene(32, camera, 24.0, bead, lamp), 2, [1.0, 0.0, 0.0, 0.0]);
    let bright = |film: &RenderedFilm| film.pixels.iter().filter(|p| p[0].y > 0.0).count();
    let pairs = || free.pixels.iter().zip(&shaded.pixels);
    assert!(pairs().all(|(a, b)| b[0].y <= a[0].y));
    // The disc of the bead and its shadow, each (0.3/0.95)² of the ball.
    let lost = 1.0 - bright(&shaded) as f64 / bright(&free) as f64;
    assert!((0.1..0.3).contains(&lost), "{lost}");
}

#[test]
fn what_cannot_be_shaded_is_refused_with_the_line_and_the_reason() {
    let good = scene(8, DVec3::new(0.0, 0.0, 5.0), 24.0, AWAY, DVec3::Z);
    let reason = |from: &str, to: &str| {
        assert!(good.contains(from), "{from}");
        plan(&good.replace(from, to), 2).unwrap_err().to_string()
    };
    assert!(plan(&good, 2).is_ok());
    for (from, to, expected) in [
        ("directional_light", "omni_light", "line 84: omni_light: only directional_light"),
        ("color\t\t1 1 1", "color\t\t1 0 0", "not grey"),
        ("direction\t0.0 0.0 1.0", "direction\t0 0 0", "a direction"),
        ("pinhole_camera", "thinlens_camera", "expected one pinhole_camera"),
        ("up\t\t0 1 0", "up\t\t0 0 1", "up is parallel to the view"),
        ("fov\t\t24.0", "fov\t\t240", "fov is missing or not an angle"),
        ("fov\t\t24.0", "fov\t24\n\troll\t3", "roll is not supported"),
        ("lookat\t\t0 0 0", "lookat\t0 0", "lookat 0 0: expected three numbers"),
        ("width\t8", "width\texpr( 8 )", "width of the film"),
        ("# mist: ", "# ", "no material has a comment"),
    ] {
        let found = reason(from, to);
        assert!(found.contains(expected), "{to}: {found}");
    }
    assert!(plan(&good, 9).unwrap_err().to_string().contains("1 to 8"));
}

#[test]
fn renders_that_show_nothing_or_do_not_fit_are_refused() {
    let plan = plan(&scene(8, DVec3::new(0.0, 0.0, 5.0), 24.0, AWAY, DVec3::Z), 2).unwrap();
    let with = |size: usize, value: f32| {
        let image = Image::new([size; 2], 3, vec![value; 3 * size * size], Encoding::Linear);
        let image = image.unwrap();
        let read = |_: &str| Ok(image.clone());
        let lit = lit([1.0, 0.0, 0.0, 0.0]);
        plan.film(read, &files(), &lit, &Control::default()).unwrap_err().to_string()
    };
    assert!(with(16, 0.0).contains("gold: no render shows it"));
    assert!(with(8, 0.0).contains("[8, 8] pixels, not [16, 16]"));
    assert_eq!(plan.scenes().count(), 7);
}
