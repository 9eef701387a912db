//! Instrument signatures, tabulated standards and second faces against NIST's library.

mod reference;

use reference::{TOLERANCE, check};
use scattering::{Basis, Geometry, Mode, Stokes, models};

#[test]
fn scattering_by_air_agrees_with_the_library() {
    check(&["Rayleigh_Instrument_BRDF_Model"]);
}

#[test]
fn models_behind_a_second_face_agree_with_the_library() {
    check(&["Transmit_BRDF_Model"]);
}

#[test]
fn the_zernike_expansion_agrees_with_the_library() {
    check(&["ZernikeExpansion_BRDF_Model"]);
}

/// Value of a detector of sensitivity `pol` for light `inpol`, per 1/sr.
fn seen(
    class: &str,
    params: &[(&str, &str)],
    degrees: [f64; 3],
    inpol: Stokes,
    pol: Stokes,
) -> f64 {
    let model = models::build(&reference::node(class, params, Mode::Compat)).unwrap();
    let [theta_i, theta_s, phi_s] = degrees.map(f64::to_radians);
    let at = Geometry { theta_i, theta_s, phi_s, rotation: 0.0 };
    pol.dot(&(model.mueller(&at, Basis::Psps) * inpol))
}

fn assert_row(got: &[f64], expected: &[f64]) {
    let largest = expected.iter().copied().fold(0.0, f64::max);
    for (g, e) in got.iter().zip(expected) {
        assert!((g - e).abs() < TOLERANCE * largest, "{g:e} is not {e:e}");
    }
}

#[test]
fn a_finite_aperture_agrees_with_the_program() {
    // tests/conformance/programs/v_inst_aperture.
    let params = [
        ("lambda", "0.631"),
        ("substrate", "(1.627,0)"),
        ("alpha", "0.713"),
        ("integralmode", "3"),
        ("model.lambda", "0.631"),
        ("model.substrate", "(1.627,0)"),
        ("model.psd.B", "40.4"),
    ];
    let beams = [
        ([1.0, -1.0, 0.0, 0.0], [0.5, -0.5, 0.0, 0.0]),
        ([1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]),
        ([1.0, 0.2, 0.3, -0.4], [0.5, 0.0, 0.5, 0.0]),
        ([1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0]),
    ];
    let rows = [
        (
            -76.53,
            [
                1.258155796255551e-05,
                7.899778191714454e-06,
                2.527280925740002e-06,
                1.608999083668017e-06,
            ],
        ),
        (
            -39.37,
            [
                1.735428576376764e-05,
                1.293252674608336e-05,
                4.201130313990961e-06,
                4.255383210629998e-06,
            ],
        ),
        (
            -2.21,
            [
                3.337935407134530e-05,
                3.399033738877531e-05,
                1.195858012719433e-05,
                1.730066033985923e-05,
            ],
        ),
        (
            34.95,
            [
                4.014133724671155e-04,
                1.146796211895115e-03,
                5.172118368912729e-04,
                9.460893973372107e-04,
            ],
        ),
    ];
    for (theta_s, expected) in rows {
        let got = beams.map(|(inpol, pol)| {
            let class = "Finite_Aperture_Instrument_BRDF_Model";
            seen(class, &params, [46.8, theta_s, 0.0], Stokes(inpol), Stokes(pol))
        });
        assert_row(&got, &expected);
    }
}

#[test]
fn a_focussed_beam_agrees_with_the_program() {
    // tests/conformance/programs/v_inst_focussed.
    let params = [
        ("lambda", "0.719"),
        ("substrate", "(3.903,0.325)"),
        ("alpha", "2.019"),
        ("integralmode", "2"),
        ("model.lambda", "0.719"),
        ("model.substrate", "(3.903,0.325)"),
        ("model.psd.B", "21.5"),
    ];
    let beams = [
        ([1.0, -1.0, 0.0, 0.0], [0.5, 0.0, 0.0, 0.5]),
        ([1.0, 0.2, 0.3, -0.4], [0.5, -0.3, 0.24, 0.32]),
        ([1.0, 0.0, 1.0, 0.0], [0.5, 0.0, -0.5, 0.0]),
        ([1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0]),
        ([1.0, 0.48, -0.6, 0.64], [0.5, 0.1, -0.35, 0.2]),
    ];
    let rows = [
        (
            5.86,
            [
                3.297592461201808e-02,
                3.540814992237641e-02,
                7.545276903917376e-02,
                4.113489591453705e-02,
                2.229900658455697e-02,
            ],
        ),
        (
            55.02,
            [
                1.479937262119113e-03,
                2.384746978488089e-03,
                1.612091758702727e-03,
                1.326131314802259e-03,
                1.847176624813460e-03,
            ],
        ),
        (
            104.18,
            [
                5.826504967536974e-04,
                7.878159859055689e-04,
                4.702279937077354e-05,
                6.107194350934763e-04,
                3.520927029796547e-04,
            ],
        ),
        (
            153.34,
            [
                4.558130292502445e-04,
                3.280358076723277e-04,
                6.840604819354568e-04,
                3.414916565197003e-04,
                7.101427374939369e-05,
            ],
        ),
    ];
    for (phi_s, expected) in rows {
        let got = beams.map(|(inpol, pol)| {
            let class = "Focussed_Beam_Instrument_BRDF_Model";
            seen(class, &params, [30.3, 23.8, phi_s], Stokes(inpol), Stokes(pol))
        });
        assert_row(&got, &expected);
    }
}
