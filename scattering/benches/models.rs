//! Mueller matrices per second, one thread, in batches.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use scattering::{
    Basis, Direction, Incidence, Mode, Model, Mueller, Node, Value, models, optics::Index, spec,
    stack::Film,
};

/// Directions in a batch: enough to hide the call, few enough to stay in the cache.
const BATCH: usize = 1024;

fn class(name: &str) -> Node {
    Node::with_defaults(spec::find_class(name).unwrap(), Mode::Sound)
}

fn facet(index: Index, films: Vec<Film>) -> Model {
    let slopes = class("Gaussian_Slope_Distribution_Function");
    let stack = class("Stack_StackModel").with("stack", Value::Films(films)).unwrap();
    let node = class("Facet_BRDF_Model")
        .with("substrate", Value::Index(index))
        .and_then(|node| node.with("sdf", Value::Member(slopes.into())))
        .and_then(|node| node.with("stack", Value::Member(stack.into())));
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
    let film = |n, thickness| Film { index: Index::constant(n, 0.0), thickness };
    let films = vec![film(2.5, 0.06), film(1.58, 0.3), film(2.5, 0.06)];
    let flakes = class("Subsurface_Facet_BRDF_Model");
    let shadowed = class("Shadowed_Facet_BRDF_Model");
    let cases = [
        ("facet metal", facet(Index::constant(1.3, 1.2), Vec::new())),
        ("facet glass", facet(Index::constant(1.5, 0.0), Vec::new())),
        ("facet three films", facet(Index::constant(1.5, 0.0), films)),
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

criterion_group!(benches, batches);
criterion_main!(benches);
