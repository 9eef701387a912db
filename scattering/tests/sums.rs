//! Sums of Mueller matrices over directions, as detectors make them.

use scattering::{
    Basis, Direction, Incidence, Mode, Model, Mueller, ParameterNode, ParameterValue, models,
    optics::RefractiveIndex, polarization::DirectionWeights,
};

fn model(name: &str, mode: Mode, side: i32) -> Model {
    let mut node = ParameterNode::with_defaults(&models::find(name).unwrap().class, mode);
    if side > 0 {
        node = node
            .with("substrate", ParameterValue::Index(RefractiveIndex::constant(1.5, 0.0)))
            .unwrap();
    }
    models::build(&node.with("type", ParameterValue::Integer(side)).unwrap()).unwrap()
}

/// Directions all over the half space, with that of the beam itself and some at the horizon.
fn directions(count: usize) -> Vec<Direction> {
    let direction = |k: usize| match k % 37 {
        5 => Direction::new(0.4, std::f64::consts::PI),
        11 => Direction::new(std::f64::consts::FRAC_PI_2, 0.3),
        _ => Direction::new(1.5 * (0.37 * k as f64).sin().abs(), 2.1 * k as f64),
    };
    (0..count).map(direction).collect()
}

fn weights(count: usize) -> DirectionWeights {
    let mut weights = DirectionWeights::default();
    for k in (0..count).map(|k| k as f64) {
        let turn = 0.3 * k;
        weights.push((0.7 * k).cos(), [turn.cos(), turn.sin()]);
    }
    weights
}

/// Σ w R(β)ᵀ M written down matrix by matrix.
fn expected(matrices: &[Mueller], weights: &DirectionWeights, sign: f64) -> Mueller {
    let mut sum = Mueller::ZERO;
    for (k, m) in matrices.iter().enumerate() {
        let (c, s) = (weights.cos2b[k], sign * weights.sin2b[k]);
        let turned = Mueller([
            [1.0, 0.0, 0.0, 0.0],
            [0.0, c, -s, 0.0],
            [0.0, s, c, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]);
        sum += turned * *m * weights.weight[k];
    }
    sum
}

#[test]
fn a_sum_is_that_of_the_matrices_of_its_directions() {
    let names = [
        "Facet_BRDF_Model",
        "Shadowed_Facet_BRDF_Model",
        "Subsurface_Facet_BRDF_Model",
        "Lambertian_BRDF_Model",
        "Microroughness_BRDF_Model",
    ];
    let incidence = Incidence::new(0.4, 0.2);
    for name in names {
        for (mode, side, basis) in [
            (Mode::Sound, 0, Basis::Psps),
            (Mode::Compat, 0, Basis::Psps),
            (Mode::Sound, 0, Basis::Xyxy),
            (Mode::Sound, 1, Basis::Psps),
            (Mode::Sound, 2, Basis::Psps),
        ] {
            if side > 0 && name != "Facet_BRDF_Model" {
                continue;
            }
            let model = model(name, mode, side);
            for (count, above) in [(0, false), (3, true), (5, true), (131, true), (300, false)] {
                let mut directions = directions(count);
                directions.retain(|direction| !above || direction.is_above());
                let weights = weights(directions.len());
                let mut matrices = vec![Mueller::ZERO; directions.len()];
                model.evaluate(&incidence, &directions, basis, &mut matrices);
                // Into the substrate, from above and from below.
                let sign = if matches!(side, 1 | 2) { -1.0 } else { 1.0 };
                let want = expected(&matrices, &weights, sign);
                let got = model.sum(&incidence, &directions, &weights, basis);
                // Rounding of a few hundred terms in another order.
                let terms: f64 = matrices.iter().map(Mueller::largest).sum();
                assert!((got - want).largest() <= 1e-14 * terms, "{name} {side} {count}");
            }
        }
    }
}

#[test]
fn nothing_is_added_for_a_beam_below_the_horizon() {
    let model = model("Shadowed_Facet_BRDF_Model", Mode::Sound, 0);
    let incidence = Incidence::new(1.6, 0.0);
    let sum = model.sum(&incidence, &directions(9), &weights(9), Basis::Psps);
    assert_eq!(sum, Mueller::ZERO);
}
