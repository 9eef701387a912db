//! Stacks of films between two media.

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::{
    amplitudes::{IncidentSide, SpAmplitudes, TangentialFields},
    layer::{FilmLayer, FilmMedium},
    root::{decaying_root, phase_factor, root},
    vectors::{EntranceFields, FieldVectors},
};
use crate::lanes::{Complex, Real, ratios};

const ONE: Complex64 = Complex64::ONE;

/// The loss that NIST adds to the tangential index of light from inside the substrate.
const TINY_LOSS: f64 = 1e-10;

/// Films between two media at one wavelength, prepared for many angles.
#[derive(Clone, Debug)]
pub struct Films {
    pub(super) outer: FilmMedium,
    pub(super) substrate: FilmMedium,
    /// The one next to the substrate first.
    pub(super) layers: Vec<FilmLayer>,
    /// 2π/λ, 1/µm.
    pub(super) wave_number: f64,
    /// That of all films, µm.
    pub(super) thickness: f64,
    /// The largest κ² that passes every film without loss; negative if there is none.
    pub(super) clear_below: f64,
    pub(super) loss: f64,
    pub(super) growing: bool,
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
        // The loss is that of |sin|, so that light of a negative angle is lost too.
        let loss = if sin < 0.0 { -self.loss } else { self.loss };
        if kappa.im == 0.0 { Complex64::new(kappa.re, -loss) } else { kappa }
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

    pub(super) fn part(&self, medium: FilmMedium, thickness: f64) -> FilmLayer {
        FilmLayer { medium, phase: self.wave_number * thickness, thickness }
    }

    /// (entrance medium, exit medium).
    pub(super) fn ends(&self, from: IncidentSide) -> (FilmMedium, FilmMedium) {
        match from {
            IncidentSide::FromOutside => (self.outer, self.substrate),
            IncidentSide::FromSubstrate => (self.substrate, self.outer),
        }
    }

    /// The films in the order from the exit to the entrance.
    pub(super) fn exit_to_entrance(
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
