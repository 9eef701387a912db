//! Twenty pigmented coatings against the random walks of `walk.rs`: what comes back in all, and in
//! five cones, of partly polarized light.
//!
//! Walks agree with the model within four standard deviations or within the error of the model:
//! it follows one reflection by facets, takes the light of flakes and body for diffuse after that,
//! and refracts by a flat surface. `MODEL_ERROR` states it.
//!
//! `cargo test --release -p mist-scattering --test coating witness -- --nocapture` lists what it finds.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;
use num_complex::Complex64;
use scattering::{
    Basis, Direction, Incidence, Mode, Model, Mueller,
    scatterer::{Scatterer, SphericalScatterer},
    spec,
    special::gauss,
};

use super::{
    pigmented,
    reference::node,
    walk::{WalkBody, WalkCoat, WalkRandom, WalkRay, WalkSheet, turned},
};

/// Rays per coating: 10⁷ in all.
const RAYS: u64 = 500_000;

/// Error of the model in what comes back in all, over the light that came.
const MODEL_ERROR: f64 = 0.02;
/// The same of the intensity and of Q in a cone, over what comes back in all.
const CONE_ERROR: f64 = 0.02;

/// Half angle of the cones.
const HALF: f64 = 0.25;

/// Vacuum wavelength, µm.
const LAMBDA: f64 = 0.532;

/// τ, slopes, index of the core (nothing: transparent), film: index and thickness.
type WitnessFlakes = (f64, (f64, f64), Option<Complex64>, Option<(f64, f64)>);

/// A coating and the beam on it.
struct WitnessCase {
    name: &'static str,
    n: f64,
    k: f64,
    surface: (f64, f64),
    flakes: Option<WitnessFlakes>,
    backing: f64,
    /// Density and index of spheres of radius 0.15 µm.
    spheres: Option<(f64, Complex64)>,
    theta: f64,
    rotation: f64,
}

/// Thickness of all coats, µm.
const THICKNESS: f64 = 20.0;
const RADIUS: f64 = 0.15;
const AREA: f64 = 400.0;

fn cases() -> Vec<WitnessCase> {
    let c = Complex64::new;
    let plain = |name, n, surface: (f64, f64), backing, theta| WitnessCase {
        name,
        n,
        k: 0.0,
        surface,
        flakes: None,
        backing,
        spheres: None,
        theta,
        rotation: 0.0,
    };
    let with = |case: WitnessCase, depth, slopes, core, film| WitnessCase {
        flakes: Some((depth, slopes, core, film)),
        ..case
    };
    let aluminium = Some(c(0.87, 6.4));
    let oxide = Some((2.6, 0.06));
    vec![
        plain("nearly smooth, black", 1.5, (0.05, 0.05), 0.0, 0.7),
        plain("rough, black", 1.5, (0.2, 0.2), 0.0, 0.5),
        plain("nearly smooth, white", 1.5, (0.05, 0.05), 1.0, 0.4),
        plain("rough, white", 1.33, (0.2, 0.2), 1.0, 0.6),
        plain("rough, grey", 1.6, (0.15, 0.15), 0.5, 0.9),
        WitnessCase { rotation: 0.5, ..plain("brushed, white", 1.5, (0.25, 0.08), 1.0, 0.7) },
        WitnessCase { rotation: 1.2, ..plain("brushed, black", 1.8, (0.1, 0.25), 0.0, 0.5) },
        WitnessCase { k: 5e-4, ..plain("tinted lacquer, white", 1.5, (0.05, 0.05), 1.0, 0.5) },
        WitnessCase { k: 1e-3, ..plain("tinted lacquer, grey", 1.6, (0.1, 0.1), 0.6, 0.8) },
        WitnessCase {
            spheres: Some((2.0, c(2.6, 0.0))),
            ..plain("white spheres over black", 1.5, (0.05, 0.05), 0.0, 0.4)
        },
        WitnessCase {
            spheres: Some((4.0, c(2.6, 0.0))),
            ..plain("white spheres over grey", 1.5, (0.1, 0.1), 0.4, 0.7)
        },
        WitnessCase {
            spheres: Some((3.0, c(2.6, 0.02))),
            ..plain("coloured spheres over white", 1.5, (0.05, 0.05), 1.0, 0.3)
        },
        with(
            plain("aluminium, dense, black", 1.5, (0.05, 0.05), 0.0, 0.5),
            4.0,
            (0.1, 0.1),
            aluminium,
            None,
        ),
        with(
            plain("aluminium, sparse, white", 1.5, (0.05, 0.05), 1.0, 0.5),
            0.5,
            (0.15, 0.15),
            aluminium,
            None,
        ),
        with(
            plain("aluminium under a rough coat", 1.5, (0.12, 0.12), 0.3, 0.6),
            1.0,
            (0.15, 0.15),
            aluminium,
            None,
        ),
        with(
            plain("aluminium with a film", 1.5, (0.05, 0.05), 0.0, 0.3),
            2.0,
            (0.12, 0.12),
            aluminium,
            Some((1.46, 0.2)),
        ),
        with(
            plain("pearl over black", 1.5, (0.05, 0.05), 0.0, 0.6),
            1.5,
            (0.12, 0.12),
            None,
            oxide,
        ),
        with(
            plain("pearl over white", 1.5, (0.05, 0.05), 1.0, 0.6),
            1.5,
            (0.12, 0.12),
            None,
            oxide,
        ),
        WitnessCase {
            k: 4e-4,
            ..with(
                plain("pearl in tinted lacquer over grey", 1.5, (0.08, 0.08), 0.5, 0.4),
                1.0,
                (0.15, 0.15),
                None,
                oxide,
            )
        },
        WitnessCase {
            rotation: 0.8,
            ..with(
                plain("brushed pearl over white", 1.5, (0.08, 0.08), 1.0, 0.5),
                1.0,
                (0.2, 0.08),
                None,
                oxide,
            )
        },
    ]
}

impl WitnessCase {
    fn model(&self) -> Model {
        let mut params = vec![
            ("lambda", LAMBDA.to_string()),
            ("overcoat", format!("({},{})", self.n, self.k)),
            ("surface_sdf.sigmax", self.surface.0.to_string()),
            ("surface_sdf.sigmay", self.surface.1.to_string()),
            ("surface_shadow.azimuth", "1".into()),
            ("flake_shadow.azimuth", "1".into()),
            ("thickness", THICKNESS.to_string()),
            ("backing.table", self.backing.to_string()),
            ("flake_density", "0".into()),
            ("exchange", "1".into()),
        ];
        if let Some((depth, slopes, core, film)) = &self.flakes {
            let core = core.unwrap_or(Complex64::new(self.n, self.k));
            params.push(("flake_area", AREA.to_string()));
            params.push(("flake_density", (depth / (AREA * THICKNESS)).to_string()));
            params.push(("substrate", format!("({},{})", core.re, core.im)));
            params.push(("sdf", "Anisotropic_Gaussian_Slope_Distribution_Function".into()));
            params.push(("sdf.sigmax", slopes.0.to_string()));
            params.push(("sdf.sigmay", slopes.1.to_string()));
            if let Some((index, thickness)) = film {
                params.push(("stack", "SingleFilm_StackModel".into()));
                params.push(("stack.material", format!("({index},0)")));
                params.push(("stack.thickness", thickness.to_string()));
            }
        }
        if let Some((density, index)) = self.spheres {
            params.push(("particle_density", density.to_string()));
            params.push(("particle_radius", RADIUS.to_string()));
            params.push(("particle.sphere", format!("({},{})", index.re, index.im)));
        }
        let params: Vec<_> = params.iter().map(|(name, value)| (*name, &**value)).collect();
        pigmented(&params)
    }

    fn coat(&self) -> WalkCoat {
        let flakes = self.flakes.as_ref().map(|(depth, slopes, core, film)| WalkSheet {
            depth: *depth,
            slopes: *slopes,
            core: core.unwrap_or(self.n.into()),
            film: film.map(|(index, thickness)| (index, thickness / LAMBDA)),
        });
        WalkCoat {
            n: self.n,
            binder: 4.0 * PI * self.k * THICKNESS / LAMBDA,
            surface: self.surface,
            flakes,
            body: self.body(),
        }
    }

    fn body(&self) -> WalkBody {
        let backing = self.backing;
        let Some((density, index)) = self.spheres else {
            return WalkBody { depth: 0.0, albedo: 1.0, g: 0.0, backing };
        };
        let medium = format!("({},0)", self.n);
        let sphere = format!("({},{})", index.re, index.im);
        let node = node(
            "MieScatterer",
            &[
                ("lambda", &LAMBDA.to_string()),
                ("medium", &medium),
                ("radius", &RADIUS.to_string()),
                ("sphere", &sphere),
            ],
            Mode::Sound,
        );
        let particle = spec::build::<dyn Scatterer>(&node).unwrap();
        let round = particle.round().unwrap();
        let sections = round.cross_sections().unwrap();
        WalkBody {
            depth: density * sections.extinction * THICKNESS,
            albedo: sections.scattering / sections.extinction,
            g: mean_cosine(round),
            backing,
        }
    }
}

fn mean_cosine(round: &dyn SphericalScatterer) -> f64 {
    let (mut sum, mut along) = (0.0, 0.0);
    for (cos, weight) in gauss::legendre(200, -1.0, 1.0) {
        let s = round.amplitudes(cos);
        let intensity = weight * (s.ss.norm_sqr() + s.pp.norm_sqr());
        sum += intensity;
        along += cos * intensity;
    }
    along / sum
}

/// The axes of the cones in the laboratory.
fn cones(theta: f64) -> [DVec3; 5] {
    [(theta, 0.0), (0.0, 0.0), (0.8, 1.2), (1.1, -0.4), (0.6, 2.6)].map(
        |(theta, phi): (f64, f64)| {
            DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
        },
    )
}

/// Sums of (I, Q) and of their squares: in all, and in each cone.
type WitnessSums = [[f64; 4]; 6];

fn walked(case: &WitnessCase, seed: u64, rays: u64) -> WitnessSums {
    let coat = case.coat();
    let cones = cones(case.theta);
    let part = |from: u64, to: u64| {
        let mut sums = [[0.0; 4]; 6];
        for ray in from..to {
            let mut random = WalkRandom::new(seed, ray);
            let beam = WalkRay::incident(case.theta, case.rotation, POLARIZED);
            let Some(out) = coat.walk(beam, &mut random) else { continue };
            let q = out.q_at_surface();
            let k = turned(out.k, case.rotation);
            let hit = cones.map(|axis| k.dot(axis) > HALF.cos());
            for (sum, counts) in sums.iter_mut().zip([true].into_iter().chain(hit)) {
                if counts {
                    for (x, y) in sum.iter_mut().zip([1.0, q, 1.0, q * q]) {
                        *x += y;
                    }
                }
            }
        }
        sums
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u64;
    let parts: Vec<WitnessSums> = std::thread::scope(|scope| {
        let part = &part;
        let handles: Vec<_> = (0..threads)
            .map(|t| scope.spawn(move || part(t * rays / threads, (t + 1) * rays / threads)))
            .collect();
        handles.into_iter().map(|handle| handle.join().unwrap()).collect()
    });
    let mut sums = [[0.0; 4]; 6];
    for part in parts {
        for (sum, x) in sums.as_flattened_mut().iter_mut().zip(part.as_flattened()) {
            *sum += x;
        }
    }
    sums
}

/// Q of the incident beam.
const POLARIZED: f64 = 0.6;

/// (I, Q) of the model: in all, and in each cone.
fn modelled(case: &WitnessCase) -> [[f64; 2]; 6] {
    let model = case.model();
    let incidence = Incidence::new(case.theta, case.rotation);
    let mut result = [[0.0; 2]; 6];
    let mut add = |slot: usize, directions: &[Direction], weights: &[f64]| {
        let mut out = vec![Mueller::ZERO; directions.len()];
        model.evaluate(&incidence, directions, Basis::Psps, &mut out);
        for (m, weight) in out.iter().zip(weights) {
            for (row, x) in result[slot].iter_mut().enumerate() {
                *x += weight * (m[(row, 0)] + POLARIZED * m[(row, 1)]);
            }
        }
    };
    let azimuths = 160;
    for (theta, weight) in gauss::legendre(120, 0.0, FRAC_PI_2) {
        let at = |j: usize| Direction::new(theta, TAU * (j as f64 + 0.5) / f64::from(azimuths));
        let directions: Vec<_> = (0..azimuths as usize).map(at).collect();
        let weight = weight * theta.sin() * theta.cos() * TAU / f64::from(azimuths);
        add(0, &directions, &vec![weight; directions.len()]);
    }
    for (slot, axis) in cones(case.theta).into_iter().enumerate() {
        let (x, y) = axis.any_orthonormal_pair();
        for (cos, weight) in gauss::legendre(24, HALF.cos(), 1.0) {
            let sin = (1.0 - cos * cos).sqrt();
            let around = |j: usize| {
                let (s, c) = (TAU * j as f64 / 48.0).sin_cos();
                axis * cos + (x * c + y * s) * sin
            };
            let seen: Vec<_> = (0..48).map(around).collect();
            let directions: Vec<_> =
                seen.iter().map(|k| Direction::new(k.z.acos(), k.y.atan2(k.x))).collect();
            let weights: Vec<_> = seen.iter().map(|k| weight * k.z * TAU / 48.0).collect();
            add(slot + 1, &directions, &weights);
        }
    }
    result
}

#[test]
fn random_walks_of_polarized_light_find_twenty_coatings_as_they_are_modelled() {
    let mut wrong = Vec::new();
    for (seed, case) in cases().iter().enumerate() {
        let (walks, model) = (walked(case, seed as u64, RAYS), modelled(case));
        let all = model[0][0];
        for (slot, (sums, expected)) in walks.iter().zip(model).enumerate() {
            for kind in 0..2 {
                let mean = sums[kind] / RAYS as f64;
                let square = sums[2 + kind] / RAYS as f64;
                let deviation = ((square - mean * mean).max(0.0) / RAYS as f64).sqrt();
                let error = if slot == 0 { MODEL_ERROR } else { CONE_ERROR * all };
                let off = mean - expected[kind];
                println!(
                    "{:34} {} {} {mean:9.5} {:9.5} {off:9.5} {:6.1} sd",
                    case.name,
                    if slot == 0 { "all".to_owned() } else { format!("cone {slot}") },
                    ["I", "Q"][kind],
                    expected[kind],
                    off / deviation.max(1e-12),
                );
                if off.abs() > (4.0 * deviation).max(error) {
                    wrong.push(format!("{} {slot} {kind}: {mean} {}", case.name, expected[kind]));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
