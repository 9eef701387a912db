//! Program text + data files → job, or everything that is wrong with it.

use std::{collections::BTreeSet, sync::Arc};

use mist_format::{
    Diagnostic, Program,
    expr::{Expr, Stack, Value},
    number::{PrintfFormat, whole_number},
    program::{
        ApertureShape, ForLoop, Integral, ListLoop, Loop, Output, ProgramVariable, SourceText,
        VariableKind, parse,
    },
    suggestion::did_you_mean,
    table::ListTable,
};
use scattering::{Basis, Class, spec};

use crate::{
    DataFiles, Files, Job, Options,
    colour::section::ColourSection,
    fault::{Fault, fault, placed},
    job::{
        ApertureParameter, ApertureSetting, IntegralPlan, OutputPlan, RequiredVariables,
        VariableEntry,
    },
    quirk::{Quirk, dialect},
    sampling::IntegrationMode,
    scope::{SlotNames, SlotValues},
    sweep::{ForPlan, ListColumn, ListPlan, LoopPlan},
    uncertainty::ErrorColumns,
};

/// Compiles `source`; its data files come from `files`.
///
/// # Errors
///
/// Everything that is wrong with the program and can be told without running it.
pub fn compile(
    source: &str,
    files: Arc<dyn Files + Send + Sync>,
    options: &Options,
) -> Result<Job, Vec<Diagnostic>> {
    let mut program = parse(source, dialect(options.mode))?;
    for (name, value) in &options.values {
        let named = |variable: &&mut ProgramVariable| variable.name.as_str() == name;
        for variable in program.variables.iter_mut().filter(named) {
            // All digits: the text gives the same number.
            variable.value = SourceText::new(format!("{value:?}"), variable.value.span().start);
        }
    }
    let library = DataFiles::new(files, dialect(options.mode));
    Compiler { program, options, library, names: SlotNames::default(), faults: Vec::new() }.job()
}

struct Compiler<'a> {
    program: Program,
    options: &'a Options,
    library: DataFiles,
    names: SlotNames,
    faults: Vec<Diagnostic>,
}

impl Compiler<'_> {
    fn job(mut self) -> Result<Job, Vec<Diagnostic>> {
        let program = self.program.clone();
        let class = self.class(&program.model);
        let required = self.required(&program);
        let entries = self.entries(&program.variables);
        let initial = self.initial(&program, &entries);
        let integrals: Vec<_> = program.integrals.iter().map(|i| self.integral(i)).collect();
        let outputs: Vec<_> = program.outputs.iter().map(|o| self.output(o)).collect();
        let errors = self.errors(&program, &entries, &initial, &integrals, &outputs);
        let mut results: BTreeSet<u32> =
            integrals.iter().map(|i| i.slot).chain(outputs.iter().map(|o| o.slot)).collect();
        results.extend(errors.iter().flat_map(ErrorColumns::slots));
        let loops: Vec<_> =
            program.loops.iter().filter_map(|each| self.vary(each, &entries, &results)).collect();
        self.incident_loops(&program, &entries, &loops);
        let format = self.format(&program);
        let colour = self.colour(&program, &entries, &loops, &outputs, &initial);
        self.basis(&program);
        if !self.faults.is_empty() {
            self.faults.sort_by_key(|d| d.span.start);
            return Err(self.faults);
        }
        let in_order = feeds_back(&entries, &required, &loops, &integrals, &results);
        let chained = is_chained(&integrals, &results);
        let reads = self.reads(&outputs, &loops, colour.as_ref());
        Ok(Job {
            basis: basis(&program),
            program,
            options: self.options.clone(),
            library: self.library,
            class: class.expect("a missing class is a fault"),
            names: self.names,
            initial,
            entries,
            loops,
            required,
            integrals,
            outputs,
            errors,
            format: format.expect("a wrong format is a fault"),
            colour,
            reads,
            in_order,
            chained,
        })
    }

    fn class(&mut self, model: &SourceText) -> Option<&'static Class> {
        let name = model.as_str();
        if let Some(found) = scattering::models::find(name) {
            return Some(&found.class);
        }
        let all: Vec<&str> = scattering::models::all().map(|spec| spec.class.name).collect();
        let other = spec::find_class(name).map(|class| format!("{name} is a {}", class.parent));
        let message = match other {
            Some(what) => format!("{what}, not a BRDF model"),
            None if name == "BRDF_Model"
                || spec::ABSTRACT.iter().any(|(this, _)| *this == name) =>
            {
                format!("{name} is a family of models, not one of them")
            }
            None => format!("there is no BRDF model called {name:?}"),
        };
        let is_family = message.ends_with("not one of them");
        let help = did_you_mean(name, all)
            .filter(|_| !is_family)
            .unwrap_or_else(|| "`mist models` lists all models; case matters".into());
        self.faults.push(fault_plain("program/unknown-model", model, message).help(help));
        None
    }

    fn expr(&mut self, text: &SourceText) -> Result<Expr, Fault> {
        let mut expr = Expr::compile(text.as_str(), dialect(self.options.mode))
            .map_err(|error| placed(text, error.diagnostic()))?;
        let names = &mut self.names;
        expr.bind(|name| names.slot(name));
        Ok(expr)
    }

    fn expr_or_note(&mut self, text: &SourceText) -> Option<Expr> {
        self.expr(text).map_err(|fault| self.faults.push(*fault)).ok()
    }

    fn required(&mut self, program: &Program) -> RequiredVariables {
        let last = program.variables.iter().rev();
        let incidentpol = last
            .filter(|v| v.kind == VariableKind::Local)
            .find(|v| v.name.as_str().eq_ignore_ascii_case("incidentpol"))
            .map(|variable| variable.value.clone());
        let incidentpol =
            incidentpol.and_then(|text| self.expr(&text).ok().map(|expr| (text, expr)));
        RequiredVariables {
            incidentangle: self.names.slot("incidentangle"),
            differential: self.names.slot("differential"),
            incidentpol,
            minsamples: self.names.slot("minsamples"),
            rotation: self.names.slot("rotation"),
            integrationmode: self.names.slot("integrationmode"),
            polygonsides: self.names.slot("polygonsides"),
            tolerance: self.names.slot("tolerance"),
            maxevaluations: self.names.slot("maxevaluations"),
            pi: self.names.slot("pi"),
            deg: self.names.slot("deg"),
        }
    }

    fn entries(&mut self, variables: &[ProgramVariable]) -> Vec<VariableEntry> {
        let mut entries = Vec::with_capacity(variables.len());
        for (at, variable) in variables.iter().enumerate() {
            let parameter = variable.parameter().map(str::to_owned);
            let (slot, expr) = match variable.kind {
                VariableKind::Literal => (None, None),
                VariableKind::Local | VariableKind::Parameter => {
                    let slot = self.names.slot(variable.name.as_str());
                    (Some(slot), self.expr_or_note(&variable.value))
                }
            };
            entries.push(VariableEntry { slot, variable: at, expr, parameter });
        }
        entries
    }

    /// Every entry evaluated once, in order, with what is defined before it.
    fn initial(&mut self, program: &Program, entries: &[VariableEntry]) -> Vec<(u32, Value)> {
        let mut scope = SlotValues::new(self.names.len(), self.library.clone());
        let mut stack = Stack::default();
        let mut initial = Vec::new();
        // SlotNames whose own entry is wrong: their users are not blamed for it.
        let mut broken = BTreeSet::new();
        for entry in entries {
            let Some(slot) = entry.slot else { continue };
            let Some(expr) = &entry.expr else {
                broken.insert(slot);
                continue;
            };
            if expr.slots().iter().any(|read| broken.contains(read)) {
                broken.insert(slot);
                continue;
            }
            match scope.value(expr, &mut stack) {
                Ok(value) => {
                    scope.set(slot, &value);
                    initial.push((slot, value));
                }
                Err(error) => {
                    let known: Vec<_> = scope.defined().map(|s| self.names.name(s)).collect();
                    let text = &program.variables[entry.variable].value;
                    let diagnostic = predefined_help(error.diagnostic(known), expr);
                    self.faults.push(*placed(text, diagnostic));
                    broken.insert(slot);
                }
            }
        }
        initial
    }

    fn vary(
        &mut self,
        each: &Loop,
        entries: &[VariableEntry],
        results: &BTreeSet<u32>,
    ) -> Option<LoopPlan> {
        match each {
            Loop::For(statement) => {
                self.for_plan(statement, entries, results).map(|plan| LoopPlan::For(Box::new(plan)))
            }
            Loop::List(statement) => {
                self.list_plan(statement, entries, results).map(LoopPlan::List)
            }
        }
    }

    /// The first entry with this name, whatever its case.
    fn entry(
        &mut self,
        name: &str,
        place: &SourceText,
        entries: &[VariableEntry],
    ) -> Option<usize> {
        let variables = &self.program.variables;
        let of = |entry: &VariableEntry| variables[entry.variable].name.as_str();
        let found = entries.iter().position(|entry| of(entry).eq_ignore_ascii_case(name));
        if found.is_none() {
            let names: Vec<&str> = entries.iter().map(of).collect();
            let message = format!("there is no variable {name:?} that a loop could change");
            let help = did_you_mean(name, names)
                .unwrap_or_else(|| format!("give it a value in VARIABLES: `{name} = 0`"));
            self.faults.push(fault_plain("loop/unknown-variable", place, message).help(help));
        }
        found
    }

    fn for_plan(
        &mut self,
        statement: &ForLoop,
        entries: &[VariableEntry],
        results: &BTreeSet<u32>,
    ) -> Option<ForPlan> {
        let entry = self.entry(statement.variable.as_str(), &statement.variable, entries);
        let from = self.expr_or_note(&statement.from);
        let to = self.expr_or_note(&statement.to);
        let by = self.expr_or_note(&statement.by);
        let (entry, from, to, by) = (entry?, from?, to?, by?);
        let fed_back =
            [&from, &to, &by].iter().any(|e| e.slots().iter().any(|slot| results.contains(slot)));
        let variable = &self.program.variables[entries[entry].variable];
        Some(ForPlan {
            statement: statement.clone(),
            entry,
            title: statement.variable.as_str().to_owned(),
            is_text: variable.kind == VariableKind::Literal,
            from,
            to,
            by,
            fed_back,
        })
    }

    fn list_plan(
        &mut self,
        statement: &ListLoop,
        entries: &[VariableEntry],
        results: &BTreeSet<u32>,
    ) -> Option<ListPlan> {
        let name = statement.file.as_str();
        let file = match self.library.list(name) {
            Ok(file) => file,
            Err(message) => {
                let help = "a LIST file has a line with names of variables, and a row with a value \
                            for each of them for every step, up to the first empty line";
                let fault = fault_plain("loop/list-file", &statement.file, message);
                self.faults.push(fault.help(help));
                return None;
            }
        };
        let mut columns = Vec::new();
        for title in file.names() {
            let entry = self.entry(title, &statement.file, entries)?;
            let variable = &self.program.variables[entries[entry].variable];
            let is_text = variable.kind == VariableKind::Literal;
            columns.push(ListColumn { entry, title: title.to_owned(), is_text });
        }
        let fed_back = self.reads_results(&file, &columns, results);
        Some(ListPlan { statement: statement.clone(), file, columns, fed_back })
    }

    /// Whether a cell of a LIST file names an integral or an output.
    fn reads_results(
        &self,
        file: &ListTable,
        columns: &[ListColumn],
        results: &BTreeSet<u32>,
    ) -> bool {
        (0..file.row_count()).any(|row| {
            columns.iter().enumerate().filter(|(_, column)| !column.is_text).any(|(at, _)| {
                let cell = file.cell(row, at);
                whole_number(cell).is_none()
                    && Expr::compile(cell, dialect(self.options.mode)).is_ok_and(|expr| {
                        let mut slots =
                            expr.names().iter().filter_map(|name| self.names.find(name));
                        slots.any(|slot| results.contains(&slot))
                    })
            })
        })
    }

    /// Without compat: a loop over incidentpol that no INPOL reads changes nothing.
    fn incident_loops(&mut self, program: &Program, entries: &[VariableEntry], loops: &[LoopPlan]) {
        if Quirk::FixedIncidentPolarization.applies_in(self.options.mode) {
            return;
        }
        let is_incident = |at: usize| {
            let name = program.variables[entries[at].variable].name.as_str();
            name.eq_ignore_ascii_case("incidentpol")
        };
        let read = program.integrals.iter().flat_map(|i| &i.parameters).any(|parameter| {
            parameter.key() == "INPOL"
                && parameter.value.as_str().to_ascii_lowercase().contains("incidentpol")
        });
        for each in loops {
            if read || !each.entries().into_iter().any(is_incident) {
                continue;
            }
            let span = match each {
                LoopPlan::For(plan) => plan.statement.span,
                LoopPlan::List(plan) => plan.statement.span,
            };
            self.faults.push(
                Diagnostic::error(
                    "loop/incidentpol",
                    span,
                    "a loop over incidentpol does not change the incident light",
                )
                .help("write INPOL = incidentpol in every integral that should follow the loop")
                .note("NIST's program keeps the expression in VARIABLES for the whole run"),
            );
        }
    }

    /// The columns of the errors, if the variable `uncertainty` asks for them.
    fn errors(
        &mut self,
        program: &Program,
        entries: &[VariableEntry],
        initial: &[(u32, Value)],
        integrals: &[IntegralPlan],
        outputs: &[OutputPlan],
    ) -> Option<ErrorColumns> {
        let name = |e: &VariableEntry| program.variables[e.variable].name.as_str();
        let number = |slot| {
            let found = initial.iter().rev().find(|(other, _)| Some(*other) == slot);
            found.map(|(_, value)| value.number())
        };
        let numbers = || entries.iter().rev().filter(|entry| entry.slot.is_some());
        let mode = numbers().find(|entry| name(entry) == "integrationmode")?;
        let is_adaptive = number(mode.slot).is_some_and(|mode| {
            IntegrationMode::decode(mode as i32) == Ok(IntegrationMode::Adaptive)
        });
        let entry = numbers().find(|entry| name(entry) == "uncertainty")?;
        let value = number(entry.slot)?;
        if value == 0.0 || !(is_adaptive || self.varies(program, "integrationmode")) {
            return None;
        }
        if value != 1.0 {
            let message = format!("uncertainty = {value} is neither 0 nor 1");
            let text = &program.variables[entry.variable].value;
            let help = "1 adds the column NAME.error of every integral NAME";
            self.faults.push(fault_plain("program/accuracy", text, message).help(help));
            return None;
        }
        if self.varies(program, "uncertainty") {
            let message = "uncertainty decides the columns of the table: no loop can change it";
            let text = &program.variables[entry.variable].value;
            self.faults.push(fault_plain("program/accuracy", text, message));
        }
        let names = &mut self.names;
        Some(ErrorColumns::new(integrals, outputs, |name| names.slot(name)))
    }

    /// Whether a loop changes the variable `name`.
    fn varies(&self, program: &Program, name: &str) -> bool {
        program.loops.iter().any(|each| match each {
            Loop::For(statement) => statement.variable.as_str().eq_ignore_ascii_case(name),
            Loop::List(statement) => {
                let file = self.library.list(statement.file.as_str());
                file.is_ok_and(|file| file.names().any(|title| title.eq_ignore_ascii_case(name)))
            }
        })
    }

    fn integral(&mut self, integral: &Integral) -> IntegralPlan {
        let slot = self.names.slot(integral.name.as_str());
        let mut settings = Vec::new();
        for parameter in &integral.parameters {
            let key = parameter.key();
            if !integral.shape.parameters().contains(&key.as_str()) {
                self.unknown_setting(integral, &parameter.name);
                continue;
            }
            if let Some(expr) = self.expr_or_note(&parameter.value) {
                settings.push(ApertureSetting {
                    key: ApertureParameter::of(&key),
                    text: parameter.value.clone(),
                    expr,
                });
            }
        }
        IntegralPlan { slot, name: integral.name.clone(), shape: integral.shape, settings }
    }

    fn unknown_setting(&mut self, integral: &Integral, name: &SourceText) {
        let known = integral.shape.parameters();
        let message = format!("{} has no parameter {name}", integral.shape.name());
        let help =
            if ApertureShape::find(name.as_str()).is_some() || integral_starts(integral, name) {
                "the integral before it lacks its END".to_owned()
            } else {
                did_you_mean(&name.as_str().to_ascii_uppercase(), known.to_vec())
                    .unwrap_or_else(|| format!("it has {}", known.join(", ")))
            };
        self.faults.push(fault_plain("integral/unknown-parameter", name, message).help(help));
    }

    fn output(&mut self, output: &Output) -> OutputPlan {
        let expr = self.expr_or_note(&output.expression).unwrap_or_else(zero);
        let label = output.label.as_str().to_owned();
        OutputPlan { slot: self.names.slot(&label), label, text: output.expression.clone(), expr }
    }

    fn format(&mut self, program: &Program) -> Option<PrintfFormat> {
        let given = program.files.format();
        let text = given.map_or("%10g\\t", SourceText::as_str);
        PrintfFormat::parse(text)
            .map_err(|error| {
                let place = given.expect("the default format is sound");
                self.faults.push(fault_plain("files/format", place, error.to_string()));
            })
            .ok()
    }

    fn basis(&mut self, program: &Program) {
        // The parser has refused unknown names; nothing is left to check here but the type.
        debug_assert!(Basis::from_name(program.files.basis().name()).is_some());
    }

    fn colour(
        &mut self,
        program: &Program,
        entries: &[VariableEntry],
        loops: &[LoopPlan],
        outputs: &[OutputPlan],
        initial: &[(u32, Value)],
    ) -> Option<ColourSection> {
        let color = program.colour.as_ref()?;
        let incident = initial
            .iter()
            .rev()
            .find(|(slot, _)| self.names.name(*slot).eq_ignore_ascii_case("incidentpol"))
            .and_then(|(_, value)| value.as_slice().first_chunk().copied());
        let (names, mode) = (&mut self.names, self.options.mode);
        let context = crate::colour::section::ColourContext {
            names,
            mode,
            entries,
            variables: &program.variables,
            loops,
            outputs,
            library: &self.library,
            job: &self.options.job,
            basis: program.files.basis().name(),
            incident,
        };
        match ColourSection::compile(color, context) {
            Ok(plan) => Some(plan),
            Err(faults) => {
                self.faults.extend(faults);
                None
            }
        }
    }

    /// Slots of variables that are read after the model was evaluated.
    fn reads(
        &self,
        outputs: &[OutputPlan],
        loops: &[LoopPlan],
        colour: Option<&ColourSection>,
    ) -> Vec<u32> {
        let has_list = loops.iter().any(|each| matches!(each, LoopPlan::List(_)));
        if has_list {
            // A cell may name any variable.
            return (0..self.names.len() as u32).collect();
        }
        let mut slots: BTreeSet<u32> =
            outputs.iter().flat_map(|output| output.expr.slots().iter().copied()).collect();
        slots.extend(colour.into_iter().flat_map(ColourSection::reads));
        slots.into_iter().collect()
    }
}

fn fault_plain(code: &'static str, text: &SourceText, message: impl Into<String>) -> Diagnostic {
    *fault(code, text, message)
}

fn zero() -> Expr {
    Expr::compile("0", mist_format::Dialect::Sound).expect("0 is an expression")
}

fn basis(program: &Program) -> Basis {
    Basis::from_name(program.files.basis().name()).unwrap_or_default()
}

/// Whether `name = value` looks like the beginning of another integral: its value is a shape.
fn integral_starts(integral: &Integral, name: &SourceText) -> bool {
    integral
        .parameters
        .iter()
        .any(|p| p.name.span() == name.span() && ApertureShape::find(p.value.as_str()).is_some())
}

/// pi and deg exist in every step, but not yet when VARIABLES is read.
fn predefined_help(diagnostic: Diagnostic, expr: &Expr) -> Diagnostic {
    let early = ["pi", "deg", "integrationmode", "polygonsides"];
    let reads_early = expr.names().iter().any(|name| early.contains(&name.as_str()));
    if reads_early && diagnostic.code == "expr/unknown-name" {
        return diagnostic
            .note("pi, deg, integrationmode and polygonsides are not yet defined in VARIABLES")
            .help("define pi = 4*atan(1) and deg = pi/180 at the top of VARIABLES");
    }
    diagnostic
}

impl ApertureParameter {
    fn of(name: &str) -> Self {
        match name {
            "CENTER" => Self::Center,
            "ALPHA" => Self::Alpha,
            "OUTERCENTER" => Self::OuterCenter,
            "INNERCENTER" => Self::InnerCenter,
            "OUTERALPHA" => Self::OuterAlpha,
            "INNERALPHA" => Self::InnerAlpha,
            "VERTEX" => Self::Vertex,
            "POLCENTER" => Self::PolCenter,
            "POL" => Self::Pol,
            "INPOL" => Self::InPol,
            other => unreachable!("{other} is no parameter of any shape"),
        }
    }
}

/// Whether an aperture reads an integral or an output.
fn is_chained(integrals: &[IntegralPlan], results: &BTreeSet<u32>) -> bool {
    let settings = integrals.iter().flat_map(|integral| &integral.settings);
    settings.flat_map(|setting| setting.expr.slots()).any(|slot| results.contains(slot))
}

/// Whether variables, loop bounds or apertures read integrals or outputs.
fn feeds_back(
    entries: &[VariableEntry],
    required: &RequiredVariables,
    loops: &[LoopPlan],
    integrals: &[IntegralPlan],
    results: &BTreeSet<u32>,
) -> bool {
    let reads = |expr: &Expr| expr.slots().iter().any(|slot| results.contains(slot));
    let in_loops = loops.iter().any(|each| match each {
        LoopPlan::For(plan) => [&plan.from, &plan.to, &plan.by].into_iter().any(reads),
        LoopPlan::List(plan) => plan.fed_back,
    });
    entries.iter().filter_map(|entry| entry.expr.as_ref()).any(reads)
        || required.incidentpol.iter().any(|(_, expr)| reads(expr))
        || [required.incidentangle, required.differential, required.minsamples, required.rotation]
            .iter()
            .any(|slot| results.contains(slot))
        || in_loops
        || is_chained(integrals, results)
}
