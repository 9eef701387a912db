//! The BRDF models, one file each, and the one way to ask them.

use glam::DVec3;
use num_complex::Complex64;

use crate::{
    Basis, Direction, Geometry, Incidence, Jones, Mode, Mueller, ParameterError, ParameterNode,
    Side,
    geometry::beams,
    polarization::{DirectionWeights, SignedWeights, change_basis},
    spec::{self, Family, Member, Parameter, Spec, range},
};

mod batch;
pub mod coating;
pub mod diffuse;
pub mod facet;
pub mod grating;
pub mod instrument;
pub mod particle;
pub mod roughness;
pub mod sum;

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
    /// Who integrates over directions would else miss narrow ones; rims may be approximate.
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
fn sum_of(
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

/// True if all directions are above the horizon; without a jump for each.
fn all_above(directions: &[Direction]) -> bool {
    directions.iter().fold(true, |above, to| above & to.is_above())
}

/// A cone of directions with a sharp rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LobeSupport {
    /// The unit vector of its middle, as seen from its side of the surface.
    pub axis: DVec3,
    /// Its half angle, radians.
    pub half_angle: f64,
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
    Parameter::number("lambda", "0.532", "um", "Vacuum wavelength"),
    Parameter::index("substrate", "(4.05,0.05)", "Index of the substrate"),
    Parameter::integer(
        "type",
        "0",
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

/// The groups of models, in the order they are listed to users.
const GROUPS: &[&[&Spec<dyn Brdf>]] = &[
    diffuse::ALL,
    facet::ALL,
    coating::ALL,
    sum::ALL,
    roughness::ALL,
    particle::ALL,
    grating::ALL,
    instrument::ALL,
];

/// All models, in the order they are listed to users.
pub fn all() -> impl Iterator<Item = &'static Spec<dyn Brdf>> {
    GROUPS.iter().flat_map(|group| group.iter().copied())
}

/// Finds a model by its name in a program.
pub fn find(name: &str) -> Option<&'static Spec<dyn Brdf>> {
    all().find(|spec| spec.class.name == name)
}

impl Member for dyn Brdf {
    const FAMILY: Family = Family::Brdf;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(all())
    }
}

/// Builds the model that `node` describes.
///
/// # Errors
///
/// What its parameters get wrong.
pub fn build(node: &ParameterNode) -> Result<Model, ParameterError> {
    if node.mode == Mode::Sound {
        range::check(node, node.number("lambda"))?;
    }
    Ok(Model::new(spec::build::<dyn Brdf>(node)?, node.mode))
}

/// The model `name` inside `node`, which must see the light of its parent on the same substrate.
///
/// # Errors
///
/// What its parameters get wrong, and a wavelength, type or substrate that is not the parent's.
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
