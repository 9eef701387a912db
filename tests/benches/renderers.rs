//! Time of a preview of 512² pixels, 31 wavelengths and 16 samples, and of a table for Mitsuba.
//!
//!     cargo bench -p mist-tests --bench renderers
//!
//! Targets: 5 s and 1 s on two processors.

use criterion::{Criterion, criterion_group, criterion_main};
use mist_engine::{
    Control,
    material::{Material, PreparedMaterial},
    request::ColourQuery,
};
use preview::{BodyShape, Lamp, LampBasis, Scene, Sky, mesh::Mesh, render};
use rise_bridge::mitsuba::{axes::HalfAngleAxes, pbsdf};
use scattering::Mode;

fn material(json: &str) -> PreparedMaterial {
    let material = Material::from_json(json).expect("the JSON above is a material");
    material.prepare(Mode::Sound, None).expect("it needs no files")
}

fn paint() -> PreparedMaterial {
    material(
        r#"{"model":"Shadowed_Facet_BRDF_Model","parameters":{"substrate":"(1.5,0)",
        "sdf":"Gaussian_Slope_Distribution_Function","sdf.s":0.25,"shadow":"Smith_Shadow_Function"}}"#,
    )
}

fn preview(c: &mut Criterion) {
    let paint = paint();
    let nm: Vec<f64> = (40..=70).map(|k| 10.0 * f64::from(k)).collect();
    let names = ColourQuery::of_factors("D65");
    let settings = names.settings(None).expect("names of CIE");
    let mut group = c.benchmark_group("preview");
    group.sample_size(10);
    for (name, shape) in [("sphere", BodyShape::Sphere), ("knot", BodyShape::Mesh(Mesh::knot(96)))]
    {
        let scene = Scene {
            shape,
            lamps: vec![Lamp::at(0.7, 2.1, 0.0, 1.0)],
            light: [1.0, 0.0, 0.0, 0.0],
            light_basis: LampBasis::PlaneOfIncidence,
            sky: Sky::Dark,
            bounce: false,
            size: [512, 512],
            samples: 16,
            exact: false,
            spectra: false,
        };
        let picture = || render(&paint, &scene, &nm, settings.clone(), &Control::default());
        group.bench_function(name, |b| b.iter(|| picture().expect("a picture")));
    }
    group.finish();
}

fn table(c: &mut Criterion) {
    let bands = pbsdf::bands(&paint(), &[450.0, 500.0, 550.0, 600.0, 650.0], true);
    let bands = bands.expect("five wavelengths");
    let axes = HalfAngleAxes::new([37, 46, 91], false).expect("a grid");
    let mut group = c.benchmark_group("pbsdf");
    group.sample_size(10);
    group.bench_function("37x46x91x5", |b| {
        b.iter(|| {
            pbsdf::write(&bands, &axes, "{}", Vec::new(), &Control::default()).expect("bytes")
        });
    });
    group.finish();
}

criterion_group!(benches, preview, table);
criterion_main!(benches);
