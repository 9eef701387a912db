//! Writes a `.pbsdf`.

use std::{
    io::Write,
    sync::atomic::{AtomicUsize, Ordering},
};

use mist_engine::{Control, material::MaterialError};
use rayon::prelude::*;

use super::{
    super::{axes::HalfAngleAxes, frame::HalfAngles},
    models::matrices,
};
use crate::{
    export::{Bands, ExportError},
    tensor::{NumberType, TensorField, TensorWriter},
};

/// The largest table in bytes.
const MOST_BYTES: u64 = 1 << 36;
/// Numbers per part that is written at once: 8 MB.
const PART: usize = 1 << 21;

/// Writes the table of `bands` on `axes`, with `description` as a field.
///
/// # Errors
///
/// If the table exceeds 64 GiB or a value is not finite, on cancellation, and if `out` fails.
pub fn write<W: Write>(
    bands: &Bands,
    axes: &HalfAngleAxes,
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
    let mut file = TensorWriter::begin(out, fields(axes, n_waves, description))?;
    file.bytes(description.as_bytes())?;
    file.f32s(axes.phi_d.iter().copied())?;
    file.f32s(axes.theta_d.iter().copied())?;
    file.f32s(axes.theta_h.iter().copied())?;
    // `bands` has checked that they are whole numbers up to 65535.
    let nm: Vec<u8> = bands.nm().iter().flat_map(|nm| (*nm as u16).to_le_bytes()).collect();
    file.bytes(&nm)?;

    let (rows, done) = (n_phi * n_d, AtomicUsize::new(0));
    let step = (PART / row).max(1);
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

fn fields(axes: &HalfAngleAxes, waves: usize, description: &str) -> Vec<TensorField> {
    let [n_phi, n_d, n_h] = axes.counts();
    vec![
        TensorField::new("description", NumberType::U8, &[description.len()]),
        TensorField::new("phi_d", NumberType::F32, &[1, n_phi]),
        TensorField::new("theta_d", NumberType::F32, &[1, n_d]),
        TensorField::new("theta_h", NumberType::F32, &[1, n_h]),
        TensorField::new("wvls", NumberType::U16, &[waves]),
        TensorField::new("M", NumberType::F32, &[n_phi, n_d, n_h, waves, 4, 4]),
    ]
}

/// The numbers of all θ_h and wavelengths at one φ_d and θ_d.
fn row_of(
    bands: &Bands,
    axes: &HalfAngleAxes,
    [i, j]: [usize; 2],
) -> Result<Vec<f32>, ExportError> {
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
