//! Whatever its parameters are, a model is refused with the parameter's name or answers numbers.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::Arc,
};

use scattering::{
    Basis, Class, Geometry, Mode, ParameterKind, ParameterNode, ParameterValue, models,
    optics::{AbscissaScale, RealFunction, RefractiveIndex, TableInterpolation},
    stack::Film,
};

/// Pseudorandom numbers, the same in every run (splitmix64).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[(self.next() % all.len() as u64) as usize]
    }

    fn number(&mut self) -> f64 {
        self.one_of(&[
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            0.0,
            -0.0,
            -1.0,
            1e-300,
            1e300,
            -1e300,
            f64::MAX,
            f64::MIN_POSITIVE,
            1e-3,
            0.1,
            0.5,
            1.0,
            1.5,
            2.0,
            30.0,
            1e6,
            -1e-9,
        ])
    }

    fn integer(&mut self) -> i32 {
        self.one_of(&[i32::MIN, -1000, -1, 0, 1, 2, 3, 7, 12, 1_000_000, i32::MAX])
    }

    fn index(&mut self) -> RefractiveIndex {
        RefractiveIndex::constant(self.number(), self.number())
    }

    fn text(&mut self) -> &'static str {
        self.one_of(&[
            "",
            "(",
            "1 2 3",
            "END",
            "nan nan",
            "0 0 0 0 0 0 0 0",
            "VERTICES\nA (0,0)\n",
            "\u{7f}\u{e9}",
        ])
    }

    /// A value of the kind, or nothing to keep the default.
    fn value(&mut self, kind: ParameterKind, depth: usize) -> Option<ParameterValue> {
        Some(match kind {
            ParameterKind::Number(_) => ParameterValue::Number(self.number()),
            ParameterKind::Integer(_) => ParameterValue::Integer(self.integer()),
            ParameterKind::Text | ParameterKind::File => ParameterValue::Text(self.text().into()),
            ParameterKind::Formula(_) => {
                let value = self.number();
                ParameterValue::Formula(Arc::new(move |x| value * x))
            }
            ParameterKind::Index { .. } => ParameterValue::Index(self.index()),
            ParameterKind::Table(_) => ParameterValue::Table(self.table()),
            ParameterKind::Films => ParameterValue::Films(
                (0..self.next() % 3)
                    .map(|_| Film { index: self.index(), thickness: self.number() })
                    .collect(),
            ),
            ParameterKind::Member { family, base, .. } => {
                let classes = family.classes();
                let class = self.one_of(&classes);
                if depth > 2 || !family.is_below(class.name, base) {
                    return None;
                }
                ParameterValue::Member(self.node(class, depth + 1).into())
            }
        })
    }

    fn table(&mut self) -> RealFunction {
        if self.next().is_multiple_of(2) {
            return RealFunction::constant(self.number());
        }
        let rows: Vec<(f64, f64)> = (0..3).map(|_| (self.number(), self.number())).collect();
        let axis = self.one_of(&[AbscissaScale::Linear, AbscissaScale::Log]);
        let rise = self.one_of(&[
            TableInterpolation::Linear,
            TableInterpolation::Log,
            TableInterpolation::Spline,
            TableInterpolation::LogSpline,
        ]);
        RealFunction::points(&rows, axis, rise)
    }

    /// The class with some of its parameters changed.
    fn node(&mut self, class: &'static Class, depth: usize) -> ParameterNode {
        let mut node = ParameterNode::with_defaults(class, Mode::Sound);
        let changed = 1 + self.next() % 3;
        for _ in 0..changed {
            let params: Vec<_> = class.parameters().collect();
            if params.is_empty() {
                break;
            }
            let param = self.one_of(&params);
            if let Some(value) = self.value(param.kind, depth) {
                node = node.with(param.name, value).unwrap();
            }
        }
        node
    }
}

const GEOMETRIES: [Geometry; 3] = [
    Geometry { theta_i: 0.5, theta_s: 0.6, phi_s: 0.7, rotation: 0.1 },
    Geometry { theta_i: 0.0, theta_s: 0.0, phi_s: 0.0, rotation: 0.0 },
    Geometry { theta_i: 1.3, theta_s: 1.3, phi_s: 3.0, rotation: -2.0 },
];

/// Faults of the model that `node` describes.
fn judge(node: &ParameterNode) -> Option<String> {
    let outcome = catch_unwind(AssertUnwindSafe(|| match models::build(node) {
        Err(error) if error.parameter.is_empty() => Some("names no parameter".to_owned()),
        Err(_) => None,
        Ok(model) => GEOMETRIES.iter().find_map(|at| {
            let m = model.mueller(at, Basis::Psps);
            let is_finite = m.0.iter().flatten().all(|x| x.is_finite());
            (!is_finite).then(|| format!("{m:?} at {at:?}"))
        }),
    }));
    outcome.unwrap_or_else(|_| Some("panics".to_owned()))
}

/// Number of tested sets of parameters: fewer if one of them may take a second.
fn draws(class: &str) -> usize {
    match class {
        "CrossRCW_BRDF_Model" | "Polydisperse_Sphere_BRDF_Model" => 20,
        _ => 200,
    }
}

fn values(node: &ParameterNode) -> String {
    let of = |(param, value): (&scattering::Parameter, &ParameterValue)| match value {
        ParameterValue::Member(inner) => {
            format!("{} = {} [{}]", param.name, inner.class.name, values(inner))
        }
        other => format!("{} = {other:?}", param.name),
    };
    node.class.parameters().zip(&node.values).map(of).collect::<Vec<_>>().join(", ")
}

#[test]
fn no_parameter_makes_a_model_panic_or_answer_without_numbers() {
    let mut dice = Dice(7);
    let mut wrong = Vec::new();
    for class in models::FAMILY.classes() {
        for _ in 0..draws(class.name) {
            let node = dice.node(class, 0);
            if let Some(why) = judge(&node) {
                wrong.push(format!("{}: {why}\n    {}", class.name, values(&node)));
            }
        }
    }
    assert!(wrong.is_empty(), "{} models:\n{}", wrong.len(), wrong.join("\n"));
}
