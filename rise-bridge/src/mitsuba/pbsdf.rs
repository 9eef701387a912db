//! `.pbsdf`: the Mueller BRDF in half and difference angles, for Mitsuba's `measured_polarized`.
//!
//! A tensor file with M[φ_d, θ_d, θ_h, λ, 4, 4] in 1/sr without a cosine, in the frame of
//! [`frame`](super::frame) (our basis `plane` with the other hand of V), and its axes. The table is
//! written slab by slab and is never whole in memory. No number in it is NaN: nodes below the
//! horizon are filled ([`asked_directions`]).
//!
//! S.-H. Baek et al., *Image-based acquisition and modeling of polarimetric reflectance*,
//! ACM Trans. Graph. 39(4), 139 (2020).

mod compare;
mod spread;
mod table;

use std::{
    io::Write,
    sync::atomic::{AtomicUsize, Ordering},
};

use mist_engine::{Control, material::MaterialError};
use rayon::prelude::*;
use scattering::{Basis, Mueller};

pub use compare::{Comparison, compare};
pub use spread::{Spread, choose_axes, spread};
pub use table::Table;

use super::{
    axes::{Axes, asked_directions},
    frame::{HalfAngles, with_other_hand},
};
use crate::{
    export::{Bands, ExportError},
    tensor::{Field, Kind, Writer},
};

/// Wavelengths that the reader in Mitsuba takes, whatever the file says.
pub const STOCK_WAVELENGTHS: usize = 5;
/// Largest table, bytes.
const MOST_BYTES: u64 = 1 << 36;
/// Numbers that are held in memory at a time: 8 MB.
const CHUNK: usize = 1 << 21;

/// The models of a table for `wavelengths` (nm); with `stock`, for Mitsuba's own reader.
///
/// # Errors
///
/// As [`Bands::new`]; for materials that are not isotropic, wavelengths that are no whole numbers
/// to 65535, and other than five of them if `stock`.
pub fn bands(
    material: &mist_engine::material::Prepared,
    wavelengths: &[f64],
    stock: bool,
) -> Result<Bands, ExportError> {
    let count = wavelengths.len();
    if stock && count != STOCK_WAVELENGTHS {
        let problem = format!(
            "{count} of them: Mitsuba's reader takes exactly {STOCK_WAVELENGTHS} and renders \
             wrongly with more; give five, or write the table for our plugin, which takes any \
             number"
        );
        return Err(ExportError::refused("wavelengths", problem));
    }
    let whole = |nm: &f64| nm.fract() == 0.0 && (1.0..=65535.0).contains(nm);
    if let Some(odd) = wavelengths.iter().find(|nm| !whole(nm)) {
        let problem = format!("{odd} nm: the format has whole nanometres only");
        return Err(ExportError::refused("wavelengths", problem));
    }
    Bands::new(material, wavelengths)?.isotropic("a .pbsdf")
}

/// Writes the table of `bands` on `axes`; `description` goes along as a field of its own.
///
/// # Errors
///
/// For tables of more than 64 GiB, models that are not finite somewhere, a wish to stop, and an
/// `out` that does not take the data.
pub fn write<W: Write>(
    bands: &Bands,
    axes: &Axes,
    description: &str,
    out: W,
    control: &Control,
) -> Result<W, ExportError> {
    let [n_phi, n_d, n_h] = axes.counts();
    let n_waves = bands.nm().len();
    let row = n_h * n_waves * 16;
    let bytes = (n_phi * n_d) as u64 * row as u64 * 4;
    if bytes > MOST_BYTES {
        let problem = format!("the table would have {bytes} bytes, more than {MOST_BYTES}");
        return Err(ExportError::refused("grid", problem));
    }
    let mut file = Writer::begin(out, fields(axes, n_waves, description))?;
    file.bytes(description.as_bytes())?;
    file.f32s(axes.phi_d.iter().copied())?;
    file.f32s(axes.theta_d.iter().copied())?;
    file.f32s(axes.theta_h.iter().copied())?;
    // Whole numbers to 65535: `bands` has looked.
    let nm: Vec<u8> = bands.nm().iter().flat_map(|nm| (*nm as u16).to_le_bytes()).collect();
    file.bytes(&nm)?;

    let (rows, done) = (n_phi * n_d, AtomicUsize::new(0));
    let step = (CHUNK / row).max(1);
    for first in (0..rows).step_by(step) {
        let one = |at: usize| {
            if control.is_cancelled() {
                return Err(ExportError::Cancelled);
            }
            let numbers = row_of(bands, axes, [at / n_d, at % n_d])?;
            control.report((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / rows as f64);
            Ok(numbers)
        };
        let chunk: Result<Vec<Vec<f32>>, ExportError> =
            (first..(first + step).min(rows)).into_par_iter().map(one).collect();
        for numbers in chunk? {
            file.f32s(numbers)?;
        }
    }
    Ok(file.finish()?)
}

fn fields(axes: &Axes, waves: usize, description: &str) -> Vec<Field> {
    let [n_phi, n_d, n_h] = axes.counts();
    vec![
        Field::new("description", Kind::U8, &[description.len()]),
        Field::new("phi_d", Kind::F32, &[1, n_phi]),
        Field::new("theta_d", Kind::F32, &[1, n_d]),
        Field::new("theta_h", Kind::F32, &[1, n_h]),
        Field::new("wvls", Kind::U16, &[waves]),
        Field::new("M", Kind::F32, &[n_phi, n_d, n_h, waves, 4, 4]),
    ]
}

/// The numbers of all θ_h and wavelengths at one φ_d and θ_d.
fn row_of(bands: &Bands, axes: &Axes, [i, j]: [usize; 2]) -> Result<Vec<f32>, ExportError> {
    let mut numbers = Vec::with_capacity(axes.theta_h.len() * bands.nm().len() * 16);
    for k in 0..axes.theta_h.len() {
        let at = axes.node([i, j, k]);
        for (m, nm) in matrices(bands, &at).zip(bands.nm()) {
            let start = numbers.len();
            numbers.extend(m.to_row_major().map(|x| x as f32));
            if numbers[start..].iter().any(|x| !x.is_finite()) {
                let HalfAngles { phi_d, theta_d, theta_h } = at;
                let [phi_d, theta_d, theta_h] = [phi_d, theta_d, theta_h].map(f64::to_degrees);
                let place = format!(
                    "phi_d {phi_d:.3}, theta_d {theta_d:.3}, theta_h {theta_h:.3} degrees, {nm} nm"
                );
                return Err(MaterialError::NotFinite(place).into());
            }
        }
    }
    Ok(numbers)
}

/// The matrices of a table at one node, per wavelength.
fn matrices<'b>(bands: &'b Bands, at: &HalfAngles) -> impl Iterator<Item = Mueller> + use<'b> {
    let (l, v) = asked_directions(at);
    bands.matrices(l, v, Basis::Plane).map(with_other_hand)
}
