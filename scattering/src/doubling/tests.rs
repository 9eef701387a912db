//! The reference cases of `tests/reference/doubling.json`: published tables and converged values.

mod laws;
mod reference;
mod rough;

use std::{f64::consts::PI, sync::Arc};

use num_complex::Complex64;

use super::{
    block::{RealMatrix, TransferBlock},
    diffuse::DiffuseModes,
    expansion::PhaseExpansion,
    interface::SmoothFace,
    nodes::RayNodes,
    phase_matrix,
    phase_table::PhaseTable,
    single::SingleSlab,
    slab::{self, SlabMedium},
    stack::{
        AngularResolution, LayerFace, SlabParticles, StackBottom, TransferLayer, TransferProblem,
        TransferStack,
    },
    table::ModeTable,
};
use crate::Mueller;
use reference::{case, number, numbers, series, stack};

/// The diffuse Mueller BRDF between two nodes at `phi`, from the blocks of all modes.
struct NodeBrdf {
    blocks: Vec<(TransferBlock, RealMatrix)>,
    scale: Vec<f64>,
    direct: Vec<RealMatrix>,
}

impl NodeBrdf {
    fn new(transfer: &TransferProblem<'_>, modes: usize) -> Self {
        let outside = transfer.outside();
        let blocks = TransferBlock::all(modes);
        let blocks = blocks.into_iter().map(|block| (block, transfer.reflection(block))).collect();
        let scale = (0..outside.len()).map(|i| outside.root_flux(i)).collect();
        Self { blocks, scale, direct: transfer.direct() }
    }

    fn mueller(&self, out: usize, into: usize, phi: f64) -> Mueller {
        let mut sum = Mueller::ZERO;
        for (block, r) in &self.blocks {
            let (s, first, m) = (block.size(), block.first(), block.mode());
            let (sin, cos) = (m as f64 * phi).sin_cos();
            let twice = if m == 0 { 1.0 } else { 2.0 };
            for a in 0..s {
                for b in 0..s {
                    let (i, j) = (first + a, first + b);
                    let direct = if out == into { self.direct[out][(i, j)] } else { 0.0 };
                    let f = (r[(s * out + a, s * into + b)] - direct)
                        / (2.0 * PI * self.scale[out] * self.scale[into]);
                    let wave = match (i < 2, j < 2) {
                        (true, false) => -sin,
                        (false, true) => sin,
                        _ => cos,
                    };
                    sum[(i, j)] += twice * f * wave;
                }
            }
        }
        sum
    }

    /// Returned light of I and Q at a node, the direct light too.
    fn returned(&self, into: usize) -> [f64; 2] {
        let r = &self.blocks[0].1;
        let row = |b: usize| {
            let part = |i: usize| self.scale[i] * r[(2 * i, 2 * into + b)];
            (0..self.scale.len()).map(part).sum::<f64>() / self.scale[into]
        };
        [row(0), row(1)]
    }
}

/// The resolution of a test: nodes outside, trapped ones, l.
fn resolution(outside: usize, trapped: usize, order: usize) -> AngularResolution {
    AngularResolution { outside, trapped, order, modes: 14 }
}

fn check_case(name: &str, resolution: &AngularResolution, tolerance: f64) {
    let case = case(name);
    let (mu_i, mu_s) = (numbers(&case["mu_i"]), numbers(&case["mu_s"]));
    let stack = stack(&case["inputs"], resolution.order + 1);
    let extra: Vec<f64> = mu_i.iter().chain(&mu_s).copied().collect();
    let transfer = TransferProblem::new(&stack, resolution, &extra);
    let modes = case["modes"].as_u64().unwrap() as usize;
    let diffuse = NodeBrdf::new(&transfer, modes);
    let first = resolution.outside;
    let mut worst: f64 = 0.0;
    for i in 0..mu_i.len() {
        for s in 0..mu_s.len() {
            for (k, phi) in numbers(&case["phi_deg"]).iter().enumerate() {
                let ours = diffuse.mueller(first + mu_i.len() + s, first + i, phi.to_radians());
                let theirs = numbers(&case["mueller"][i][s][k]);
                for (a, b) in ours.to_row_major().iter().zip(theirs) {
                    worst = worst.max((a - b).abs());
                }
            }
        }
        let returned = diffuse.returned(first + i);
        for (a, b) in returned.iter().zip(numbers(&case["returned_all_IQ"][i])) {
            assert!((a - b).abs() < tolerance, "{name}: returned {a} {b}");
        }
    }
    assert!(worst < tolerance, "{name}: off by {worst:e}");
}

#[test]
fn smooth_cases_are_those_of_the_file() {
    let few = resolution(12, 9, 22);
    for name in
        ["rayleigh_black", "rayleigh_grey", "white", "film", "mie_three_sizes", "mie_walk", "hg"]
    {
        let few = if name == "hg" { resolution(12, 9, 24) } else { few };
        check_case(name, &few, 1e-5);
    }
    check_case("metal_bottom", &few, 1e-5);
    check_case("half_space_white", &few, 1e-5);
}

#[test]
fn spheres_without_a_surface_are_those_of_the_file() {
    check_case("no_surface", &resolution(24, 0, 16), 3e-6);
}

#[test]
fn published_tables_are_met() {
    for (name, nodes, tolerance, signs) in [
        ("coulson_A0", 20, 1e-6, [1.0, 1.0, -1.0]),
        ("coulson_A0.8", 20, 1e-6, [1.0, 1.0, -1.0]),
        ("siewert_aerosol", 20, 2e-6, [1.0, -1.0, 1.0]),
    ] {
        let case = case(name);
        let mu_i = number(&case["mu_i"]);
        let values = case["values"].as_array().unwrap();
        let extra: Vec<f64> =
            std::iter::once(mu_i).chain(values.iter().map(|v| number(&v["mu_s"]))).collect();
        let resolution = resolution(nodes, 0, 11);
        let stack = stack(&case["inputs"], resolution.order + 1);
        let transfer = TransferProblem::new(&stack, &resolution, &extra);
        let diffuse = NodeBrdf::new(&transfer, 12);
        let mut worst: f64 = 0.0;
        for (k, value) in values.iter().enumerate() {
            let phi = number(&value["phi_deg"]).to_radians();
            let m = diffuse.mueller(nodes + 1 + k, nodes, phi);
            for (row, (sign, want)) in signs.iter().zip(numbers(&value["table_IQU"])).enumerate() {
                let got = sign * PI * mu_i * m[(row, 0)];
                worst = worst.max((got - want).abs());
            }
        }
        assert!(worst < tolerance, "{name}: off by {worst:e}");
    }
}

/// A slab of one kind of scatterers with its own index.
fn layer(n: f64, depth: f64, albedo: f64, series: PhaseExpansion) -> TransferLayer {
    let particles = Some(SlabParticles { depth, albedo, series, whole: None });
    TransferLayer { n, face: LayerFace::default(), particles, binder: 0.0, flakes: None }
}

#[test]
fn half_spaces_of_isotropic_scatterers_follow_the_h_function() {
    let mu = [0.2, 0.5, 0.9];
    for (albedo, bottom, h) in [
        (0.9, StackBottom::Black, [1.291_433_73, 1.556_033_8, 1.800_787_36]),
        (0.999, StackBottom::Black, [1.434_415_86, 1.958_687_47, 2.601_622_39]),
    ] {
        let isotropic = PhaseExpansion::henyey_greenstein(0.0, 1);
        let stack = TransferStack { layers: vec![layer(1.0, 400.0, albedo, isotropic)], bottom };
        let resolution = resolution(20, 0, 0);
        let transfer = TransferProblem::new(&stack, &resolution, &mu);
        let diffuse = NodeBrdf::new(&transfer, 0);
        for i in 0..3 {
            for s in 0..3 {
                let got = diffuse.mueller(20 + s, 20 + i, 0.0)[(0, 0)];
                let want = albedo * h[i] * h[s] / (4.0 * PI * (mu[i] + mu[s]));
                assert!((got - want).abs() < 1e-6 * want, "{albedo} {i} {s}: {got} {want}");
            }
        }
    }
}

#[test]
fn light_from_the_depth_is_polarized_at_the_limb_as_in_milne_s_problem() {
    // S. Chandrasekhar, Radiative Transfer (Dover, 1960), section 68.
    let directions = RayNodes::new(&[], 24, 0, &[1e-5, 1.0]).inside(1.0);
    let block = TransferBlock::Intensity;
    let (mut down, mut up) = phase_matrix::modes(block, &directions, &PhaseExpansion::rayleigh());
    slab::close(block, &directions, &mut down, &mut up);
    let mut medium = SlabMedium::clear(block, &directions, 0.0);
    medium.add(100.0, (&down, &up), 100.0);
    let t = medium.operator(block, &directions).t_up;
    let radiance = |i: usize, c: usize| t[(2 * i + c, 10)] / directions.root_flux(i);
    let limb = radiance(24, 1) / radiance(24, 0);
    assert!((limb.abs() - 0.11713).abs() < 3e-5, "{limb}");
    let contrast = radiance(25, 0) / radiance(24, 0);
    assert!((contrast - 3.063).abs() < 2e-3, "{contrast}");
}

#[test]
fn interpolated_values_are_those_of_the_file() {
    for name in ["rayleigh_grey", "mie_walk"] {
        let case = case(name);
        let resolution = resolution(16, 10, 26);
        let stack = stack(&case["inputs"], 27);
        let transfer = TransferProblem::new(&stack, &resolution, &[]);
        let diffuse = DiffuseModes::new(&transfer, 20, 1e-7);
        let table = ModeTable::new(&diffuse, 48);
        let mut worst: f64 = 0.0;
        for (i, mu_i) in numbers(&case["mu_i"]).iter().enumerate() {
            let mut beam = table.beam(mu_i.acos());
            for (s, mu_s) in numbers(&case["mu_s"]).iter().enumerate() {
                for (k, phi) in numbers(&case["phi_deg"]).iter().enumerate() {
                    let phi = phi.to_radians();
                    let ours = beam.mueller(mu_s.acos(), (phi.cos(), phi.sin())).to_row_major();
                    for (a, b) in ours.iter().zip(numbers(&case["mueller"][i][s][k])) {
                        worst = worst.max((a - b).abs());
                    }
                }
            }
        }
        assert!(worst < 1e-6, "{name}: off by {worst:e}");
    }
}

#[test]
fn flakes_are_those_of_the_file() {
    for name in ["flakes_metal", "flakes_white"] {
        check_case(name, &resolution(14, 11, 8), 5e-5);
    }
}

/// Modes and light scattered once of a slab of Henyey and Greenstein's function, g = 0.85.
fn peaked(n: f64, nodes: (usize, usize), order: usize) -> (ModeTable, Vec<SingleSlab>) {
    let g: f64 = 0.85;
    let elements = |c: f64| {
        let p = (1.0 - g * g) / (1.0 + g * g - 2.0 * g * c).powf(1.5);
        [p, 0.0, 0.0, 0.0, 0.0, 0.0]
    };
    let mut layer = layer(n, 3.0, 0.98, PhaseExpansion::henyey_greenstein(g, order + 1));
    let whole = Some(Arc::new(PhaseTable::new(elements, 1.0)));
    layer.particles.as_mut().unwrap().whole = whole;
    let stack = TransferStack { layers: vec![layer], bottom: StackBottom::Black };
    let transfer = TransferProblem::new(&stack, &resolution(nodes.0, nodes.1, order), &[]);
    let diffuse = DiffuseModes::new(&transfer, order, 1e-7);
    (ModeTable::new(&diffuse, 48), transfer.singles())
}

#[test]
fn forward_peaks_need_few_orders_since_light_scattered_once_is_exact() {
    for (n, tolerance) in [(1.5, 1.3e-4), (1.0, 2e-3)] {
        let few = peaked(n, (12, if n > 1.0 { 9 } else { 0 }), 20);
        let many = peaked(n, (20, if n > 1.0 { 14 } else { 0 }), 38);
        let at = |(table, singles): &(ModeTable, Vec<SingleSlab>), a: f64, b: f64, phi: f64| {
            let turn = (phi.cos(), phi.sin());
            let single = &singles[0];
            let (i, s) = (single.ray(a.sin()), single.ray(b.sin()));
            table.beam(a).mueller(b, turn) + single.mueller(&i, &s, turn)
        };
        for (a, b, phi) in [(0.5, 0.9, 0.3), (1.3, 1.2, 0.1), (0.2, 0.4, 2.0)] {
            let (few, many) = (at(&few, a, b, phi), at(&many, a, b, phi));
            let off = (few - many).largest();
            assert!(off < tolerance * (1.0 + many.largest()), "{n} {a} {b} {phi}: {off:e}");
        }
    }
}

#[test]
fn light_scattered_once_is_the_sum_of_its_modes() {
    let mut layer =
        layer(1.5, 0.8, 0.9, series(&case("mie_walk")["inputs"][1]["slab"]["phase"], 14));
    layer.face = LayerFace::Smooth(SmoothFace { films: vec![(Complex64::new(1.9, 0.3), 0.2)] });
    let particles = layer.particles.as_mut().unwrap();
    let own = particles.series.clone();
    particles.whole = Some(Arc::new(PhaseTable::new(|c| own.at_cosine(c), 1.0)));
    let stack = TransferStack { layers: vec![layer], bottom: StackBottom::Black };
    let transfer = TransferProblem::new(&stack, &resolution(4, 3, 14), &[]);
    let single = &transfer.singles()[0];
    let modes: Vec<_> = TransferBlock::all(14)
        .into_iter()
        .map(|block| (block, transfer.single_modes(block)))
        .collect();
    let brdf = NodeBrdf {
        blocks: modes,
        scale: vec![(0.5 / PI).sqrt(); 4],
        direct: vec![RealMatrix::zeros(4, 4); 4],
    };
    let rays: Vec<_> =
        (0..4).map(|i| single.ray((1.0 - transfer.outside().mu[i].powi(2)).sqrt())).collect();
    for (i, s, phi) in [(0, 1, 0.7f64), (2, 3, -2.0), (3, 0, 1.4), (1, 1, 0.3)] {
        let sum = brdf.mueller(s, i, phi);
        let whole = single.mueller(&rays[i], &rays[s], (phi.cos(), phi.sin()));
        assert!((sum - whole).largest() < 1e-9 * whole.largest(), "{phi}: {sum:?} {whole:?}");
    }
}
