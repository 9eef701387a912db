//! Coherent reflection, transmission and fields of a stack of films between two media.
//!
//! Every quantity depends on the tangential index κ = n sin θ, which all media share. With
//! q = √(n² − κ²) (= n cos θ), a film of thickness t has the phase δ = 2πtq/λ, the admittance
//! Y = q for s and q/n² for p, and carries the vector (1, Y) of its two tangential fields by
//!
//! $$ F = \begin{pmatrix} \cos\delta & -(i/Y)\sin\delta \\ -iY\sin\delta & \cos\delta \end{pmatrix} $$
//!
//! from its far face to its near face. From the exit medium inwards, v = F…F(1, Y_t), and with
//! X = v₁Y₀ and Z = v₂
//!
//! $$ r = \frac{X-Z}{X+Z}, \quad t_s = \frac{2Y_0}{X+Z}, \quad
//!    t_p = \frac{n_0}{n_t}\frac{2Y_0}{X+Z} $$
//!
//! Where the wave fades, F is used times e^{iδ}, so that thick films do not overflow; the product
//! of these factors is put back where it matters. A wave that travels without loss has real δ and
//! Y, and its F has two real and two imaginary elements.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999), section 1.6.

mod clear;

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::{
    Jones,
    lanes::{Complex, Real, ratios},
};

const I: Complex64 = Complex64::I;
const ONE: Complex64 = Complex64::ONE;

/// The loss that NIST adds to the tangential index of light from inside the substrate.
const TINY_LOSS: f64 = 1e-10;

/// Smaller indices count as this one.
const LEAST_INDEX: f64 = 1e-6;

/// Below this phase sin δ / q is taken from its series.
const SMALL_PHASE: f64 = 1e-2;

/// A pair of amplitude coefficients.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpAmplitudes {
    /// For s.
    pub s: Complex64,
    /// For p.
    pub p: Complex64,
}

impl SpAmplitudes {
    /// The Jones matrix that is diagonal with these elements.
    pub fn jones(self) -> Jones {
        Jones::diagonal(self.s, self.p)
    }
}

/// Tangential fields at a depth, driven by a unit plane wave (E = 1 for s, H = 1 for p).
///
/// The normal displacement of p is D = κU. For a unit **electric** p wave in a medium of index n
/// multiply `u` and `w` by n.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TangentialFields {
    /// Electric field of s.
    pub e: Complex64,
    /// Magnetic field of p.
    pub u: Complex64,
    /// Tangential electric field of p.
    pub w: Complex64,
}

/// A wave that meets the stack, by the side it comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IncidentSide {
    /// From the outer medium: "12".
    FromOutside,
    /// From the substrate: "21".
    FromSubstrate,
}

/// Films between two media at one wavelength, prepared for many angles.
#[derive(Clone, Debug)]
pub struct Films {
    outer: FilmMedium,
    substrate: FilmMedium,
    /// The one next to the substrate first.
    layers: Vec<FilmLayer>,
    /// 2π/λ, 1/µm.
    wave_number: f64,
    /// That of all films, µm.
    thickness: f64,
    /// The largest κ² that passes every film without loss; negative if there is none.
    clear_below: f64,
    loss: f64,
    growing: bool,
}

#[derive(Clone, Copy, Debug)]
struct FilmMedium {
    index: Complex64,
    epsilon: Complex64,
    inverse_epsilon: Complex64,
}

#[derive(Clone, Copy, Debug)]
struct FilmLayer {
    medium: FilmMedium,
    /// 2πt/λ.
    phase: f64,
    /// t, µm.
    thickness: f64,
}

/// The two field vectors (s, p) at a face, each times a common phase factor.
#[derive(Clone, Copy)]
struct FieldVectors {
    s: [Complex64; 2],
    p: [Complex64; 2],
}

/// Boundary values of a wave at a face of the stack: X ± Z of both polarizations.
struct EntranceFields {
    y0: SpAmplitudes,
    x: SpAmplitudes,
    z: SpAmplitudes,
    /// The product of the factors of the films passed.
    phase: Complex64,
}

impl FilmMedium {
    fn new(index: Complex64) -> Self {
        // A film whose graded index passes through 0 would have no admittance.
        let index =
            if index.norm_sqr() < LEAST_INDEX * LEAST_INDEX { LEAST_INDEX.into() } else { index };
        let epsilon = index * index;
        Self { index, epsilon, inverse_epsilon: 1.0 / epsilon }
    }

    fn admittances(&self, q: Complex64) -> SpAmplitudes {
        SpAmplitudes { s: q, p: q * self.inverse_epsilon }
    }
}

impl Films {
    /// Films given as (index, thickness µm), the one next to the substrate first, between the
    /// media `outer` and `substrate`, at the vacuum wavelength `lambda` µm.
    pub fn new(
        films: &[(Complex64, f64)],
        outer: Complex64,
        substrate: Complex64,
        lambda: f64,
    ) -> Self {
        let wave_number = TAU / lambda;
        let layer = |&(index, thickness): &(Complex64, f64)| FilmLayer {
            medium: FilmMedium::new(index),
            phase: wave_number * thickness,
            thickness,
        };
        let layers: Vec<FilmLayer> = films.iter().map(layer).collect();
        let clear = |layer: &FilmLayer| {
            if layer.medium.epsilon.im == 0.0 { layer.medium.epsilon.re } else { -1.0 }
        };
        Self {
            outer: FilmMedium::new(outer),
            substrate: FilmMedium::new(substrate),
            wave_number,
            thickness: layers.iter().map(|layer| layer.thickness).sum(),
            clear_below: layers.iter().map(clear).fold(f64::INFINITY, f64::min),
            layers,
            loss: 0.0,
            growing: false,
        }
    }

    /// The same with the loss of 10⁻¹⁰ in [`Films::kappa_inside`]
    /// ([`Defect::TinyLoss`](crate::Defect::TinyLoss)).
    pub fn with_tiny_loss(mut self) -> Self {
        self.loss = TINY_LOSS;
        self
    }

    /// The same with the growing wave −i√(κ² − n²) in a transparent medium beyond the critical
    /// angle ([`Defect::RecyclingBranch`](crate::Defect::RecyclingBranch)).
    pub fn with_growing_branch(mut self) -> Self {
        self.growing = true;
        self.clear_below = -1.0;
        self
    }

    /// Index of the substrate.
    pub fn substrate(&self) -> Complex64 {
        self.substrate.index
    }

    /// Index of the outer medium.
    pub fn outer(&self) -> Complex64 {
        self.outer.index
    }

    /// The number of films.
    pub fn len(&self) -> usize {
        self.layers.len()
    }

    /// True if the interface is bare.
    pub fn is_empty(&self) -> bool {
        self.layers.is_empty()
    }

    /// Tangential index of light that travels in the substrate at an angle with this sine.
    pub fn kappa_inside(&self, sin: f64) -> Complex64 {
        let kappa = self.substrate.index * sin;
        if kappa.im == 0.0 { Complex64::new(kappa.re, -self.loss) } else { kappa }
    }

    /// Reflection of light from outside.
    pub fn r12(&self, kappa: Complex64) -> SpAmplitudes {
        self.entrance(IncidentSide::FromOutside, kappa * kappa).reflection()
    }

    /// Reflection of light from the substrate.
    pub fn r21(&self, kappa: Complex64) -> SpAmplitudes {
        self.entrance(IncidentSide::FromSubstrate, kappa * kappa).reflection()
    }

    /// Transmission of electric fields from outside into the substrate.
    pub fn t12(&self, kappa: Complex64) -> SpAmplitudes {
        let ratio = self.outer.index / self.substrate.index;
        self.entrance(IncidentSide::FromOutside, kappa * kappa).transmission(ratio)
    }

    /// Transmission of electric fields from the substrate to the outside.
    pub fn t21(&self, kappa: Complex64) -> SpAmplitudes {
        let ratio = self.substrate.index / self.outer.index;
        self.entrance(IncidentSide::FromSubstrate, kappa * kappa).transmission(ratio)
    }

    /// [`Films::r12`] for real κ ≤ n of a transparent outer medium where `q_outer` = n cos θ and
    /// κ² are known already; the shortest way for a bare interface.
    pub fn r12_known(&self, q_outer: f64, kappa_squared: f64) -> SpAmplitudes {
        if !self.layers.is_empty() {
            let q0 = Complex64::from(q_outer);
            return self
                .entrance_with(IncidentSide::FromOutside, kappa_squared.into(), q0)
                .reflection();
        }
        let [s, p] = self.bare(q_outer, kappa_squared);
        SpAmplitudes { s: s.into(), p: p.into() }
    }

    /// True if [`Films::bare`] says what this interface reflects of light from outside.
    pub(crate) fn is_bare(&self) -> bool {
        self.layers.is_empty()
    }

    /// [`Films::r12_known`] of an interface without films, for one angle or for several.
    #[inline(always)]
    pub(crate) fn bare<R: Real>(&self, q_outer: R, kappa_squared: R) -> [Complex<R>; 2] {
        let (e0, et) = (self.outer.epsilon.re, self.substrate.epsilon);
        let mut q = root(-kappa_squared + et.re, et.im);
        if self.growing && et.im == 0.0 {
            q.im = -q.im;
        }
        let outer = Complex::real(q_outer);
        let (a, b) = (Complex { re: q_outer * et.re, im: q_outer * et.im }, q * q_outer.splat(e0));
        ratios([outer - q, a - b], [outer + q, a + b])
    }

    /// Fields at every interface for a wave from the side `from` with unit amplitude where it
    /// enters the stack; element 0 of `out` is the face of the substrate, the last one that of
    /// the outer medium.
    ///
    /// # Panics
    ///
    /// If `out` does not have one element more than there are films.
    pub fn fields_at_interfaces(
        &self,
        from: IncidentSide,
        kappa: Complex64,
        out: &mut [TangentialFields],
    ) {
        assert_eq!(out.len(), self.layers.len() + 1, "one interface more than films");
        let kappa2 = kappa * kappa;
        let (entry, exit) = self.ends(from);
        let place = |passed: usize| match from {
            IncidentSide::FromOutside => passed,
            IncidentSide::FromSubstrate => self.layers.len() - passed,
        };
        let mut v = self.exit_vectors(exit, kappa2);
        out[place(0)] = v.fields();
        for (passed, layer) in self.exit_to_entrance(from).enumerate() {
            v.pass(layer, self.root(layer.medium.epsilon - kappa2));
            out[place(passed + 1)] = v.fields();
        }
        let amplitude = self.amplitude(entry, kappa2, &v);
        // The factors of the films between the entrance and the interface.
        let mut phase = ONE;
        for (passed, layer) in self.exit_to_entrance(from).enumerate().rev() {
            let here = &mut out[place(passed + 1)];
            *here = here.scaled(amplitude, phase);
            phase *= layer.factor(self.root(layer.medium.epsilon - kappa2));
        }
        out[place(0)] = out[place(0)].scaled(amplitude, phase);
    }

    /// Fields at the depth `depth` µm below the outer face, for a wave from the side `from` with
    /// unit amplitude where it enters the stack. Negative depths lie in the outer medium, depths
    /// beyond the films in the substrate.
    pub fn fields_at_depth(
        &self,
        from: IncidentSide,
        kappa: Complex64,
        depth: f64,
    ) -> TangentialFields {
        let kappa2 = kappa * kappa;
        if kappa.im == 0.0 && self.is_clear_at(kappa2.re, depth) {
            let [e, u, w] = self.clear_fields(from, kappa2.re, depth).map(Into::into);
            return TangentialFields { e, u, w };
        }
        let (entry, exit) = self.ends(from);
        // Distance from the exit face, positive towards the source.
        let distance = match from {
            IncidentSide::FromOutside => self.thickness - depth,
            IncidentSide::FromSubstrate => depth,
        };
        let mut v = self.exit_vectors(exit, kappa2);
        if distance < 0.0 {
            let q = self.root(exit.epsilon - kappa2);
            let faded = phase_factor(q, -distance * self.wave_number);
            let (at_exit, phase) = (v.fields(), self.pass_all(from, kappa2, &mut v));
            return at_exit.scaled(self.amplitude(entry, kappa2, &v), phase * faded);
        }
        let mut found = None;
        let mut left = ONE;
        let mut passed = 0.0;
        for layer in self.exit_to_entrance(from) {
            let q = self.root(layer.medium.epsilon - kappa2);
            if found.is_none() && distance <= passed + layer.thickness {
                let part = self.part(layer.medium, distance - passed);
                v.pass(&part, q);
                found = Some(v.fields());
                left = v.pass(&FilmLayer { phase: layer.phase - part.phase, ..*layer }, q);
            } else {
                let factor = v.pass(layer, q);
                if found.is_some() {
                    left *= factor;
                }
            }
            passed += layer.thickness;
        }
        let amplitude = self.amplitude(entry, kappa2, &v);
        if let Some(fields) = found {
            return fields.scaled(amplitude, left);
        }
        let part = self.part(entry, distance - passed);
        let mut outside = v;
        let gone = outside.pass(&part, self.root(entry.epsilon - kappa2));
        outside.fields().scaled(amplitude, ONE / gone)
    }

    fn part(&self, medium: FilmMedium, thickness: f64) -> FilmLayer {
        FilmLayer { medium, phase: self.wave_number * thickness, thickness }
    }

    /// (entrance medium, exit medium).
    fn ends(&self, from: IncidentSide) -> (FilmMedium, FilmMedium) {
        match from {
            IncidentSide::FromOutside => (self.outer, self.substrate),
            IncidentSide::FromSubstrate => (self.substrate, self.outer),
        }
    }

    /// The films in the order from the exit to the entrance.
    fn exit_to_entrance(
        &self,
        from: IncidentSide,
    ) -> impl DoubleEndedIterator<Item = &FilmLayer> + ExactSizeIterator {
        let last = self.layers.len();
        (0..last).map(move |j| match from {
            IncidentSide::FromOutside => &self.layers[j],
            IncidentSide::FromSubstrate => &self.layers[last - 1 - j],
        })
    }

    #[inline]
    fn exit_vectors(&self, exit: FilmMedium, kappa2: Complex64) -> FieldVectors {
        let y = exit.admittances(self.root(exit.epsilon - kappa2));
        FieldVectors { s: [ONE, y.s], p: [ONE, y.p] }
    }

    /// Carries `v` through all films and returns the product of their factors.
    fn pass_all(&self, from: IncidentSide, kappa2: Complex64, v: &mut FieldVectors) -> Complex64 {
        let mut phase = ONE;
        for layer in self.exit_to_entrance(from) {
            phase *= v.pass(layer, self.root(layer.medium.epsilon - kappa2));
        }
        phase
    }

    /// 2Y₀/(X + Z) of both polarizations for the vectors at the entrance.
    #[inline]
    fn amplitude(&self, entry: FilmMedium, kappa2: Complex64, v: &FieldVectors) -> SpAmplitudes {
        let y0 = entry.admittances(self.root(entry.epsilon - kappa2));
        let one = |y0: Complex64, [a, b]: [Complex64; 2]| {
            if y0.im == 0.0 {
                let sum = a * y0.re + b;
                return sum.conj() * (2.0 * y0.re / sum.norm_sqr());
            }
            2.0 * y0 / (a * y0 + b)
        };
        SpAmplitudes { s: one(y0.s, v.s), p: one(y0.p, v.p) }
    }

    fn entrance(&self, from: IncidentSide, kappa2: Complex64) -> EntranceFields {
        let (entry, _) = self.ends(from);
        self.entrance_with(from, kappa2, self.root(entry.epsilon - kappa2))
    }

    fn entrance_with(
        &self,
        from: IncidentSide,
        kappa2: Complex64,
        q0: Complex64,
    ) -> EntranceFields {
        let (entry, exit) = self.ends(from);
        let mut v = self.exit_vectors(exit, kappa2);
        let phase = self.pass_all(from, kappa2, &mut v);
        let y0 = entry.admittances(q0);
        EntranceFields {
            y0,
            x: SpAmplitudes { s: v.s[0] * y0.s, p: v.p[0] * y0.p },
            z: SpAmplitudes { s: v.s[1], p: v.p[1] },
            phase,
        }
    }

    /// The root of q² that propagates or decays away from the light's source: Re ≥ 0 where
    /// Re q² ≥ 0, Im > 0 elsewhere.
    fn root(&self, q2: Complex64) -> Complex64 {
        let root = decaying_root(q2);
        if self.growing && q2.im == 0.0 && q2.re < 0.0 { -root } else { root }
    }
}

impl EntranceFields {
    fn reflection(&self) -> SpAmplitudes {
        SpAmplitudes {
            s: (self.x.s - self.z.s) / (self.x.s + self.z.s),
            p: (self.x.p - self.z.p) / (self.x.p + self.z.p),
        }
    }

    fn transmission(&self, index_ratio: Complex64) -> SpAmplitudes {
        SpAmplitudes {
            s: 2.0 * self.y0.s * self.phase / (self.x.s + self.z.s),
            p: index_ratio * 2.0 * self.y0.p * self.phase / (self.x.p + self.z.p),
        }
    }
}

impl FilmLayer {
    /// True if a wave with this q travels in it without loss.
    fn is_clear(&self, q: Complex64) -> bool {
        q.im == 0.0 && self.medium.epsilon.im == 0.0
    }

    /// Factor of [`FieldVectors::pass`]: e^{iδ} where the wave decays.
    fn factor(&self, q: Complex64) -> Complex64 {
        if self.is_clear(q) { ONE } else { phase_factor(q, self.phase) }
    }
}

impl FieldVectors {
    /// Carries both vectors through `layer`, from its far to its near face, and returns the
    /// factor that they were multiplied by.
    #[inline]
    fn pass(&mut self, layer: &FilmLayer, q: Complex64) -> Complex64 {
        if layer.phase == 0.0 {
            return ONE;
        }
        if layer.is_clear(q) {
            let v = clear::passed([self.s, self.p].map(|v| v.map(Into::into)), layer, q.re);
            [self.s, self.p] = v.map(|v| v.map(Into::into));
            return ONE;
        }
        let delta = q * layer.phase;
        let factor = phase_factor(q, layer.phase);
        let double = factor * factor;
        let cos = 0.5 * (double + 1.0);
        // sin δ e^{iδ} and the same over q, which stays finite where q vanishes.
        let (sin, sin_over_q) = if delta.norm_sqr() < SMALL_PHASE * SMALL_PHASE {
            let d2 = delta * delta;
            let sinc = ONE - d2 / 6.0 * (ONE - d2 / 20.0 * (ONE - d2 / 42.0));
            (delta * sinc * factor, layer.phase * sinc * factor)
        } else {
            let sin = -0.5 * I * (double - 1.0);
            (sin, sin / q)
        };
        let FilmMedium { epsilon, inverse_epsilon, .. } = layer.medium;
        let [a, b] = self.s;
        self.s = [a * cos - I * b * sin_over_q, b * cos - I * a * q * sin];
        let [a, b] = self.p;
        self.p =
            [a * cos - I * b * epsilon * sin_over_q, b * cos - I * a * q * inverse_epsilon * sin];
        factor
    }

    fn fields(&self) -> TangentialFields {
        TangentialFields { e: self.s[0], u: self.p[0], w: self.p[1] }
    }
}

impl TangentialFields {
    #[inline]
    fn scaled(&self, amplitude: SpAmplitudes, phase: Complex64) -> Self {
        let (s, p) = (amplitude.s * phase, amplitude.p * phase);
        Self { e: self.e * s, u: self.u * p, w: self.w * p }
    }
}

/// e^{iδ} with δ = q·phase.
fn phase_factor(q: Complex64, phase: f64) -> Complex64 {
    Complex64::from_polar((-q.im * phase).exp(), q.re * phase)
}

/// The square root with Re ≥ 0 where Re z ≥ 0 and with Im > 0 where Re z < 0.
///
/// For q² = n² − κ² this is the wave that propagates or decays away from its source.
pub fn decaying_root(z: Complex64) -> Complex64 {
    root(z.re, z.im).into()
}

/// [`decaying_root`] of several numbers with one imaginary part.
#[inline(always)]
pub(crate) fn root<R: Real>(re: R, im: f64) -> Complex<R> {
    if im == 0.0 {
        let part = |x: R| (-x).select(x.splat(0.0), x).sqrt();
        return Complex { re: part(re), im: part(-re) };
    }
    let size = (re * re + im * im).sqrt();
    let large = ((size + re.abs()) * 0.5).sqrt();
    let small = re.splat(0.5 * im) / large;
    Complex { re: re.select(large, small), im: re.select(small, large) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn c(re: f64, im: f64) -> Complex64 {
        Complex64::new(re, im)
    }

    fn stack() -> Films {
        Films::new(&[(c(2.3, 0.01), 0.13), (c(1.46, 0.0), 0.2)], ONE, c(1.5, 0.0), 0.55)
    }

    fn close(a: Complex64, b: Complex64, tolerance: f64) -> bool {
        (a - b).norm() <= tolerance
    }

    #[test]
    fn glass_at_brewsters_angle_does_not_reflect_p() {
        let glass = Films::new(&[], ONE, c(1.5, 0.0), 0.55);
        let r = glass.r12(c(1.5f64.atan().sin(), 0.0));
        assert!(r.p.norm() < 1e-15);
        assert!(r.s.re < -0.3);
    }

    #[test]
    fn a_film_of_zero_thickness_changes_nothing() {
        let bare = Films::new(&[], ONE, c(1.3, 1.2), 0.55);
        let film = Films::new(&[(c(2.3, 0.0), 0.0)], ONE, c(1.3, 1.2), 0.55);
        for kappa in [0.0, 0.5, 0.99] {
            let (a, b) = (bare.r12(c(kappa, 0.0)), film.r12(c(kappa, 0.0)));
            assert!(close(a.s, b.s, 1e-15) && close(a.p, b.p, 1e-15));
        }
    }

    #[test]
    fn what_a_transparent_stack_does_not_reflect_it_transmits() {
        let films = Films::new(&[(c(2.3, 0.0), 0.13)], ONE, c(1.5, 0.0), 0.55);
        for sin in [0.0f64, 0.4, 0.95] {
            let (r, t) = (films.r12(c(sin, 0.0)), films.t12(c(sin, 0.0)));
            let ratio = (2.25 - sin * sin).sqrt() / (1.0 - sin * sin).sqrt();
            assert!((r.s.norm_sqr() + ratio * t.s.norm_sqr() - 1.0).abs() < 1e-14);
            assert!((r.p.norm_sqr() + ratio * t.p.norm_sqr() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn transmission_both_ways_differs_by_the_ratio_of_n_cos() {
        let films = stack();
        let sin = 0.6f64;
        let ratio = (2.25 - sin * sin).sqrt() / (1.0 - sin * sin).sqrt();
        let (t12, t21) = (films.t12(c(sin, 0.0)), films.t21(c(sin, 0.0)));
        assert!(close(t21.s, t12.s * ratio, 1e-14) && close(t21.p, t12.p * ratio, 1e-14));
    }

    #[test]
    fn the_known_cosine_gives_the_same_reflection() {
        let (sin, cos) = 0.7f64.sin_cos();
        for films in [stack(), Films::new(&[], ONE, c(1.3, 1.2), 0.55)] {
            let (a, b) = (films.r12(c(sin, 0.0)), films.r12_known(cos, sin * sin));
            assert!(close(a.s, b.s, 1e-15) && close(a.p, b.p, 1e-15));
        }
    }

    #[test]
    fn beyond_the_critical_angle_the_wave_outside_decays() {
        // Below the surface of glass, evanescent outside: the field half a wavelength above is
        // smaller than at the surface.
        let glass = Films::new(&[], ONE, c(1.5, 0.0), 0.55);
        let kappa = glass.kappa_inside(0.9);
        let at = |depth| glass.fields_at_depth(IncidentSide::FromSubstrate, kappa, depth).e.norm();
        assert!(at(-0.275) < 0.2 * at(0.0));
        assert!((glass.r21(kappa).s.norm() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn thick_absorbing_films_neither_overflow_nor_pass_light() {
        let films = Films::new(&[(c(1.5, 1.0), 1e4)], ONE, c(1.5, 0.0), 0.5);
        let alone = Films::new(&[], ONE, c(1.5, 1.0), 0.5);
        let kappa = c(0.3, 0.0);
        assert!(close(films.r12(kappa).p, alone.r12(kappa).p, 1e-14));
        assert_eq!(films.t12(kappa).s, c(0.0, 0.0));
    }

    #[test]
    fn a_film_in_which_light_just_grazes_is_regular() {
        // q = 0 in the film: the limit of its neighbours.
        let films = Films::new(&[(c(0.5, 0.0), 0.1)], ONE, c(1.5, 0.0), 0.55);
        let (at, near) = (films.r12(c(0.5, 0.0)), films.r12(c(0.5 + 1e-9, 0.0)));
        assert!(close(at.s, near.s, 1e-7) && close(at.p, near.p, 1e-7));
    }

    #[test]
    fn fields_at_the_faces_are_one_plus_r_and_t() {
        let films = stack();
        let kappa = c(0.6, 0.0);
        let mut at = [TangentialFields::default(); 3];
        for (from, first, last) in
            [(IncidentSide::FromOutside, 2, 0), (IncidentSide::FromSubstrate, 0, 2)]
        {
            films.fields_at_interfaces(from, kappa, &mut at);
            let (r, t, entry, exit) = match from {
                IncidentSide::FromOutside => (films.r12(kappa), films.t12(kappa), 1.0, 1.5),
                IncidentSide::FromSubstrate => (films.r21(kappa), films.t21(kappa), 1.5, 1.0),
            };
            assert!(close(at[first].e, 1.0 + r.s, 1e-14));
            assert!(close(at[first].u, 1.0 + r.p, 1e-14));
            assert!(close(at[last].e, t.s, 1e-14));
            assert!(close(at[last].u, t.p * exit / entry, 1e-14));
        }
    }

    #[test]
    fn fields_at_the_depth_of_an_interface_are_those_of_the_interface() {
        let films = stack();
        let kappa = c(0.6, 0.0);
        let mut at = [TangentialFields::default(); 3];
        for from in [IncidentSide::FromOutside, IncidentSide::FromSubstrate] {
            films.fields_at_interfaces(from, kappa, &mut at);
            for (interface, depth) in [(2, 0.0), (1, 0.2), (0, 0.33)] {
                for nudge in [-1e-12, 0.0, 1e-12] {
                    let there = films.fields_at_depth(from, kappa, depth + nudge);
                    assert!(close(there.e, at[interface].e, 1e-10), "{from:?} {interface}");
                    assert!(close(there.u, at[interface].u, 1e-10));
                    assert!(close(there.w, at[interface].w, 1e-10));
                }
            }
        }
    }
}
