//! Trapezoidal line whose corners are arcs.
//!
//! With sidewall angle θ, radii r_t at the top and r_b at the foot, the half profile is, from
//! the edge of the flat top outwards (X from 0 to a₆),
//!
//! $$ Y = \begin{cases} H - r_t + \sqrt{r_t^2 - X^2} & X < a_2 \\
//! (a_6 - a_4 + a_5 - X)\tan\theta & X < a_2 + a_3 \\
//! r_b - \sqrt{r_b^2 - (a_6 - X)^2} & \text{else} \end{cases} $$
//!
//! a₂ = r_t sin θ, a₄ = r_b sin θ, a₅ = r_b(1 − cos θ) cot θ,
//! a₃ = (H − (r_t + r_b)(1 − cos θ)) cot θ, a₁ = w/2 − a₃ − a₂ − a₅, a₆ = a₂ + a₃ + a₄. Levels are
//! cut at equal steps of X. Sidewalls beyond 90° overhang: the line grows wider upwards, the arcs turn
//! beyond their vertical tangents, and levels are cut at equal steps of ∫|dX| down the profile.
//!
//! M. G. Moharam, D. A. Pommet, E. B. Grann, T. K. Gaylord, J. Opt. Soc. Am. A 12, 1077 (1995),
//! for profiles as stacks of lamellar slices.

use super::{
    COMMON, Grating, GratingCommon, GratingMaterial, LinePattern, LineProfile, LineSlice, levels,
    not_negative, positive,
};
use crate::{
    optics::RefractiveIndex,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::index("material", (4.05, 0.05), "Index of the line"),
    Parameter::number("height", 0.1, "um", "Height of the line"),
    Parameter::number("width", 0.1, "um", "Width of the line at its foot, without the arcs"),
    Parameter::number("sidewall", 88.0, "deg", "Angle of the sidewall; above 90 it overhangs"),
    Parameter::number("radiusb", 0.01, "um", "Radius of the arcs at the foot"),
    Parameter::number("radiust", 0.001, "um", "Radius of the arcs at the top"),
    Parameter::integer("nlevels", 10, "Number of slices"),
];

/// Name, parameters and constructor of a [`CornerRounded`].
pub const SPEC: Spec<dyn Grating> = Spec {
    class: Class {
        name: "Corner_Rounded_Grating",
        parent: "Grating",
        summary: "Trapezoidal line with rounded corners",
        equation: "arc of radiust, straight sidewall, arc of radiusb",
        source: "moharam-1995b",
        params: &[COMMON, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(CornerRounded::read(node)?)),
};

/// A line with rounded corners.
#[derive(Clone, Debug)]
pub struct CornerRounded {
    common: GratingCommon,
    material: RefractiveIndex,
    /// Half width and thickness of every level, the topmost first.
    levels: Vec<(f64, f64)>,
}

impl CornerRounded {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = GratingCommon::read(node)?;
        let outline = HalfProfile::read(node, common.period)?;
        let levels = outline.levels(levels(node, "nlevels", 2)?);
        Ok(Self { common, material: node.index("material").clone(), levels })
    }
}

/// The half profile of the line, from the edge of the flat top down to the foot.
struct HalfProfile {
    height: f64,
    top_radius: f64,
    foot_radius: f64,
    tan: f64,
    /// Half width of the flat top.
    flat: f64,
    /// Widths of the upper arc, the sidewall and the lower arc between their ends; the sidewall's is
    /// negative if it overhangs.
    arc: f64,
    wall: f64,
    foot: f64,
    /// Height over width of the lower arc's end, a₅.
    foot_rise: f64,
}

impl HalfProfile {
    fn read(node: &ParameterNode, period: f64) -> Result<Self, ParameterError> {
        let sidewall = node.number("sidewall");
        if !(sidewall > 0.0 && sidewall < 180.0) {
            let problem = format!("{sidewall} is not between 0 and 180");
            return Err(ParameterError::new("sidewall", problem));
        }
        let (sin, cos) = sidewall.to_radians().sin_cos();
        let (tan, cot) = (sin / cos, cos / sin);
        let (height, width) = (positive(node, "height")?, positive(node, "width")?);
        let (rt, rb) = (not_negative(node, "radiust")?, not_negative(node, "radiusb")?);
        let (arc, foot, foot_rise) = (rt * sin, rb * sin, rb * (1.0 - cos) * cot);
        let straight = height - (rt + rb) * (1.0 - cos);
        let wall = straight * cot;
        let flat = 0.5 * width - wall - arc - foot_rise;
        if straight < 0.0 {
            return Err(ParameterError::new("height", "the arcs are higher than the line"));
        }
        let profile =
            Self { height, top_radius: rt, foot_radius: rb, tan, flat, arc, wall, foot, foot_rise };
        let (narrowest, widest) = profile.half_widths();
        if narrowest < 0.0 {
            return Err(ParameterError::new("width", "sidewalls and arcs are wider than the line"));
        }
        if widest > 0.5 * period {
            let problem = "the line with its arcs is wider than the period";
            return Err(ParameterError::new("period", problem));
        }
        Ok(profile)
    }

    fn overhangs(&self) -> bool {
        self.tan < 0.0
    }

    /// X where the profile meets the substrate, a₆.
    fn end(&self) -> f64 {
        self.arc + self.wall + self.foot
    }

    /// The smallest and the largest half width.
    fn half_widths(&self) -> (f64, f64) {
        let end = self.flat + self.end();
        if self.overhangs() {
            let (top, neck) = (self.flat + self.top_radius, end - self.foot_radius);
            (self.flat.min(neck), top.max(end))
        } else {
            (self.flat, end)
        }
    }

    /// ∫|dX| from the edge of the flat top to the foot.
    fn length(&self) -> f64 {
        if self.overhangs() {
            2.0 * (self.top_radius + self.foot_radius) - self.arc - self.wall - self.foot
        } else {
            self.end()
        }
    }

    /// (X, Y) at ∫|dX| = `s` from the edge of the flat top.
    fn place(&self, s: f64) -> (f64, f64) {
        let (rt, rb, end) = (self.top_radius, self.foot_radius, self.end());
        let upper = |x: f64| (rt.powi(2) - x * x).sqrt();
        let lower = |x: f64| (rb.powi(2) - (end - x).powi(2)).sqrt();
        if !self.overhangs() {
            let y = if s < self.arc {
                self.height - rt + upper(s)
            } else if s < self.arc + self.wall {
                (end - self.foot + self.foot_rise - s) * self.tan
            } else {
                rb - lower(s)
            };
            return (s, y);
        }
        // Out and back along the upper arc, back along the wall, back and out along the lower arc.
        let left = self.length() - s;
        if s < rt {
            (s, self.height - rt + upper(s))
        } else if s < 2.0 * rt - self.arc {
            let x = 2.0 * rt - s;
            (x, self.height - rt - upper(x))
        } else if left > 2.0 * rb - self.foot {
            let x = 2.0 * rt - s;
            (x, (end - self.foot + self.foot_rise - x) * self.tan)
        } else if left > rb {
            let x = end - (2.0 * rb - left);
            (x, rb + lower(x))
        } else {
            let x = end - left;
            (x, rb - lower(x))
        }
    }

    /// `n` levels at equal steps of ∫|dX|, bounded by the midpoints of neighbouring heights.
    fn levels(&self, n: usize) -> Vec<(f64, f64)> {
        let length = self.length();
        let places: Vec<(f64, f64)> =
            (0..n).map(|i| self.place((i as f64 + 0.5) / n as f64 * length)).collect();
        let middle = |i: usize| 0.5 * (places[i].1 + places[i + 1].1);
        (0..n)
            .map(|i| {
                let thickness = match i {
                    0 => self.height - middle(0),
                    i if i + 1 == n => middle(n - 2),
                    i => middle(i - 1) - middle(i),
                };
                (self.flat + places[i].0, thickness)
            })
            .collect()
    }
}

impl Grating for CornerRounded {
    fn at(&self, lambda: f64) -> Result<LineProfile, ParameterError> {
        let inside = GratingMaterial::from_index(self.material.at(lambda));
        let outside = GratingMaterial::from_index(self.common.above.at(lambda));
        let slices = self.levels.iter().map(|&(half, thickness)| LineSlice {
            thickness,
            pattern: LinePattern::line(-half, half, self.common.period, inside, outside),
        });
        Ok(self.common.profile(lambda, slices))
    }
}
