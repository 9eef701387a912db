//! Energy of random coatings and surfaces: no polarization comes back stronger than it came.
//!
//! The integral over the hemisphere is a sum over Gauss nodes and azimuths, as fine as the slopes
//! of at least 0.15 need: what it is off by is far below what coatings that absorb keep, and for
//! the brightest the sum is repeated with twice the nodes.

use std::f64::consts::PI;

use scattering::Model;

use super::{build, hemisphere, most, pigmented};

/// Surfaces, and coatings.
const SETS: usize = 1000;

/// Largest allowed reflectance.
const ALL: f64 = 1.0 + 1e-6;

/// Numbers from 0 to 1, always the same (a linear congruential generator of Knuth's).
struct RandomDirections(u64);

impl RandomDirections {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        low + (high - low) * (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Reflectance for the polarization with the largest reflectance.
fn returned(model: &Model, theta: f64, rotation: f64) -> f64 {
    let coarse = most(&hemisphere(model, theta, rotation, 40));
    if coarse < 0.99 { coarse } else { most(&hemisphere(model, theta, rotation, 100)) }
}

fn across_threads(sets: usize, run: impl Fn(usize) -> Option<String> + Sync) -> Vec<String> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let part = |t: usize| (t..sets).step_by(threads).filter_map(&run).collect::<Vec<_>>();
    std::thread::scope(|scope| {
        let part = &part;
        let handles: Vec<_> = (0..threads).map(|t| scope.spawn(move || part(t))).collect();
        handles.into_iter().flat_map(|handle| handle.join().unwrap()).collect()
    })
}

#[test]
fn no_random_surface_returns_more_light_than_came() {
    let wrong = across_threads(SETS, |case| {
        let mut random = RandomDirections(case as u64 + 1);
        // The first numbers of neighbouring seeds are alike.
        for _ in 0..8 {
            random.between(0.0, 1.0);
        }
        let mut draw = |low, high| random.between(low, high).to_string();
        let index = format!("({},{})", draw(0.2, 3.0), draw(0.0, 8.0));
        let (x, y) = (draw(0.15, 0.6), draw(0.15, 0.6));
        let model = build(
            "Shadowed_Facet_BRDF_Model",
            &[
                // Every fourth is a perfect mirror.
                ("substrate", if case.is_multiple_of(4) { "(0,3)" } else { &index }),
                ("sdf", "Anisotropic_Gaussian_Slope_Distribution_Function"),
                ("sdf.sigmax", &x),
                ("sdf.sigmay", &y),
                ("shadow", "Sancer_Shadow_Function"),
                // The jump at equal azimuths has no area; a quadrature could hit it.
                ("shadow.azimuth", "1"),
            ],
        );
        let (theta, rotation) = (random.between(0.0, 1.5), random.between(0.0, PI));
        let returned = returned(&model, theta, rotation);
        (returned > ALL).then(|| format!("{case}: {x} {y} at {theta}: {returned}"))
    });
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_random_coating_returns_more_light_than_came() {
    let wrong = across_threads(SETS, |case| {
        let mut random = RandomDirections(case as u64 + 7_000_001);
        for _ in 0..8 {
            random.between(0.0, 1.0);
        }
        let params = random_coating(case, &mut random);
        let params: Vec<_> = params.iter().map(|(name, value)| (*name, &**value)).collect();
        let model = pigmented(&params);
        let (theta, rotation) = (random.between(0.0, 1.4), random.between(0.0, PI));
        let returned = returned(&model, theta, rotation);
        (returned > ALL).then(|| format!("{params:?} at {theta}, {rotation}: {returned}"))
    });
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn random_coating(case: usize, random: &mut RandomDirections) -> Vec<(&'static str, String)> {
    let mut draw = |low, high| random.between(low, high).to_string();
    let coat = draw(1.0, 2.2);
    let k = if case % 5 == 4 { draw(0.0, 1e-3) } else { "0".to_owned() };
    let (flakes, surface) = (draw(0.15, 0.4), draw(0.15, 0.4));
    // The tables of anisotropic slopes take longer to build.
    let across = |x: &str, y: String| if case % 40 == 39 { y } else { x.to_owned() };
    let flakes_y = across(&flakes, draw(0.15, 0.4));
    let surface_y = across(&surface, draw(0.15, 0.4));
    // Films with the binder as their core, an opaque lossless core, metal.
    let core = match case % 3 {
        0 => format!("({coat},{k})"),
        1 => "(0,3)".into(),
        _ => format!("({},{})", draw(0.2, 3.0), draw(0.0, 8.0)),
    };
    let film = if case.is_multiple_of(2) { "SingleFilm_StackModel" } else { "No_StackModel" };
    let mut params = vec![
        ("overcoat", format!("({coat},{k})")),
        ("substrate", core),
        ("stack", film.to_owned()),
        ("sdf", "Anisotropic_Gaussian_Slope_Distribution_Function".to_owned()),
        ("sdf.sigmax", flakes),
        ("sdf.sigmay", flakes_y),
        ("surface_sdf.sigmax", surface),
        ("surface_sdf.sigmay", surface_y),
        ("surface_shadow.azimuth", "1".to_owned()),
        ("flake_shadow.azimuth", "1".to_owned()),
        // A third without flakes: only the body's light is left to be too much.
        ("flake_density", if case % 9 < 3 { "0".into() } else { draw(0.0, 4e-4) }),
        ("correlation", if case % 4 == 3 { draw(0.0, 1.0) } else { "1".into() }),
        ("exchange", (case % 7 % 2).to_string()),
        ("particle.sphere", format!("(2.6,{})", if case.is_multiple_of(4) { 0.0 } else { 0.01 })),
        ("particle_radius", draw(0.05, 0.3)),
        ("particle_density", if case % 11 == 10 { draw(0.0, 5.0) } else { "0".into() }),
        ("backing.table", if case % 4 < 3 { "1".into() } else { draw(0.0, 1.0) }),
    ];
    if film.starts_with("Single") {
        params.push(("stack.material", "(2.4,0)".to_owned()));
        params.push(("stack.thickness", draw(0.02, 0.2)));
    }
    params
}
