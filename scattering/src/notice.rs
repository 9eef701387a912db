//! Notices of a build besides its result: defects that it avoided, limits that it exceeded.

use std::{collections::BTreeSet, fmt};

use crate::Defect;

/// A remark on a result; it is not an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Notice {
    /// The result differs from that of NIST's library by this defect.
    Defect(Defect),
    /// The parameters lie outside of the range in which the model is right.
    Limit(ModelLimit),
}

/// A limit of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ModelLimit {
    /// Particles of a coating are so close that they do not scatter independently.
    ParticlesTooDense,
    /// Flakes of a coating are so many that they cannot tilt as their slopes say.
    FlakesTooDense,
    /// Light that a coating loses between its flakes.
    LostBetweenFlakes,
    /// A phase matrix gives light more polarization than intensity.
    Unrealizable,
    /// Multipoles of a particle have converged to this part of their size only.
    Unconverged {
        /// The relative error of the amplitudes, 10⁻⁶.
        millionths: u32,
    },
    /// Efficiencies of a grating change by this part between half the harmonics and all of them.
    HarmonicsUnconverged {
        /// The largest relative change, 10⁻⁶.
        millionths: u32,
    },
    /// The azimuthal modes of a paint end before they are small.
    ModesEnded,
    /// A tabulated reflectance is above 1.
    ReflectanceAboveOne,
}

/// Keeps the largest error of each kind among the limits that state one.
pub fn keep_largest(notices: &mut BTreeSet<Notice>) {
    // Limits of one kind follow each other with rising errors.
    let all: Vec<Notice> = notices.iter().copied().collect();
    for pair in all.windows(2) {
        if let [Notice::Limit(a), Notice::Limit(b)] = pair
            && std::mem::discriminant(a) == std::mem::discriminant(b)
        {
            notices.remove(&pair[0]);
        }
    }
}

impl ModelLimit {
    /// Description of the problem and its remedy.
    pub fn describe(self) -> &'static str {
        match self {
            Self::ParticlesTooDense => {
                "the particles fill more than a tenth of the volume and do not scatter \
                 independently there: lower particle_density"
            }
            Self::FlakesTooDense => {
                "the flakes need more than the whole volume to tilt as sdf says: lower \
                 flake_density or the slopes"
            }
            Self::LostBetweenFlakes => {
                "more than a twentieth of the light is lost between flakes: raise correlation or \
                 lower flake_density"
            }
            Self::Unconverged { .. } => {
                "the multipoles of the particle have not converged: a smaller, rounder or smoother \
                 body does"
            }
            Self::HarmonicsUnconverged { .. } => {
                "the efficiencies of the grating have not converged: raise order (order1 and order2 \
                 of crossed gratings)"
            }
            Self::Unrealizable => {
                "scattered light has more polarization than intensity at some angles: lower plmax, \
                 pcmax or s of the phase function"
            }
            Self::ReflectanceAboveOne => {
                "a reflectance of the table is above 1: more light returns than arrives; divide \
                 percentages by 100"
            }
            Self::ModesEnded => {
                "narrow lobes of the paint have more azimuthal modes than are taken: the BRDF \
                 ripples; take wider slopes of faces and flakes or a coarser tolerance"
            }
        }
    }
}

impl From<Defect> for Notice {
    fn from(defect: Defect) -> Self {
        Self::Defect(defect)
    }
}

impl From<ModelLimit> for Notice {
    fn from(limit: ModelLimit) -> Self {
        Self::Limit(limit)
    }
}

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Defect(defect) => write!(
                f,
                "this run meets a defect of NIST's library and has the sound value (--compat \
                 reproduces NIST's) [{defect}]"
            ),
            Self::Limit(ModelLimit::Unconverged { millionths }) => write!(
                f,
                "the multipoles of the particle have converged to {:.0e} of their amplitudes only",
                f64::from(*millionths) * 1e-6
            ),
            Self::Limit(ModelLimit::HarmonicsUnconverged { millionths }) => write!(
                f,
                "efficiencies of the grating are known to {:.0e} of their value only, by which they \
                 change between half the harmonics and all of them: raise order (order1 and order2 \
                 of crossed gratings)",
                f64::from(*millionths) * 1e-6
            ),
            Self::Limit(limit) => f.write_str(limit.describe()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_several_errors_the_largest_is_kept() {
        let limit = |millionths| Notice::from(ModelLimit::HarmonicsUnconverged { millionths });
        let others = [ModelLimit::ModesEnded.into(), Defect::Nudge.into()];
        let mut notices: BTreeSet<Notice> = [limit(2000), limit(50_000), limit(5000)].into();
        notices.extend(others);
        keep_largest(&mut notices);
        assert_eq!(notices, [limit(50_000), others[0], others[1]].into());
    }
}
