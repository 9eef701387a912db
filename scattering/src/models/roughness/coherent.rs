//! Scattering that is coherent over a range of interfaces with the same profile.
//!
//! $$ \mathbf{J} = \sqrt{\mathrm{PSD}} \sum_{m} \mathbf{J}_m $$
//!
//! with the amplitudes of [`StackContrast`].

use std::{ops::Range, slice};

use num_complex::Complex64;

use super::{RoughSurface, interfaces::StackContrast};
use crate::{
    Direction, Incidence, Jones, Mueller, ParameterError, ParameterNode,
    models::{Brdf, CommonParameters},
};

/// Interfaces of a film stack that are rough with one profile.
pub(super) struct CorrelatedInterfaces {
    rough: RoughSurface,
    interfaces: StackContrast,
    which: Range<usize>,
}

impl CorrelatedInterfaces {
    /// Of the interfaces of `films`, the substrate's first, those in `which`.
    pub(super) fn new(
        rough: RoughSurface,
        films: &[(Complex64, f64)],
        which: Range<usize>,
    ) -> Self {
        let interfaces = StackContrast::new(&rough.common, films);
        Self { rough, interfaces, which }
    }

    /// One film: its index is the parameter `film`, its thickness `thickness`.
    pub(super) fn one_film(
        node: &ParameterNode,
        which: Range<usize>,
    ) -> Result<Box<dyn Brdf>, ParameterError> {
        let rough = RoughSurface::read(node)?;
        let film = node.index("film").at(rough.common.lambda);
        let films = [(film, super::thickness(node, "thickness")?)];
        Ok(Box::new(Self::new(rough, &films, which)))
    }

    /// Calls `each` with the position of every direction and its amplitude per √PSD.
    fn amplitudes(
        &self,
        incidence: &Incidence,
        directions: &[Direction],
        mut each: impl FnMut(usize, Jones),
    ) {
        self.interfaces.amplitudes(incidence, directions, self.which.clone(), |place, jones| {
            each(place, jones.iter().fold(Jones::default(), |sum, j| sum + *j));
        });
    }
}

impl Brdf for CorrelatedInterfaces {
    fn common(&self) -> &CommonParameters {
        &self.rough.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let mut out = [Mueller::ZERO];
        self.mueller_batch(incidence, slice::from_ref(direction), &mut out);
        out[0]
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        self.amplitudes(incidence, directions, |place, jones| {
            let density = self.rough.density(incidence, &directions[place]);
            out[place] = jones.mueller() * density;
        });
    }

    fn jones(&self, incidence: &Incidence, direction: &Direction) -> Option<Jones> {
        let mut out = None;
        self.amplitudes(incidence, slice::from_ref(direction), |_, jones| {
            out = Some(jones.scaled(self.rough.density(incidence, direction).sqrt()));
        });
        out
    }

    fn is_coherent(&self) -> bool {
        true
    }
}
