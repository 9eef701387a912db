//! First-order amplitudes of every interface of a film stack.
//!
//! The small displacement of an interface between permittivities ε₋ below and ε₊ above is the
//! perturbation of [`FirstOrder`] with
//!
//! $$ C = \sigma \frac{\pi}{\lambda^2} (\varepsilon_+ - \varepsilon_-), \quad
//!    \varepsilon^2 = \varepsilon_- \varepsilon_+ $$
//!
//! J. M. Elson, *Multilayer-coated optics: guided-wave coupling and scattering by means of
//! interface random roughness*, J. Opt. Soc. Am. A 12, 729 (1995), by transfer matrices.

use std::{f64::consts::PI, ops::Range};

use num_complex::Complex64;

use crate::{
    Direction, Incidence, Jones,
    models::CommonParameters,
    optics::{
        film::{IncidentSide, TangentialFields},
        first_order::{Drive, FirstOrder},
    },
};

/// A film stack with the optical contrast of its interfaces.
pub(super) struct StackContrast {
    stack: FirstOrder,
    /// In the order in which light leaves them: the last one first.
    contrasts: Vec<InterfaceContrast>,
}

struct InterfaceContrast {
    /// C.
    coupling: Complex64,
    /// 1/(ε₋ε₊).
    inverse_product: Complex64,
}

impl StackContrast {
    /// The interfaces of `films`, (index, thickness µm) with the one next to the substrate first.
    pub(super) fn new(common: &CommonParameters, films: &[(Complex64, f64)]) -> Self {
        let stack = FirstOrder::new(common.side, films, common.substrate, common.lambda);
        let mut media = vec![common.substrate];
        media.extend(films.iter().map(|&(index, _)| index));
        media.push(Complex64::ONE);
        if stack.is_turned_over() {
            media.reverse();
        }
        let scale = stack.sign() * PI / (stack.lambda() * stack.lambda());
        let contrast = |pair: &[Complex64]| {
            let [below, above] = [0, 1].map(|j| (pair[j] / stack.unit()).powi(2));
            InterfaceContrast {
                coupling: (above - below) * scale,
                inverse_product: 1.0 / (above * below),
            }
        };
        let contrasts = media.windows(2).map(contrast).collect();
        Self { stack, contrasts }
    }

    /// Every interface.
    pub(super) fn every(&self) -> Range<usize> {
        0..self.contrasts.len()
    }

    /// Calls `each` with the position of every direction and the amplitudes per √PSD of the
    /// interfaces in `which`, that of the substrate first.
    pub(super) fn amplitudes(
        &self,
        incidence: &Incidence,
        directions: &[Direction],
        which: Range<usize>,
        mut each: impl FnMut(usize, &[Jones]),
    ) {
        let count = self.contrasts.len();
        let mut fields = vec![TangentialFields::default(); count];
        let drives = self.drives(incidence, &mut fields);
        let mut jones = vec![Jones::default(); which.len()];
        for (place, direction) in directions.iter().enumerate() {
            let (from, kappa) = self.stack.kappa_out(direction);
            self.stack.films().fields_at_interfaces(from, kappa, &mut fields);
            for (jones, from_substrate) in jones.iter_mut().zip(which.clone()) {
                let turned_over = self.stack.is_turned_over();
                let m = if turned_over { count - 1 - from_substrate } else { from_substrate };
                *jones = self.stack.scatter(&drives[m], &fields[m], direction);
            }
            each(place, &jones);
        }
    }

    fn drives(&self, incidence: &Incidence, fields: &mut [TangentialFields]) -> Vec<Drive> {
        let kappa = self.stack.kappa_in(incidence);
        self.stack.films().fields_at_interfaces(IncidentSide::FromOutside, kappa, fields);
        let drive = |(field, contrast): (&TangentialFields, &InterfaceContrast)| {
            self.stack.drive(incidence, field, contrast.coupling, contrast.inverse_product)
        };
        fields.iter().zip(&self.contrasts).map(drive).collect()
    }
}
