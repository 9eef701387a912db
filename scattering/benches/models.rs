//! Mueller matrices per second, one thread, in batches.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use scattering::{
    Basis, Direction, Incidence, Mode, Model, Mueller, ParameterNode, ParameterValue, models,
    optics::RefractiveIndex, stack::Film,
};

/// Directions in a batch: enough to hide the call, few enough to stay in the cache.
const BATCH: usize = 1024;

fn class(name: &str) -> ParameterNode {
    ParameterNode::with_defaults(scattering::registry::find_class(name).unwrap(), Mode::Sound)
}

fn facet(index: RefractiveIndex, films: Vec<Film>) -> Model {
    let slopes = class("Gaussian_Slope_Distribution_Function");
    let stack = class("Stack_StackModel").with("stack", ParameterValue::Films(films)).unwrap();
    let node = class("Facet_BRDF_Model")
        .with("substrate", ParameterValue::Index(index))
        .and_then(|node| node.with("sdf", ParameterValue::Member(slopes.into())))
        .and_then(|node| node.with("stack", ParameterValue::Member(stack.into())));
    models::build(&node.unwrap()).unwrap()
}

/// Directions spread over the hemisphere.
fn directions() -> Vec<Direction> {
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let at = |i: usize| {
        let cos = 1.0 - (i as f64 + 0.5) / BATCH as f64;
        Direction::new(cos.acos(), golden * i as f64)
    };
    (0..BATCH).map(at).collect()
}

fn batches(c: &mut Criterion) {
    let film = |n, thickness| Film { index: RefractiveIndex::constant(n, 0.0), thickness };
    let films = vec![film(2.5, 0.06), film(1.58, 0.3), film(2.5, 0.06)];
    let flakes = class("Subsurface_Facet_BRDF_Model");
    let shadowed = class("Shadowed_Facet_BRDF_Model");
    let cases = [
        ("facet metal", facet(RefractiveIndex::constant(1.3, 1.2), Vec::new())),
        ("facet glass", facet(RefractiveIndex::constant(1.5, 0.0), Vec::new())),
        ("facet three films", facet(RefractiveIndex::constant(1.5, 0.0), films)),
        ("flakes under a coat", models::build(&flakes).unwrap()),
        ("shadowed facet", models::build(&shadowed).unwrap()),
    ];
    let (incidence, directions) = (Incidence::new(0.7, 0.2), directions());
    let mut out = vec![Mueller::ZERO; BATCH];
    let mut group = c.benchmark_group("batch");
    group.throughput(Throughput::Elements(BATCH as u64));
    for (name, model) in &cases {
        group.bench_function(*name, |b| {
            b.iter(|| {
                model.evaluate(black_box(&incidence), &directions, Basis::Psps, &mut out);
                black_box(&out);
            });
        });
    }
    group.finish();
}

/// Every class with its defaults: many directions of one beam, and one direction of many beams.
///
/// The second counts what is done for each beam: a grating solves its equations.
fn defaults(c: &mut Criterion) {
    let all = directions();
    let mut out = vec![Mueller::ZERO; BATCH];
    let mut group = c.benchmark_group("defaults");
    group.sample_size(10);
    for spec in models::all() {
        let Ok(model) = models::build(&class(spec.class.name)) else { continue };
        group.bench_function(format!("{} per direction", spec.class.name), |b| {
            let beam = Incidence::new(0.7, 0.2);
            b.iter(|| {
                model.evaluate(black_box(&beam), &all, Basis::Psps, &mut out);
                black_box(&out);
            });
        });
        let mut number = 0;
        group.bench_function(format!("{} per beam", spec.class.name), |b| {
            b.iter(|| {
                number = (number + 1) % 900;
                let beam = Incidence::new(0.1 + 0.001 * f64::from(number), 0.2);
                model.evaluate(&beam, &all[..1], Basis::Psps, &mut out[..1]);
                black_box(&out[0]);
            });
        });
    }
    group.finish();
}

criterion_group!(benches, batches, defaults);
criterion_main!(benches);
