//! Grids against exact areas, and against tables of NIST's program.

use std::f64::consts::{FRAC_PI_2, PI};

use scattering::{Mode, ParameterNode, models};

use super::*;
use crate::region::{PolarAngles, Region, RegionError};
use crate::sampling::{IntegrationMode, Outlines, PlaneSampling, truncated};

const DEGREE: f64 = PI / 180.0;

fn model(name: &str) -> Model {
    let class = &models::find(name).unwrap().class;
    models::build(&ParameterNode::with_defaults(class, Mode::Compat)).unwrap()
}

const POLYGONS: Outlines = Outlines::Polygons { sides: 360 };

/// The plane of a value of `integrationmode` and the seed of its points.
type Sampled = (PlaneSampling, Option<u64>);

fn sampling(mode: i32, differential: f64, outlines: Outlines) -> Sampled {
    let Ok(IntegrationMode::Plane { projection, is_random, is_normalized }) =
        IntegrationMode::decode(mode)
    else {
        panic!("{mode} has no plane")
    };
    let min_samples = 24;
    let plane = PlaneSampling { projection, differential, min_samples, is_normalized, outlines };
    (plane, is_random.then_some(5))
}

/// The same with another `min_samples`.
fn with_samples(min_samples: i32, (plane, seed): Sampled) -> Sampled {
    (PlaneSampling { min_samples, ..plane }, seed)
}

fn layout(region: &Region, (plane, seed): &Sampled) -> Result<Layout, RegionError> {
    Layout::new(region, plane, *seed)
}

fn matrix(region: &Region, sampling: &Sampled) -> Mueller {
    let layout = layout(region, sampling).unwrap();
    let incidence = Incidence::new(0.3, 0.0);
    let model = model("Lambertian_BRDF_Model");
    integrate(&model, &incidence, Basis::Psps, &layout, &|| false).unwrap()
}

/// The reflectance of a perfect diffuser into a region.
fn diffuse(region: &Region, sampling: &Sampled) -> f64 {
    matrix(region, sampling)[(0, 0)]
}

fn circle(center: PolarAngles, alpha: f64) -> Region {
    Region::Circle { center, alpha }
}

fn assert_close(got: f64, want: f64, relative: f64) {
    assert!((got - want).abs() <= relative * want.abs(), "{got} is not {want}");
}

#[test]
fn the_cone_of_90_degrees_about_the_normal_has_the_directions_of_the_hemisphere() {
    assert_eq!(Region::around((0.0, 0.0), FRAC_PI_2), Region::Hemi);
    for mode in [1, 2, 3, 4, 12] {
        let sampling = sampling(mode, 0.001, POLYGONS);
        let cone = matrix(&circle((0.0, 0.0), FRAC_PI_2), &sampling);
        assert_eq!(cone, matrix(&Region::Hemi, &sampling), "mode {mode}");
    }
    for (center, alpha) in [((0.0, 0.1), FRAC_PI_2), ((0.0, 0.0), -FRAC_PI_2)] {
        assert_eq!(Region::around(center, alpha), circle(center, alpha));
    }
}

#[test]
fn a_perfect_diffuser_sends_everything_into_the_hemisphere() {
    for mode in 1..=6 {
        let got = diffuse(&Region::Hemi, &sampling(mode, 0.001, Outlines::Exact));
        assert_close(got, 1.0, 1e-14);
    }
    // d = 1/8: points of the orthographic grid fall exactly on the horizon.
    let got = diffuse(&Region::Hemi, &sampling(3, 1.0 / 64.0, Outlines::Exact));
    assert_close(got, 1.0, 1e-14);
}

#[test]
fn a_perfect_diffuser_shows_the_exact_area_of_every_region() {
    let regions = [
        circle((1.3, 0.4), 0.5),
        circle((0.3, 0.4), 1.5),
        Region::Annulus {
            outer_center: (1.1, 0.2),
            outer_alpha: 0.8,
            inner_center: (1.2, -0.1),
            inner_alpha: 0.2,
        },
        Region::Polygon {
            vertices: vec![(FRAC_PI_2, 0.1), (1.2, 0.9), (0.2, 0.4)],
            polarization_center: (1.0, 0.5),
        },
    ];
    for region in regions {
        let want = region.projected_solid_angle() / PI;
        assert_close(diffuse(&region, &sampling(2, 0.001, Outlines::Exact)), want, 1e-13);
        for mode in [11, 12, 13] {
            // Without normalization the rim is cut by a grid of 4e4 points or more.
            let raw = diffuse(&region, &sampling(mode, 2e-5, Outlines::Exact));
            assert_close(raw, want, 4e-3);
        }
    }
}

#[test]
fn conformance_hemi_edge_is_reproduced() {
    // v_shape_hemi_edge: points exactly on the horizon, some of them inside the polygon.
    let expected = [
        (1, 1.0),
        (11, 1.000144518818347),
        (2, 9.999999999999998e-01),
        (12, 9.996919862959677e-01),
        (3, 9.897435897435894e-01),
        (13, 9.599032505229934e-01),
    ];
    for (mode, want) in expected {
        let got = diffuse(&Region::Hemi, &sampling(mode, 0.015625, POLYGONS));
        assert_close(got, want, 1e-13);
    }
}

#[test]
fn conformance_circles_at_the_horizon_are_reproduced() {
    let below = circle((92.0 * DEGREE, -0.1 * DEGREE), 28.6 * DEGREE);
    let wide = circle((17.3 * DEGREE, 47.8 * DEGREE), 90.0 * DEGREE);
    let cases = [
        (&below, 1.56, 54, 1, 2.127096760676903e-02),
        (&below, 1.56, 54, 11, 2.100544521450316e-02),
        (&below, 1.56, 54, 2, 2.127096760676900e-02),
        (&below, 1.56, 54, 12, 2.146646376425214e-02),
        (&below, 1.56, 54, 3, 2.127096760676906e-02),
        (&below, 1.56, 54, 13, 2.132985436135365e-02),
        (&wide, 4.0, 30, 1, 9.773267774691211e-01),
        (&wide, 4.0, 30, 11, 9.779698036435311e-01),
        (&wide, 4.0, 30, 12, 9.795367034474965e-01),
        (&wide, 4.0, 30, 13, 1.051908943125240),
    ];
    for (region, step, min_samples, mode, want) in cases {
        let differential = (step * DEGREE).powi(2);
        let sampling = with_samples(min_samples, sampling(mode, differential, POLYGONS));
        // 4·atan(1)/180 of the program and PI/180 here agree to the last bit.
        assert_close(diffuse(region, &sampling), want, 1e-12);
    }
}

#[test]
fn conformance_circles_with_few_sides_are_reproduced() {
    let region = circle((1.135, 1.236), 0.288);
    let expected = [
        (3, 1.502661524824315e-02, 4.150746554695992e-01),
        (5, 2.758848902122610e-02, 7.584600089776830e-01),
        (17, 3.144286396278125e-02, 9.754520616357081e-01),
        (100, 3.144286396278125e-02, 9.994265207588835e-01),
        (720, 3.144286396278125e-02, 1.000212207404320),
    ];
    for (sides, cone, hemisphere) in expected {
        let outlines = Outlines::Polygons { sides };
        let sampling = with_samples(10, sampling(12, (4.6 * DEGREE).powi(2), outlines));
        assert_close(diffuse(&region, &sampling), cone, 1e-13);
        assert_close(diffuse(&Region::Hemi, &sampling), hemisphere, 1e-13);
    }
}

#[test]
fn conformance_degenerate_polygons_are_reproduced() {
    let polygon = |vertices: &[PolarAngles]| Region::Polygon {
        vertices: vertices.to_vec(),
        polarization_center: (0.0, 0.0),
    };
    let [sampling, sound] =
        [POLYGONS, Outlines::Exact].map(|o| with_samples(10, sampling(2, 0.002, o)));
    assert!(diffuse(&polygon(&[(0.5, 0.0), (0.5, 1.535)]), &sampling).is_nan());
    assert!(diffuse(&polygon(&[]), &sampling).is_nan());
    let doubled = [(0.2, 0.0), (0.2, 0.0), (0.5, 0.886), (0.6, -0.5), (0.6, -0.5)];
    assert_close(diffuse(&polygon(&doubled), &sampling), 2.204946366512104e-02, 1e-13);
    let bow_tie = polygon(&[(0.5, 0.1), (0.5, 3.2), (0.5, 1.7), (0.5, 4.8)]);
    assert_close(diffuse(&bow_tie, &sampling), 3.131002661836194e-03, 1e-13);
    assert!(layout(&bow_tie, &sound).is_err());
    assert_close(diffuse(&polygon(&doubled), &sound), 2.204946366512104e-02, 1e-13);
}

#[test]
fn conformance_rings_around_a_point_hold_as_many_directions() {
    // E and F of v_shape_annulus_odd: the inner or the outer ring is a point that lies in
    // line with a column of the grid.
    let count = |outer_alpha, inner_alpha| {
        let (outer_center, inner_center) = ((0.0, 0.0), (0.0, 0.0));
        let ring = Region::Annulus { outer_center, outer_alpha, inner_center, inner_alpha };
        let sampling = with_samples(10, sampling(2, 0.003, POLYGONS));
        layout(&ring, &sampling).unwrap().directions()
    };
    assert_eq!((count(0.579, 0.0), count(0.0, 0.512)), (340, 276));
}

#[test]
fn apertures_of_no_size_and_impossible_steps_give_nan() {
    for outlines in [POLYGONS, Outlines::Exact] {
        let usual = sampling(2, 0.01, outlines);
        assert!(diffuse(&circle((0.3, 0.0), 0.0), &usual).is_nan());
        let no_step = sampling(2, 0.0, outlines);
        assert!(diffuse(&Region::Hemi, &no_step).is_nan());
    }
    let no_sides = sampling(2, 0.01, Outlines::Polygons { sides: 0 });
    assert!(diffuse(&Region::Hemi, &no_sides).is_nan());
}

#[test]
fn minsamples_is_rounded_up_to_a_square() {
    let with = |min_samples| {
        let sampling = with_samples(truncated(min_samples), sampling(12, 1.0, Outlines::Exact));
        diffuse(&circle((0.4, 0.5), 0.3), &sampling)
    };
    assert_eq!(with(17.0).to_bits(), with(25.9).to_bits());
    assert_ne!(with(17.0).to_bits(), with(26.0).to_bits());
    let negative = with_samples(25, sampling(12, -1.0, Outlines::Exact));
    assert_eq!(with(25.0), diffuse(&circle((0.4, 0.5), 0.3), &negative));
}

#[test]
fn one_direction_is_the_brdf_times_its_cosine() {
    let at = |theta| {
        diffuse(&Region::Differential { center: (theta, 1.0) }, &sampling(1, 1.0, Outlines::Exact))
    };
    assert_close(at(0.7), 0.7_f64.cos() / PI, 1e-15);
    assert_close(at(-0.7), 0.7_f64.cos() / PI, 1e-15);
    assert_eq!(at(FRAC_PI_2), 0.0);
    assert_eq!(at(2.0), 0.0);
}

#[test]
fn one_two_and_seven_threads_give_the_same_bits() {
    let region = circle((0.8, 0.4), 0.9);
    for mode in [2, 5] {
        // 3e3 points are stored, 6e5 are laid out chunk by chunk.
        for differential in [1e-3, 4e-6] {
            let sampling = sampling(mode, differential, Outlines::Exact);
            let in_pool = |threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let integral = pool.install(|| matrix(&region, &sampling));
                integral.to_row_major().map(f64::to_bits)
            };
            assert_eq!(in_pool(1), in_pool(2));
            assert_eq!(in_pool(1), in_pool(7));
        }
    }
}

#[test]
fn the_integral_is_the_sum_of_its_samples() {
    let model = model("Microroughness_BRDF_Model");
    let incidence = Incidence::new(0.5, 0.2);
    let (pol, inpol) = (Stokes([0.5, 0.1, -0.35, 0.2]), Stokes([1.0, 0.2, 0.3, -0.4]));
    let region = circle((0.6, 0.4), 0.4);
    let layout = layout(&region, &sampling(12, 0.01, POLYGONS)).unwrap();
    let mut sum = 0.0;
    let per_point = 2.0 * 0.005;
    samples(&model, &incidence, Basis::Psps, &layout, (&pol, &inpol), &mut |s| {
        sum += s.brdf * s.theta.cos() * per_point;
    });
    let integral = integrate(&model, &incidence, Basis::Psps, &layout, &|| false).unwrap();
    assert_close(contract(&integral, &pol, &inpol), sum, 1e-12);
    assert!(sum != 0.0);
}

#[test]
fn grids_converge_faster_than_linearly_with_their_step() {
    let model = model("Microroughness_BRDF_Model");
    let incidence = Incidence::new(0.4, 0.0);
    let reflectance = |differential| {
        let sampling = sampling(2, differential, Outlines::Exact);
        let layout = layout(&circle((0.6, 2.5), 0.3), &sampling).unwrap();
        integrate(&model, &incidence, Basis::Psps, &layout, &|| false).unwrap()[(0, 0)]
    };
    // Away from the specular peak, where the integrand is smooth on the scale of the grids.
    let finest = reflectance(3e-6);
    let error = |differential: f64| (reflectance(differential) / finest - 1.0).abs();
    // A rim cut by a square grid makes errors of about h^1.5: 0.03 for a tenth of the step.
    assert!(error(1e-4) < 0.05 * error(1e-2), "{} {}", error(1e-4), error(1e-2));
}

#[test]
fn estimates_tell_a_huge_layout_before_it_is_made() {
    let region = circle((0.3, 0.1), 0.4);
    let of = |(plane, _): Sampled| Layout::estimate(&region, &plane);
    let points = 2.0 * PI * (1.0 - 0.4_f64.cos()) / 1e-4;
    assert_close(of(sampling(2, 1e-4, POLYGONS)), points + 360.0, 1e-6);
    assert!(of(with_samples(1_000_000_000, sampling(2, 1e-4, POLYGONS))) > 9e8);
    assert!(of(sampling(2, 1e-300, POLYGONS)) > 1e200);
    assert!(of(sampling(2, 1e-4, Outlines::Polygons { sides: 1 << 30 })) > 1e9);
}
