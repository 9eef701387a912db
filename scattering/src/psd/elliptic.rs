//! Equal features of elliptic outline at random places: the spectrum of plateaus and of dimples.
//!
//! $$ \mathrm{PSD} = D \left( c V \frac{J_n(2\pi u)}{(2\pi u)^n} \right)^2,\quad
//!    u^2 = \left(\frac{f_x a_x}{2}\right)^2 + \left(\frac{f_y a_y}{2}\right)^2 $$
//!
//! a_x, a_y are the full axes of the ellipse, V the volume of one feature, D the number per area;
//! c = 2ⁿ n! makes the bracket V at zero frequency.

use std::f64::consts::{PI, TAU};

use super::{Psd, strength};
use crate::{
    spec::{Parameter, ParameterError, ParameterNode},
    special::bessel::bessel_over_power,
};

/// The parameters of every class of such features.
pub(super) const ELLIPTIC: &[Parameter] = &[
    Parameter::number("axisx", 1.5, "um", "Full axis along x"),
    Parameter::number("axisy", 1.5, "um", "Full axis along y"),
    Parameter::number("height", 0.01, "um", "Height of one"),
    Parameter::number("density", 0.01, "1/um^2", "Number per area"),
];

/// Features whose transform is J_N(z)/z^N of an ellipse.
#[derive(Clone, Debug)]
pub struct Elliptic<const N: usize> {
    /// a_x/2 and a_y/2, µm.
    semi_axes: (f64, f64),
    /// D (c V)², µm⁴.
    peak: f64,
}

impl<const N: usize> Elliptic<N> {
    /// Features of `shape` times the volume of a plateau, and the `factor` c of the formula above.
    ///
    /// # Errors
    ///
    /// A negative density.
    pub(super) fn read(
        node: &ParameterNode,
        factor: f64,
        shape: f64,
    ) -> Result<Self, ParameterError> {
        let (ax, ay) = (node.number("axisx"), node.number("axisy"));
        let volume = PI / 4.0 * shape * ax * ay * node.number("height");
        let peak = strength(node, "density")? * (factor * volume).powi(2);
        Ok(Self { semi_axes: (0.5 * ax, 0.5 * ay), peak })
    }
}

impl<const N: usize> Psd for Elliptic<N> {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        let u = (fx * self.semi_axes.0).hypot(fy * self.semi_axes.1);
        self.peak * bessel_over_power::<N>(TAU * u).powi(2)
    }
}
