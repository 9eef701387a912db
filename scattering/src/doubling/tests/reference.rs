//! Reads the cases of `tests/reference/doubling.json` as stacks.

use std::f64::consts::PI;

use num_complex::Complex64;
use serde_json::Value;

use super::super::{
    expansion::PhaseExpansion,
    flakes::FlakeLayer,
    interface::SmoothFace,
    rough::{FacetBounces, RoughFace},
    slopes::GaussianSlopes,
    stack::{LayerFace, SlabParticles, StackBottom, TransferLayer, TransferStack},
};
use crate::{
    Mode, Mueller, ParameterNode, ParameterValue, optics::RefractiveIndex, registry,
    scatterer::Scatterer, spec,
};

pub(super) fn file() -> Value {
    serde_json::from_str(include_str!("../../../../tests/reference/doubling.json")).unwrap()
}

pub(super) fn case(name: &str) -> Value {
    let all = file();
    let found = |list: &str| {
        all[list].as_array().unwrap().iter().find(|case| case["name"] == name).cloned()
    };
    found("cases").or_else(|| found("external")).unwrap_or_else(|| panic!("no case {name}"))
}

pub(super) fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or_else(|| panic!("{v} is not a number"))
}

pub(super) fn numbers(v: &Value) -> Vec<f64> {
    v.as_array().map_or_else(|| vec![number(v)], |list| list.iter().map(number).collect())
}

/// The expansion of the phase matrix of a file's slab.
pub(super) fn series(phase: &Value, top: usize) -> PhaseExpansion {
    match phase["kind"].as_str().unwrap() {
        "Rayleigh" => PhaseExpansion::rayleigh(),
        "HG" => PhaseExpansion::henyey_greenstein(number(&phase["g"]), top),
        "coefficients" => {
            let list = |name: &str| numbers(&phase[name]);
            let lists = ["a1", "a2", "a3", "a4", "b1", "b2"].map(list);
            let term = |l: usize| std::array::from_fn(|k| lists[k][l]);
            PhaseExpansion { terms: (0..lists[0].len()).map(term).collect() }
        }
        "spheres" => {
            let parts: Vec<(f64, Box<dyn Scatterer>)> = phase["parts"]
                .as_array()
                .unwrap()
                .iter()
                .map(|part| (number(&part["number_weight"]), sphere(part)))
                .collect();
            let elements = |c: f64| {
                let mut sum = Mueller::ZERO;
                for (weight, sphere) in &parts {
                    sum += sphere.round().unwrap().amplitudes(c).mueller() * *weight;
                }
                [sum[(0, 0)], sum[(1, 1)], sum[(2, 2)], sum[(3, 3)], sum[(0, 1)], sum[(2, 3)]]
            };
            let mut series = PhaseExpansion::integrated(elements, top, 240);
            let whole = series.terms[0][0];
            series.terms.iter_mut().flatten().for_each(|x| *x /= whole);
            series
        }
        other => panic!("{other}"),
    }
}

/// A sphere of the size parameter and relative index of a file.
pub(super) fn sphere(part: &Value) -> Box<dyn Scatterer> {
    let index = numbers(&part["relative_index"]);
    let value = |n, k| ParameterValue::Index(RefractiveIndex::constant(n, k));
    let node =
        ParameterNode::with_defaults(registry::find_class("MieScatterer").unwrap(), Mode::Sound)
            .with("lambda", ParameterValue::Number(2.0 * PI))
            .and_then(|n| n.with("medium", value(1.0, 0.0)))
            .and_then(|n| {
                n.with("radius", ParameterValue::Number(number(&part["size_parameter_in_medium"])))
            })
            .and_then(|n| n.with("sphere", value(index[0], index[1])))
            .unwrap();
    spec::build(&node).unwrap()
}

pub(super) fn slopes(sigma: &Value) -> GaussianSlopes {
    GaussianSlopes { sigma: number(sigma) }
}

pub(super) fn flakes(v: &Value) -> FlakeLayer {
    let core = v.get("core").map(|core| {
        let core = numbers(core);
        Complex64::new(core[0], core[1])
    });
    let lambda = v.get("wavelength").map_or(1.0, number);
    let film = |film: &Value| (number(&film[0]).into(), number(&film[1]) / lambda);
    let plate = v.get("plate").and_then(Value::as_array);
    FlakeLayer {
        depth: number(&v["coverage_depth"]),
        slopes: slopes(&v["slope_sigma"]),
        films: SmoothFace { films: plate.map_or_else(Vec::new, |f| f.iter().map(film).collect()) },
        core,
    }
}

/// The stack of a file's inputs, with phase matrices up to l = `top`.
pub(super) fn stack(inputs: &Value, top: usize) -> TransferStack {
    let mut layers = Vec::new();
    let mut bottom = StackBottom::Black;
    let mut face = LayerFace::default();
    for input in inputs.as_array().unwrap() {
        if let Some(interface) = input.get("interface") {
            let lambda = interface.get("wavelength").map_or(1.0, number);
            let films = interface.get("films").and_then(Value::as_array);
            let film = |film: &Value| (number(&film[0]).into(), number(&film[1]) / lambda);
            let films =
                SmoothFace { films: films.map_or_else(Vec::new, |f| f.iter().map(film).collect()) };
            face = match interface.get("slope_sigma") {
                Some(sigma) => LayerFace::Rough(RoughFace {
                    films,
                    slopes: slopes(sigma),
                    bounces: FacetBounces::All,
                }),
                None => LayerFace::Smooth(films),
            };
        } else if let Some(slab) = input.get("slab") {
            // A half space is one that no light leaves below: white over white.
            let depth = slab["depth"].as_f64().unwrap_or(1e3);
            layers.push(TransferLayer {
                n: number(&slab["index"]),
                face: std::mem::take(&mut face),
                particles: Some(SlabParticles {
                    depth,
                    albedo: number(&slab["albedo"]),
                    series: series(&slab["phase"], top),
                    whole: None,
                }),
                binder: slab.get("binder_depth").map_or(0.0, number),
                flakes: slab.get("flakes").map(flakes),
            });
            if slab["depth"].as_f64().is_none() {
                bottom = StackBottom::Lambertian(1.0);
            }
        } else if let Some(below) = input.get("bottom") {
            if let Some(rho) = below.get("lambertian") {
                bottom = StackBottom::Lambertian(number(rho));
            } else if let Some(metal) = below.get("metal") {
                let metal = numbers(metal);
                let index = Complex64::new(metal[0], metal[1]);
                bottom = StackBottom::Mirror(SmoothFace::default(), index);
            }
        }
    }
    TransferStack { layers, bottom }
}
