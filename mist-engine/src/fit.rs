//! Fitting variables of a program to measured values, by least squares.
//!
//! $$ \chi^2(\mathbf{p}) = \sum_i \left(\frac{y_i - f_i(\mathbf{p})}{\sigma_i}\right)^2 $$
//!
//! is made least over the variables **p** by the Levenberg–Marquardt method of the crate
//! `rmpfit`. The f are outputs of the program, so the aperture of the instrument and whatever else
//! the program integrates over is part of the fit. The derivatives are central differences.
//!
//! With ν = data − variables, s² = χ²/ν and J the derivatives of the weighted residuals, the
//! covariance of the variables is s² (JᵀJ)⁻¹ and a variable's interval is its value ± t √C_ii with
//! Student's t for ν; with σ that are known ([`FitSettings::absolute`]), (JᵀJ)⁻¹ and the normal
//! distribution.
//!
//! Limits: the intervals are those of a model that is linear near the solution, with independent
//! errors. A minimum is a local one: it depends on the start.
//!
//! J. J. Moré, in *Numerical Analysis*, Lect. Notes Math. 630, 105 (1978); C. B. Markwardt, ASP
//! Conf. Ser. 411, 251 (2009).

mod cells;
mod compared;
mod covariance;
mod error;
mod measured;
mod result;
mod settings;
mod solve;

use crate::{Control, function::ProgramFunction};

pub use compared::{ComparedValue, compared};
pub use error::FitError;
pub use measured::{Datum, MeasuredError, MeasuredTable};
pub use result::{Fit, Fitted, Residuals};
pub use settings::FitSettings;

/// Fits the variables of `program` to `measured`.
///
/// # Errors
///
/// See [`FitError`].
pub fn fit(
    program: &ProgramFunction,
    measured: &MeasuredTable,
    settings: &FitSettings,
    control: &Control,
) -> Result<Fit, FitError> {
    solve::LeastSquares::new(program, measured, settings, control)?.solve()
}

#[cfg(test)]
mod tests;
