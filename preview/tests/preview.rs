//! Pictures against closed forms: white, glass at Brewster's angle, one bounce, polarized lamps.

use std::f64::consts::PI;

use exr::prelude::{ReadChannels as _, ReadLayers as _};
use glam::DVec3;
use mist_engine::{
    Control,
    material::{Material, PreparedMaterial},
    request::ColourQuery,
};
use pictures::image::{Encoding, Image};
use preview::{
    BodyShape, Environment, Lamp, LampBasis, RenderedFilm, Scene, Sky, mesh::Mesh, render,
    spectral_exr,
};
use scattering::Mode;
use spectra::ColourSettings;

const WAVELENGTHS: [f64; 7] = [400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0];

fn material(json: &str) -> PreparedMaterial {
    Material::from_json(json).unwrap().prepare(Mode::Sound, None).unwrap()
}

fn white() -> PreparedMaterial {
    material(r#"{"model":"Lambertian_BRDF_Model","parameters":{"reflectance.table":1}}"#)
}

fn settings() -> ColourSettings {
    let names = ColourQuery::of_factors("D65");
    names.settings(None).unwrap()
}

fn scene(shape: BodyShape, lamps: Vec<Lamp>) -> Scene {
    Scene {
        shape,
        lamps,
        light: [1.0, 0.0, 0.0, 0.0],
        light_basis: LampBasis::PlaneOfIncidence,
        sky: Sky::Dark,
        bounce: false,
        size: [16, 16],
        samples: 4,
        exact: false,
        spectra: false,
    }
}

fn film(material: &PreparedMaterial, scene: &Scene) -> RenderedFilm {
    render(material, scene, &WAVELENGTHS, settings(), &Control::default()).unwrap()
}

/// Y of the four Stokes components in the middle of the picture.
fn middle(film: &RenderedFilm) -> [f64; 4] {
    let [width, height] = film.size;
    film.pixels[width * (height / 2) + width / 2].map(|xyz| xyz.y)
}

fn degrees(angle: f64) -> f64 {
    angle * PI / 180.0
}

#[test]
fn a_white_surface_that_faces_the_lamp_has_the_value_one() {
    let lamp = Lamp { toward: DVec3::Z, radius: 0.0, irradiance: 1.0 };
    let [i, q, u, v] = middle(&film(&white(), &scene(BodyShape::Plane(0.0), vec![lamp])));
    // The spectrum is summed in another order than that of the white.
    assert!((i - 1.0).abs() < 1e-12 && q == 0.0 && u == 0.0 && v == 0.0, "{i} {q} {u} {v}");
}

#[test]
fn a_white_surface_under_the_sky_alone_has_the_value_of_the_sky() {
    let sky = Scene { sky: Sky::Uniform(0.5), ..scene(BodyShape::Plane(0.3), Vec::new()) };
    // Every sample of a white surface has the same value.
    assert!((middle(&film(&white(), &sky))[0] - 0.5).abs() < 1e-12);
}

#[test]
fn a_sky_that_is_bright_on_one_side_lights_what_turns_there() {
    // White above the horizon of the camera, black below it.
    let values = (0..32).flat_map(|row| [if row < 16 { 1.0 } else { 0.0 }; 64]).collect();
    let picture = Image::new([64, 32], 1, values, Encoding::Linear).unwrap();
    for tilt in [0.0, 40.0, -70.0] {
        let scene = Scene {
            sky: Sky::Map(Environment::new(&picture, 0.8)),
            samples: 4096,
            ..scene(BodyShape::Plane(degrees(tilt)), Vec::new())
        };
        // The part of a half space that a plane sees: (1 + cos of the angle to the zenith)/2.
        let expected = 0.8 * 0.5 * (1.0 + degrees(tilt).sin());
        let [found, q, ..] = middle(&film(&white(), &scene));
        assert!((found - expected).abs() < 0.02 && q == 0.0, "{tilt}: {found}, {expected}");
    }
}

#[test]
fn light_in_the_mirror_of_glass_at_brewsters_angle_is_horizontal() {
    let glass = r#"{"model":"Facet_BRDF_Model","parameters":{"substrate":"(1.5,0)",
        "sdf":"Gaussian_Slope_Distribution_Function","sdf.s":0.2}}"#;
    let tilt = 1.5_f64.atan();
    // The plane leans back, so the mirror of the view lies above, in the plane x = 0.
    let lamp = Lamp::at(2.0 * tilt, degrees(90.0), 0.0, 1.0);
    let [i, q, u, v] = middle(&film(&material(glass), &scene(BodyShape::Plane(tilt), vec![lamp])));
    assert!(i > 0.01, "{i}");
    for (found, expected) in [(q / i, 1.0), (u / i, 0.0), (v / i, 0.0)] {
        assert!((found - expected).abs() < 1e-9, "{q} {u} {v} of {i}");
    }
}

#[test]
fn a_filter_sees_a_turned_camera_as_a_turned_filter() {
    // The same scene turned by 30° about the view: Q + iU turns by 60°.
    let metal = r#"{"model":"Facet_BRDF_Model","parameters":{"substrate":"(1.2,7)","sdf.s":0.4}}"#;
    let metal = material(metal);
    let turned = |azimuth: f64| {
        let lamp = Lamp::at(degrees(50.0), degrees(azimuth), 0.0, 1.0);
        middle(&film(
            &metal,
            &Scene { light: [1.0, 0.3, 0.4, 0.5], ..scene(BodyShape::Plane(0.0), vec![lamp]) },
        ))
    };
    let ([i, q, u, v], [i2, q2, u2, v2]) = (turned(10.0), turned(40.0));
    let (sin, cos) = degrees(60.0).sin_cos();
    for (found, expected) in [(i2, i), (q2, cos * q - sin * u), (u2, sin * q + cos * u), (v2, v)] {
        assert!((found - expected).abs() < 1e-12 * i, "{found} {expected}");
    }
}

#[test]
fn horizontal_light_is_perpendicular_to_a_vertical_plane_of_incidence() {
    let metal = r#"{"model":"Facet_BRDF_Model","parameters":{"substrate":"(1.2,7)","sdf.s":0.4}}"#;
    let metal = material(metal);
    let seen = |light_basis| {
        let lamp = Lamp::at(degrees(50.0), degrees(90.0), 0.0, 1.0);
        let light = [1.0, 0.6, 0.0, 0.5];
        middle(&film(
            &metal,
            &Scene { light, light_basis, ..scene(BodyShape::Plane(0.0), vec![lamp]) },
        ))
    };
    let (plane, horizontal) = (seen(LampBasis::PlaneOfIncidence), seen(LampBasis::Horizontal));
    for (a, b) in plane.iter().zip(horizontal) {
        assert!((a - b).abs() < 1e-12, "{plane:?} {horizontal:?}");
    }
}

#[test]
fn light_between_points_only_adds_and_only_where_points_see_each_other() {
    let lamp = Lamp::at(degrees(20.0), degrees(90.0), 0.0, 1.0);
    let pictures = |shape| {
        let dark = scene(shape, vec![lamp]);
        let bright = Scene { bounce: true, ..dark.clone() };
        (film(&white(), &dark), film(&white(), &bright))
    };
    let (once, twice) = pictures(BodyShape::Sphere);
    assert!(once == twice, "a sphere sees nothing of itself");
    let (once, twice) = pictures(BodyShape::Mesh(Mesh::torus(24)));
    let pairs = || once.pixels.iter().zip(&twice.pixels).map(|(a, b)| (a[0].y, b[0].y));
    // The same samples of the lamp are in both; their sums are rounded in another order.
    assert!(pairs().all(|(a, b)| b >= a - 1e-12), "light was lost");
    assert!(pairs().any(|(a, b)| b > 1.1 * a && a > 0.0), "the hole lights nothing");
}

#[test]
fn the_picture_is_the_same_on_one_thread_and_on_three() {
    let lamp = Lamp::at(degrees(40.0), degrees(120.0), degrees(3.0), 1.0);
    let metal = r#"{"model":"Facet_BRDF_Model","parameters":{"sdf.s":0.4}}"#;
    let metal = material(metal);
    let scene =
        Scene { sky: Sky::Uniform(0.2), bounce: true, ..scene(BodyShape::Sphere, vec![lamp]) };
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| film(&metal, &scene))
    };
    assert!(on(1) == on(3));
}

#[test]
fn a_transmitting_model_and_a_cancellation_are_refused() {
    let lamp = Lamp::at(0.3, 0.0, 0.0, 1.0);
    let scene = scene(BodyShape::Sphere, vec![lamp]);
    let through = r#"{"model":"Facet_BRDF_Model","parameters":{"substrate":"(1.5,0)","type":1}}"#;
    let refusal = render(&material(through), &scene, &WAVELENGTHS, settings(), &Control::default());
    assert!(refusal.unwrap_err().to_string().contains("type"));
    let control = Control::default();
    control.cancel.store(true, std::sync::atomic::Ordering::Relaxed);
    assert!(render(&white(), &scene, &WAVELENGTHS, settings(), &control).is_err());
}

#[test]
fn the_picture_of_interpolated_responses_is_that_of_every_sample() {
    let paint = r#"{"model":"Shadowed_Facet_BRDF_Model","parameters":{"substrate":"(1.5,0)",
        "sdf":"Gaussian_Slope_Distribution_Function","sdf.s":0.3}}"#;
    let paint = material(paint);
    let lamp = Lamp::at(degrees(60.0), degrees(120.0), 0.0, 2.0);
    let light = [1.0, 0.2, 0.1, 0.0];
    let light_basis = LampBasis::Horizontal;
    let scene =
        Scene { light, light_basis, size: [192; 2], ..scene(BodyShape::Sphere, vec![lamp]) };
    let (fast, slow) =
        (film(&paint, &scene), film(&paint, &Scene { exact: true, ..scene.clone() }));
    assert!(fast != slow, "nothing was interpolated");
    for (a, b) in fast.pixels.iter().zip(&slow.pixels) {
        for (a, b_part) in a.iter().zip(b) {
            // The stated error: 1 per mille of the light, or of that of a body of reflectance 0.02.
            let most = 1e-3 * b[0].y.max(2.0 * 0.02);
            assert!((a.y - b_part.y).abs() <= most, "{} {} of {}", a.y, b_part.y, b[0].y);
        }
    }
}

#[test]
fn a_spectral_picture_holds_the_spectra_of_which_the_colours_are() {
    let lamp = Lamp { toward: DVec3::Z, radius: 0.0, irradiance: 1.0 };
    let scene = Scene { spectra: true, ..scene(BodyShape::Plane(0.0), vec![lamp]) };
    let film = film(&white(), &scene);
    let middle = 4 * WAVELENGTHS.len() * (16 * 8 + 8);
    let pixel = &film.spectra[middle..middle + 4 * WAVELENGTHS.len()];
    // 32-bit numbers.
    assert!(pixel[..WAVELENGTHS.len()].iter().all(|x| (x - 1.0).abs() < 1e-6), "{pixel:?}");
    assert!(pixel[WAVELENGTHS.len()..].iter().all(|x| *x == 0.0));
    let bytes = spectral_exr(&film, &WAVELENGTHS).unwrap();
    let file = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(std::io::Cursor::new(bytes))
        .unwrap();
    let channels = file.layer_data.channel_data.list;
    let names: Vec<String> = channels.iter().map(|channel| channel.name.to_string()).collect();
    assert_eq!(names.len(), 28);
    assert!(names.contains(&"S0.450,000000nm".into()) && names.contains(&"S3.700,000000nm".into()));
}
