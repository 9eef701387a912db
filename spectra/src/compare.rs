//! Comparison of a measured and a simulated spectrum.
//!
//! The simulated spectrum is brought to the measured wavelengths that it covers, by a cubic spline
//! (straight lines for uneven steps and fewer than four samples), never below zero if no sample is. With m measured and s simulated,
//!
//! | number | meaning |
//! | --- | --- |
//! | rms | √mean (m − s)² |
//! | scale | k = Σ m s/Σ s², which minimizes Σ (m − k s)² |
//! | scaled rms | √mean (m − k s)² |
//! | correlation | Pearson's coefficient |
//! | CIEDE2000 | of the two colours, and of the measured and the scaled one |
//!
//! Colours are those of reflectances on a scale on which a perfect diffuser is 1.

use crate::{
    difference::delta_e_2000,
    illuminant::Illuminant,
    interpolate::{cubic_spline, straight_lines},
    lab::{self, Lab},
    observer::Observer,
    spectrum::Spectrum,
    wavelength::GridError,
};

/// Wavelengths that a spectrum must cover, nm: less than 1 % of the colour lies outside.
pub const NEEDED_NM: [f64; 2] = [420.0, 680.0];
/// Wavelengths without which colours would be those of the extrapolation, nm.
const VISIBLE_NM: [f64; 2] = [400.0, 700.0];

/// The comparison of two spectra.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumComparison {
    /// The measured wavelengths that both cover, nm.
    pub wavelengths: Vec<f64>,
    /// Measured values there.
    pub measured: Vec<f64>,
    /// Simulated values there.
    pub simulated: Vec<f64>,
    /// Root of the mean square of the differences.
    pub rms: f64,
    /// The factor on the simulated values that minimizes the difference.
    pub scale: f64,
    /// Root of the mean square of the remaining difference.
    pub scaled_rms: f64,
    /// Correlation; none if one of the spectra is constant.
    pub correlation: Option<f64>,
    /// L\*a\*b\* of the measured, the simulated and the scaled spectrum.
    pub lab: [Lab; 3],
    /// CIEDE2000 between measured and simulated.
    pub delta_e: f64,
    /// CIEDE2000 between measured and scaled.
    pub scaled_delta_e: f64,
}

/// Errors of comparing two spectra.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CompareError {
    /// They have no visible wavelength in common, so that they have no colours.
    #[error(
        "no common wavelength is visible: they end at {first} and {last} nm; 400 to 700 nm are"
    )]
    Invisible {
        /// The shortest common wavelength, nm.
        first: f64,
        /// The longest common wavelength, nm.
        last: f64,
    },
    /// They have too few wavelengths in common.
    #[error(
        "the simulated spectrum covers {found} of the measured wavelengths ({measured} nm against \
         {simulated} nm); at least 3 are needed"
    )]
    Apart {
        /// Measured wavelengths that are covered.
        found: usize,
        /// Range of the measured spectrum.
        measured: String,
        /// Range of the simulated spectrum.
        simulated: String,
    },
    /// The simulated spectrum is zero.
    #[error(
        "the simulated spectrum is zero everywhere, so no factor brings it to the measured one"
    )]
    Zero,
    /// The common wavelengths are not a grid.
    #[error("{0}")]
    Grid(#[from] GridError),
}

/// Compares `simulated` with `measured`; their colours are those under `illuminant` for
/// `observer`.
///
/// # Errors
///
/// If they have fewer than three wavelengths in common, or the simulated one is zero.
pub fn compare(
    measured: &Spectrum,
    simulated: &Spectrum,
    illuminant: &Illuminant,
    observer: Observer,
) -> Result<SpectrumComparison, CompareError> {
    let known = simulated.grid().nm();
    let (first, last) = (known[0], known[known.len() - 1]);
    let all = measured.grid().nm();
    let (mut wavelengths, mut m) = (Vec::new(), Vec::new());
    for (nm, value) in all.iter().zip(measured.values()) {
        if (first..=last).contains(nm) {
            wavelengths.push(*nm);
            m.push(*value);
        }
    }
    if wavelengths.len() < 3 {
        let range = |list: &[f64]| format!("{} to {}", list[0], list[list.len() - 1]);
        let (measured, simulated) = (range(all), range(known));
        return Err(CompareError::Apart { found: wavelengths.len(), measured, simulated });
    }
    let (first, last) = (wavelengths[0], wavelengths[wavelengths.len() - 1]);
    if last < VISIBLE_NM[0] || first > VISIBLE_NM[1] {
        return Err(CompareError::Invisible { first, last });
    }
    let is_even = simulated.grid().step_nm().is_some();
    let spline = cubic_spline(known, simulated.values(), &wavelengths).filter(|_| is_even);
    let mut s = spline.unwrap_or_else(|| {
        let mut s = vec![0.0; m.len()];
        straight_lines(known, simulated.values(), &wavelengths, &mut s);
        s
    });
    if simulated.values().iter().all(|value| *value >= 0.0) {
        s.iter_mut().for_each(|value| *value = value.max(0.0));
    }
    let square = dot(&s, &s);
    if !(square > 0.0) {
        return Err(CompareError::Zero);
    }
    let scale = dot(&m, &s) / square;
    let scaled: Vec<f64> = s.iter().map(|s| scale * s).collect();
    let white = illuminant.white(observer);
    let colour = |values: &[f64]| -> Result<Lab, GridError> {
        let spectrum = Spectrum::new(&wavelengths, values)?;
        Ok(lab::from_xyz(spectrum.xyz(illuminant, observer), white))
    };
    let lab = [colour(&m)?, colour(&s)?, colour(&scaled)?];
    Ok(SpectrumComparison {
        rms: rms(&m, &s),
        scale,
        scaled_rms: rms(&m, &scaled),
        correlation: correlation(&m, &s),
        delta_e: delta_e_2000(lab[0], lab[1]),
        scaled_delta_e: delta_e_2000(lab[0], lab[2]),
        lab,
        wavelengths,
        measured: m,
        simulated: s,
    })
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn rms(a: &[f64], b: &[f64]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    (squares / a.len() as f64).sqrt()
}

fn correlation(a: &[f64], b: &[f64]) -> Option<f64> {
    let centred = |list: &[f64]| -> Vec<f64> {
        let mean = list.iter().sum::<f64>() / list.len() as f64;
        list.iter().map(|v| v - mean).collect()
    };
    let (a, b) = (centred(a), centred(b));
    let size = (dot(&a, &a) * dot(&b, &b)).sqrt();
    (size > 0.0).then(|| dot(&a, &b) / size)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spectrum(from: f64, step: f64, count: usize, value: fn(f64) -> f64) -> Spectrum {
        let nm: Vec<f64> = (0..count).map(|i| from + step * i as f64).collect();
        Spectrum::new(&nm, &nm.iter().map(|nm| value(*nm)).collect::<Vec<_>>()).unwrap()
    }

    fn compared(
        measured: &Spectrum,
        simulated: &Spectrum,
    ) -> Result<SpectrumComparison, CompareError> {
        let d65 = Illuminant::named("D65").unwrap();
        compare(measured, simulated, &d65, Observer::Cie1931_2)
    }

    #[test]
    fn half_a_spectrum_on_another_grid_has_the_factor_two() {
        let shape = |nm: f64| 0.4 + 0.3 * ((nm - 550.0) / 60.0).sin();
        let half = |nm: f64| 0.2 + 0.15 * ((nm - 550.0) / 60.0).sin();
        let found =
            compared(&spectrum(360.0, 10.0, 40, shape), &spectrum(380.0, 5.0, 70, half)).unwrap();
        assert_eq!(found.wavelengths, (38..=72).map(|i| f64::from(10 * i)).collect::<Vec<_>>());
        // The spline meets its knots; sums of some dozen numbers of order one.
        assert!((found.scale - 2.0).abs() < 1e-13 && found.scaled_rms < 1e-13, "{found:?}");
        assert!((found.correlation.unwrap() - 1.0).abs() < 1e-13);
        assert!(found.scaled_delta_e < 1e-9 && found.delta_e > 5.0);
    }

    #[test]
    fn equal_spectra_do_not_differ() {
        let flat = spectrum(400.0, 20.0, 16, |_| 0.5);
        let found = compared(&flat, &flat).unwrap();
        assert_eq!((found.rms, found.scale, found.delta_e), (0.0, 1.0, 0.0));
        assert_eq!(found.correlation, None);
    }

    #[test]
    fn spectra_that_do_not_meet_or_are_dark_are_refused() {
        let flat = |from, value| spectrum(from, 10.0, 10, value);
        let apart = compared(&flat(400.0, |_| 0.5), &flat(475.0, |_| 0.5));
        assert!(matches!(apart, Err(CompareError::Apart { found: 2, .. })), "{apart:?}");
        let infrared = flat(1000.0, |_| 0.5);
        let unseen = compared(&infrared, &infrared);
        assert_eq!(unseen, Err(CompareError::Invisible { first: 1000.0, last: 1090.0 }));
        let dark = compared(&flat(400.0, |_| 0.5), &flat(400.0, |_| 0.0));
        assert_eq!(dark, Err(CompareError::Zero));
    }
}
