//! First-order amplitudes of every interface of a film stack, by reciprocity.
//!
//! The amplitude that a small displacement of one interface scatters is the bilinear form of the
//! field that the source drives there and the field that a unit wave sent in from the detector
//! would drive there. With the fields E (s) and U, W (p) of [`Films`], D = κU, the permittivities
//! ε₋ below and ε₊ above the interface, σ = −1 for reflection and +1 for transmission,
//!
//! $$ C = \sigma \frac{\pi}{\lambda^2} (\varepsilon_+ - \varepsilon_-)
//!        \sqrt{\frac{n_d}{\cos\theta_i \cos\theta_s}} $$
//!
//! $$ J_{ss} = C E_i E_s \cos\varphi, \quad J_{ps} = -C W_i E_s \sin\varphi, \quad
//!    J_{sp} = \sigma C E_i W_s \sin\varphi, \quad
//!    J_{pp} = C \left( \frac{D_i D_s}{\varepsilon_- \varepsilon_+}
//!             + \sigma W_i W_s \cos\varphi \right) $$
//!
//! n_d is 1 for reflection; for transmission it is the index of the substrate, and the wave from
//! the detector has unit electric field there. Light from the substrate side is the same problem
//! turned over: all indices and the wavelength divided by n, the films reversed, and the signs
//! of the off-diagonal elements turned.
//!
//! J. M. Elson, *Multilayer-coated optics: guided-wave coupling and scattering by means of
//! interface random roughness*, J. Opt. Soc. Am. A 12, 729 (1995), by transfer matrices.

use std::f64::consts::PI;

use num_complex::Complex64;

use crate::{
    Direction, Incidence, Jones, Side,
    models::Common,
    optics::film::{Fields, Films, Wave},
};

/// A film stack with the optical contrast of its interfaces.
pub(super) struct Interfaces {
    films: Films,
    contrasts: Vec<Contrast>,
    detector: Detector,
    /// σ(π/λ²)√n_d.
    scale: f64,
    turned_over: bool,
}

struct Contrast {
    /// ε₊ − ε₋.
    difference: Complex64,
    /// 1/(ε₋ε₊).
    inverse_product: Complex64,
}

#[derive(Clone, Copy)]
struct Detector {
    from: Wave,
    /// n_d.
    index: f64,
    /// σ.
    sign: f64,
}

/// The source's fields at one interface times what does not depend on the direction.
#[derive(Clone, Copy)]
struct Drive {
    e: Complex64,
    w: Complex64,
    d: Complex64,
}

impl Interfaces {
    /// The interfaces of `films`, (index, thickness µm) with the one next to the substrate first.
    pub(super) fn new(common: &Common, films: &[(Complex64, f64)]) -> Self {
        let turned_over = common.side.from_below();
        let transmits = matches!(common.side, Side::DownDown | Side::UpUp);
        let (films, substrate, lambda) = if turned_over {
            let n = common.substrate.re;
            let films = films.iter().rev().map(|&(index, t)| (index / n, t)).collect();
            (films, Complex64::from(1.0 / n), common.lambda / n)
        } else {
            (films.to_vec(), common.substrate, common.lambda)
        };
        let detector = if transmits {
            Detector { from: Wave::FromSubstrate, index: substrate.re, sign: 1.0 }
        } else {
            Detector { from: Wave::FromOutside, index: 1.0, sign: -1.0 }
        };
        Self {
            contrasts: contrasts(substrate, &films),
            films: Films::new(&films, Complex64::ONE, substrate, lambda),
            detector,
            scale: detector.sign * PI / (lambda * lambda) * detector.index.sqrt(),
            turned_over,
        }
    }

    /// The number of interfaces: one more than films.
    pub(super) fn len(&self) -> usize {
        self.contrasts.len()
    }

    /// Calls `each` with the position of every direction and the amplitudes per √PSD of all
    /// interfaces, that of the substrate first.
    pub(super) fn amplitudes(
        &self,
        incidence: &Incidence,
        directions: &[Direction],
        mut each: impl FnMut(usize, &[Jones]),
    ) {
        let mut fields = vec![Fields::default(); self.len()];
        let drives = self.drives(incidence, &mut fields);
        let mut jones = vec![Jones::default(); self.len()];
        for (place, direction) in directions.iter().enumerate() {
            let kappa = Complex64::from(self.detector.index * direction.sin);
            self.films.fields_at_interfaces(self.detector.from, kappa, &mut fields);
            let pairs = drives.iter().zip(&fields);
            if self.turned_over {
                for (j, (drive, field)) in jones.iter_mut().rev().zip(pairs) {
                    *j = drive.scatter(field, direction, self.detector).flipped();
                }
            } else {
                for (j, (drive, field)) in jones.iter_mut().zip(pairs) {
                    *j = drive.scatter(field, direction, self.detector);
                }
            }
            each(place, &jones);
        }
    }

    fn drives(&self, incidence: &Incidence, fields: &mut [Fields]) -> Vec<Drive> {
        self.films.fields_at_interfaces(Wave::FromOutside, incidence.sin.into(), fields);
        let scale = self.scale / incidence.cos.sqrt();
        let drive = |(field, contrast): (&Fields, &Contrast)| {
            let c = contrast.difference * scale;
            Drive {
                e: c * field.e,
                w: c * field.w,
                d: c * field.u * incidence.sin * contrast.inverse_product,
            }
        };
        fields.iter().zip(&self.contrasts).map(drive).collect()
    }
}

/// The contrasts from the substrate outwards.
fn contrasts(substrate: Complex64, films: &[(Complex64, f64)]) -> Vec<Contrast> {
    let inside = films.iter().map(|&(index, _)| index);
    let mut below = substrate * substrate;
    let mut all = Vec::with_capacity(films.len() + 1);
    for index in inside.chain([Complex64::ONE]) {
        let above = index * index;
        all.push(Contrast { difference: above - below, inverse_product: 1.0 / (above * below) });
        below = above;
    }
    all
}

impl Drive {
    fn scatter(&self, seen: &Fields, direction: &Direction, detector: Detector) -> Jones {
        let Detector { index, sign, .. } = detector;
        let scale = 1.0 / direction.cos.sqrt();
        let (c, s) = (direction.cos_phi * scale, direction.sin_phi * scale);
        let w = seen.w * (sign * index);
        let d = seen.u * (index * index * direction.sin * scale);
        Jones {
            ss: self.e * seen.e * c,
            ps: self.w * seen.e * -s,
            sp: self.e * w * s,
            pp: self.d * d + self.w * w * c,
        }
    }
}
