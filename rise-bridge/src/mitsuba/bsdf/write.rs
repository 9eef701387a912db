//! Writes a `.bsdf`.

use std::{
    io::Write,
    sync::atomic::{AtomicUsize, Ordering},
};

use mist_engine::Control;
use rayon::prelude::*;

use super::{
    sampler::{BsdfSampler, ViewerImages},
    size::{BsdfChannels, BsdfSize},
};
use crate::{
    export::{Bands, ExportError},
    tensor::TensorWriter,
};

/// Writes the table of `bands`, with `description` as a field.
///
/// # Errors
///
/// If an anisotropic material has one azimuth, if a value is not finite, on cancellation, and if
/// `out` fails.
pub fn write<W: Write>(
    bands: &Bands,
    channels: BsdfChannels,
    size: BsdfSize,
    description: &str,
    out: W,
    control: &Control,
) -> Result<W, ExportError> {
    let sampler = BsdfSampler::new(bands, channels, size)?;
    let mut file = TensorWriter::begin(out, sampler.fields(description))?;
    file.bytes(description.as_bytes())?;
    file.bytes(&[1])?;
    file.f32s(sampler.thetas.iter().map(|x| *x as f32))?;
    file.f32s(sampler.phis.iter().map(|x| *x as f32))?;
    // Two equal rows: the density does not depend on the azimuth.
    file.f32s(sampler.ndf.iter().chain(&sampler.ndf).copied())?;
    file.f32s([1.0; 4])?;
    file.f32s(std::iter::repeat_n(1.0, size.phi_i * size.theta_i * 4))?;
    if channels == BsdfChannels::Spectra {
        file.f32s(bands.nm().iter().map(|nm| *nm as f32))?;
    }
    let viewers = size.phi_i * size.theta_i;
    let (mut luminance, done) = (Vec::new(), AtomicUsize::new(0));
    let step = rayon::current_num_threads().max(1);
    for first in (0..viewers).step_by(step) {
        let images: Result<Vec<ViewerImages>, ExportError> = (first..(first + step).min(viewers))
            .into_par_iter()
            .map(|at| {
                let images = sampler.images([at / size.theta_i, at % size.theta_i], control)?;
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                control.report(done as f64 / viewers as f64);
                Ok(images)
            })
            .collect();
        for images in images? {
            file.f32s(images.values)?;
            luminance.extend(images.luminance);
        }
    }
    file.f32s(luminance)?;
    Ok(file.finish()?)
}
