//! Reflection and transmission of plane waves by a periodic layered structure.

use num_complex::Complex64;

use super::{
    dense,
    layer::{CoupledOperators, LayerOperators},
    slab::SymmetricSlab,
};
use crate::{Jones, special::matrix::ComplexMatrix};

const ONE: Complex64 = Complex64::ONE;

/// Below this sine a beam counts as normal and takes its s direction from the laboratory.
const NORMAL: f64 = 1e-10;

/// |k_z| of a wave along the surface is kept at least this large: where an order grazes exactly,
/// the admittance has a pole. 10⁻⁸ is the root of the rounding error of k_z².
const GRAZING: f64 = 1e-8;

/// |k_y| up to this size, the rounding error of a product of sines, is 0.
const ACROSS: f64 = 1e-15;

/// A periodic structure at one wavelength, prepared for any incident direction.
#[derive(Clone, Debug)]
pub struct PeriodicStructure {
    /// Layers, the one on the side of the incident light first.
    pub layers: Vec<LayerOperators>,
    /// Index of the medium the light comes from; real.
    pub incident: f64,
    /// Index of the medium behind.
    pub behind: Complex64,
    /// Lateral wave vectors of the harmonics, relative to the zeroth, in units of k₀.
    pub harmonics: Vec<(f64, f64)>,
    /// Position of the zeroth harmonic.
    pub zeroth: usize,
}

/// One diffracted plane wave that carries power away.
#[derive(Clone, Copy, Debug)]
pub struct DiffractionOrder {
    /// Lateral unit-vector components of its direction, in the frame of the structure.
    pub lateral: (f64, f64),
    /// |cos θ| of its direction.
    pub cos: f64,
    /// Field amplitudes (s, p) out of (s, p) in, times the root of the ratio of the powers.
    pub jones: Jones,
}

/// The incident plane wave in the frame of the structure.
#[derive(Clone, Copy, Debug)]
pub struct IncidentWave {
    /// Lateral wave vector in units of k₀: index times sine.
    pub lateral: (f64, f64),
    /// cos θ > 0.
    pub cos: f64,
    /// The direction that is s for a beam along the normal.
    pub normal_s: (f64, f64),
}

impl PeriodicStructure {
    /// The waves reflected (`behind` false) or transmitted (true), light coming down.
    pub fn diffract(&self, wave: &IncidentWave, behind: bool) -> Vec<DiffractionOrder> {
        let lateral: Vec<(f64, f64)> =
            self.harmonics.iter().map(|g| (wave.lateral.0 + g.0, wave.lateral.1 + g.1)).collect();
        let across = lateral.iter().all(|k| k.1.abs() <= ACROSS);
        let fields = if across && self.layers.iter().all(LayerOperators::is_diagonal) {
            self.fields_across(&lateral, behind)
        } else {
            self.fields(&lateral, behind)
        };
        let exit = ExitMedium { wave, index: self.incident, behind, exit: self.exit_index(behind) };
        lateral.iter().zip(&fields).filter_map(|(&k, field)| exit.order(k, field)).collect()
    }

    fn exit_index(&self, behind: bool) -> f64 {
        match (behind, self.behind.im == 0.0) {
            (false, _) => self.incident,
            (true, true) => self.behind.re,
            (true, false) => 0.0,
        }
    }

    /// E_x and E_y per harmonic for E_x = 1 and E_y = 1 in the zeroth, s and p separately.
    fn fields_across(&self, lateral: &[(f64, f64)], behind: bool) -> Vec<FieldMatrix> {
        let kx: Vec<f64> = lateral.iter().map(|k| k.0).collect();
        let (above, below) = (self.normal_waves(lateral, false), self.normal_waves(lateral, true));
        let (eps_above, eps_below) = self.permittivities();
        let unit = unit_columns(kx.len(), &[self.zeroth]);

        let s = LayerCascade::new(&self.layers, |l| l.across_s(&kx), &diagonal(&below));
        let ey = s.respond(&diagonal(&above), &unit, behind);

        let admittance = |kz: &[Complex64], eps: Complex64| -> Vec<Complex64> {
            kz.iter().map(|kz| kz / eps).collect()
        };
        let (y_above, y_below) = (admittance(&above, eps_above), admittance(&below, eps_below));
        let p = LayerCascade::new(&self.layers, |l| l.across_p(&kx), &diagonal(&y_below));
        let hy = p.respond(&diagonal(&y_above), &unit, behind);
        // E_x of the incident wave of H_y = 1 is −y, that of an upward wave +y, downward −y.
        let incident = -y_above[self.zeroth];
        let ex = |n: usize| if behind { -y_below[n] } else { y_above[n] } * hy[(n, 0)] / incident;

        (0..kx.len()).map(|n| [[ex(n), Complex64::ZERO], [Complex64::ZERO, ey[(n, 0)]]]).collect()
    }

    /// The same for any direction, where s and p mix.
    fn fields(&self, lateral: &[(f64, f64)], behind: bool) -> Vec<FieldMatrix> {
        let n = lateral.len();
        let (eps_above, eps_below) = self.permittivities();
        let y_above = admittance(lateral, &self.normal_waves(lateral, false), eps_above);
        let y_below = admittance(lateral, &self.normal_waves(lateral, true), eps_below);
        let ladder = LayerCascade::new(&self.layers, |l| l.conical(lateral), &y_below);
        let unit = unit_columns(2 * n, &[self.zeroth, n + self.zeroth]);
        let e = ladder.respond(&y_above, &unit, behind);
        (0..n).map(|m| [[e[(m, 0)], e[(m, 1)]], [e[(n + m, 0)], e[(n + m, 1)]]]).collect()
    }

    fn permittivities(&self) -> (Complex64, Complex64) {
        (Complex64::from(self.incident * self.incident), self.behind * self.behind)
    }

    /// k_z of every harmonic outside the layers, decaying or outgoing.
    fn normal_waves(&self, lateral: &[(f64, f64)], behind: bool) -> Vec<Complex64> {
        let (above, below) = self.permittivities();
        let epsilon = if behind { below } else { above };
        lateral.iter().map(|&k| normal_wave(epsilon, k)).collect()
    }
}

/// `[[E_x from E_x, E_x from E_y], [E_y from E_x, E_y from E_y]]`.
type FieldMatrix = [[Complex64; 2]; 2];

/// √(ε − k²) with Im ≥ 0.
fn normal_wave(epsilon: Complex64, (kx, ky): (f64, f64)) -> Complex64 {
    let root = (epsilon - kx * kx - ky * ky).sqrt();
    let kz = if root.im < 0.0 { -root } else { root };
    if kz.norm() < GRAZING { GRAZING.into() } else { kz }
}

/// V = Y U of upward waves in a homogeneous medium: 2×2 per harmonic.
fn admittance(lateral: &[(f64, f64)], kz: &[Complex64], epsilon: Complex64) -> ComplexMatrix {
    let n = lateral.len();
    let mut y = ComplexMatrix::zeros(2 * n, 2 * n);
    for (m, (&(kx, ky), &kz)) in lateral.iter().zip(kz).enumerate() {
        y[(m, m)] = (epsilon - ky * ky) / kz;
        y[(m, n + m)] = kx * ky / kz;
        y[(n + m, m)] = kx * ky / kz;
        y[(n + m, n + m)] = (epsilon - kx * kx) / kz;
    }
    y
}

fn diagonal(values: &[Complex64]) -> ComplexMatrix {
    let mut m = ComplexMatrix::zeros(values.len(), values.len());
    for (k, value) in values.iter().enumerate() {
        m[(k, k)] = *value;
    }
    m
}

fn unit_columns(rows: usize, at: &[usize]) -> ComplexMatrix {
    let mut m = ComplexMatrix::zeros(rows, at.len());
    for (column, row) in at.iter().enumerate() {
        m[(*row, column)] = ONE;
    }
    m
}

/// The layers added up from behind.
struct LayerCascade {
    /// Reflection by all layers, against the reference admittance 1.
    reflection: ComplexMatrix,
    /// Per layer, front first: downward waves behind it from those before it.
    passage: Vec<ComplexMatrix>,
    /// Reflection by the medium behind.
    last: ComplexMatrix,
}

impl LayerCascade {
    fn new(
        layers: &[LayerOperators],
        pair: impl Fn(&LayerOperators) -> CoupledOperators,
        behind: &ComplexMatrix,
    ) -> Self {
        let last = dense::cayley(-ONE, behind.clone());
        let mut reflection = last.clone();
        let mut passage = Vec::with_capacity(layers.len());
        for layer in layers.iter().rev().filter(|layer| layer.depth > 0.0) {
            let (r, through) = SymmetricSlab::new(&pair(layer), layer.depth).above(&reflection);
            reflection = r;
            passage.push(through);
        }
        passage.reverse();
        Self { reflection, passage, last }
    }

    /// U reflected, or transmitted to `behind`, for the columns of U that come in.
    fn respond(
        &self,
        front: &ComplexMatrix,
        incoming: &ComplexMatrix,
        behind: bool,
    ) -> ComplexMatrix {
        let one = dense::identity(front.nrows());
        let (plus, minus) = (&one + front, &one - front);
        let r = &self.reflection;
        let driven = (r * &plus - &minus) * incoming;
        let reflected = dense::solve(dense::add_product(plus.clone(), -ONE, r, &minus), driven);
        if !behind {
            return reflected;
        }
        // Downward amplitude (U − V)/2 with V = −Y U_in + Y U_out.
        let mut down = (&plus * incoming + &minus * &reflected) * faer::Scale(Complex64::from(0.5));
        for through in &self.passage {
            down = through * &down;
        }
        (&one + &self.last) * down
    }
}

/// Side of the diffracted waves.
struct ExitMedium<'a> {
    wave: &'a IncidentWave,
    index: f64,
    behind: bool,
    exit: f64,
}

impl ExitMedium<'_> {
    /// The order with lateral wave vector `k` and tangential field `e`, if it carries power.
    fn order(&self, k: (f64, f64), e: &FieldMatrix) -> Option<DiffractionOrder> {
        let lateral = (k.0 / self.exit, k.1 / self.exit);
        let cos2 = 1.0 - lateral.0 * lateral.0 - lateral.1 * lateral.1;
        if !(self.exit > 0.0 && cos2 > GRAZING * GRAZING) {
            return None;
        }
        let cos = cos2.sqrt();
        let incident = (self.wave.lateral.0 / self.index, self.wave.lateral.1 / self.index);
        let into = along(incident, self.wave.normal_s);
        let out = along(lateral, self.wave.normal_s);
        // Lateral field of s is ẑ × κ, that of p is κ cos θ downwards and −κ cos θ upwards.
        let from_s = across(into);
        let from_p = (into.0 * self.wave.cos, into.1 * self.wave.cos);
        let field = |u: (f64, f64)| [e[0][0] * u.0 + e[0][1] * u.1, e[1][0] * u.0 + e[1][1] * u.1];
        let to_s = |f: [Complex64; 2]| f[0] * across(out).0 + f[1] * across(out).1;
        let sign = if self.behind { 1.0 } else { -1.0 };
        let to_p = |f: [Complex64; 2]| (f[0] * out.0 + f[1] * out.1) * (sign / cos);
        let (fs, fp) = (field(from_s), field(from_p));
        let jones = Jones { ss: to_s(fs), ps: to_s(fp), sp: to_p(fs), pp: to_p(fp) };
        let power = self.exit * cos / (self.index * self.wave.cos);
        Some(DiffractionOrder { lateral, cos, jones: jones.scaled(power.sqrt()) })
    }
}

/// Unit vector κ of the lateral direction, with ẑ × κ = `normal_s` for a normal beam.
fn along(lateral: (f64, f64), normal_s: (f64, f64)) -> (f64, f64) {
    if lateral.0.abs() <= NORMAL && lateral.1.abs() <= NORMAL {
        return (normal_s.1, -normal_s.0);
    }
    let length = lateral.0.hypot(lateral.1);
    (lateral.0 / length, lateral.1 / length)
}

/// ẑ × κ.
fn across(kappa: (f64, f64)) -> (f64, f64) {
    (-kappa.1, kappa.0)
}
