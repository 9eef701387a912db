//! Fourier transforms of pictures, and filters as functions of spatial frequency.
//!
//! A spectrum has the columns k_x = 0 … ⌊w/2⌋ one after the other, each with the frequencies
//! k_y = 0 … h−1; frequencies above h/2 are negative. A filter has one real number per frequency.

use std::sync::Arc;

use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex, num_complex::Complex64};
use rustfft::{Fft, FftPlanner};

/// Rows or columns per block, so that a cache line is read once.
const BLOCK: usize = 8;

/// Transforms of pictures of one size.
pub(super) struct Transform {
    width: usize,
    height: usize,
    row_forward: Arc<dyn RealToComplex<f64>>,
    row_back: Arc<dyn ComplexToReal<f64>>,
    column_forward: Arc<dyn Fft<f64>>,
    column_back: Arc<dyn Fft<f64>>,
}

/// The spectrum of a picture.
pub(super) struct PictureSpectrum(Vec<Complex64>);

/// A spatial frequency in cycles per pixel, and in whole cycles per picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frequency {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) cycles: [i64; 2],
}

impl Frequency {
    pub(super) fn radius(self) -> f64 {
        self.x.hypot(self.y)
    }

    /// Orientation in radians, −π/2 … π/2.
    pub(super) fn angle(self) -> f64 {
        self.y.atan2(self.x)
    }
}

impl Transform {
    pub(super) fn new(width: usize, height: usize) -> Self {
        let (mut rows, mut columns) = (RealFftPlanner::new(), FftPlanner::new());
        Self {
            width,
            height,
            row_forward: rows.plan_fft_forward(width),
            row_back: rows.plan_fft_inverse(width),
            column_forward: columns.plan_fft_forward(height),
            column_back: columns.plan_fft_inverse(height),
        }
    }

    pub(super) fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    fn columns(&self) -> usize {
        self.width / 2 + 1
    }

    /// The filter whose value is `value` at each frequency.
    pub(super) fn filter(&self, value: impl Fn(Frequency) -> f64 + Sync) -> Vec<f64> {
        let [width, height] = self.size();
        let at = |index: usize| {
            let (kx, ky) = ((index / height) as i64, (index % height) as i64);
            let ky = if 2 * ky > height as i64 { ky - height as i64 } else { ky };
            let (x, y) = (kx as f64 / width as f64, ky as f64 / height as f64);
            value(Frequency { x, y, cycles: [kx, ky] })
        };
        (0..self.columns() * height).into_par_iter().map(at).collect()
    }

    /// The spectrum of `picture`.
    pub(super) fn spectrum(&self, picture: &[f64]) -> PictureSpectrum {
        let (half, height) = (self.columns(), self.height);
        let mut by_row = vec![Complex64::default(); half * height];
        by_row.par_chunks_mut(half).zip(picture.par_chunks(self.width)).for_each_init(
            || (self.row_forward.make_input_vec(), self.row_forward.make_scratch_vec()),
            |(input, scratch), (row, values)| {
                input.copy_from_slice(values);
                self.row_forward
                    .process_with_scratch(input, row, scratch)
                    .expect("the lengths are those of the plan");
            },
        );
        let mut spectrum = vec![Complex64::default(); half * height];
        spectrum.par_chunks_mut(BLOCK * height).enumerate().for_each(|(block, columns)| {
            let count = columns.len() / height;
            for y in 0..height {
                let row = &by_row[y * half + block * BLOCK..][..count];
                for (column, value) in row.iter().enumerate() {
                    columns[column * height + y] = *value;
                }
            }
            self.column_forward.process(columns);
        });
        PictureSpectrum(spectrum)
    }

    /// The picture whose spectrum is `spectrum` times `filter`.
    pub(super) fn picture(&self, spectrum: &PictureSpectrum, filter: &[f64]) -> Vec<f64> {
        let (half, height) = (self.columns(), self.height);
        // The transforms do not divide by the number of pixels.
        let scale = 1.0 / (self.width * height) as f64;
        let mut columns: Vec<Complex64> =
            spectrum.0.par_iter().zip(filter).map(|(value, by)| value * (by * scale)).collect();
        columns
            .par_chunks_mut(BLOCK * height)
            .for_each(|columns| self.column_back.process(columns));
        let mut picture = vec![0.0; self.width * height];
        picture.par_chunks_mut(BLOCK * self.width).enumerate().for_each_init(
            || (vec![Complex64::default(); BLOCK * half], self.row_back.make_scratch_vec()),
            |(rows, scratch), (block, out)| {
                let count = out.len() / self.width;
                for kx in 0..half {
                    let column = &columns[kx * height + block * BLOCK..][..count];
                    for (row, value) in column.iter().enumerate() {
                        rows[row * half + kx] = *value;
                    }
                }
                for (row, out) in rows.chunks_mut(half).zip(out.chunks_mut(self.width)) {
                    // The spectrum of a real picture is real here; odd filters leave imaginary parts.
                    row[0].im = 0.0;
                    if self.width.is_multiple_of(2) {
                        row[half - 1].im = 0.0;
                    }
                    self.row_back
                        .process_with_scratch(row, out, scratch)
                        .expect("the lengths are those of the plan");
                }
            },
        );
        picture
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_filter_of_one_gives_the_picture_back_for_even_and_odd_sizes() {
        for (width, height) in [(16, 12), (15, 9), (2, 2), (24, 35)] {
            let picture: Vec<f64> =
                (0..width * height).map(|i| (i as f64 * 0.37).sin() + 0.01 * i as f64).collect();
            let transform = Transform::new(width, height);
            let back = transform.picture(&transform.spectrum(&picture), &transform.filter(|_| 1.0));
            for (before, after) in picture.iter().zip(&back) {
                // Rounding of sums of a few hundred numbers of order one.
                assert!((before - after).abs() < 1e-13, "{width}×{height}: {before} {after}");
            }
        }
    }

    #[test]
    fn a_wave_stands_at_its_frequency() {
        let (width, height) = (20, 12);
        let wave = |x: usize, y: usize| {
            let phase = 3.0 * x as f64 / width as f64 - 2.0 * y as f64 / height as f64;
            (std::f64::consts::TAU * phase).cos()
        };
        let picture: Vec<f64> = (0..width * height).map(|i| wave(i % width, i / width)).collect();
        let transform = Transform::new(width, height);
        let only = transform.filter(|f| f64::from(u8::from(f.cycles == [3, -2])));
        let back = transform.picture(&transform.spectrum(&picture), &only);
        for (before, after) in picture.iter().zip(&back) {
            assert!((before - after).abs() < 1e-13, "{before} {after}");
        }
    }
}
