//! First-order scattering by a small perturbation inside a film stack, by reciprocity.
//!
//! The scattered amplitude is a bilinear form of two fields at the perturbation: the field of the
//! source, and the field of a unit wave that comes from the detector. With the fields E (s) and
//! U, W (p) of [`Films`], D = κU, σ = −1 for reflection and +1 for transmission, and the coupling C
//! and the product of permittivities ε² of the perturbation,
//!
//! $$ J_{ss} = C E_i E_s \cos\varphi, \quad J_{ps} = -C W_i E_s \sin\varphi, \quad
//!    J_{sp} = \sigma C E_i W_s \sin\varphi, \quad
//!    J_{pp} = C \left( \frac{D_i D_s}{\varepsilon^2} + \sigma W_i W_s \cos\varphi \right) \qquad (1) $$
//!
//! times √(n_d/(cos θ_i cos θ_s)). n_d is 1 for reflection; for transmission it is the index of
//! the substrate, and the wave from the detector has unit electric field there. Light from the
//! substrate side is the same problem turned over: all indices and the wavelength divided by n,
//! the films reversed, and the signs of the off-diagonal elements turned.
//!
//! J. M. Elson, J. Opt. Soc. Am. A 12, 729 (1995), and T. A. Germer, J. Opt. Soc. Am. A 18, 1279
//! (2001), reach the same amplitudes by transfer matrices.

use num_complex::Complex64;

use super::film::{Films, IncidentSide, TangentialFields};
use crate::{
    Direction, Incidence, Jones, Side,
    geometry::ScatteredRay,
    lanes::{Complex, Real},
};

/// A film stack turned so that the light comes from its outer side.
#[derive(Clone, Debug)]
pub struct FirstOrder {
    films: Films,
    lambda: f64,
    /// Divisor of the indices.
    unit: f64,
    /// Position of the detector.
    from: IncidentSide,
    /// n_d.
    index: f64,
    /// σ.
    sign: f64,
    turned_over: bool,
}

/// The fields of the source at a perturbation, times the factors that do not depend on the
/// direction.
#[derive(Clone, Copy, Debug)]
pub struct Drive {
    e: Complex64,
    w: Complex64,
    d: Complex64,
}

impl FirstOrder {
    /// The stack `films` of (index, thickness µm), the one next to the substrate first, at the
    /// vacuum wavelength `lambda` µm. The substrate is transparent unless `side` is reflection
    /// from outside.
    pub fn new(side: Side, films: &[(Complex64, f64)], substrate: Complex64, lambda: f64) -> Self {
        let turned_over = side.from_below();
        let unit = if turned_over { substrate.re } else { 1.0 };
        let mut films: Vec<_> = films.iter().map(|&(index, t)| (index / unit, t)).collect();
        let substrate = if turned_over {
            films.reverse();
            Complex64::from(1.0 / unit)
        } else {
            substrate
        };
        let lambda = lambda / unit;
        let films = Films::new(&films, Complex64::ONE, substrate, lambda);
        let (from, index, sign) = match side {
            Side::DownUp | Side::UpDown => (IncidentSide::FromOutside, 1.0, -1.0),
            Side::DownDown | Side::UpUp => (IncidentSide::FromSubstrate, substrate.re, 1.0),
        };
        Self { films, lambda, unit, from, index, sign, turned_over }
    }

    /// The films as the light meets them.
    pub fn films(&self) -> &Films {
        &self.films
    }

    /// The wavelength where the light comes from, µm.
    pub fn lambda(&self) -> f64 {
        self.lambda
    }

    /// Divisor of every index: the index of the medium of the incident light.
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// True if the films stand in reverse order.
    pub fn is_turned_over(&self) -> bool {
        self.turned_over
    }

    /// σ: −1 for reflection, +1 for transmission.
    pub fn sign(&self) -> f64 {
        self.sign
    }

    /// Tangential index of the incident wave.
    pub fn kappa_in(&self, incidence: &Incidence) -> Complex64 {
        incidence.sin.into()
    }

    /// Tangential index of the wave from the detector, and the side it comes from.
    pub fn kappa_out(&self, direction: &Direction) -> (IncidentSide, Complex64) {
        (self.from, (self.index * direction.sin).into())
    }

    /// Response to a source with these fields at the perturbation; `coupling` is C and
    /// `inverse_product` 1/ε².
    pub fn drive(
        &self,
        incidence: &Incidence,
        fields: &TangentialFields,
        coupling: Complex64,
        inverse_product: Complex64,
    ) -> Drive {
        let c = coupling * (self.index / incidence.cos).sqrt();
        Drive {
            e: c * fields.e,
            w: c * fields.w,
            d: c * fields.u * (incidence.sin * self.index * self.index) * inverse_product,
        }
    }

    /// The amplitude whose Mueller matrix is the BRDF; `seen` are the fields of the detector.
    #[inline]
    pub fn scatter(&self, drive: &Drive, seen: &TangentialFields, direction: &Direction) -> Jones {
        let seen = [seen.e, seen.u, seen.w].map(Into::into);
        let [ss, ps, sp, pp] =
            self.elements(drive, seen, &ScatteredRay::single(direction)).map(Into::into);
        Jones { ss, ps, sp, pp }
    }

    /// The elements ss, ps, sp and pp of that amplitude, for one direction or several.
    #[inline(always)]
    pub(crate) fn elements<R: Real>(
        &self,
        drive: &Drive,
        [e, u, w]: [Complex<R>; 3],
        to: &ScatteredRay<R>,
    ) -> [Complex<R>; 4] {
        let scale = to.cos.splat(1.0) / to.cos.sqrt();
        let (c, s) = (to.cos_phi * scale, to.sin_phi * scale);
        let w = w * to.cos.splat(self.sign * self.index);
        let across = if self.turned_over { -s } else { s };
        [
            e.times(drive.e) * c,
            e.times(drive.w) * -across,
            w.times(drive.e) * across,
            u.times(drive.d) * (to.sin * scale) + w.times(drive.w) * c,
        ]
    }
}
