//! Plane waves and the multipoles they excite or are made of.
//!
//! The polar axis points down, to the substrate if there is one; a beam comes with the one that
//! the substrate makes of it, mirrored in a plane across the axis. With the reflection r of p or
//! s, its phase included, σ = (−1)^{l−m} and τ, μ of the beam's angle, a unit wave excites
//!
//! | | e | h |
//! |---|---|---|
//! | p | i^{l−1} τ (1 − σr)/(l(l+1)) | −i^l μ (1 + σr)/(l(l+1)) |
//! | s | −i^l μ (1 + σr)/(l(l+1)) | i^{l+1} τ (1 − σr)/(l(l+1)) |
//!
//! times 1/k, and the amplitude of the scattered light, s = φ̂ and p = θ̂, is
//!
//! $$ J = -i \sum_{lm} (-i)^l e^{im\varphi} \begin{cases}
//!   w_e \tau (1-\sigma r) + i w_h \mu (1+\sigma r) & \text{p} \\
//!   i w_e \mu (1+\sigma r) - w_h \tau (1-\sigma r) & \text{s} \end{cases} $$
//!
//! The factor −i makes it the amplitude matrix of Bohren & Huffman. Orders m and −m share their
//! τ, have opposite μ, and are summed as cosines and sines of mφ.

use num_complex::Complex64;

use crate::{
    Jones,
    optics::film::SpAmplitudes,
    special::harmonics::{Harmonics, Scalar},
};

const I: Complex64 = Complex64::I;

/// A plane wave and its mirror image.
#[derive(Clone, Copy, Debug)]
pub struct MirroredWave {
    /// Cosine of the angle from the axis; complex for a wave that fades along it.
    pub cos: Complex64,
    /// Sine of that angle.
    pub sin: f64,
    /// Amplitudes of the beam itself.
    pub direct: SpAmplitudes,
    /// Amplitudes of its mirror image.
    pub mirrored: SpAmplitudes,
}

impl MirroredWave {
    /// A beam of unit amplitude without a mirror image.
    pub fn free(cos: f64, sin: f64) -> Self {
        let one = SpAmplitudes { s: Complex64::ONE, p: Complex64::ONE };
        Self { cos: cos.into(), sin, direct: one, mirrored: SpAmplitudes::default() }
    }

    /// direct − mirrored and direct + mirrored, each (p, s).
    fn combined(&self) -> [(Complex64, Complex64); 2] {
        let (d, m) = (self.direct, self.mirrored);
        [(d.p - m.p, d.s - m.s), (d.p + m.p, d.s + m.s)]
    }
}

/// Coefficients of one (m, l) for both polarizations of the beam that excites them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Multipole {
    /// (e, h) for p.
    pub p: [Complex64; 2],
    /// (e, h) for s.
    pub s: [Complex64; 2],
}

impl Multipole {
    /// The same times `factor`.
    pub fn scaled(self, factor: f64) -> Self {
        let times = |pair: [Complex64; 2]| pair.map(|z| z * factor);
        Self { p: times(self.p), s: times(self.s) }
    }
}

/// k times the coefficients of the regular waves that `beam` is made of, for m ≥ 0 in the order
/// of [`Harmonics::visit`].
pub fn regular(harmonics: &Harmonics, beam: &MirroredWave) -> Vec<Multipole> {
    let [minus, plus] = beam.combined();
    let mut out = Vec::new();
    harmonics.visit(beam.cos, beam.sin.into(), |m, l, tau, mu| {
        let (of_tau, of_mu) = if (l - m) % 2 == 0 { (minus, plus) } else { (plus, minus) };
        let turn = power_of_i(l) / (l * (l + 1)) as f64;
        out.push(Multipole {
            p: [-I * turn * tau * of_tau.0, -turn * mu * of_mu.0],
            s: [-turn * mu * of_mu.1, I * turn * tau * of_tau.1],
        });
    });
    out
}

fn power_of_i(l: usize) -> Complex64 {
    [Complex64::ONE, I, -Complex64::ONE, -I][l % 4]
}

/// OutgoingMultipoles multipoles, prepared for their sum in any direction.
#[derive(Clone, Debug)]
pub struct OutgoingMultipoles {
    even: Vec<[Complex64; 4]>,
    odd: Option<Vec<[Complex64; 4]>>,
}

impl OutgoingMultipoles {
    /// The multipoles `w` of m ≥ 0, each with (m, l), and those of −m that mirror symmetry asks
    /// for: e of p and h of s are even in m, the others odd.
    pub fn symmetric(w: impl Iterator<Item = (usize, usize, Multipole)>) -> Self {
        let double = |(m, l, w): (usize, usize, Multipole)| {
            let factor = if m == 0 { 1.0 } else { 2.0 };
            turned(l, &w).map(|z| z * factor)
        };
        Self { even: w.map(double).collect(), odd: None }
    }

    /// The multipoles (l, w of m, w of −m) for any m ≥ 0; for m = 0 the second one is zero.
    ///
    /// The negative orders count with P̃_l^{−m} = P̃_l^m.
    pub fn general(w: &[(usize, Multipole, Multipole)]) -> Self {
        const SIGNS: [f64; 4] = [1.0, -1.0, -1.0, 1.0];
        let part = |sign: f64| {
            let each = |(l, plus, minus): &(usize, Multipole, Multipole)| {
                let (a, b) = (turned(*l, plus), turned(*l, minus));
                std::array::from_fn(|j| a[j] + b[j] * (sign * SIGNS[j]))
            };
            w.iter().map(each).collect()
        };
        Self { even: part(1.0), odd: Some(part(-1.0)) }
    }

    /// The amplitude matrix in the direction of `beam` at the azimuth with this cosine and sine.
    pub fn amplitude(
        &self,
        harmonics: &Harmonics,
        beam: &MirroredWave,
        (c, s): (f64, f64),
    ) -> Jones {
        if beam.cos.im == 0.0 {
            self.sum(harmonics, beam, beam.cos.re, beam.sin, Complex64::new(c, s))
        } else {
            self.sum(harmonics, beam, beam.cos, beam.sin.into(), Complex64::new(c, s))
        }
    }

    fn sum<T: Scalar>(
        &self,
        harmonics: &Harmonics,
        beam: &MirroredWave,
        cos: T,
        sin: T,
        turn: Complex64,
    ) -> Jones {
        let combined = beam.combined();
        let (mut start, mut power, mut phase) = (0, T::from(1.0), Complex64::ONE);
        let mut total = Jones::default();
        for m in 0..=harmonics.m_max() {
            let (along, across) = (Complex64::from(phase.re), I * phase.im);
            let size = harmonics.l_max() + 1 - Harmonics::l_min(m);
            let sets = [(Some(&self.even), along, across), (self.odd.as_ref(), across, along)];
            for (set, diagonal, off) in sets {
                let Some(set) = set else { continue };
                let mut sums = DegreeSums::default();
                let mut at = set[start..start + size].iter();
                harmonics.order(m, power, cos, sin, |l, tau, mu| {
                    if let Some(w) = at.next() {
                        sums.add((l - m) % 2, w, tau, mu);
                    }
                });
                total = total + sums.jones(&combined, diagonal, off);
            }
            start += size;
            phase *= turn;
            if m > 0 {
                power = power * sin;
            }
        }
        total
    }
}

/// (−i)^l (p_e, ip_h, s_e, is_h).
fn turned(l: usize, w: &Multipole) -> [Complex64; 4] {
    let turn = power_of_i(3 * l);
    [turn * w.p[0], I * turn * w.p[1], turn * w.s[0], I * turn * w.s[1]]
}

/// Sums over l of one order: those that go with direct − mirrored, and with direct + mirrored.
#[derive(Default)]
struct DegreeSums([[Complex64; 4]; 2]);

impl DegreeSums {
    #[inline]
    fn add<T: Scalar>(&mut self, parity: usize, w: &[Complex64; 4], tau: T, mu: T) {
        let [a, b, c, d] = *w;
        // In the order pp, s→p, p→s, ss.
        for (sum, z) in self.0[parity].iter_mut().zip([a, c, b, d]) {
            *sum += tau.of(z);
        }
        for (sum, z) in self.0[1 - parity].iter_mut().zip([b, d, a, c]) {
            *sum += mu.of(z);
        }
    }

    fn jones(
        &self,
        combined: &[(Complex64, Complex64); 2],
        diagonal: Complex64,
        off: Complex64,
    ) -> Jones {
        let [(p0, s0), (p1, s1)] = *combined;
        let [minus, plus] = &self.0;
        Jones {
            pp: -I * diagonal * (p0 * minus[0] + p1 * plus[0]),
            sp: -I * off * (p0 * minus[1] + p1 * plus[1]),
            ps: off * (s0 * minus[2] + s1 * plus[2]),
            ss: diagonal * (s0 * minus[3] + s1 * plus[3]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        scatterer::{layered, series},
        tmatrix::TMatrix,
    };

    #[test]
    fn a_sphere_scatters_as_the_series_of_mie_says() {
        let coefficients = layered::coefficients(&[(Complex64::new(1.6, 0.2), 2.0)], 9);
        let t = TMatrix::sphere(&coefficients);
        let harmonics = Harmonics::new(9, 9);
        let series = series::MieSeries::new(&coefficients);
        let (i, o, phi) = (0.4f64, 1.9f64, 0.0f64);
        let incoming = regular(&harmonics, &MirroredWave::free(i.cos(), i.sin()));
        let mut order = Vec::new();
        harmonics.visit(0.5, 0.5, |m, l, _, _| order.push((m, l)));
        let scattered = order.iter().zip(&incoming).map(|(&(m, l), v)| {
            let size = t.blocks[m].nrows() / 2;
            let at = l - m.max(1);
            let apply = |v: [Complex64; 2]| {
                [t.blocks[m][(at, at)] * v[0], t.blocks[m][(size + at, size + at)] * v[1]]
            };
            (m, l, Multipole { p: apply(v.p), s: apply(v.s) })
        });
        let outgoing = OutgoingMultipoles::symmetric(scattered);
        let beam = MirroredWave::free(o.cos(), o.sin());
        let j = outgoing.amplitude(&harmonics, &beam, (phi.cos(), phi.sin()));
        let (s1, s2) = series.amplitudes((o - i).cos());
        // In the plane of both beams s is ⊥ and p is ∥, and nothing is crossed.
        assert!((j.ss - s1).norm() < 1e-12 * s1.norm(), "{} {s1}", j.ss);
        assert!((j.pp - s2).norm() < 1e-12 * s1.norm(), "{} {s2}", j.pp);
        assert!(j.ps.norm() + j.sp.norm() < 1e-12 * s1.norm());
    }
}
