//! Tables against what is known of them.

use super::*;
use crate::{
    Limits,
    material::Material,
    request::{ColourQuery, GridRequest, Patch, PatchRow},
};

use scattering::{Basis, Mode};

const GREY: &str = r#"{"model": "Lambertian_BRDF_Model",
    "parameters": [["reflectance", "Table_Reflectance"], ["reflectance.table", 0.5]]}"#;

const ROUGH: &str = r#"{"model": "Facet_BRDF_Model", "parameters":
    [["substrate", "(1.5,0)"], ["sdf", "Gaussian_Slope_Distribution_Function"], ["sdf.s", 0.2]]}"#;

fn request(directions: TableDirections) -> TableRequest {
    TableRequest {
        material: "sample".into(),
        directions,
        wavelengths: (0..8).map(|k| 400.0 + 50.0 * f64::from(k)).collect(),
        settings: ColourQuery::default().settings(None).unwrap(),
        incident: [1.0, 0.0, 0.0, 0.0],
        stokes: true,
        basis: Basis::Psps,
        sampling: None,
        limits: Limits::default(),
    }
}

fn grid(patch: GridPatch) -> TableDirections {
    let phis = if patch == GridPatch::Ring { vec![0.0] } else { vec![0.0, 90.0, 180.0] };
    TableDirections::Grid(GridRequest {
        thetai: vec![0.0, 45.0, 90.0],
        thetas: vec![0.0, 45.0, 90.0],
        phis,
        patch,
    })
}

fn run(json: &str, request: &TableRequest) -> ColourTable {
    let material = Material::from_json(json).unwrap().prepare(Mode::Sound, None).unwrap();
    table(&material, request, &Control::default()).unwrap()
}

#[test]
fn a_grey_sample_is_grey_in_every_patch_and_flagged_at_the_horizon() {
    for patch in [GridPatch::Point, GridPatch::Circle(2.0), GridPatch::Cell, GridPatch::Ring] {
        let table = run(GREY, &request(grid(patch)));
        assert_eq!(table.stokes, 3);
        for row in &table.rows {
            // The adaptation of white adds rounding; adaptive circles add the error of their rule,
            // which is far below the stated 1e-5 for a constant.
            let error = if matches!(patch, GridPatch::Circle(_)) { 1e-9 } else { 1e-12 };
            for value in row.rgb[0].iter().chain([&row.xyz[0][1]]) {
                assert!((value * std::f64::consts::PI - 0.5).abs() < error, "{patch:?} {value}");
            }
            let at_horizon = row.thetai == 90.0 || row.thetas == 90.0;
            assert_eq!(row.flags, if at_horizon { ColourRow::FILLED } else { 0 });
        }
        for albedo in &table.albedo {
            assert!((albedo.intensity - 0.5).abs() < 1e-6, "{albedo:?}");
        }
    }
}

#[test]
fn a_node_is_what_the_model_says_there() {
    let table = run(ROUGH, &request(grid(GridPatch::Point)));
    let row = table.rows.iter().find(|r| r.thetai == 45.0 && r.thetas == 45.0 && r.phis == 0.0);
    let (model, _) = Material::from_json(ROUGH)
        .unwrap()
        .prepare(Mode::Sound, None)
        .unwrap()
        .at(0.4)
        .model()
        .unwrap();
    let angle = 45f64.to_radians();
    let at = scattering::Geometry { theta_i: angle, theta_s: angle, phi_s: 0.0, rotation: 0.0 };
    let want = model.mueller(&at, Basis::Psps);
    assert_eq!(row.unwrap().spectra[0][0], want[(0, 0)]);
    assert_eq!(row.unwrap().spectra[1][0], want[(1, 0)]);
}

#[test]
fn the_cells_of_a_grid_add_up_to_the_hemispherical_reflectance() {
    let axis = |last: u32| (0..=last / 5).map(|k| f64::from(5 * k)).collect::<Vec<f64>>();
    let what = TableDirections::Grid(GridRequest {
        thetai: vec![30.0],
        thetas: axis(90),
        phis: axis(180),
        patch: GridPatch::Cell,
    });
    let table = run(ROUGH, &request(what));
    let part = |row: &ColourRow| {
        let images = if row.phis == 0.0 || row.phis == 180.0 { 1.0 } else { 2.0 };
        images * row.omega * row.xyz[0][1]
    };
    let sum: f64 = table.rows.iter().map(part).sum();
    // Seven nodes per 5° and side resolve a lobe of 11° far better than this.
    assert!((sum / table.albedo[0].intensity - 1.0).abs() < 1e-5, "{sum} {:?}", table.albedo);
}

#[test]
fn one_two_and_seven_threads_give_the_same_bits() {
    let run_in = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(ROUGH, &request(grid(GridPatch::Cell))))
    };
    let one = run_in(1);
    assert_eq!(one, run_in(2));
    assert_eq!(one, run_in(7));
}

#[test]
fn a_list_keeps_its_order_and_refuses_a_wrong_patch_by_its_number() {
    let place = |thetai, patch| PatchRow { thetai, thetas: 30.0, phis: 0.0, patch };
    let list = vec![
        place(60.0, Patch::Circle(2.0)),
        place(10.0, Patch::Ring(5.0, 10.0)),
        place(60.0, Patch::Polygon(vec![(20.0, 0.0), (30.0, 20.0), (40.0, -10.0)])),
    ];
    let table = run(ROUGH, &request(TableDirections::List(list.clone())));
    assert_eq!(table.rows.iter().map(|row| row.thetai).collect::<Vec<_>>(), [60.0, 10.0, 60.0]);
    assert!(table.albedo.is_empty());
    let mut wrong = list;
    wrong[1].patch = Patch::Polygon(vec![(20.0, 0.0), (100.0, 20.0), (40.0, -10.0)]);
    let material = Material::from_json(ROUGH).unwrap().prepare(Mode::Sound, None).unwrap();
    let error =
        super::table(&material, &request(TableDirections::List(wrong)), &Control::default());
    assert!(error.unwrap_err().to_string().starts_with("patch 2"));
}

#[test]
fn a_cancelled_table_and_one_beyond_its_limits_are_refused() {
    let material = Material::from_json(GREY).unwrap().prepare(Mode::Sound, None).unwrap();
    let control = Control::default();
    control.cancel.store(true, std::sync::atomic::Ordering::Relaxed);
    let all = request(grid(GridPatch::Cell));
    assert!(matches!(super::table(&material, &all, &control), Err(MaterialError::Cancelled)));
    let limits = Limits { evaluations: 10.0, ..Limits::default() };
    let small = TableRequest { limits, ..all };
    let refused = super::table(&material, &small, &Control::default());
    assert!(matches!(refused, Err(MaterialError::Limit(_))));
}

#[test]
fn the_factor_of_a_diffuser_is_its_reflectance() {
    let mut request = request(grid(GridPatch::Point));
    request.settings.quantity = Quantity::Factor;
    for row in run(GREY, &request).rows {
        // Rounding of the adaptation of white.
        assert!((row.xyz[0][1] - 0.5).abs() < 1e-12 && (row.spectra[0][0] - 0.5).abs() < 1e-15);
    }
}
