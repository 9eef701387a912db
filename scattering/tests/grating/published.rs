//! Efficiencies that other people published or computed with other methods.

use scattering::Model;

use super::parts::{LineStack, efficiency, index, integer, number};

const INCIDENCE: f64 = std::f64::consts::PI / 6.0;

/// (TE, TM) efficiency of an order in the plane of incidence.
fn te_tm(model: &Model, lines: &LineStack, order: f64, exit: f64) -> (f64, f64) {
    let x = (INCIDENCE.sin() + order * lines.lambda / lines.period) / exit;
    let m = efficiency(model, INCIDENCE, 0.0, x, 0.0);
    (m[(0, 0)] + m[(0, 1)], m[(0, 0)] - m[(0, 1)])
}

#[test]
fn sinusoidal_grating_a_hundred_periods_deep_has_the_published_efficiencies() {
    // L. Li, J. Opt. Soc. Am. A 10, 2581 (1993), table 3 with h/d = 100: ε = 2.25, λ = d/1.7,
    // 30°. The digits are those that K. C. Johnson's program GD-Calc (public domain, demo 1b)
    // lists for 50 strata and orders up to 20; they end in the fifth digit.
    let lines = LineStack { lambda: 1.0 / 1.7, period: 1.0, order: 20, substrate: (1.5, 0.0) };
    let relief = [
        ("material", index(1.5, 0.0)),
        ("amplitude", number(100.0)),
        ("option", integer(1)),
        ("nlevels", integer(50)),
    ];
    let reflected = lines.model(0, "Sinusoidal_Relief_Grating", &relief);
    let transmitted = lines.model(1, "Sinusoidal_Relief_Grating", &relief);
    for (model, exit, order, te, tm) in [
        (&reflected, 1.0, -2.0, 0.00118, 0.00195),
        (&reflected, 1.0, -1.0, 0.000_773_35, 0.000_213_47),
        (&reflected, 1.0, 0.0, 0.001_003_1, 0.000_240_74),
        (&transmitted, 1.5, -3.0, 0.001_634_9, 0.004_204_8),
        (&transmitted, 1.5, -2.0, 0.198_62, 0.138_07),
        (&transmitted, 1.5, -1.0, 0.079_493, 0.085_393),
        (&transmitted, 1.5, 0.0, 0.6894, 0.750_73),
        (&transmitted, 1.5, 1.0, 0.027_892, 0.019_199),
    ] {
        for (got, want) in [te_tm(model, &lines, order, exit)].map(|(a, b)| [(a, te), (b, tm)])[0] {
            assert!((got / want - 1.0).abs() < 5e-5, "order {order}: {got} is not {want}");
        }
    }
}

#[test]
fn lamellar_metal_grating_converges_to_the_published_efficiencies() {
    // The grating on which L. Li, C. W. Haggans, J. Opt. Soc. Am. A 10, 1184 (1993), and after
    // them P. Lalanne, G. M. Morris (1996), G. Granet, B. Guizal (1996) showed the convergence in
    // TM: n = 0.22 + 6.71i, period, depth and wavelength 1 µm, half filled, 30°. Converged:
    // TE order −1 0.7343, TM order 0 0.8484. At 40 harmonics 2·10⁻³ is left.
    let lines = LineStack { lambda: 1.0, period: 1.0, order: 40, substrate: (0.22, 6.71) };
    let model = lines.model(
        0,
        "Single_Line_Grating",
        &[
            ("material", index(0.22, 6.71)),
            ("height", number(1.0)),
            ("topwidth", number(0.5)),
            ("bottomwidth", number(0.5)),
        ],
    );
    let (te, _) = te_tm(&model, &lines, -1.0, 1.0);
    let (_, tm) = te_tm(&model, &lines, 0.0, 1.0);
    assert!((te - 0.7343).abs() < 2e-3, "TE {te}");
    assert!((tm - 0.8484).abs() < 2e-3, "TM {tm}");
}
