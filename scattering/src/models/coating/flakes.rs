//! Flakes in a binder: shadowed facets that reflect, and films that transmit to what lies below.
//!
//! With `substrate` of the binder's index a flake is its films alone and what it does not reflect
//! or absorb passes; with any other substrate it is an opaque core with films on it. The films of
//! different flakes differ in thickness by a common factor of relative standard deviation
//! `flake_spread`, over which intensities are averaged (five nodes of Gauss and Hermite).
//!
//! What passes is taken for flakes that lie flat, but never more than the tilted ones leave over.

use num_complex::Complex64;

use super::{
    body::nonnegative,
    interface::{Roughness, facets},
    passage::Passage,
    returned::Returned,
};
use crate::{
    Direction, Incidence, Mueller, Node, ParamError,
    models::{Brdf, Common},
    optics::film::Films,
    slope::SlopeDistribution,
    spec,
    special::gauss,
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

/// Indices closer than this are one.
const SAME: f64 = 1e-12;

/// The flakes of a coating, for light inside the binder.
pub(super) struct Flakes {
    /// Facets of one thickness, with their share.
    kinds: Vec<(Box<dyn Brdf>, Films, f64)>,
    /// What all of them return; nothing for opaque flakes.
    returned: Option<Returned>,
}

impl Flakes {
    /// The flakes of `node` in a binder of index `binder`, where light travels at angles with
    /// sines up to `largest`.
    pub(super) fn read(
        node: &Node,
        common: &Common,
        binder: f64,
        largest: f64,
    ) -> Result<Self, ParamError> {
        let spread = nonnegative(node, "flake_spread")?;
        if spread >= 1.0 / 3.0 {
            let problem =
                format!("{spread} leaves flakes without thickness; below 1/3 is possible");
            return Err(ParamError::new("flake_spread", problem));
        }
        let stack = node.member::<Stack>("stack")?.at(common.lambda);
        let (lambda, core) = (common.lambda / binder, common.substrate / binder);
        let roughness = Roughness { slopes: node.child("sdf"), shadow: node.child("flake_shadow") };
        let kind = |factor: f64, weight: f64| {
            let films: Vec<_> =
                stack.iter().map(|&(index, t)| (index / binder, t * factor)).collect();
            let node = facets(core, &films, lambda, &roughness)?;
            let brdf = spec::build::<dyn Brdf>(&node).map_err(rename)?;
            Ok((brdf, Films::new(&films, Complex64::ONE, core, lambda), weight))
        };
        let kinds = if spread == 0.0 || stack.is_empty() {
            vec![kind(1.0, 1.0)?]
        } else {
            NORMAL.iter().map(|&(x, w)| kind(1.0 + spread * x, w)).collect::<Result<_, _>>()?
        };
        let mut flakes = Self { kinds, returned: None };
        if (core - 1.0).norm() < SAME {
            let slopes = node.member::<dyn SlopeDistribution>("sdf")?;
            let brdf = |at: &Incidence, to: &Direction| flakes.mueller(at, to);
            let flat = |sin: f64, _| flakes.mean(|films| films.r12(sin.into())).row();
            let returned = Returned::tabulate(&*slopes, &brdf, &flat, largest.asin());
            flakes.returned = Some(returned);
        }
        Ok(flakes)
    }

    /// Whether nothing passes.
    pub(super) fn are_opaque(&self) -> bool {
        self.returned.is_none()
    }

    /// The BRDF of a complete layer of flakes.
    pub(super) fn mueller(&self, at: &Incidence, to: &Direction) -> Mueller {
        let mut sum = Mueller::ZERO;
        for (brdf, _, weight) in &self.kinds {
            sum += brdf.mueller(at, to) * *weight;
        }
        sum
    }

    /// What passes of a ray with this sine and doubled azimuth, s and p alone.
    pub(super) fn passage(&self, sin: f64, turn: (f64, f64)) -> Passage {
        let Some(returned) = &self.returned else { return Passage::NONE };
        let flat = self.mean(|films| films.t12(sin.into()));
        let reflected = self.mean(|films| films.r12(sin.into()));
        let more = returned.at(sin.asin(), turn.0, turn.1);
        // No more than 1 less what comes back.
        let rest = |r: f64, more: f64| (1.0 - r - more).max(0.0);
        flat.with_intensities(
            flat.s.min(rest(reflected.s, more[0] + more[1])),
            flat.p.min(rest(reflected.p, more[0] - more[1])),
        )
    }

    /// (reflectance, transmittance) of diffuse light inside the binder.
    pub(super) fn diffuse(&self) -> (f64, f64) {
        if self.are_opaque() {
            return (0.0, 0.0);
        }
        let part = |of: &dyn Fn(&Films, Complex64) -> crate::optics::film::Pair| {
            gauss::integrate(64, 0.0, std::f64::consts::FRAC_PI_2, |t| {
                let row = self.mean(|films| of(films, t.sin().into())).row();
                row[0] * (2.0 * t).sin()
            })
        };
        (part(&|films, kappa| films.r21(kappa)), part(&|films, kappa| films.t12(kappa)))
    }

    fn mean(&self, of: impl Fn(&Films) -> crate::optics::film::Pair) -> Passage {
        self.kinds.iter().fold(Passage::NONE, |sum, (_, films, weight)| {
            sum.plus(Passage::of(of(films), *weight))
        })
    }
}

/// The names that the flakes' facets have in the coating.
fn rename(error: ParamError) -> ParamError {
    let parameter = match error.parameter.strip_prefix("shadow") {
        Some(rest) => format!("flake_shadow{rest}"),
        None => error.parameter,
    };
    ParamError { parameter, problem: error.problem }
}
