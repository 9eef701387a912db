//! Sinusoidal surface relief.
//!
//! $$ z = \tfrac A2 \left(1 + \cos\frac{2\pi x}{d}\right) $$
//!
//! A (`amplitude`) is the height from trough to crest, d the period. `option` 0 cuts at equal
//! steps of the width, 1 at equal steps of the height. With `base` > 0 the lowest level is a full
//! layer of that thickness.
//!
//! M. G. Moharam, D. A. Pommet, E. B. Grann, T. K. Gaylord, J. Opt. Soc. Am. A 12, 1077 (1995).

use std::f64::consts::{PI, TAU};

use super::{
    COMMON, Grating, GratingCommon, GratingMaterial, LinePattern, LineProfile, LineSlice, levels,
    not_negative,
};
use crate::{
    optics::RefractiveIndex,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::index("material", (4.05, 0.05), "Index of the relief"),
    Parameter::number("amplitude", 0.4, "um", "Height from trough to crest"),
    Parameter::number("base", 0.0, "um", "Thickness of a full layer under the relief"),
    Parameter::integer("option", 0, "0 equal steps of the width, 1 equal steps of the height"),
    Parameter::integer("nlevels", 20, "Number of slices, the base among them"),
];

/// Name, parameters and constructor of a [`SinusoidalRelief`].
pub const SPEC: Spec<dyn Grating> = Spec {
    class: Class {
        name: "Sinusoidal_Relief_Grating",
        parent: "Grating",
        summary: "Sinusoidal surface relief",
        equation: "z = amplitude/2 (1 + cos(2 pi x/period))",
        source: "moharam-1995b",
        params: &[COMMON, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(SinusoidalRelief::read(node)?)),
};

/// A sinusoidal surface.
#[derive(Clone, Debug)]
pub struct SinusoidalRelief {
    common: GratingCommon,
    material: RefractiveIndex,
    amplitude: f64,
    base: f64,
    by_height: bool,
    /// Slices of the relief alone.
    levels: usize,
}

impl SinusoidalRelief {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let base = not_negative(node, "base")?;
        let for_base = usize::from(base != 0.0);
        let by_height = match node.integer("option") {
            0 => false,
            1 => true,
            other => return Err(ParameterError::new("option", format!("{other} is not 0 or 1"))),
        };
        Ok(Self {
            common: GratingCommon::read(node)?,
            material: node.index("material").clone(),
            amplitude: not_negative(node, "amplitude")?,
            base,
            by_height,
            levels: levels(node, "nlevels", 1 + for_base as i32)? - for_base,
        })
    }

    /// Half width and thickness of a level.
    fn level(&self, level: usize) -> (f64, f64) {
        let (level, n, period) = (level as f64, self.levels as f64, self.common.period);
        let h = (level + 0.5) / n;
        if self.by_height {
            return (period / TAU * (1.0 - 2.0 * h).acos(), self.amplitude / n);
        }
        let step = (PI * level / n).cos() - (PI * (level + 1.0) / n).cos();
        (0.5 * period * h, 0.5 * self.amplitude * step)
    }
}

impl Grating for SinusoidalRelief {
    fn at(&self, lambda: f64) -> Result<LineProfile, ParameterError> {
        let period = self.common.period;
        let inside = GratingMaterial::from_index(self.material.at(lambda));
        let outside = GratingMaterial::from_index(self.common.above.at(lambda));
        let relief = (0..self.levels).map(|level| {
            let (half, thickness) = self.level(level);
            LineSlice {
                thickness,
                pattern: LinePattern::line(-half, half, period, inside, outside),
            }
        });
        let base =
            LineSlice { thickness: self.base, pattern: LinePattern::uniform(inside, period) };
        Ok(self.common.profile(lambda, relief.chain((self.base > 0.0).then_some(base))))
    }
}

#[cfg(test)]
mod tests {
    use crate::{Mode, ParameterNode, ParameterValue, grating::Grating, spec};

    #[test]
    fn both_ways_of_cutting_keep_the_height() {
        for option in [0, 1] {
            let node = ParameterNode::with_defaults(&super::SPEC.class, Mode::Sound)
                .with("option", ParameterValue::Integer(option))
                .and_then(|node| node.with("base", ParameterValue::Number(0.1)))
                .unwrap();
            let profile = spec::build::<dyn Grating>(&node).unwrap().at(0.5).unwrap();
            let height: f64 = profile.slices.iter().map(|slice| slice.thickness).sum();
            assert!((height - 0.5).abs() < 1e-14);
            assert_eq!(profile.slices.len(), 20);
        }
    }
}
