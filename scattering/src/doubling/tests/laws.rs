//! Laws of stacks: identities, reciprocity, energy.

use super::*;

fn largest_difference(a: &TransferStack, b: &TransferStack, resolution: &AngularResolution) -> f64 {
    let [a, b] = [a, b].map(|stack| TransferProblem::new(stack, resolution, &[]));
    let blocks = TransferBlock::all(3);
    let difference =
        |block: &TransferBlock| (a.reflection(*block) - b.reflection(*block)).norm_max();
    blocks.iter().map(difference).fold(0.0, f64::max)
}

#[test]
fn what_is_not_there_changes_nothing() {
    let series = PhaseExpansion::henyey_greenstein(0.6, 20);
    let coat = |n: f64, depth: f64| TransferLayer {
        binder: 0.1 * depth,
        ..layer(n, depth, 0.9, series.clone())
    };
    let bottom = StackBottom::Mirror(SmoothFace::default(), Complex64::new(1.2, 7.0));
    let stack = |layers: Vec<TransferLayer>| TransferStack { layers, bottom: bottom.clone() };
    let resolution = resolution(8, 6, 14);
    let whole = stack(vec![coat(1.5, 1.2)]);
    for other in [
        // Split.
        stack(vec![coat(1.5, 0.5), coat(1.5, 0.7)]),
        // Index matched to the air, without particles.
        stack(vec![coat(1.0, 0.0), coat(1.5, 1.2)]),
        // Without thickness.
        stack(vec![coat(1.5, 1.2), coat(1.5, 0.0)]),
    ] {
        let off = largest_difference(&whole, &other, &resolution);
        assert!(off < 1e-12, "{off:e}");
    }
}

#[test]
fn every_stack_is_reciprocal() {
    let series = series(&case("mie_walk")["inputs"][1]["slab"]["phase"], 20);
    let film = SmoothFace { films: vec![(Complex64::new(1.9, 0.3), 0.2)] };
    let layers = vec![
        TransferLayer { face: LayerFace::Smooth(film.clone()), ..layer(1.33, 0.7, 0.9, series) },
        layer(1.6, 2.0, 1.0, PhaseExpansion::rayleigh()),
    ];
    let stack =
        TransferStack { layers, bottom: StackBottom::Mirror(film, Complex64::new(0.2, 3.0)) };
    let resolution = resolution(8, 5, 18);
    let transfer = TransferProblem::new(&stack, &resolution, &[]);
    for block in TransferBlock::all(4) {
        let r = transfer.reflection(block);
        let off = (block.reversed(&r) - &r).norm_max();
        assert!(off < 1e-13, "{block:?}: {off:e}");
    }
}

#[test]
fn white_stacks_return_all_light_at_every_node() {
    let film = SmoothFace { films: vec![(Complex64::new(2.1, 0.0), 0.2)] };
    for depth in [0.01, 3.0, 1e3] {
        let layers = vec![
            TransferLayer {
                face: LayerFace::Smooth(film.clone()),
                ..layer(1.33, depth, 1.0, PhaseExpansion::rayleigh())
            },
            layer(1.6, 2.0, 1.0, PhaseExpansion::henyey_greenstein(0.7, 20)),
        ];
        let stack = TransferStack { layers, bottom: StackBottom::Lambertian(1.0) };
        let resolution = resolution(8, 6, 18);
        let transfer = TransferProblem::new(&stack, &resolution, &[]);
        let diffuse = NodeBrdf::new(&transfer, 0);
        for i in 0..8 {
            let [all, q] = diffuse.returned(i);
            assert!((all - 1.0).abs() < 1e-11 * (1.0 + depth), "{depth} {i}: {all}");
            assert!(q.abs() < 1e-11 * (1.0 + depth), "{depth} {i}: {q}");
        }
    }
}

/// ∫ f cos θ dΩ of the assembled BRDF, columns I and Q.
fn hemisphere(table: &ModeTable, theta_i: f64) -> [f64; 2] {
    let mut sum = [0.0; 2];
    let mut beam = table.beam(theta_i);
    for (mu, w) in crate::special::gauss::legendre(64, 0.0, 1.0) {
        // All modes but the first integrate to nothing.
        for k in 0..32 {
            let phi = 2.0 * PI * (f64::from(k) + 0.5) / 32.0;
            let m = beam.mueller(mu.acos(), (phi.cos(), phi.sin()));
            sum = std::array::from_fn(|q| sum[q] + m[(0, q)] * mu * w * 2.0 * PI / 32.0);
        }
    }
    sum
}

#[test]
fn the_assembled_brdf_of_white_stacks_returns_all_light() {
    let series = PhaseExpansion::rayleigh();
    let stack = TransferStack {
        layers: vec![layer(1.5, 0.5, 1.0, series)],
        bottom: StackBottom::Lambertian(1.0),
    };
    let transfer = TransferProblem::new(&stack, &resolution(12, 9, 3), &[]);
    let diffuse = DiffuseModes::new(&transfer, 4, 1e-9);
    let table = ModeTable::new(&diffuse, 48);
    for mu in [0.97f64, 0.7, 0.4, 0.1, 0.03] {
        let one = RayNodes::new(&[1.5], 0, 0, &[mu]);
        let [r, q] = [0, 1].map(|c| {
            SmoothFace::default().operator(TransferBlock::Mode(1), &one, 1.0, 1.5).r_down[(0, c)]
        });
        let [all, all_q] = hemisphere(&table, mu.acos());
        assert!((all + r - 1.0).abs() < 1e-6, "{mu}: {all} {r}");
        assert!((all_q + q).abs() < 1e-6, "{mu}: {all_q} {q}");
    }
}
