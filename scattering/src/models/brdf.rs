//! The interface of BRDF models, and the parameters that all of them have.

use glam::DVec3;
use num_complex::Complex64;

use crate::{
    Basis, Direction, Incidence, Jones, Mueller, Side,
    polarization::SignedWeights,
    spec::{self, Family, Parameter, ParameterError, ParameterNode},
};

/// The family of BRDF models.
pub static FAMILY: Family = Family::new("BRDF_Model", "BRDF models", spec::classes::<dyn Brdf>)
    .with_abstract(&[
        ("Roughness_BRDF_Model", "BRDF_Model"),
        ("Local_BRDF_Model", "BRDF_Model"),
        ("Instrument_BRDF_Model", "BRDF_Model"),
    ]);

/// A prepared model of scattering from a surface.
///
/// Everything that depends on parameters alone was computed when it was built.
pub trait Brdf: Send + Sync {
    /// Parameters of every model: wavelength, substrate, side.
    fn common(&self) -> &CommonParameters;

    /// Mueller BRDF (1/sr) in the model's own basis.
    ///
    /// Called only for |θ_i| < π/2 and |θ_s| < π/2.
    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller;

    /// The same for many directions of one beam; `out` has the length of `directions`.
    ///
    /// Overridden where a batch can share work; the numbers do not change by it.
    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        for (m, direction) in out.iter_mut().zip(directions) {
            *m = self.mueller(incidence, direction);
        }
    }

    /// Σ w R(β)ᵀ M over directions of one beam; `weights` has the length of `directions`.
    ///
    /// Overridden where the matrices of a sum need not be written; a sum in another order differs
    /// by its rounding.
    fn sum(
        &self,
        incidence: &Incidence,
        directions: &[Direction],
        weights: SignedWeights<'_>,
    ) -> Mueller {
        sum_of(directions, weights, |directions, out| {
            self.mueller_batch(incidence, directions, out);
        })
    }

    /// Jones matrix J with M(J) the BRDF, for models that do not depolarize.
    fn jones(&self, _: &Incidence, _: &Direction) -> Option<Jones> {
        None
    }

    /// Cones with sharp rims into which light of one beam goes, such as the orders of a grating.
    ///
    /// Integrators start there, so that narrow lobes are not missed; rims may be approximate.
    fn lobe_supports(&self, _: &Incidence) -> Vec<LobeSupport> {
        Vec::new()
    }

    /// True if [`Brdf::jones`] answers.
    fn is_coherent(&self) -> bool {
        false
    }

    /// True if a matrix takes less time than to find it where it was kept.
    fn is_quick(&self) -> bool {
        false
    }

    /// The basis of the model's own matrices.
    fn native_basis(&self) -> Basis {
        Basis::Psps
    }
}

/// Directions that are evaluated at a time in a sum; their matrices stay in the fastest cache.
pub(crate) const BATCH: usize = 128;

/// Σ w R(β)ᵀ M of the matrices that `evaluate` gives for parts of the directions.
pub(crate) fn sum_of(
    directions: &[Direction],
    weights: SignedWeights<'_>,
    evaluate: impl Fn(&[Direction], &mut [Mueller]),
) -> Mueller {
    let mut sum = Mueller::ZERO;
    let mut matrices = [Mueller::ZERO; BATCH];
    for (number, directions) in directions.chunks(BATCH).enumerate() {
        let matrices = &mut matrices[..directions.len()];
        evaluate(directions, matrices);
        for (k, m) in matrices.iter().enumerate() {
            weights.add(number * BATCH + k, m, &mut sum);
        }
    }
    sum
}

/// A cone of directions with a sharp rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LobeSupport {
    /// The unit vector of its middle, as seen from its side of the surface.
    pub axis: DVec3,
    /// Its half angle, radians.
    pub half_angle: f64,
}

impl LobeSupport {
    /// The cone behind a face, seen from inside of a medium of the relative index `index`, as it is
    /// outside: its rim is not a circle any more. None if it is reflected totally.
    pub(crate) fn refracted(self, index: f64) -> Option<Self> {
        let (x, y) = (index * self.axis.x, index * self.axis.y);
        let cos = (1.0 - x * x - y * y).sqrt();
        let half_angle = self.half_angle * index * self.axis.z / cos;
        (half_angle < 1.0).then(|| Self { axis: DVec3::new(x, y, cos), half_angle })
    }
}

/// Parameters of every model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommonParameters {
    /// Vacuum wavelength, µm.
    pub lambda: f64,
    /// Index of the substrate at that wavelength.
    pub substrate: Complex64,
    /// Sides of the incident and of the scattered light.
    pub side: Side,
}

/// The parameters of [`CommonParameters`]: the first group of every model.
pub const COMMON: &[Parameter] = &[
    Parameter::number("lambda", 0.532, "um", "Vacuum wavelength"),
    Parameter::index("substrate", (4.05, 0.05), "Index of the substrate"),
    Parameter::integer(
        "type",
        0,
        "0 reflection, 1 transmission into, 2 reflection inside, 3 transmission out of the substrate",
    ),
];

impl CommonParameters {
    /// Reads the common parameters of `node`.
    ///
    /// # Errors
    ///
    /// For a wavelength that is not positive, a type outside 0–3, and an absorbing substrate
    /// with a type other than 0.
    pub fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let lambda = node.number("lambda");
        if !(lambda > 0.0 && lambda.is_finite()) {
            return Err(ParameterError::new("lambda", format!("{lambda} um is not a wavelength")));
        }
        let number = node.integer("type");
        let side = Side::from_type(number)
            .ok_or_else(|| ParameterError::new("type", format!("{number} is not 0, 1, 2 or 3")))?;
        let substrate = node.index("substrate").at(lambda);
        if side != Side::DownUp && substrate.im != 0.0 {
            return Err(ParameterError::new(
                "substrate",
                format!("an absorbing substrate (k = {}) has no type {number}", substrate.im),
            ));
        }
        Ok(Self { lambda, substrate, side })
    }

    /// An error unless the model reflects from outside.
    ///
    /// # Errors
    ///
    /// For every type but 0.
    pub fn only_reflection(&self, class: &str) -> Result<(), ParameterError> {
        if self.side == Side::DownUp {
            return Ok(());
        }
        let problem = format!("{class} has type 0 only, not {}", self.side.number());
        Err(ParameterError::new("type", problem))
    }
}

/// The model `name` inside `node`, which must see the light of its parent on the same substrate.
///
/// # Errors
///
/// Invalid parameters of the model, and a wavelength, type or substrate that is not the parent's.
pub fn nested(
    node: &ParameterNode,
    name: &str,
    parent: &CommonParameters,
) -> Result<Box<dyn Brdf>, ParameterError> {
    let brdf = node.member::<dyn Brdf>(name)?;
    let CommonParameters { lambda, substrate, side } = *brdf.common();
    let differs = |parameter: &str, own: String, parents: String| {
        let problem = format!("{own} is not {parents}, that of the model around it");
        Err(ParameterError::new(&format!("{name}.{parameter}"), problem))
    };
    if lambda != parent.lambda {
        return differs("lambda", format!("{lambda} um"), format!("{} um", parent.lambda));
    }
    if substrate != parent.substrate {
        return differs("substrate", substrate.to_string(), parent.substrate.to_string());
    }
    if side != parent.side {
        return differs("type", side.number().to_string(), parent.side.number().to_string());
    }
    Ok(brdf)
}
