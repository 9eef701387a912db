//! Fields in stacks whose films a wave passes without loss, for one angle or a batch.

use super::{
    amplitudes::IncidentSide,
    clear::passed,
    films::Films,
    layer::{FilmLayer, FilmMedium},
    root::root,
};
use crate::lanes::{Complex, Real};

impl Films {
    /// True if waves of the squared tangential index `kappa_squared` pass every film without loss
    /// and the place `depth` µm below the outer face lies in a film.
    #[inline]
    pub(crate) fn is_clear_at(&self, kappa_squared: f64, depth: f64) -> bool {
        kappa_squared <= self.clear_below && (0.0..=self.thickness).contains(&depth)
    }

    /// [`Films::fields_at_depth`] E, U and W where [`Films::is_clear_at`] holds, by the squared
    /// tangential index.
    #[inline(always)]
    pub(crate) fn clear_fields<R: Real>(
        &self,
        from: IncidentSide,
        kappa_squared: R,
        depth: f64,
    ) -> [Complex<R>; 3] {
        let (entry, exit) = self.ends(from);
        // From the exit face, positive towards the source.
        let mut distance = match from {
            IncidentSide::FromOutside => self.thickness - depth,
            IncidentSide::FromSubstrate => depth,
        };
        let y = exit.admittance_pair(kappa_squared);
        let one = Complex::real(kappa_squared.splat(1.0));
        let mut v = [[one, y[0]], [one, y[1]]];
        let mut there = None;
        let last = self.layers.len().saturating_sub(1);
        for (place, layer) in self.exit_to_entrance(from).enumerate() {
            let q = (-kappa_squared + layer.medium.epsilon.re).sqrt();
            // Rounding leaves no gap behind the last film.
            if there.is_none() && (distance <= layer.thickness || place == last) {
                let part = self.part(layer.medium, distance.min(layer.thickness));
                let inside = passed(v, &part, q);
                v = passed(inside, &FilmLayer { phase: layer.phase - part.phase, ..*layer }, q);
                there = Some(inside);
            } else {
                v = passed(v, layer, q);
            }
            distance -= layer.thickness;
        }
        let there = there.unwrap_or(v);
        let y0 = entry.admittance_pair(kappa_squared);
        let (s, p) = (amplitude(v[0], y0[0]), amplitude(v[1], y0[1]));
        [there[0][0] * s, there[1][0] * p, there[1][1] * p]
    }
}

impl FilmMedium {
    /// Y of s and p.
    #[inline(always)]
    fn admittance_pair<R: Real>(&self, kappa_squared: R) -> [Complex<R>; 2] {
        let q = root(-kappa_squared + self.epsilon.re, self.epsilon.im);
        [q, q.times(self.inverse_epsilon)]
    }
}

/// The amplitude of a wave from a medium of the admittance `y0` that arrives as `v`.
// No closure: those are compiled without the vectors of the processor.
#[inline(always)]
fn amplitude<R: Real>(v: [Complex<R>; 2], y0: Complex<R>) -> Complex<R> {
    (y0 + y0).over(v[0] * y0 + v[1])
}
