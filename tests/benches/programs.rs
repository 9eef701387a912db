//! Time of complete runs of the bench programs: compile, run, format.
//!
//!     cargo bench -p mist-tests
//!
//! `docs/performance.md` compares the figures with NIST's.

use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use mist_tests::corpus;
use scattering::Mode;

fn programs(c: &mut Criterion) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/bench");
    let mut group = c.benchmark_group("programs");
    group.sample_size(10);
    for case in corpus::cases(&folder) {
        let Ok((sink, _)) = corpus::run(&folder, &case, Mode::Compat) else {
            continue;
        };
        assert!(!sink.results.is_empty());
        group.bench_function(&case.name, |b| b.iter(|| corpus::run(&folder, &case, Mode::Compat)));
    }
    group.finish();
}

criterion_group!(benches, programs);
criterion_main!(benches);
