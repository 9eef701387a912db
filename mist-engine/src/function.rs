//! A program as a function of some of its variables.
//!
//! The program is compiled once. [`Job::with_values`] gives entries of VARIABLES other values, from
//! memory; everything else, apertures and loops included, stays what the program says. If these values
//! are parameters of the model alone, the loops are replayed once for all runs.

use std::{
    io,
    sync::{Arc, OnceLock},
};

use mist_format::{Diagnostic, program::VariableKind, suggestion::did_you_mean};

use crate::{
    Control, Failure, Files, Job, Options, OutputStream, Sink, TableLine,
    colour::ColourTable,
    compile::{compile, early_constants, initial_values},
    run::ReusableSteps,
};

/// A variable of a job that is one number and that no loop changes.
#[derive(Clone, Debug, PartialEq)]
pub struct JobVariable {
    name: String,
    value: f64,
    entry: usize,
}

impl JobVariable {
    /// Its name, as the program writes it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The value that the program gives it.
    pub fn value(&self) -> f64 {
        self.value
    }
}

/// A compiled program and the variables that are its arguments.
pub struct ProgramFunction {
    job: Job,
    variables: Vec<JobVariable>,
    names: Vec<String>,
    start: Vec<f64>,
    titles: [Vec<String>; 2],
    headers: Vec<String>,
    /// The steps of the first run, if the variables change nothing but parameters of the model.
    steps: OnceLock<Option<ReusableSteps>>,
}

/// One run of a program.
#[derive(Debug, Default)]
pub struct FunctionValues {
    /// The lines of the results.
    pub rows: Vec<OutputRow>,
    /// The colours, if the program has a section COLOR.
    pub colour: Option<ColourTable>,
    /// True if the rows have the columns of the loops.
    shows: bool,
}

/// A line of the results, unrounded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OutputRow {
    /// The columns of the loops, unless only outputs were asked for.
    pub loops: Vec<String>,
    /// The outputs.
    pub outputs: Vec<f64>,
}

/// Reason why a variable cannot be varied.
#[derive(Debug, thiserror::Error)]
pub enum FunctionError {
    /// No variables were named.
    #[error("no variable is named that should vary")]
    Nothing,
    /// There is no such variable.
    #[error("the program has no variable {name:?}{}", suggestion(.help))]
    Unknown {
        /// The name.
        name: String,
        /// Suggested name.
        help: Option<String>,
    },
    /// The variable is named twice, or assigned more than once in the program.
    #[error("{0:?} is named or assigned more than once; it must have one value in VARIABLES")]
    Twice(String),
    /// A loop writes the variable.
    #[error("{0:?} is varied by a loop of the program; take the loop out or name another variable")]
    Looped(String),
    /// The variable is not a number.
    #[error("{0:?} is not one number, so it cannot vary")]
    NoNumber(String),
    /// The program cannot be compiled.
    #[error("the program is wrong")]
    Program(Vec<Diagnostic>),
}

fn suggestion(help: &Option<String>) -> String {
    help.as_ref().map_or_else(String::new, |help| format!("; {help}"))
}

impl ProgramFunction {
    /// The program `source` as a function of the variables `names`. A parameter of the model is
    /// named with or without its `#`.
    ///
    /// # Errors
    ///
    /// If the program is wrong, or one of the variables cannot vary.
    pub fn new(
        source: &str,
        files: Arc<dyn Files + Send + Sync>,
        options: Options,
        names: &[String],
    ) -> Result<Self, FunctionError> {
        let job = compile(source, files, &options).map_err(FunctionError::Program)?;
        if names.is_empty() {
            return Err(FunctionError::Nothing);
        }
        let mut variables: Vec<JobVariable> = Vec::new();
        for name in names {
            let variable = job.variable(name)?;
            if variables.contains(&variable) {
                return Err(FunctionError::Twice(variable.name));
            }
            variables.push(variable);
        }
        let start = variables.iter().map(JobVariable::value).collect();
        let names = variables.iter().map(|variable| variable.name.clone()).collect();
        let titles = job.columns().map(|titles| titles.into_iter().map(str::to_owned).collect());
        let headers = job.program().files.headers();
        let headers = headers.map(|header| header.as_str().to_owned()).collect();
        Ok(Self { job, variables, names, start, titles, headers, steps: OnceLock::new() })
    }

    /// Warnings of its text: [`Job::slips`].
    pub fn slips(&self) -> Vec<Diagnostic> {
        self.job.slips()
    }

    /// The variables, as the program writes them.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The values that the program gives them.
    pub fn start(&self) -> &[f64] {
        &self.start
    }

    /// Titles of the columns of the loops, and of the outputs.
    pub fn titles(&self) -> &[Vec<String>; 2] {
        &self.titles
    }

    /// The lines that stand above the titles in the results of the program.
    pub fn headers(&self) -> &[String] {
        &self.headers
    }

    /// Runs the program with `values` for the variables.
    ///
    /// # Errors
    ///
    /// As [`Job::run`]; a value that the model cannot take is one of them.
    pub fn run(&self, values: &[f64], control: &Control) -> Result<FunctionValues, Failure> {
        self.run_into(FunctionValues { shows: true, ..FunctionValues::default() }, values, control)
    }

    /// [`ProgramFunction::run`] without the columns of the loops.
    ///
    /// # Errors
    ///
    /// As [`Job::run`].
    pub fn outputs(&self, values: &[f64], control: &Control) -> Result<FunctionValues, Failure> {
        self.run_into(FunctionValues::default(), values, control)
    }

    fn run_into(
        &self,
        mut ran: FunctionValues,
        values: &[f64],
        control: &Control,
    ) -> Result<FunctionValues, Failure> {
        let job = self.job.with_values(&self.variables, values).map_err(Failure::Program)?;
        let once = Control { cancel: control.cancel.clone(), progress: None };
        let entries = || self.variables.iter().map(|variable| variable.entry).collect::<Vec<_>>();
        let summary = match self.steps.get_or_init(|| ReusableSteps::of(&job, &entries(), &once)) {
            Some(steps) => job.run_again(steps, &mut ran, &once)?,
            None => job.run(&mut ran, &once)?,
        };
        let colour = summary.colour;
        Ok(FunctionValues { colour, ..ran })
    }
}

impl Sink for FunctionValues {
    fn write(&mut self, _: OutputStream, _: &str) -> io::Result<()> {
        Ok(())
    }

    fn wants(&self, _: OutputStream) -> bool {
        false
    }

    fn wants_loops(&self) -> bool {
        self.shows
    }

    fn row(&mut self, line: &TableLine) -> io::Result<()> {
        let loops = match self.shows {
            true => line.loops().map(str::to_owned).collect(),
            false => Vec::new(),
        };
        self.rows.push(OutputRow { loops, outputs: line.outputs().to_vec() });
        Ok(())
    }
}

impl Job {
    /// The job with other values for some of its variables, one value each. Nothing is compiled
    /// again, and no text is made of the numbers.
    ///
    /// # Errors
    ///
    /// Expressions of VARIABLES that fail with these values.
    pub fn with_values(
        &self,
        variables: &[JobVariable],
        values: &[f64],
    ) -> Result<Self, Vec<Diagnostic>> {
        let new = variables.iter().map(|variable| variable.entry).zip(values.iter().copied());
        let is_new = |entry: usize| variables.iter().any(|variable| variable.entry == entry);
        let old = self.given.iter().copied().filter(|(entry, _)| !is_new(*entry));
        let given: Vec<(usize, f64)> = old.chain(new).collect();
        let mut faults = Vec::new();
        let plan = &self.plan;
        let initial = initial_values(
            (&plan.entries, &plan.program.variables),
            (&plan.names, &self.library),
            early_constants(&plan.required, self.options.mode),
            &given,
            |fault| faults.push(fault),
        );
        if !faults.is_empty() {
            return Err(faults);
        }
        Ok(Self { given: given.into(), initial: initial.into(), ..self.clone() })
    }

    /// The variable called `name`. A parameter of the model is named with or without its `#`.
    ///
    /// # Errors
    ///
    /// If there is no such variable, or if it is not one number that stays as it is.
    pub fn variable(&self, name: &str) -> Result<JobVariable, FunctionError> {
        let plan = &self.plan;
        let written = |at: usize| plan.program.variables[plan.entries[at].variable].name.as_str();
        let means = |at: &usize| {
            let written = written(*at);
            written == name || written.strip_prefix('#') == Some(name)
        };
        let count = plan.entries.len();
        let mut all = (0..count).filter(means);
        let Some(at) = all.next() else {
            let help = did_you_mean(name, (0..count).map(written));
            return Err(FunctionError::Unknown { name: name.to_owned(), help });
        };
        let name = written(at).to_owned();
        if all.next().is_some() {
            return Err(FunctionError::Twice(name));
        }
        if plan.loops.iter().any(|each| each.entries().contains(&at)) {
            return Err(FunctionError::Looped(name));
        }
        let entry = &plan.entries[at];
        let is_text = plan.program.variables[entry.variable].kind == VariableKind::Literal;
        let value = self.initial.iter().find(|(slot, _)| Some(*slot) == entry.slot);
        match value.and_then(|(_, value)| value.single()) {
            Some(value) if !is_text => Ok(JobVariable { name, value, entry: at }),
            _ => Err(FunctionError::NoNumber(name)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MemoryFiles;

    const PROGRAM: &str = "
        MODEL = Lambertian_BRDF_Model
        VARIABLES:
          incidentangle = 0.5   incidentpol = (1,0,0,0)   rotation = 0
          differential = 0.01   minsamples = 20   x = 1
          rho = 0.25   double = 2*rho   $reflectance = Table_Reflectance   #reflectance.table = double

        END
        VARY: FOR x FROM 1 TO 2 BY 1 END
        INTEGRALS: R = HEMI END END
        OUTPUTS: 1 R END
        FILES: END
    ";

    fn varied(names: &[&str]) -> Result<ProgramFunction, FunctionError> {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        ProgramFunction::new(PROGRAM, Arc::new(MemoryFiles::default()), Options::default(), &names)
    }

    #[test]
    fn what_depends_on_a_variable_follows_it() {
        let varied = varied(&["rho"]).unwrap();
        assert_eq!((varied.start(), varied.titles()[1].len()), (&[0.25][..], 1));
        let at = |rho| varied.run(&[rho], &Control::default()).unwrap().rows[1].outputs[0];
        // The model is linear in its reflectance.
        assert!((at(0.1) / at(0.25) - 0.4).abs() < 1e-14);
    }

    #[test]
    fn variables_that_cannot_vary_are_told_apart() {
        assert!(matches!(varied(&["roh"]), Err(FunctionError::Unknown { help: Some(_), .. })));
        assert!(matches!(varied(&["x"]), Err(FunctionError::Looped(_))));
        assert!(matches!(varied(&["incidentpol"]), Err(FunctionError::NoNumber(_))));
        assert!(matches!(varied(&["$reflectance"]), Err(FunctionError::NoNumber(_))));
        assert!(matches!(varied(&["rho", "rho"]), Err(FunctionError::Twice(_))));
        assert!(matches!(varied(&[]), Err(FunctionError::Nothing)));
    }
}
