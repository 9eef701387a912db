//! `.RISEdataBSDF`: the BRDF in linear RGB over polar angles, for RISE's `datadriven_material`.
//!
//! ```text
//! file    := int32 0x0BDF, uint32 1, int32 Ni, int32 Nr, emitter × Ni
//! emitter := float64 θ_i, (refl, trans) × Nr
//! refl    := float64 e1, e2, R, G, B      elevations above the surface, horizon first
//! trans   := float64 t1, t2, R, G, B      read and never used by RISE: zeros here
//! ```
//!
//! Little endian, radians, values in 1/sr without a cosine, linear Rec.709. RISE uses the mean of e1
//! and e2 only; we write e1 = e2 = π/2 − node with nodes from 0 to π/2, so that no direction lies
//! outside of the nodes. RISE checks little: a truncated table is dark without a message. [`read`]
//! checks the whole file.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::export::ExportError;

const MAGIC: i32 = 0x0BDF;
const VERSION: u32 = 1;
/// Maximum number of nodes per axis.
const MAX_NODES: usize = 4096;

/// A table over uniform nodes from 0 to π/2.
#[derive(Clone, Debug, PartialEq)]
pub struct RingTable {
    /// Nodes of both polar angles.
    pub nodes: usize,
    /// Linear RGB (1/sr) at `[θ_i][θ_r]`.
    pub rgb: Vec<[f64; 3]>,
}

impl RingTable {
    /// A table with `nodes` nodes per axis.
    ///
    /// # Errors
    ///
    /// If the number of nodes is not 3 to 4096, or values are missing, negative or not finite.
    pub fn new(nodes: usize, rgb: Vec<[f64; 3]>) -> Result<Self, ExportError> {
        if !(3..=MAX_NODES).contains(&nodes) || rgb.len() != nodes * nodes {
            let problem = format!("{} values for {nodes} nodes of each angle", rgb.len());
            return Err(ExportError::refused("table", problem));
        }
        let bad = rgb.iter().position(|c| c.iter().any(|x| !(x.is_finite() && *x >= 0.0)));
        if let Some(bad) = bad {
            let problem = format!(
                "theta_i node {}, theta_r node {}: {:?} is negative or not finite, and RISE would \
                 show it black",
                bad / nodes,
                bad % nodes,
                rgb[bad]
            );
            return Err(ExportError::refused("table", problem));
        }
        Ok(Self { nodes, rgb })
    }

    /// The angle of node `k`, radians.
    pub fn angle(&self, k: usize) -> f64 {
        FRAC_PI_2 * k as f64 / (self.nodes - 1) as f64
    }

    /// The bytes of the file.
    pub fn bytes(&self) -> Vec<u8> {
        let n = self.nodes;
        let mut out = Vec::with_capacity(size(n, n));
        out.extend(MAGIC.to_le_bytes());
        out.extend(VERSION.to_le_bytes());
        out.extend((n as i32).to_le_bytes());
        out.extend((n as i32).to_le_bytes());
        let mut numbers = |values: &[f64]| values.iter().for_each(|x| out.extend(x.to_le_bytes()));
        for i in 0..n {
            // Slightly more than π/2 for the last node: beyond it RISE is black.
            let margin = if i + 1 == n { 1e-9 } else { 0.0 };
            numbers(&[self.angle(i) + margin]);
            for r in (0..n).rev() {
                let [red, green, blue] = self.rgb[i * n + r];
                let elevation = FRAC_PI_2 - self.angle(r);
                numbers(&[elevation, elevation, red, green, blue]);
                let below = PI - self.angle(r);
                numbers(&[below, below, 0.0, 0.0, 0.0]);
            }
        }
        out
    }

    /// The value that RISE interpolates between the nodes: linear in θ_i.
    pub fn at(&self, theta_i: f64, r: usize) -> [f64; 3] {
        let x = (theta_i / FRAC_PI_2 * (self.nodes - 1) as f64).clamp(0.0, (self.nodes - 1) as f64);
        let low = (x as usize).min(self.nodes - 2);
        let part = x - low as f64;
        std::array::from_fn(|c| {
            let [a, b] = [low, low + 1].map(|i| self.rgb[i * self.nodes + r][c]);
            a * (1.0 - part) + b * part
        })
    }

    /// The reflectance for diffuse light: Σ over both hemispheres.
    pub fn reflectance(&self) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for i in 0..self.nodes {
            for r in 0..self.nodes {
                // f dω_r / π with the projected solid angles of both rings.
                let weight = self.ring(i) * self.ring(r) / PI;
                for (sum, x) in sum.iter_mut().zip(self.rgb[i * self.nodes + r]) {
                    *sum += weight * x;
                }
            }
        }
        sum.map(|x| x.min(1.0))
    }

    /// The projected solid angle of the ring of node `k`, sr.
    fn ring(&self, k: usize) -> f64 {
        let (inner, outer) = ring(k, self.nodes);
        PI * (outer.to_radians().sin().powi(2) - inner.to_radians().sin().powi(2))
    }
}

/// The inner and outer polar angle of the ring around node `k` of `nodes`, degrees.
pub fn ring(k: usize, nodes: usize) -> (f64, f64) {
    let step = 90.0 / (nodes - 1) as f64;
    let half = |x: f64| (x * step).clamp(0.0, 90.0);
    (half(k as f64 - 0.5), half(k as f64 + 0.5))
}

/// Bytes of a table of `n_i` emitters with `n_r` patches.
fn size(n_i: usize, n_r: usize) -> usize {
    16 + n_i * (8 + 80 * n_r)
}

/// Reads a table that [`RingTable::bytes`] wrote.
///
/// # Errors
///
/// If RISE would show the file wrongly or black; the error names the reason.
pub fn read(bytes: &[u8]) -> Result<RingTable, ExportError> {
    let refused = |problem: String| ExportError::refused("table", problem);
    let word =
        |at: usize| bytes.get(at..at + 4).map(|b| i32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let (Some(magic), Some(version), Some(n_i), Some(n_r)) = (word(0), word(4), word(8), word(12))
    else {
        return Err(refused("the file ends within its header".into()));
    };
    if magic != MAGIC || version != VERSION as i32 {
        return Err(refused("the file does not begin with 0x0BDF and version 1".into()));
    }
    let nodes = usize::try_from(n_i).ok().filter(|n| n_r == n_i && (3..=MAX_NODES).contains(n));
    let nodes = nodes.ok_or_else(|| refused(format!("{n_i} times {n_r} nodes")))?;
    let expected = size(nodes, nodes);
    if bytes.len() != expected {
        return Err(refused(format!("{} bytes instead of {expected}", bytes.len())));
    }
    let number = |k: usize| {
        let at = 16 + 8 * k;
        f64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight bytes"))
    };
    let mut table = RingTable { nodes, rgb: vec![[0.0; 3]; nodes * nodes] };
    for i in 0..nodes {
        let start = i * (1 + 10 * nodes);
        let near = |found: f64, node: f64| (found - node).abs() < 1e-6;
        if !near(number(start), table.angle(i)) {
            return Err(refused(format!("theta_i {i} is not a uniform node")));
        }
        for k in 0..nodes {
            let (at, r) = (start + 1 + 10 * k, nodes - 1 - k);
            let mean = FRAC_PI_2 - 0.5 * (number(at) + number(at + 1));
            if !near(mean, table.angle(r)) {
                return Err(refused(format!("theta_r {r} is not a uniform node")));
            }
            table.rgb[i * nodes + r] = [number(at + 2), number(at + 3), number(at + 4)];
        }
    }
    RingTable::new(nodes, table.rgb)
}

/// Moves `rgb` towards the grey of its luminance until no channel is negative.
pub fn into_gamut(rgb: [f64; 3]) -> [f64; 3] {
    // Luminance of linear Rec.709: ITU-R BT.709-6.
    let grey = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    let least = rgb.iter().copied().fold(f64::INFINITY, f64::min);
    if least >= 0.0 {
        return rgb;
    }
    if grey <= 0.0 {
        return [0.0; 3];
    }
    let part = grey / (grey - least);
    rgb.map(|x| (grey + part * (x - grey)).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> RingTable {
        let value = |k: usize| [0.1 + 0.01 * k as f64, 0.2, 0.3];
        RingTable::new(5, (0..25).map(value).collect()).unwrap()
    }

    #[test]
    fn a_table_is_read_back_and_has_the_size_of_the_formula() {
        let bytes = table().bytes();
        assert_eq!(bytes.len(), 16 + 5 * (8 + 80 * 5));
        assert_eq!(read(&bytes).unwrap(), table());
    }

    #[test]
    fn what_rise_would_show_black_is_refused() {
        let bytes = table().bytes();
        for len in [0, 3, 15, 100, bytes.len() - 1] {
            assert!(read(&bytes[..len]).is_err());
        }
        let mut other = bytes.clone();
        other[0] = 0;
        assert!(read(&other).is_err());
        assert!(RingTable::new(5, vec![[f64::NAN, 0.0, 0.0]; 25]).is_err());
        assert!(RingTable::new(5, vec![[-0.1, 0.0, 0.0]; 25]).is_err());
    }

    #[test]
    fn a_white_diffuser_returns_all_light() {
        let white = RingTable::new(10, vec![[1.0 / PI; 3]; 100]).unwrap();
        assert!(white.reflectance().iter().all(|x| (x - 1.0).abs() < 1e-12));
    }

    #[test]
    fn colours_out_of_gamut_keep_their_luminance() {
        let moved = into_gamut([0.5, 0.2, -0.1]);
        let luminance = |c: [f64; 3]| 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
        assert!(moved.iter().all(|x| *x >= 0.0) && moved[2] < 1e-15);
        assert!((luminance(moved) - luminance([0.5, 0.2, -0.1])).abs() < 1e-12);
    }
}
