//! Flakes in a binder: shadowed facets that reflect, with films that transmit to the body below.
//!
//! If `substrate` has the index of the binder, a flake consists of its films alone and transmits the
//! light that it neither reflects nor absorbs. With any other substrate a flake is an opaque core
//! with films on it. The thicknesses of the films of different flakes differ by a common factor of
//! the relative standard deviation `flake_spread`; intensities are averaged over it (Gauss–Hermite
//! quadrature with five nodes).
//!
//! The absorption of flakes is that of flakes that lie flat. The transmitted light is the rest, after
//! absorption and the reflection by tilted flakes. Light that goes from one flake to another counts as
//! transmitted.

use num_complex::Complex64;

use super::{
    body::nonnegative,
    directional_albedo::{DirectionalAlbedo, ErrorSign},
    interface::{InterfaceRay, RoughnessParameters, facets},
    transmission::TransmissionFactors,
};
use crate::{
    Direction, Incidence, Mueller, ParameterError, ParameterNode,
    models::{Brdf, CommonParameters},
    optics::film::Films,
    slope::SlopeDistribution,
    spec,
    stack::Stack,
};

/// Nodes and weights of the average over a normal distribution.
const NORMAL: [(f64, f64); 5] = [
    (0.0, 8.0 / 15.0),
    (1.355_626_179_974_266, 0.222_075_922_005_612_6),
    (-1.355_626_179_974_266, 0.222_075_922_005_612_6),
    (2.856_970_013_872_806, 0.011_257_411_327_720_69),
    (-2.856_970_013_872_806, 0.011_257_411_327_720_69),
];

/// Indices that differ by less count as equal.
const SAME: f64 = 1e-12;

/// The flakes of a coating, for light inside the binder.
pub(super) struct Flakes {
    /// Facets of one thickness, with their share.
    kinds: Vec<(Box<dyn Brdf>, Films, f64)>,
    transparent: bool,
    tables: Option<FlakeTables>,
}

/// Light of a beam that flakes return.
struct FlakeTables {
    /// Directional albedo, minus that of flat flakes.
    returned: DirectionalAlbedo,
    /// The same for light that the surface above reflects back to them.
    caught: DirectionalAlbedo,
}

/// Reflection and transmission of diffuse light at flakes, s and p.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FlakeFractions {
    /// Reflected.
    pub(super) returned: (f64, f64),
    /// Reflected by the flakes and reflected back by the surface.
    pub(super) caught: (f64, f64),
    /// Transmitted.
    pub(super) passed: (f64, f64),
}

impl Flakes {
    /// The flakes of `node` in a binder of index `binder`.
    pub(super) fn read(
        node: &ParameterNode,
        common: &CommonParameters,
        binder: Complex64,
    ) -> Result<Self, ParameterError> {
        let spread = nonnegative(node, "flake_spread")?;
        if spread >= 1.0 / 3.0 {
            let problem =
                format!("{spread} leaves flakes without thickness; below 1/3 is possible");
            return Err(ParameterError::new("flake_spread", problem));
        }
        let stack = node.member::<Stack>("stack")?.at(common.lambda);
        let transparent = (common.substrate / binder - 1.0).norm() < SAME;
        let core = if transparent { Complex64::ONE } else { common.substrate / binder.re };
        let lambda = common.lambda / binder.re;
        let roughness =
            RoughnessParameters { slopes: node.child("sdf"), shadow: node.child("flake_shadow") };
        let kind = |factor: f64, weight: f64| {
            let films: Vec<_> =
                stack.iter().map(|&(index, t)| (index / binder.re, t * factor)).collect();
            let node = facets(core, &films, lambda, &roughness)?;
            let brdf = spec::build::<dyn Brdf>(&node).map_err(rename)?;
            Ok((brdf, Films::new(&films, Complex64::ONE, core, lambda), weight))
        };
        let kinds = if spread == 0.0 || stack.is_empty() {
            vec![kind(1.0, 1.0)?]
        } else {
            NORMAL.iter().map(|&(x, w)| kind(1.0 + spread * x, w)).collect::<Result<_, _>>()?
        };
        Ok(Self { kinds, transparent, tables: None })
    }

    /// Tabulates the directional albedo. The surface above has the given `internal_reflectance`;
    /// from the sine `edge` on it reflects totally.
    pub(super) fn tabulate(
        &mut self,
        node: &ParameterNode,
        internal_reflectance: &dyn Fn(&InterfaceRay) -> TransmissionFactors,
        edge: f64,
    ) -> Result<(), ParameterError> {
        let slopes = node.member::<dyn SlopeDistribution>("sdf")?;
        let rows = |at: &Incidence, to: &Direction| {
            let up = self.mueller(at, to);
            let back = internal_reflectance(&InterfaceRay::reversed(at, to)).row();
            let caught = std::array::from_fn(|j| back[0] * up.0[0][j] + back[1] * up.0[1][j]);
            [up.0[0], caught]
        };
        let flat = |sin: f64| [self.flat(sin).row(), [0.0; 4]];
        let safe = [ErrorSign::Large, ErrorSign::Small];
        let [returned, caught] =
            DirectionalAlbedo::tabulate(&*slopes, &rows, &flat, (Some(edge), safe));
        self.tables = Some(FlakeTables { returned, caught });
        Ok(())
    }

    /// True if the flakes transmit light.
    pub(super) fn are_transparent(&self) -> bool {
        self.transparent
    }

    /// The BRDF of a complete layer of flakes.
    pub(super) fn mueller(&self, at: &Incidence, to: &Direction) -> Mueller {
        let mut sum = Mueller::ZERO;
        for (brdf, _, weight) in &self.kinds {
            sum += brdf.mueller(at, to) * *weight;
        }
        sum
    }

    /// (returned, caught): rows of a ray above the flakes.
    pub(super) fn rows(&self, ray: &InterfaceRay) -> ([f64; 4], [f64; 4]) {
        let Some(tables) = &self.tables else { return ([0.0; 4], [0.0; 4]) };
        let (theta, (cos, sin)) = (ray.sin.min(1.0).asin(), ray.turn);
        let flat = self.flat(ray.sin).row();
        let mut returned = tables.returned.at(theta, cos, sin);
        for (x, f) in returned.iter_mut().zip(flat) {
            *x += f;
        }
        (returned, tables.caught.at(theta, cos, sin))
    }

    /// The fractions of a ray with this sine, the mean over azimuths.
    pub(super) fn fractions(&self, sin: f64) -> FlakeFractions {
        let Some(tables) = &self.tables else { return FlakeFractions::default() };
        let theta = sin.min(1.0).asin();
        let flat = self.flat(sin);
        let more = tables.returned.mean(theta);
        let part =
            |of: [f64; 4]| ((of[0] + of[1]).clamp(0.0, 1.0), (of[0] - of[1]).clamp(0.0, 1.0));
        let returned = part([flat.row()[0] + more[0], flat.row()[1] + more[1], 0.0, 0.0]);
        let passed = if self.transparent {
            let (s, p) = self.absorbed(sin);
            ((1.0 - s - returned.0).max(0.0), (1.0 - p - returned.1).max(0.0))
        } else {
            (0.0, 0.0)
        };
        FlakeFractions { returned, caught: part(tables.caught.mean(theta)), passed }
    }

    /// Fractions of s and p that flat transparent flakes absorb.
    pub(super) fn absorbed(&self, sin: f64) -> (f64, f64) {
        let (r, t) = (self.flat(sin), self.mean(|films| films.t12(sin.into())));
        ((1.0 - r.s - t.s).max(0.0), (1.0 - r.p - t.p).max(0.0))
    }

    /// Reflectance of flat flakes.
    fn flat(&self, sin: f64) -> TransmissionFactors {
        self.mean(|films| films.r12(sin.into()))
    }

    fn mean(
        &self,
        of: impl Fn(&Films) -> crate::optics::film::SpAmplitudes,
    ) -> TransmissionFactors {
        self.kinds.iter().fold(TransmissionFactors::NONE, |sum, (_, films, weight)| {
            sum.plus(TransmissionFactors::of(of(films), *weight))
        })
    }
}

/// `error` with the name that a parameter of the flakes has in the coating.
fn rename(error: ParameterError) -> ParameterError {
    let parameter = match error.parameter.strip_prefix("shadow") {
        Some(rest) => format!("flake_shadow{rest}"),
        None => error.parameter,
    };
    ParameterError { parameter, problem: error.problem }
}
