//! Polarization bases: psps, xyxy and plane, and the change from one to another.

use glam::DVec3;

use super::{Jones, Mueller};

/// The pair of field directions in which Stokes vectors and Mueller matrices are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Basis {
    /// s is horizontal (perpendicular to the normal and the ray), p = k × s. The default.
    #[default]
    Psps,
    /// y takes the place of s and x of p; x follows the sample's axes for every direction.
    Xyxy,
    /// Perpendicular to the scattering plane takes the place of s, parallel that of p.
    Plane,
}

impl Basis {
    /// The basis that programs call `psps`, `xyxy` or `plane`; the case matters.
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "psps" => Some(Self::Psps),
            "xyxy" => Some(Self::Xyxy),
            "plane" => Some(Self::Plane),
            _ => None,
        }
    }

    /// Name in programs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Psps => "psps",
            Self::Xyxy => "xyxy",
            Self::Plane => "plane",
        }
    }
}

/// A text that is not the name of a [`Basis`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is none of psps, xyxy and plane")]
pub struct UnknownBasis(pub String);

impl std::str::FromStr for Basis {
    type Err = UnknownBasis;

    fn from_str(text: &str) -> Result<Self, UnknownBasis> {
        Self::from_name(text).ok_or_else(|| UnknownBasis(text.to_owned()))
    }
}

/// Two unit vectors across a beam; `first` takes the place of s, `second` that of p.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransverseFrame {
    /// The direction in place of s.
    pub first: DVec3,
    /// The direction in place of p.
    pub second: DVec3,
}

/// Below this length of a cross product two directions count as parallel.
const PARALLEL: f64 = 1e-10;

/// Unit vector perpendicular to `a` and `b`; where they are parallel, to `a` and x̂, or ŷ.
pub fn perp(a: DVec3, b: DVec3) -> DVec3 {
    let a = a.normalize();
    let cross = a.cross(b.normalize());
    if cross.length() > PARALLEL {
        return cross.normalize();
    }
    let cross = a.cross(DVec3::X);
    if cross.length() > PARALLEL {
        return cross.normalize();
    }
    a.cross(DVec3::Y).normalize()
}

/// True if a beam counts as one along the normal.
pub(crate) fn is_normal(k: DVec3) -> bool {
    k.x.abs() <= PARALLEL && k.y.abs() <= PARALLEL
}

impl TransverseFrame {
    /// (s, p) of the beam `k`: s = ẑ × k normalized, p = k × s; s = ŷ along the normal.
    pub fn psps(k: DVec3) -> Self {
        let s = if is_normal(k) { DVec3::Y } else { perp(DVec3::Z, k) };
        Self { first: s, second: perp(k, s) }
    }

    /// (s, p) of the beam `k` whose s is given.
    pub fn with_s(k: DVec3, s: DVec3) -> Self {
        Self { first: s, second: perp(k, s) }
    }

    /// (y, x) of the beam `k`.
    pub fn xyxy(k: DVec3) -> Self {
        let x = if is_normal(k) {
            DVec3::X
        } else {
            let Self { first: s, second: p } = Self::psps(k);
            let (c, sigma) = (k.x / k.x.hypot(k.y), k.y / k.x.hypot(k.y));
            let along = if k.z > 0.0 { -c } else { c };
            along * p - sigma * s
        };
        Self { first: perp(x, k), second: x }
    }

    /// (⊥, ∥) of the beam `k` in the scattering plane of `k_i` and `k_s`.
    pub fn plane(k: DVec3, k_i: DVec3, k_s: DVec3) -> Self {
        let across = perp(k_i, k_s);
        Self { first: across, second: perp(k, across) }
    }

    /// Jones matrix that takes field components in `self` to components in `new`.
    pub fn to(&self, new: &Self) -> Jones {
        Jones::real(
            new.first.dot(self.first),
            new.first.dot(self.second),
            new.second.dot(self.first),
            new.second.dot(self.second),
        )
    }
}

/// The two beams of an event: where they go, and their s, which k alone does not tell where it
/// lies along the normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamPair {
    /// Propagation of the incident and of the scattered beam.
    pub k: [DVec3; 2],
    /// s of both.
    pub s: [DVec3; 2],
}

impl BeamPair {
    /// The frames of `basis` for both beams.
    fn frames(&self, basis: Basis) -> [TransverseFrame; 2] {
        let [k_i, k_s] = self.k;
        match basis {
            Basis::Psps => {
                [TransverseFrame::with_s(k_i, self.s[0]), TransverseFrame::with_s(k_s, self.s[1])]
            }
            Basis::Xyxy => self.k.map(TransverseFrame::xyxy),
            Basis::Plane => self.k.map(|k| TransverseFrame::plane(k, k_i, k_s)),
        }
    }
}

/// The matrix `m`, given in basis `from`, in basis `to`, for these beams.
pub fn change_basis(m: Mueller, from: Basis, to: Basis, beams: &BeamPair) -> Mueller {
    if from == to {
        return m;
    }
    let ([from_i, from_s], [to_i, to_s]) = (beams.frames(from), beams.frames(to));
    from_s.to(&to_s).mueller() * m * to_i.to(&from_i).mueller()
}

/// The Jones matrix `j`, given in basis `from`, in basis `to`, for these beams.
pub(crate) fn change_jones_basis(j: Jones, from: Basis, to: Basis, beams: &BeamPair) -> Jones {
    if from == to {
        return j;
    }
    let ([from_i, from_s], [to_i, to_s]) = (beams.frames(from), beams.frames(to));
    from_s.to(&to_s) * j * to_i.to(&from_i)
}
