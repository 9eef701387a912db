//! Integrals with known values, from regions of every shape.

use std::f64::consts::{FRAC_PI_2, PI};

use scattering::{Mode, ParameterNode, models};

use super::*;
use crate::{
    region::PolarAngles,
    sampling::{Layout, PlaneSampling},
};

const ACCURACY: Accuracy = Accuracy::required(1e-9, 10_000_000);

fn model(name: &str) -> Model {
    let class = &models::find(name).unwrap().class;
    models::build(&ParameterNode::with_defaults(class, Mode::Sound)).unwrap()
}

fn estimate(model: &Model, theta_i: f64, region: &Region, tolerance: f64) -> Estimate {
    let incidence = Incidence::new(theta_i, 0.0);
    let accuracy = Accuracy { tolerance, ..ACCURACY };
    integrate(model, &incidence, Basis::Psps, region, &accuracy, &|| false).unwrap()
}

fn regions() -> Vec<Region> {
    let circle = |center, alpha| Region::Circle { center, alpha };
    let annulus = |outer_center, outer_alpha, inner_center, inner_alpha| Region::Annulus {
        outer_center,
        outer_alpha,
        inner_center,
        inner_alpha,
    };
    let polygon = |vertices: &[PolarAngles]| Region::Polygon {
        vertices: vertices.to_vec(),
        polarization_center: (0.4, 0.3),
    };
    vec![
        Region::Hemi,
        circle((0.5, 0.0), 0.3),
        circle((0.5, 0.2), 0.05),
        circle((1.3, 2.0), 0.5),
        circle((0.9, 0.1), 0.4),
        circle((0.2, 1.0), 1.5),
        circle((0.3, -1.0), 2.0),
        circle((FRAC_PI_2, 0.0), 0.6),
        annulus((0.5, 0.0), 0.3, (0.5, 0.0), 0.1),
        annulus((0.5, 0.1), 0.4, (0.6, 0.2), 0.2),
        annulus((1.2, 0.3), 0.8, (1.3, 0.0), 0.3),
        annulus((0.5, 0.0), 0.3, (0.8, 0.0), 0.2),
        annulus((0.1, 0.0), 0.2, (0.1, 0.0), 0.7),
        polygon(&[(0.2, 0.0), (0.7, 0.9), (0.9, -0.4)]),
        polygon(&[(FRAC_PI_2, 0.1), (1.2, 0.9), (0.2, 0.4)]),
        polygon(&[(FRAC_PI_2, 0.0), (FRAC_PI_2, 2.0), (FRAC_PI_2, 4.0)]),
        polygon(&[(0.35, 0.0), (0.87, 0.35), (0.6, 1.0), (1.0, 1.9), (0.26, 2.4), (0.96, 3.5)]),
    ]
}

#[test]
fn a_perfect_diffuser_shows_the_exact_area_of_every_region() {
    let diffuser = model("Lambertian_BRDF_Model");
    for region in regions() {
        for theta_i in [0.0, 0.5, 1.4] {
            let got = estimate(&diffuser, theta_i, &region, 1e-9);
            let off = (got.matrix[(0, 0)] - region.projected_solid_angle() / PI).abs();
            assert!(off <= got.error[(0, 0)] + 1e-14, "{region:?} {theta_i}: {off} {got:?}");
        }
    }
}

#[test]
fn a_fine_grid_agrees_for_a_polarizing_model() {
    let rough = model("Microroughness_BRDF_Model");
    let (incidence, basis) = (Incidence::new(0.5, 0.0), Basis::Psps);
    // Away from the specular peak, which no grid resolves.
    let region = Region::Circle { center: (0.7, 2.1), alpha: 0.4 };
    let plane = PlaneSampling { differential: 2e-6, min_samples: 1, ..PlaneSampling::default() };
    let layout = Layout::new(&region, &plane, None).unwrap();
    let grid = crate::integrate::integrate(&rough, &incidence, basis, &layout, &|| false).unwrap();
    let adaptive = estimate(&rough, 0.5, &region, 1e-9);
    // The grid has 2.5e5 points and errors near 1e-6.
    assert!((grid - adaptive.matrix).largest() < 1e-5 * grid.largest());
    assert!(adaptive.evaluations < 20_000, "{}", adaptive.evaluations);
}

#[test]
fn results_of_two_tolerances_differ_by_less_than_their_errors() {
    let rough = model("Microroughness_BRDF_Model");
    for region in regions() {
        let (rough_one, fine) =
            (estimate(&rough, 0.5, &region, 1e-4), estimate(&rough, 0.5, &region, 1e-7));
        let off = rough_one.matrix - fine.matrix;
        for i in 0..4 {
            for j in 0..4 {
                let allowed = rough_one.error[(i, j)] + fine.error[(i, j)];
                assert!(off[(i, j)].abs() <= allowed, "{region:?} {i}{j} {}", off[(i, j)]);
            }
        }
    }
}

#[test]
fn one_two_and_seven_threads_give_the_same_bits() {
    let rough = model("Microroughness_BRDF_Model");
    let region = Region::Circle { center: (0.5, 0.1), alpha: 0.4 };
    let in_pool = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let estimate = pool.install(|| estimate(&rough, 0.5, &region, 1e-7));
        (estimate.matrix.to_row_major().map(f64::to_bits), estimate.evaluations)
    };
    assert_eq!(in_pool(1), in_pool(2));
    assert_eq!(in_pool(1), in_pool(7));
}

#[test]
fn a_budget_that_does_not_suffice_is_an_error() {
    let rough = model("Microroughness_BRDF_Model");
    let accuracy = Accuracy::required(1e-12, 3_000);
    let incidence = Incidence::new(0.5, 0.0);
    let refused = integrate(&rough, &incidence, Basis::Psps, &Region::Hemi, &accuracy, &|| false);
    match refused {
        Err(AdaptiveError::Budget { reached, evaluations, .. }) => {
            assert!(reached > 1e-12 && evaluations <= 3_000);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_empty_region_holds_nothing() {
    let diffuser = model("Lambertian_BRDF_Model");
    for region in [
        Region::Circle { center: (0.4, 0.0), alpha: 0.0 },
        Region::Circle { center: (2.5, 0.0), alpha: 0.3 },
        Region::Polygon { vertices: Vec::new(), polarization_center: (0.0, 0.0) },
    ] {
        let got = estimate(&diffuser, 0.3, &region, 1e-6);
        assert_eq!((got.matrix, got.error), (Mueller::ZERO, Mueller::ZERO));
    }
}
