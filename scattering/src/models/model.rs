//! Prepared models as their users see them: with the horizon and the polarization bases.

use super::brdf::{Brdf, CommonParameters, LobeSupport, sum_of};
use crate::{
    Basis, Direction, Geometry, Incidence, Jones, Mode, Mueller,
    geometry::beams,
    interrupt,
    polarization::{DirectionWeights, change_basis, change_jones_basis},
    spec::{self, ParameterError, ParameterNode, range},
};

/// Builds the model that `node` describes.
///
/// # Errors
///
/// Invalid parameters of the model.
pub fn build(node: &ParameterNode) -> Result<Model, ParameterError> {
    if node.mode == Mode::Sound {
        range::check(node, node.number("lambda"))?;
    }
    Ok(Model::new(spec::build::<dyn Brdf>(node)?, node.mode))
}

/// True if all directions are above the horizon; without a jump for each.
fn all_above(directions: &[Direction]) -> bool {
    directions.iter().fold(true, |above, to| above & to.is_above())
}

/// A prepared model with the horizon and the bases: what users of models hold.
pub struct Model {
    brdf: Box<dyn Brdf>,
    /// Change of bases.
    mode: Mode,
}

impl Model {
    /// The model `brdf`, which was built in `mode`.
    pub fn new(brdf: Box<dyn Brdf>, mode: Mode) -> Self {
        Self { brdf, mode }
    }

    /// Parameters of every model.
    pub fn common(&self) -> &CommonParameters {
        self.brdf.common()
    }

    /// True if a matrix takes less time than to find it where it was kept.
    pub fn is_quick(&self) -> bool {
        self.brdf.is_quick()
    }

    /// Cones with sharp rims into which light of one beam goes; none at and below the horizon.
    pub fn lobe_supports(&self, incidence: &Incidence) -> Vec<LobeSupport> {
        if incidence.is_above() { self.brdf.lobe_supports(incidence) } else { Vec::new() }
    }

    /// Mueller BRDF (1/sr) for one geometry; zero at and below the horizon of either beam.
    pub fn mueller(&self, at: &Geometry, basis: Basis) -> Mueller {
        let mut out = [Mueller::ZERO];
        self.evaluate(&at.incidence(), &[at.direction()], basis, &mut out);
        out[0]
    }

    /// Mueller BRDFs (1/sr) for one beam and many directions; zero at and below the horizon.
    ///
    /// # Panics
    ///
    /// If `out` has another length than `directions`.
    pub fn evaluate(
        &self,
        incidence: &Incidence,
        directions: &[Direction],
        basis: Basis,
        out: &mut [Mueller],
    ) {
        assert_eq!(directions.len(), out.len(), "one matrix per direction");
        interrupt::check();
        if !incidence.is_above() {
            out.fill(Mueller::ZERO);
            return;
        }
        if all_above(directions) {
            self.brdf.mueller_batch(incidence, directions, out);
        } else {
            for (m, d) in out.iter_mut().zip(directions) {
                *m = if d.is_above() { self.brdf.mueller(incidence, d) } else { Mueller::ZERO };
            }
        }
        self.convert(incidence, directions, basis, out);
    }

    /// True if [`Model::jones`] answers: the model does not depolarize.
    pub fn is_coherent(&self) -> bool {
        self.brdf.is_coherent()
    }

    /// Jones matrix (sr^-1/2) whose Mueller matrix is the BRDF, for one beam and one direction; zero
    /// at and below the horizon, none if the model depolarizes.
    pub fn jones(
        &self,
        incidence: &Incidence,
        direction: &Direction,
        basis: Basis,
    ) -> Option<Jones> {
        interrupt::check();
        if !(incidence.is_above() && direction.is_above()) {
            return self.is_coherent().then(Jones::default);
        }
        let jones = self.brdf.jones(incidence, direction)?;
        let beams = beams(self.common().side, incidence, direction, self.mode);
        Some(change_jones_basis(jones, self.brdf.native_basis(), basis, &beams))
    }

    /// Σ w R(β)ᵀ M over many directions of one beam, in the units of the BRDF (1/sr) times those of
    /// the weights; nothing comes from and goes to directions at and below the horizon.
    ///
    /// # Panics
    ///
    /// If there is another number of weights than of directions.
    pub fn sum(
        &self,
        incidence: &Incidence,
        directions: &[Direction],
        weights: &DirectionWeights,
        basis: Basis,
    ) -> Mueller {
        assert_eq!(directions.len(), weights.count(), "one weight per direction");
        interrupt::check();
        let weights = weights.signed(self.turn_sign());
        let is_above = incidence.is_above() && all_above(directions);
        if is_above && self.brdf.native_basis() == basis {
            return self.brdf.sum(incidence, directions, weights);
        }
        sum_of(directions, weights, |directions, out| {
            self.evaluate(incidence, directions, basis, out);
        })
    }

    /// −1 for light that leaves downwards, where an aperture's sensitivity turns the other way,
    /// otherwise 1.
    pub fn turn_sign(&self) -> f64 {
        if self.common().side.to_below() { -1.0 } else { 1.0 }
    }

    fn convert(&self, inc: &Incidence, directions: &[Direction], to: Basis, out: &mut [Mueller]) {
        let from = self.brdf.native_basis();
        if from == to {
            return;
        }
        let side = self.common().side;
        for (m, d) in out.iter_mut().zip(directions) {
            *m = change_basis(*m, from, to, &beams(side, inc, d, self.mode));
        }
    }
}
