//! Volume hologram: a permittivity that varies as a cosine along a tilted direction.
//!
//! $$ \epsilon = \frac{\epsilon_{max} + \epsilon_{min}}{2} + \frac{\epsilon_{max} - \epsilon_{min}}{2}
//! \cos\frac{2\pi (x + H\tan\tau)}{d} $$
//!
//! H is the depth of a level's middle, τ (`tilt`) the tilt of the fringes.
//!
//! NIST's library expands 1/ε in twenty powers of the contrast ([`Defect::VolumeSeries`]).
//!
//! H. Kogelnik, Bell Syst. Tech. J. 48, 2909 (1969).

use std::f64::consts::TAU;

use super::{
    COMMON, CosineReciprocal, Grating, GratingCommon, LinePattern, LineProfile, LineSlice, levels,
    not_negative,
};
use crate::{
    Defect,
    optics::RefractiveIndex,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::index("minimum", (1.52, 0.0), "Index at one end of the swing"),
    Parameter::index("maximum", (1.5, 0.0), "Index at the other end"),
    Parameter::number("thick", 0.1, "um", "Thickness"),
    Parameter::number("tilt", 0.0, "deg", "Tilt of the fringes from the normal"),
    Parameter::integer("nlevels", 1, "Number of slices"),
];

/// Name, parameters and constructor of a [`SinusoidalVolume`].
pub const SPEC: Spec<dyn Grating> = Spec {
    class: Class {
        name: "Sinusoidal_Volume_Grating",
        parent: "Grating",
        summary: "Volume hologram",
        equation: "eps = (emax+emin)/2 + (emax-emin)/2 cos(2 pi (x + H tan(tilt))/period)",
        source: "kogelnik-1969",
        params: &[COMMON, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(SinusoidalVolume::read(node)?)),
};

/// A volume hologram.
#[derive(Clone, Debug)]
pub struct SinusoidalVolume {
    common: GratingCommon,
    minimum: RefractiveIndex,
    maximum: RefractiveIndex,
    thickness: f64,
    slope: f64,
    levels: usize,
    /// Asked whether to end the series of 1/ε early, which matters at large contrasts.
    node: ParameterNode,
}

impl SinusoidalVolume {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let tilt = node.number("tilt");
        if tilt.is_nan() || tilt.abs() >= 90.0 {
            return Err(ParameterError::new("tilt", format!("{tilt} is not between -90 and 90")));
        }
        Ok(Self {
            common: GratingCommon::read(node)?,
            minimum: node.index("minimum").clone(),
            maximum: node.index("maximum").clone(),
            thickness: not_negative(node, "thick")?,
            slope: tilt.to_radians().tan(),
            levels: levels(node, "nlevels", 1)?,
            node: node.clone(),
        })
    }
}

impl Grating for SinusoidalVolume {
    fn at(&self, lambda: f64) -> Result<LineProfile, ParameterError> {
        let (low, high) = (self.minimum.at(lambda).powi(2), self.maximum.at(lambda).powi(2));
        let thickness = self.thickness / self.levels as f64;
        let period = self.common.period;
        let (mean, swing) = (0.5 * (high + low), 0.5 * (high - low));
        // Below this contrast the powers that NIST's library leaves out are less than 10⁻¹⁰.
        let is_large = swing.norm() > 0.3 * mean.norm();
        let reciprocal = if is_large && self.node.reproduces(Defect::VolumeSeries) {
            CosineReciprocal::TwentyPowers
        } else {
            CosineReciprocal::Exact
        };
        let slices = (0..self.levels).map(|level| {
            let depth = (level as f64 + 0.5) * thickness;
            let pattern = LinePattern::Cosine {
                mean,
                swing,
                phase: TAU * depth * self.slope / period,
                period,
                reciprocal,
            };
            LineSlice { thickness, pattern }
        });
        Ok(self.common.profile(lambda, slices))
    }
}
