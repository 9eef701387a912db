//! Frames and tables of Mitsuba against matrices that NIST's library and Mitsuba computed.
//!
//! `data/mitsuba.json` has per geometry the matrix in the bases psps and plane, that of the table
//! and that which Mitsuba's bases (32-bit numbers) make of it.

use std::io::Cursor;

use glam::DVec3;
use mist_engine::{
    Control,
    material::{Material, PreparedMaterial},
};
use rise_bridge::{
    export::Bands,
    mitsuba::{
        axes::{HalfAngleAxes, node_directions},
        bsdf::{self, BsdfChannels, BsdfSize},
        frame::{self, HalfAngles},
        pbsdf::{self, PbsdfTable, interpolation_error},
    },
};
use scattering::{Basis, Mode, Model, Mueller};
use serde::Deserialize;

#[derive(Deserialize)]
struct MitsubaCase {
    model: String,
    params: serde_json::Value,
    l: [f64; 3],
    v: [f64; 3],
    rusinkiewicz_rad: MitsubaAngles,
    scatmech_psps: [[f64; 4]; 4],
    scatmech_plane: [[f64; 4]; 4],
    mitsuba_table: [[f64; 4]; 4],
    mitsuba_stokes_basis_in: [f64; 3],
    mitsuba_stokes_basis_out: [f64; 3],
    mitsuba_eval_radiance_mode: [[f64; 4]; 4],
}

#[derive(Deserialize)]
struct MitsubaAngles {
    phi_d: Option<f64>,
    theta_d: Option<f64>,
    theta_h: Option<f64>,
}

impl MitsubaCase {
    fn material(&self) -> PreparedMaterial {
        let json = serde_json::json!({ "model": self.model, "parameters": self.params });
        // NIST's own numbers: sound values of Diffuse_Subsurface_BRDF_Model differ by 2e-5.
        Material::from_json(&json.to_string()).unwrap().prepare(Mode::Compat, None).unwrap()
    }

    fn model(&self) -> Model {
        self.material().model().unwrap().0
    }

    fn directions(&self) -> (DVec3, DVec3) {
        (DVec3::from(self.l), DVec3::from(self.v))
    }
}

fn cases() -> Vec<MitsubaCase> {
    serde_json::from_str(include_str!("data/mitsuba.json")).unwrap()
}

/// Largest difference over the largest element.
fn error(ours: Mueller, theirs: [[f64; 4]; 4]) -> f64 {
    let theirs = Mueller(theirs);
    (ours - theirs).largest() / theirs.largest()
}

#[test]
fn our_matrices_are_those_of_the_table_and_of_mitsuba() {
    for case in cases() {
        let (l, v) = case.directions();
        let ask = |basis| case.model().evaluate_local(&[(l, v)], basis)[0];
        let (psps, plane) = (ask(Basis::Psps), ask(Basis::Plane));
        // The same formulas in 64 bits; l and v give the angles with an error of 1e-16.
        let table = frame::with_opposite_handedness(plane);
        for (ours, theirs) in
            [(psps, case.scatmech_psps), (plane, case.scatmech_plane), (table, case.mitsuba_table)]
        {
            let error = error(ours, theirs);
            assert!(error < 1e-9, "{} {l} {v}: {error:e} {ours:?} {theirs:?}", case.model);
        }
        // Mitsuba's bases are 32-bit numbers: 6e-8 in every component.
        for ours in [frame::from_table(table, l, v), frame::from_psps(psps, l, v)] {
            let error = error(ours * l.z, case.mitsuba_eval_radiance_mode);
            assert!(error < 1e-6, "{} {l} {v}: {error:e}", case.model);
        }
    }
}

#[test]
fn bases_and_half_angles_are_mitsubas() {
    for case in cases() {
        let (l, v) = case.directions();
        for (k, theirs) in [(-l, case.mitsuba_stokes_basis_in), (v, case.mitsuba_stokes_basis_out)]
        {
            // 32-bit numbers.
            assert!((frame::stokes_basis(k) - DVec3::from(theirs)).length() < 1e-6);
        }
        let MitsubaAngles { phi_d: Some(phi_d), theta_d: Some(theta_d), theta_h: Some(theta_h) } =
            case.rusinkiewicz_rad
        else {
            continue;
        };
        let ours = HalfAngles::of(l, v).unwrap();
        let theirs = HalfAngles { phi_d, theta_d, theta_h };
        let error = [ours.phi_d - phi_d, ours.theta_d - theta_d, ours.theta_h - theta_h];
        assert!(error.iter().all(|e| e.abs() < 1e-9), "{ours:?} {theirs:?}");
    }
}

/// A table with the angles of `at` among its nodes, and others close by: in 32 bits a little of the
/// neighbours comes in, and a far one may be a peak.
fn axes_through(at: &HalfAngles) -> HalfAngleAxes {
    let with = |mut nodes: Vec<f32>, x: f64| {
        nodes.extend([-0.01, 0.0, 0.01].map(|step| (x + step) as f32));
        nodes.sort_by(f32::total_cmp);
        nodes
    };
    let plain = HalfAngleAxes::parse("3x2x2", true).unwrap();
    HalfAngleAxes {
        phi_d: with(plain.phi_d, at.phi_d),
        theta_d: with(plain.theta_d, at.theta_d),
        theta_h: with(plain.theta_h, at.theta_h),
    }
}

fn file(bands: &Bands, axes: &HalfAngleAxes) -> Vec<u8> {
    pbsdf::write(bands, axes, "{}", Vec::new(), &Control::default()).unwrap()
}

const NM: [f64; 5] = [450.0, 500.0, 550.0, 600.0, 650.0];

#[test]
fn a_table_evaluated_as_mitsuba_does_gives_mitsubas_values() {
    for case in cases() {
        let (l, v) = case.directions();
        // Mirror images have no azimuth about the half vector: Mitsuba gives 0 there.
        let Some(at) = HalfAngles::of(l, v) else { continue };
        let bands = pbsdf::bands(&case.material(), &NM, true).unwrap();
        let table = PbsdfTable::read(Cursor::new(file(&bands, &axes_through(&at)))).unwrap();
        let error = error(table.eval(l, v, 550.0), case.mitsuba_eval_radiance_mode);
        // Numbers, nodes and Mitsuba's bases have 32 bits.
        assert!(error < 1e-6, "{} {l} {v}: {error:e}", case.model);
    }
}

#[test]
fn nodes_come_back_to_32_bits_and_none_is_empty() {
    let case = &cases()[2];
    let bands = pbsdf::bands(&case.material(), &NM, true).unwrap();
    let axes = HalfAngleAxes::parse("5x4x6", false).unwrap();
    let table = PbsdfTable::read(Cursor::new(file(&bands, &axes))).unwrap();
    assert_eq!(table.axes()[3], NM);
    for node in (0..5).flat_map(|i| (0..4).flat_map(move |j| (0..6).map(move |k| [i, j, k]))) {
        let (l, v) = node_directions(&axes.node(node));
        for (w, model) in bands.models().iter().enumerate() {
            let found = table.node([node[0], node[1], node[2], w]);
            assert!(found.0.iter().flatten().all(|x| x.is_finite()));
            let exact = model.evaluate_local(&[(l, v)], Basis::Plane)[0];
            let error = (found - frame::with_opposite_handedness(exact)).largest();
            // Half a unit in the last of 24 bits, and the smallest number with all of them.
            assert!(
                error <= 6e-8 * exact.largest() + f64::from(f32::MIN_POSITIVE),
                "{node:?}: {error:e}"
            );
        }
    }
}

#[test]
fn the_error_between_nodes_is_stated_and_shrinks_with_the_grid() {
    let bands = pbsdf::bands(&cases()[0].material(), &NM, true).unwrap();
    let coarse = interpolation_error(&bands, &HalfAngleAxes::parse("37x46x91", false).unwrap());
    // Known for this grid and material from Mitsuba's reader: median 0.1 %, 95 % 2.1 % for
    // directions that do not come near the horizon; these do.
    assert!(coarse.median < 0.002 && coarse.quantile_95 < 0.05, "{coarse:?}");
    let fine = interpolation_error(&bands, &HalfAngleAxes::parse("73x91x181", false).unwrap());
    assert!(fine.quantile_95 < 0.5 * coarse.quantile_95, "{fine:?}");
    let (axes, found) = pbsdf::choose_axes(&bands, 0.05, false).unwrap();
    assert!(found.quantile_95 <= 0.05 && axes.nodes() <= 37 * 46 * 91);
}

#[test]
fn a_table_agrees_with_its_material_and_not_with_another() {
    let all = cases();
    let bands = pbsdf::bands(&all[0].material(), &NM, true).unwrap();
    let bytes = file(&bands, &HalfAngleAxes::parse("9x8x12", false).unwrap());
    let against = |case: &MitsubaCase| {
        pbsdf::compare(Cursor::new(&bytes), &case.material(), &Control::default()).unwrap()
    };
    let same = against(&all[0]);
    assert!(same.compared > 1000 && same.empty == 0);
    assert!(same.found.iter().all(|d| d.largest < 1e-6 && (d.brightness - 1.0).abs() < 1e-6));
    assert!(against(&all[6]).found.iter().all(|d| d.mean > 0.1));
}

#[test]
fn what_mitsuba_cannot_read_is_refused_with_the_reason() {
    let material = cases()[0].material();
    let reason = |nm: &[f64]| pbsdf::bands(&material, nm, true).err().unwrap().to_string();
    assert!(reason(&[400.0, 450.0, 500.0, 550.0, 600.0, 650.0]).contains("takes exactly 5"));
    assert!(reason(&[450.0, 500.0, 550.5, 600.0, 650.0]).contains("whole nanometres"));
    assert!(pbsdf::bands(&material, &[400.0, 700.0], false).is_ok());
}

#[test]
fn a_bsdf_gives_the_material_back_in_spectra_and_in_colours() {
    let bands = Bands::new(&cases()[0].material(), &NM).unwrap();
    for channels in [BsdfChannels::Spectra, BsdfChannels::Rgb] {
        let size = BsdfSize::parse("24x64").unwrap();
        let file = bsdf::write(&bands, channels, size, "{}", Vec::new(), &Control::default());
        let table = bsdf::BsdfTable::read(Cursor::new(file.unwrap())).unwrap();
        let (mut sum, mut difference) = (0.0, 0.0);
        for k in 0..500 {
            let [a, b, c] = [0.819, 0.671, 0.549].map(|step| (k as f64 * step).fract());
            let direction = |theta: f64, phi: f64| {
                DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
            };
            let (l, v) = (direction(1.3 * a, 6.283 * b), direction(1.3 * c, 0.4));
            let exact = bands.unpolarized(l, v).next().unwrap() * l.z;
            sum += exact;
            // The metal is grey: every wavelength and every channel has one value.
            difference += table.eval(l, v).iter().map(|x| (x - exact).abs()).fold(0.0, f64::max);
        }
        // What other readers of the format found for this grid and roughness: 0.55 %.
        assert!(difference < 0.01 * sum, "{channels:?}: {}", difference / sum);
    }
}

#[test]
fn the_error_of_a_bsdf_is_that_of_the_file_that_is_read_back() {
    let bands = Bands::new(&cases()[0].material(), &NM).unwrap();
    let size = BsdfSize::parse("16x24").unwrap();
    let stated = bsdf::interpolation_error(&bands, BsdfChannels::Spectra, size).unwrap();
    let file =
        bsdf::write(&bands, BsdfChannels::Spectra, size, "{}", Vec::new(), &Control::default());
    let table = bsdf::BsdfTable::read(Cursor::new(file.unwrap())).unwrap();
    let direction = |sin2: f64, phi: f64| {
        let sin = sin2.sqrt();
        DVec3::new(sin * phi.cos(), sin * phi.sin(), (1.0 - sin2).sqrt())
    };
    // Even over projected solid angles of light and viewer, another way than the statement's.
    let (mut all, mut worse) = ([0.0, 0.0], [0.0, 0.0]);
    for k in 0..200_000 {
        let [a, b, c] = [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|x| (f64::from(k) * x).fract());
        let (l, v) = (direction(a, 6.283_185 * b), direction(0.998 * c, 0.0));
        let exact = bands.unpolarized(l, v).next().unwrap();
        let error = (table.eval(l, v)[0] / (exact * l.z) - 1.0).abs();
        for (k, bound) in [stated.median, stated.quantile_95].into_iter().enumerate() {
            all[k] += exact;
            worse[k] += if error > bound { exact } else { 0.0 };
        }
    }
    let [half, twentieth] = [worse[0] / all[0], worse[1] / all[1]];
    // 4096 directions tell parts of the light to a few hundredths.
    assert!((half - 0.5).abs() < 0.08, "{half} of the light is worse than the median {stated:?}");
    assert!((twentieth - 0.05).abs() < 0.03, "{twentieth} is worse than 95 %, {stated:?}");
}

#[test]
fn the_size_of_a_bsdf_is_chosen_for_an_error() {
    let bands = Bands::new(&cases()[0].material(), &NM).unwrap();
    let (size, found) = bsdf::choose_size(&bands, BsdfChannels::Spectra, 0.02).unwrap();
    assert!(found.quantile_95 <= 0.02 && size.side <= 128, "{size:?} {found:?}");
    let smaller = BsdfSize { theta_i: 16, side: 32, ..size };
    assert!(
        bsdf::interpolation_error(&bands, BsdfChannels::Spectra, smaller).unwrap().quantile_95
            > found.quantile_95
    );
    let refused = bsdf::choose_size(&bands, BsdfChannels::Spectra, 1e-6).unwrap_err().to_string();
    assert!(refused.contains("the largest size, 1x64x512"), "{refused}");
}
