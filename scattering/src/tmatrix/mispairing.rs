//! Multipoles as NIST's library pairs them with harmonics where m_max < l_max.
//!
//! The library keeps the multipoles w in a list of all (l, m) with |m| ≤ l, and the azimuthal
//! phases e^{imφ} in a shorter list of those with |m| ≤ min(m_max, l). It multiplies both lists
//! entry by entry, to the end of the shorter one. The angular functions of light that leaves
//! outside stand in the shorter list ([`outside`]), those of light that leaves into the substrate
//! in the longer one ([`inside`]). With m_max = l_max both lists are the same.

use num_complex::Complex64;

use super::waves::{MirroredWave, Multipole, OutgoingMultipoles};
use crate::{Jones, special::harmonics::Harmonics};

/// The multipoles of all (l, m), l ≤ l_max, in the order of the library's list, as far as the
/// list of phases reaches; (p, s) of e and h.
struct Paired {
    multipoles: Vec<Multipole>,
    /// (l, m) of each entry in the list of phases.
    phases: Vec<(usize, isize)>,
}

/// All (l, m) with |m| ≤ min(`m_max`, l) in the order of the library's lists.
fn list(l_max: usize, m_max: usize) -> impl Iterator<Item = (usize, isize)> {
    (1..=l_max).flat_map(move |l| {
        let m = l.min(m_max) as isize;
        (-m..=m).map(move |m| (l, m))
    })
}

impl Paired {
    /// From the multipoles (m, l, w) of m ≥ 0, which mirror symmetry completes.
    fn new(w: &[(usize, usize, Multipole)], harmonics: &Harmonics) -> Self {
        let phases: Vec<_> = list(harmonics.l_max(), harmonics.m_max()).collect();
        let mut multipoles = vec![Multipole::default(); phases.len()];
        for (m, l, w) in w {
            let opposite = Multipole { p: [w.p[0], -w.p[1]], s: [-w.s[0], w.s[1]] };
            let middle = l * l + l - 1;
            for (at, w) in [(middle - m, opposite), (middle + m, *w)] {
                if let Some(entry) = multipoles.get_mut(at) {
                    *entry = w;
                }
            }
        }
        Self { multipoles, phases }
    }
}

/// Values by (m ≥ 0, l) for the orders m and −m, in the order of [`Harmonics::visit`].
fn gathered(
    harmonics: &Harmonics,
    entries: impl Iterator<Item = ((usize, isize), Multipole)>,
) -> OutgoingMultipoles {
    let mut all = Vec::new();
    for m in 0..=harmonics.m_max() {
        let empty = |l| (l, Multipole::default(), Multipole::default());
        all.extend((Harmonics::l_min(m)..=harmonics.l_max()).map(empty));
    }
    for ((l, m), w) in entries {
        let order = m.unsigned_abs();
        let entry = &mut all[harmonics.place(order, l)];
        if m < 0 {
            entry.2 = w;
        } else {
            entry.1 = w;
        }
    }
    OutgoingMultipoles::general(&all)
}

/// The multipoles of light that leaves outside: each has l, m of its place in the shorter list.
pub(crate) fn outside(
    w: &[(usize, usize, Multipole)],
    harmonics: &Harmonics,
) -> OutgoingMultipoles {
    let Paired { multipoles, phases } = Paired::new(w, harmonics);
    // The library's P̃_l^{−m} is (−1)^m P̃_l^m, in the coefficients and in the harmonics.
    let sign = |m: isize| if m < 0 && m % 2 != 0 { -1.0 } else { 1.0 };
    let places = list(harmonics.l_max(), harmonics.l_max());
    let entries = phases.into_iter().zip(places).zip(multipoles).map(|((to, from), w)| {
        let factor = sign(to.1) * sign(from.1);
        (to, w.scaled(factor))
    });
    gathered(harmonics, entries)
}

/// The multipoles of light that leaves into the substrate.
#[derive(Clone, Debug)]
pub(crate) struct Inside {
    harmonics: Harmonics,
    /// The multipoles that the library multiplies with e^{imφ}, with m.
    by_phase: Vec<(isize, OutgoingMultipoles)>,
}

/// The multipoles of light that leaves into the substrate: each keeps its own l and m but for the
/// phase, which has m of its place in the shorter list.
pub(crate) fn inside(w: &[(usize, usize, Multipole)], harmonics: &Harmonics) -> Inside {
    let Paired { multipoles, phases } = Paired::new(w, harmonics);
    let m_max = harmonics.m_max() as isize;
    let own = || list(harmonics.l_max(), harmonics.l_max()).zip(multipoles.iter().copied());
    let of_phase = |m: isize| {
        let entries = own()
            .zip(&phases)
            .filter(|((own, _), phase)| phase.1 == m && own.1.abs() <= m_max)
            .map(|(entry, _)| entry);
        (m, gathered(harmonics, entries))
    };
    let by_phase = (-m_max..=m_max).map(of_phase).collect();
    Inside { harmonics: harmonics.clone(), by_phase }
}

impl Inside {
    /// The amplitude matrix in the direction of `beam` at the azimuth with this cosine and sine.
    pub(crate) fn amplitude(&self, beam: &MirroredWave, (c, s): (f64, f64)) -> Jones {
        let turn = Complex64::new(c, s);
        self.by_phase.iter().fold(Jones::default(), |sum, (m, multipoles)| {
            let j = multipoles.amplitude(&self.harmonics, beam, (1.0, 0.0));
            sum + j * turn.powi(*m as i32)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::film::Films;

    #[test]
    fn with_all_orders_the_librarys_pairing_is_the_right_one() {
        let harmonics = Harmonics::new(4, 4);
        let z = |at: usize, j: usize| Complex64::new((at + j) as f64, (at * j) as f64 - 3.0);
        let mut w = Vec::new();
        harmonics.visit(0.5, 0.5, |m, l, _, _| {
            let at = w.len();
            let (p, s) = match m {
                0 => ([z(at, 1), Complex64::ZERO], [Complex64::ZERO, z(at, 4)]),
                _ => ([z(at, 1), z(at, 2)], [z(at, 3), z(at, 4)]),
            };
            w.push((m, l, Multipole { p, s }));
        });
        let films = Films::new(&[], Complex64::ONE, Complex64::new(1.5, 0.1), 0.6);
        let beam =
            MirroredWave { mirrored: films.r12(0.6.into()), ..MirroredWave::free(-0.8, 0.6) };
        let azimuth = (0.6, 0.8);
        let right =
            OutgoingMultipoles::symmetric(w.iter().copied()).amplitude(&harmonics, &beam, azimuth);
        let pairings = [
            outside(&w, &harmonics).amplitude(&harmonics, &beam, azimuth),
            inside(&w, &harmonics).amplitude(&beam, azimuth),
        ];
        for pairing in pairings {
            let main = (pairing.ss - right.ss).norm() + (pairing.ps - right.ps).norm();
            let other = (pairing.pp - right.pp).norm() + (pairing.sp - right.sp).norm();
            assert!(main + other < 1e-11 * right.ss.norm(), "{pairing:?} {right:?}");
        }
    }
}
