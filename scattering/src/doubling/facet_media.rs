//! One reflection or refraction at the facets between two media.
//!
//! For light of one side, k_i → k_o, with the facet's normal n̂ and m = n_t/n_i,
//!
//! $$ f_R = \frac{M_R\,S}{4n_z^4\mu_i\mu_o(1+\Lambda_i+\Lambda_o)}, \qquad
//!    f_T = \frac{M_T\,S\,|c_ic_t|\,m^2\,B(1+\Lambda_i,1+\Lambda_t)}
//!    {n_z^4\mu_i\mu_t\,|k_i-mk_t|^2} $$
//!
//! c the cosines at the facet.
//!
//! K. E. Torrance and E. M. Sparrow, J. Opt. Soc. Am. 57, 1105 (1967); B. Walter et al., Proc. EGSR
//! (2007); M. I. Sancer, IEEE Trans. Antennas Propag. AP-17, 577 (1969).

use glam::DVec3;

use super::{
    azimuth,
    block::{Stokes4, TransferBlock},
    facet::{PolarizedRay, mueller, scaled},
    interface::SmoothFace,
    nodes::MediumDirections,
    operator::LayerOperator,
    slopes::{GaussianSlopes, beta},
};

/// Azimuths of the kernels.
const AZIMUTHS: usize = 96;

/// A face between two media with the directions in them.
pub(super) struct FacetMedia<'a> {
    pub(super) films: &'a SmoothFace,
    pub(super) slopes: GaussianSlopes,
    /// Above, below.
    pub(super) sides: [&'a MediumDirections; 2],
}

impl FacetMedia<'_> {
    /// Operators of one bounce.
    pub(super) fn one_bounce(&self, last: usize) -> Vec<LayerOperator> {
        let counts = self.sides.map(MediumDirections::len);
        let reflected = |side: usize| {
            let own = self.sides[side];
            azimuth::modes((counts[side], counts[side]), last, AZIMUTHS, |i, j, turn| {
                let (into, out) =
                    (self.ray(side, j, false, (1.0, 0.0)), self.ray(side, i, true, turn));
                let m = self.reflection(side, &into, &out);
                scaled(m, std::f64::consts::TAU * own.root_flux(i) * own.root_flux(j))
            })
        };
        let crossed = azimuth::modes((counts[1], counts[0]), last, AZIMUTHS, |i, j, turn| {
            let (into, out) = (self.ray(0, j, false, (1.0, 0.0)), self.ray(1, i, true, turn));
            let [a, b] = self.sides;
            let m = self.refraction(&into, &out);
            let factor = std::f64::consts::TAU * a.n / b.n;
            scaled(m, factor * b.root_flux(i) * a.root_flux(j))
        });
        let operators = reflected(0).into_iter().zip(crossed).zip(reflected(1));
        operators
            .map(|((r_down, t_down), r_up)| LayerOperator {
                t_up: TransferBlock::Mode(1).reversed(&t_down),
                r_down,
                t_down,
                r_up,
            })
            .collect()
    }

    /// The ray of a node that comes to the face from its side (or leaves it for that side).
    pub(super) fn ray(
        &self,
        side: usize,
        node: usize,
        leaves: bool,
        turn: (f64, f64),
    ) -> PolarizedRay {
        let mu = self.sides[side].mu[node];
        let comes_down = side == 0;
        let u = match (comes_down, leaves) {
            (true, false) | (false, true) => -mu,
            (true, true) | (false, false) => mu,
        };
        PolarizedRay::new(u, turn)
    }

    /// Coefficients of light from `side` that meets a facet at the cosine `cos`.
    pub(super) fn coefficients(&self, side: usize, cos: f64) -> [[num_complex::Complex64; 2]; 2] {
        let [a, b] = self.sides.map(|side| side.n);
        let cos = cos.min(1.0);
        if side == 0 {
            self.films.facet(cos, a, b.into())
        } else {
            self.films.facet_from_below(cos, a, b)
        }
    }

    /// f_R, 1/sr.
    fn reflection(&self, side: usize, into: &PolarizedRay, out: &PolarizedRay) -> Stokes4 {
        let half = out.k - into.k;
        let size = half.length();
        let normal = half / size * half.z.signum();
        let density = self.slopes.density(normal);
        if !(density > 0.0) {
            return [[0.0; 4]; 4];
        }
        let (mu_i, mu_o) = (into.k.z.abs(), out.k.z.abs());
        let lambda = |mu: f64| self.slopes.lambda(mu);
        let seen = 1.0 / (1.0 + lambda(mu_i) + lambda(mu_o));
        let [r, _] = self.coefficients(side, into.k.dot(normal).abs());
        scaled(mueller(into, out, normal, r), 0.25 * density * seen / (mu_i * mu_o))
    }

    /// f_T from above to below, 1/sr.
    fn refraction(&self, into: &PolarizedRay, out: &PolarizedRay) -> Stokes4 {
        let Some((normal, c_i, factor)) = self.refracting(0, into, out) else {
            return [[0.0; 4]; 4];
        };
        let (mu_i, mu_t) = (into.k.z.abs(), out.k.z.abs());
        let lambda = |mu: f64| self.slopes.lambda(mu);
        let seen = beta(lambda(mu_i), lambda(mu_t));
        let [_, t] = self.coefficients(0, c_i);
        scaled(mueller(into, out, normal, t), factor * seen / (mu_i * mu_t))
    }

    /// The facet that refracts `into` of `side` into `out`: its normal (n_z > 0), |c_i|, and
    /// S |c_i c_t| m²/(n_z⁴ |k_i − m k_t|²).
    pub(super) fn refracting(
        &self,
        side: usize,
        into: &PolarizedRay,
        out: &PolarizedRay,
    ) -> Option<(DVec3, f64, f64)> {
        let m = self.sides[1 - side].n / self.sides[side].n;
        let v = into.k - out.k * m;
        let size2 = v.length_squared();
        if size2 < 1e-24 || v.z == 0.0 {
            return None;
        }
        let normal = v / size2.sqrt() * v.z.signum();
        let (c_i, c_t) = (into.k.dot(normal), out.k.dot(normal));
        // Both rays cross the facet in one sense, from the side they come from.
        let sense = if side == 0 { -1.0 } else { 1.0 };
        if c_i * sense <= 0.0 || c_t * sense <= 0.0 {
            return None;
        }
        let density = self.slopes.density(normal);
        if !(density > 0.0) {
            return None;
        }
        Some((normal, c_i.abs(), density * (c_i * c_t).abs() * m * m / size2))
    }
}
