//! The least squares problem: residuals and derivatives from runs of the program, the
//! Levenberg–Marquardt method from a crate, then what the minimum says.

use std::collections::BTreeMap;

use rmpfit::{MPConfig, MPError, MPFitter, MPPar, MPResult, MPSide, MPSuccess};
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use super::{
    covariance,
    error::FitError,
    measured::MeasuredTable,
    result::{Fit, Fitted, Residuals},
    settings::FitSettings,
};
use crate::{
    Control, Failure,
    function::{FunctionValues, OutputRow, ProgramFunction},
};

/// Residual where the program cannot be run: so large that the step is taken back, so small that
/// its square is finite.
const REFUSED: f64 = 1e30;

/// Changes of χ² and of the variables, relative, and cosines between residuals and derivatives,
/// below which a minimum is reached.
const REACHED: f64 = 1e-10;

/// A way to run the program: with or without the columns of its loops.
type RunFunction = fn(&ProgramFunction, &[f64], &Control) -> Result<FunctionValues, Failure>;

/// A fit under way.
pub(super) struct LeastSquares<'a> {
    program: &'a ProgramFunction,
    measured: &'a MeasuredTable,
    settings: &'a FitSettings,
    control: &'a Control,
    start: Vec<f64>,
    parameters: Vec<MPPar>,
    config: MPConfig,
    /// The line of the results that each datum is about.
    lines: Vec<usize>,
    runs: usize,
    iterations: usize,
    /// The variables of the last run and its residuals: the solver asks again for the point that
    /// it has accepted.
    last: Option<(Vec<f64>, Vec<f64>)>,
    /// The error that ended the fit.
    broken: Option<FitError>,
}

impl<'a> LeastSquares<'a> {
    pub(super) fn new(
        program: &'a ProgramFunction,
        measured: &'a MeasuredTable,
        settings: &'a FitSettings,
        control: &'a Control,
    ) -> Result<Self, FitError> {
        check(settings)?;
        let mut start = program.start().to_vec();
        let by_name = ByName(program.names());
        for (name, value) in by_name.find(&settings.start)? {
            start[name] = *value;
        }
        let mut parameters: Vec<MPPar> = start.iter().map(|_| free()).collect();
        for (at, [low, high]) in by_name.find(&settings.bounds)? {
            if !(low < high && (*low..=*high).contains(&start[at])) {
                let problem =
                    format!("the bounds {low} to {high} do not hold its start {}", start[at]);
                return Err(FitError::Setting { name: program.names()[at].clone(), problem });
            }
            let limits = MPPar { limited_low: true, limited_up: true, ..free() };
            parameters[at] = MPPar { limit_low: *low, limit_up: *high, ..limits };
        }
        let (data, variables) = (measured.data().len(), start.len());
        if data <= variables {
            return Err(FitError::TooFewData { data, variables });
        }
        let mut problem = Self {
            program,
            measured,
            settings,
            control,
            start,
            parameters,
            config: MPConfig {
                ftol: REACHED,
                xtol: REACHED,
                gtol: REACHED,
                max_iter: settings.iterations,
                ..MPConfig::default()
            },
            lines: Vec::new(),
            runs: 0,
            iterations: 0,
            last: None,
            broken: None,
        };
        let rows = problem.run(&problem.start.clone(), ProgramFunction::run)?;
        problem.lines = measured.locate(&rows, &program.titles()[0])?;
        Ok(problem)
    }

    pub(super) fn solve(mut self) -> Result<Fit, FitError> {
        let mut values = self.start.clone();
        let done = self.mpfit(&mut values);
        if let Some(broken) = self.broken.take() {
            return Err(broken);
        }
        let (success, iterations) = match done {
            Ok(status) => (status.success, status.n_iter),
            Err(MPError::Nan) => (MPSuccess::NotDone, self.iterations),
            Err(_) => unreachable!("the arguments were checked, and runs say why they break"),
        };
        if matches!(success, MPSuccess::MaxIter | MPSuccess::NotDone) {
            let values = self.named(&values);
            return Err(FitError::NotConverged { iterations, values });
        }
        self.conclude(&values, iterations)
    }

    /// Result of the fit at the minimum `values`.
    fn conclude(mut self, values: &[f64], iterations: usize) -> Result<Fit, FitError> {
        let residuals = self.residuals(values)?;
        let at_bound = |at: &usize| {
            let bounds = &self.parameters[*at];
            (bounds.limited_low && values[*at] <= bounds.limit_low)
                || (bounds.limited_up && values[*at] >= bounds.limit_up)
        };
        let free: Vec<usize> = (0..values.len()).filter(|at| !at_bound(at)).collect();
        let columns = free.iter().map(|at| self.derivative(values, *at));
        let columns: Vec<Vec<f64>> = columns.collect::<Result<_, _>>()?;
        let inverse = covariance::inverse(&columns).map_err(|found| {
            let name = |column: &usize| self.program.names()[free[*column]].clone();
            let with = found.explained_by.iter().map(name).collect();
            FitError::NotIdentifiable { name: name(&found.column), with }
        })?;
        let freedom = residuals.len() - free.len();
        let chi_squared: f64 = residuals.iter().map(|r| r * r).sum();
        let reduced = chi_squared / freedom as f64;
        let scale = if self.settings.absolute { 1.0 } else { reduced };
        let times = quantile(self.settings, freedom);
        let mut parameters = Vec::new();
        for (at, value) in values.iter().enumerate() {
            let column = free.iter().position(|each| *each == at);
            let error = column.map(|column| (scale * inverse[column][column]).sqrt());
            parameters.push(Fitted {
                name: self.program.names()[at].clone(),
                start: self.start[at],
                value: *value,
                standard_error: error,
                interval: error.map(|error| [value - times * error, value + times * error]),
                at_bound: column.is_none(),
            });
        }
        let mut correlation = vec![vec![0.0; values.len()]; values.len()];
        for (i, a) in free.iter().enumerate() {
            for (j, b) in free.iter().enumerate() {
                let product = (inverse[i][i] * inverse[j][j]).sqrt();
                correlation[*a][*b] = if i == j { 1.0 } else { inverse[i][j] / product };
            }
        }
        Ok(Fit {
            parameters,
            confidence: self.settings.confidence,
            absolute: self.settings.absolute,
            correlation,
            residuals: self.summary(&residuals, freedom, chi_squared),
            iterations,
            runs: self.runs,
            ignored: self.measured.ignored().to_vec(),
        })
    }

    fn summary(&self, residuals: &[f64], freedom: usize, chi_squared: f64) -> Residuals {
        let data = self.measured.data();
        let reduced = chi_squared / freedom as f64;
        let plain: Vec<f64> = residuals.iter().zip(data).map(|(r, d)| r * d.sigma).collect();
        let computed: Vec<f64> = plain.iter().zip(data).map(|(r, d)| d.value - r).collect();
        let measured: Vec<f64> = data.iter().map(|d| d.value).collect();
        let larger = |a: &usize, b: &usize| residuals[*a].abs().total_cmp(&residuals[*b].abs());
        let worst = (0..residuals.len()).max_by(larger).unwrap_or_default();
        let output = self.program.titles()[1][data[worst].output].clone();
        let largest = residuals[worst].abs() / reduced.sqrt();
        Residuals {
            data: data.len(),
            degrees_of_freedom: freedom,
            chi_squared,
            reduced_chi_squared: reduced,
            rms: (plain.iter().map(|r| r * r).sum::<f64>() / data.len() as f64).sqrt(),
            largest: if largest.is_finite() { largest } else { 0.0 },
            largest_at: (data[worst].row, output),
            correlation: correlation(&measured, &computed),
        }
    }

    fn named(&self, values: &[f64]) -> Vec<(String, f64)> {
        self.program.names().iter().cloned().zip(values.iter().copied()).collect()
    }

    fn run(&mut self, values: &[f64], how: RunFunction) -> Result<Vec<OutputRow>, FitError> {
        self.runs += 1;
        match how(self.program, values, self.control) {
            Ok(ran) => Ok(ran.rows),
            Err(Failure::Cancelled) => Err(FitError::Cancelled),
            Err(failure) => Err(FitError::Run { values: self.named(values), failure }),
        }
    }

    /// (measured − computed)/σ.
    fn residuals(&mut self, values: &[f64]) -> Result<Vec<f64>, FitError> {
        if let Some((known, residuals)) = &self.last
            && known == values
        {
            return Ok(residuals.clone());
        }
        let residuals = self.computed_residuals(values)?;
        self.last = Some((values.to_vec(), residuals.clone()));
        Ok(residuals)
    }

    /// [`LeastSquares::residuals`] by a run of the program.
    fn computed_residuals(&mut self, values: &[f64]) -> Result<Vec<f64>, FitError> {
        let rows = self.run(values, ProgramFunction::outputs)?;
        let data = self.measured.data().iter().zip(&self.lines);
        data.map(|(datum, line)| {
            let computed = rows.get(*line).map_or(f64::NAN, |row| row.outputs[datum.output]);
            if computed.is_finite() {
                return Ok((datum.value - computed) / datum.sigma);
            }
            let output = self.program.titles()[1][datum.output].clone();
            Err(FitError::NotFinite { values: self.named(values), output, value: computed })
        })
        .collect()
    }

    /// Derivatives of the residuals by variable `at`: central differences, one-sided where the
    /// other side is out of bounds or refused by the model.
    fn derivative(&mut self, values: &[f64], at: usize) -> Result<Vec<f64>, FitError> {
        let size = values[at].abs().max(1e-3 * self.start[at].abs());
        let step = self.settings.step * if size > 0.0 { size } else { 1.0 };
        let bounds = &self.parameters[at];
        let low = if bounds.limited_low { bounds.limit_low } else { f64::NEG_INFINITY };
        let high = if bounds.limited_up { bounds.limit_up } else { f64::INFINITY };
        let ends = [(values[at] - step).max(low), (values[at] + step).min(high)];
        let mut sides = Vec::new();
        for end in ends {
            let mut moved = values.to_vec();
            moved[at] = end;
            sides.push(self.computed_residuals(&moved).map(|residuals| (end, residuals)));
        }
        let [below, above] = <[_; 2]>::try_from(sides).expect("two ends give two sides");
        let (below, above) = match (below, above) {
            (Err(FitError::Cancelled), _) | (_, Err(FitError::Cancelled)) => {
                return Err(FitError::Cancelled);
            }
            (Ok(below), Ok(above)) => (below, above),
            (Ok(below), Err(_)) => (below, (values[at], self.residuals(values)?)),
            (Err(_), Ok(above)) => ((values[at], self.residuals(values)?), above),
            (Err(error), Err(_)) => return Err(error),
        };
        let width = above.0 - below.0;
        Ok(above.1.iter().zip(&below.1).map(|(a, b)| (a - b) / width).collect())
    }

    /// Keeps `error`, which ends the fit.
    fn break_off(&mut self, error: FitError) -> MPError {
        self.broken = Some(error);
        MPError::Eval
    }
}

impl MPFitter for LeastSquares<'_> {
    fn eval(&mut self, values: &[f64], deviates: &mut [f64]) -> MPResult<()> {
        match self.residuals(values) {
            Ok(residuals) => deviates.copy_from_slice(&residuals),
            Err(FitError::Cancelled) => return Err(self.break_off(FitError::Cancelled)),
            // The model does not exist there: a step to be taken back, unless it is the first.
            Err(error) if self.runs <= 2 => return Err(self.break_off(error)),
            Err(_) => deviates.fill(REFUSED),
        }
        Ok(())
    }

    fn number_of_points(&self) -> usize {
        self.measured.data().len()
    }

    fn config(&self) -> &MPConfig {
        &self.config
    }

    fn parameters(&self) -> &[MPPar] {
        &self.parameters
    }

    fn jacobian(
        &mut self,
        values: &[f64],
        deviates: &mut [f64],
        derivatives: &mut [Option<Vec<f64>>],
    ) -> MPResult<()> {
        self.iterations += 1;
        // A fit takes about ten iterations; the bar nears its end and never reaches it.
        self.control.report(1.0 - (-(self.iterations as f64) / 10.0).exp());
        self.eval(values, deviates)?;
        for (at, column) in derivatives.iter_mut().enumerate() {
            if let Some(column) = column {
                match self.derivative(values, at) {
                    Ok(derivative) => column.copy_from_slice(&derivative),
                    Err(error) => return Err(self.break_off(error)),
                }
            }
        }
        Ok(())
    }
}

fn free() -> MPPar {
    MPPar { side: MPSide::User, ..MPPar::default() }
}

/// Settings by the number of their variable.
struct ByName<'a>(&'a [String]);

impl ByName<'_> {
    fn find<'s, T>(
        &self,
        settings: &'s BTreeMap<String, T>,
    ) -> Result<Vec<(usize, &'s T)>, FitError> {
        let find = |(name, value): (&String, &'s T)| {
            let same = |each: &String| each == name || each.strip_prefix('#') == Some(name);
            let at = self.0.iter().position(same);
            at.map(|at| (at, value)).ok_or_else(|| FitError::Setting {
                name: name.clone(),
                problem: "it is not one of the variables that vary".into(),
            })
        };
        settings.iter().map(find).collect()
    }
}

fn check(settings: &FitSettings) -> Result<(), FitError> {
    let wrong = |name: &str, problem: &str| {
        Err(FitError::Setting { name: name.into(), problem: problem.into() })
    };
    if !(settings.step > 0.0 && settings.step < 1.0) {
        return wrong("the step", "it must lie between 0 and 1");
    }
    if !(settings.confidence > 0.0 && settings.confidence < 1.0) {
        return wrong("the confidence", "it must lie between 0 and 1");
    }
    if settings.iterations == 0 {
        return wrong("the iterations", "there must be at least one");
    }
    match settings.start.iter().find(|(_, value)| !value.is_finite()) {
        Some((name, _)) => wrong(name, "its start is not a finite number"),
        None => Ok(()),
    }
}

/// Half width of an interval in standard errors.
fn quantile(settings: &FitSettings, freedom: usize) -> f64 {
    let upper = 0.5 + 0.5 * settings.confidence;
    if settings.absolute {
        Normal::standard().inverse_cdf(upper)
    } else {
        let student = StudentsT::new(0.0, 1.0, freedom as f64);
        student.expect("there are degrees of freedom").inverse_cdf(upper)
    }
}

/// Pearson's correlation; none if a list does not vary.
fn correlation(a: &[f64], b: &[f64]) -> Option<f64> {
    let mean = |list: &[f64]| list.iter().sum::<f64>() / list.len() as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let pairs = || a.iter().zip(b).map(|(a, b)| (a - mean_a, b - mean_b));
    let products = pairs().map(|(a, b)| a * b).sum::<f64>();
    let squares =
        pairs().map(|(a, _)| a * a).sum::<f64>() * pairs().map(|(_, b)| b * b).sum::<f64>();
    (squares > 0.0).then(|| products / squares.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_students_t() {
        let settings = FitSettings::default();
        // Tables of Student's distribution, three decimals.
        for (freedom, expected) in [(1, 12.706), (5, 2.571), (30, 2.042), (120, 1.980)] {
            assert!((quantile(&settings, freedom) - expected).abs() < 6e-4, "{freedom}");
        }
        let absolute = FitSettings { absolute: true, ..settings };
        assert!((quantile(&absolute, 5) - 1.959964).abs() < 1e-6);
    }
}
