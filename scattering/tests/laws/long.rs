//! Long and flat particles obey the laws of scattering: reciprocity, and the balance of energy of lossless ones.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use scattering::{
    Jones, Mode, ParameterNode, ParameterValue, optics::RefractiveIndex,
    polarization::TransverseFrame, registry::find_class, scatterer::Scatterer, spec,
    special::gauss,
};

/// Amplitudes of reversed beams agree to this part of the largest one: the error that a sound run states.
const RECIPROCAL: f64 = 1e-4;
/// Extinction and scattering agree to this part, twice the error of an amplitude.
const BALANCED: f64 = 2e-4;

/// (vertical, horizontal) half axes in units of 1/k.
const BODIES: [(f64, f64); 8] = [
    (10.0, 1.0),
    (8.0, 1.0),
    (1.0, 8.0),
    (12.0, 3.0),
    (3.0, 9.0),
    (5.0, 0.5),
    (0.6, 5.0),
    (20.0, 10.0),
];

fn spheroid((vertical, horizontal): (f64, f64), n: f64) -> Box<dyn Scatterer> {
    let class =
        |name: &str| ParameterNode::with_defaults(find_class(name).expect("a class"), Mode::Sound);
    let shape = class("Ellipsoid_Axisymmetric_Shape")
        .with("vertical", ParameterValue::Number(vertical))
        .and_then(|node| node.with("horizontal", ParameterValue::Number(horizontal)))
        .expect("half axes");
    let node = class("TMatrix_Axisymmetric_Scatterer")
        .with("lambda", ParameterValue::Number(TAU))
        .and_then(|node| node.with("Shape", ParameterValue::Member(shape.into())))
        .and_then(|node| {
            node.with("particle", ParameterValue::Index(RefractiveIndex::constant(n, 0.0)))
        })
        .expect("parameters");
    spec::build::<dyn Scatterer>(&node)
        .unwrap_or_else(|error| panic!("{vertical} {horizontal} {n}: {error}"))
}

fn jones(particle: &dyn Scatterer, k_in: DVec3, k_out: DVec3) -> Jones {
    particle.jones(k_in, k_out, &TransverseFrame::psps(k_in), &TransverseFrame::psps(k_out))
}

fn direction(cos: f64, phi: f64) -> DVec3 {
    let sin = (1.0 - cos * cos).sqrt();
    DVec3::new(sin * phi.cos(), sin * phi.sin(), cos)
}

#[test]
fn reversed_light_takes_the_same_path_through_long_particles() {
    for (body, n) in BODIES.into_iter().zip([1.33, 1.59, 1.33, 1.59, 1.33, 1.59, 1.33, 1.33]) {
        let particle = spheroid(body, n);
        for (a, b) in [
            (direction(-0.8, 0.0), direction(0.6, 0.9)),
            (direction(-0.1, 0.3), direction(-0.7, 2.0)),
        ] {
            let (forth, back) = (jones(&*particle, a, b), jones(&*particle, -b, -a));
            let size = forth.ss.norm().max(forth.pp.norm());
            let difference = (forth.ss - back.ss).norm()
                + (forth.pp - back.pp).norm()
                + (forth.ps + back.sp).norm()
                + (forth.sp + back.ps).norm();
            assert!(difference < RECIPROCAL * size, "{body:?} {n}: {:e}", difference / size);
        }
    }
}

#[test]
fn long_lossless_particles_scatter_what_they_take_from_the_beam() {
    for (body, n) in BODIES.into_iter().zip([1.59, 1.33, 1.59, 1.33, 1.59, 1.001, 1.59, 1.33]) {
        let particle = spheroid(body, n);
        let k_in = direction(-0.65, 0.4);
        let forward = jones(&*particle, k_in, k_in);
        // With k = 1 and unpolarized light: 4π Re S(0) and ∫ |S|² dΩ.
        let extinction = TAU * (forward.ss + forward.pp).re;
        let azimuths = 96;
        let mut scattering = 0.0;
        for (cos, weight) in gauss::legendre(72, -1.0, 1.0) {
            for step in 0..azimuths {
                let phi = TAU * step as f64 / azimuths as f64;
                let j = jones(&*particle, k_in, direction(cos, phi));
                let sum: f64 = [j.ss, j.ps, j.sp, j.pp].iter().map(|z| z.norm_sqr()).sum();
                scattering += weight * 2.0 * PI / azimuths as f64 * 0.5 * sum;
            }
        }
        let balance = scattering / extinction - 1.0;
        assert!(balance.abs() < BALANCED, "{body:?} {n}: {balance:e}");
    }
}
