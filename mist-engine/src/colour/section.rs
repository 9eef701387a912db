//! The section COLOR, compiled: which numbers make a spectrum, and how it becomes a colour.

use std::collections::BTreeSet;

use mist_format::{
    Diagnostic,
    expr::Expr,
    program::{ColourKey, ColourStatements, ProgramVariable, SourceText},
    suggestion::did_you_mean,
};
use scattering::Mode;
use spectra::{
    Adaptation, ColourSettings, Extrapolation, Filter, Illuminant, Observer, Quantity, RgbSpace,
    Spectrum,
};

use crate::{
    DataFiles,
    deviation::dialect,
    fault::placed,
    plan::{
        ColourSection, IntegralPlan, LoopPlan, LoopRole, OutputPlan, PlacedExpression,
        VariableEntry,
    },
    slots::SlotNames,
};

/// Context in which the section is compiled.
pub(crate) struct ColourContext<'a> {
    pub(crate) names: &'a mut SlotNames,
    pub(crate) mode: Mode,
    pub(crate) entries: &'a [VariableEntry],
    pub(crate) variables: &'a [ProgramVariable],
    pub(crate) loops: &'a [LoopPlan],
    pub(crate) integrals: &'a [IntegralPlan],
    pub(crate) outputs: &'a [OutputPlan],
    pub(crate) library: &'a DataFiles,
    pub(crate) job: &'a str,
    pub(crate) basis: &'a str,
}

impl ColourSection {
    pub(crate) fn compile(
        color: &ColourStatements,
        context: ColourContext<'_>,
    ) -> Result<Self, Vec<Diagnostic>> {
        SectionCompiler { color, context, faults: Vec::new() }.section()
    }

    /// The name of the file that `key` asks for: a table, spectra, JSON or a plot.
    pub fn file(&self, key: ColourKey) -> Option<&str> {
        self.files.iter().find(|(this, _)| *this == key).map(|(_, name)| name.as_str())
    }

    /// Variables that it reads after the model was evaluated.
    pub(crate) fn reads(&self) -> impl Iterator<Item = u32> {
        let placed = std::iter::once(&self.wavelength).chain(self.angles.iter().flatten());
        let expressions = placed.flat_map(|placed| placed.expr.slots().iter().copied());
        let leading = self.roles.iter().flat_map(|role| match role {
            LoopRole::Leading(columns) => columns.iter().map(|(_, slot)| *slot).collect(),
            LoopRole::Folded | LoopRole::Direction => Vec::new(),
        });
        expressions.chain(leading)
    }
}

struct SectionCompiler<'a> {
    color: &'a ColourStatements,
    context: ColourContext<'a>,
    faults: Vec<Diagnostic>,
}

impl SectionCompiler<'_> {
    fn section(mut self) -> Result<ColourSection, Vec<Diagnostic>> {
        let wavelength = self.wavelength();
        let angles = [
            ("thetai", ColourKey::Thetai),
            ("thetas", ColourKey::Thetas),
            ("phis", ColourKey::Phis),
            ("omega", ColourKey::Omega),
        ]
        .map(|(name, key)| self.angle(name, key));
        let spectrum = self.spectrum();
        let settings = self.settings();
        if !self.faults.is_empty() {
            return Err(self.faults);
        }
        let wavelength = wavelength.expect("a missing wavelength is a fault");
        let roles = self.roles(&wavelength, &angles);
        let text = |key| self.color.last(key).map(|text| text.as_str().to_owned());
        let place = self.color.entries.first().map(|entry| entry.name.clone()).unwrap_or_default();
        Ok(ColourSection {
            wavelength,
            angles,
            integral: self.integral(&spectrum),
            spectrum,
            roles,
            settings: settings.expect("wrong settings are faults"),
            frame: self.context.basis.to_owned(),
            patch: text(ColourKey::Patch).unwrap_or_else(|| "point".into()),
            material: text(ColourKey::Material).unwrap_or_else(|| self.context.job.to_owned()),
            place,
            files: self.files(),
        })
    }

    /// The names of the files; a table and a plot if the program names none.
    fn files(&self) -> Vec<(ColourKey, String)> {
        let keys = [ColourKey::Table, ColourKey::Spectra, ColourKey::Json, ColourKey::Plot];
        let named = |key| Some((key, self.color.last(key)?.as_str().to_owned()));
        let files: Vec<_> = keys.into_iter().filter_map(named).collect();
        if !files.is_empty() || self.context.mode == Mode::Compat {
            return files;
        }
        let name = |extension| format!("{}.{extension}", self.context.job);
        vec![(ColourKey::Table, name("mtab")), (ColourKey::Plot, name("svg"))]
    }

    fn fault(&mut self, code: &'static str, text: &SourceText, error: &impl std::fmt::Display) {
        self.faults.push(Diagnostic::error(code, text.span(), error.to_string()));
    }

    fn expr(&mut self, text: &SourceText) -> Option<PlacedExpression> {
        match Expr::compile(text.as_str(), dialect(self.context.mode)) {
            Ok(mut expr) => {
                expr.bind(|name| self.context.names.slot(name));
                Some(PlacedExpression { text: Some(text.clone()), expr })
            }
            Err(error) => {
                self.faults.push(*placed(text, error.diagnostic()));
                None
            }
        }
    }

    fn wavelength(&mut self) -> Option<PlacedExpression> {
        if let Some(text) = self.color.last(ColourKey::Wavelength) {
            return self.expr(text);
        }
        if self.context.variables.iter().any(|variable| variable.name.as_str() == "#lambda") {
            return self.implied("#lambda");
        }
        let message = "COLOR needs the wavelength: an expression in micrometres";
        self.faults.push(
            Diagnostic::error("color/wavelength", self.color.span, message)
                .help("write `wavelength = wl` for a variable in um, `wl/1000` for one in nm"),
        );
        None
    }

    /// The expression of a column; by default the variable of its name, if there is one.
    fn angle(&mut self, name: &str, key: ColourKey) -> Option<PlacedExpression> {
        if let Some(text) = self.color.last(key) {
            return self.expr(text);
        }
        let variables = self.context.variables.iter().map(|v| v.name.as_str());
        let labels = self.context.outputs.iter().map(|output| output.label.as_str());
        if !variables.chain(labels).any(|known| known == name) {
            return None;
        }
        self.implied(name)
    }

    /// An expression that the program does not contain.
    fn implied(&mut self, text: &str) -> Option<PlacedExpression> {
        let mut expr = Expr::compile(text, dialect(self.context.mode)).ok()?;
        expr.bind(|name| self.context.names.slot(name));
        Some(PlacedExpression { text: None, expr })
    }

    fn spectrum(&mut self) -> Vec<u32> {
        let labels = self.color.spectrum();
        let Some(place) = self.color.last(ColourKey::Spectrum) else {
            let message = "COLOR needs the spectrum: one output label, or four for I, Q, U, V";
            self.faults.push(
                Diagnostic::error("color/spectrum", self.color.span, message)
                    .help("write `spectrum = label` or `spectrum = f0,f1,f2,f3`"),
            );
            return Vec::new();
        };
        if labels.len() != 1 && labels.len() != 4 {
            let message = format!("a spectrum has one label or four, this has {}", labels.len());
            self.fault("color/spectrum", place, &message);
            return Vec::new();
        }
        let outputs = self.context.outputs;
        let mut slots = Vec::new();
        for label in &labels {
            if let Some(found) = outputs.iter().rev().find(|o| o.label == label.as_str()) {
                slots.push(found.slot);
                continue;
            }
            let message = format!("no output is called {:?}", label.as_str());
            let known: Vec<&str> = outputs.iter().map(|o| o.label.as_str()).collect();
            let help = did_you_mean(label.as_str(), known);
            self.faults.push(
                Diagnostic::error("color/unknown-output", label.span(), message).help_if(help),
            );
        }
        slots
    }

    fn settings(&mut self) -> Option<ColourSettings> {
        let quantity = self.word(ColourKey::Quantity, "brdf", Quantity::parse);
        let observer = self.word(ColourKey::Observer, "CIE1931_2", Observer::parse);
        let adaptation = self.word(ColourKey::Adaptation, "Bradford", Adaptation::parse);
        let space = self.word(ColourKey::Space, "sRGB", RgbSpace::parse);
        let illuminant = self.illuminant();
        let mut filters = Vec::new();
        for text in self.color.filters() {
            match Filter::parse(text.as_str()) {
                Ok(filter) => filters.push(filter),
                Err(error) => self.fault("color/filter", text, &error),
            }
        }
        let quantity = quantity?;
        let outside =
            if quantity == Quantity::Radiance { Extrapolation::Zero } else { Extrapolation::Hold };
        Some(ColourSettings {
            quantity,
            illuminant: illuminant?,
            observer: observer?,
            space: space?,
            adaptation: adaptation?,
            filters,
            outside,
        })
    }

    fn word<T, E: std::fmt::Display>(
        &mut self,
        key: ColourKey,
        default: &str,
        parse: impl Fn(&str) -> Result<T, E>,
    ) -> Option<T> {
        let given = self.color.last(key);
        match (parse(given.map_or(default, SourceText::as_str)), given) {
            (Ok(value), _) => Some(value),
            (Err(error), Some(text)) => {
                self.fault("color/name", text, &error);
                None
            }
            (Err(_), None) => unreachable!("the default {default} is known"),
        }
    }

    /// A CIE name, a temperature, `D(temperature)`, or a file with a spectrum.
    fn illuminant(&mut self) -> Option<Illuminant> {
        let given = self.color.last(ColourKey::Illuminant);
        let text = given.map_or("D65", SourceText::as_str);
        let error = match Illuminant::parse(text) {
            Ok(illuminant) => return Some(illuminant),
            Err(error) => error,
        };
        let place = given.expect("D65 is known");
        let Ok(file) = self.context.library.text(text) else {
            self.fault("color/illuminant", place, &error);
            return None;
        };
        let read = Spectrum::parse(&file)
            .map_err(|error| error.to_string())
            .and_then(|(spectrum, _)| spectrum.illuminant(text).map_err(|e| e.to_string()));
        read.map_err(|error| self.fault("color/illuminant", place, &error)).ok()
    }

    /// Role of every loop in the table, determined by its dependents.
    fn roles(
        &self,
        wavelength: &PlacedExpression,
        angles: &[Option<PlacedExpression>; 4],
    ) -> Vec<LoopRole> {
        let spectral = self.depends_on(wavelength.expr.slots());
        let directional: BTreeSet<usize> = angles
            .iter()
            .flatten()
            .flat_map(|placed| self.depends_on(placed.expr.slots()))
            .collect();
        let role = |each: &LoopPlan| {
            let entries = each.entries();
            if entries.iter().any(|entry| spectral.contains(entry)) {
                LoopRole::Folded
            } else if entries.iter().any(|entry| directional.contains(entry)) {
                LoopRole::Direction
            } else {
                let named = entries.iter().zip(each.titles());
                let columns = named.filter_map(|(entry, title)| {
                    Some((title.to_owned(), self.context.entries[*entry].slot?))
                });
                LoopRole::Leading(columns.collect())
            }
        };
        self.context.loops.iter().map(role).collect()
    }

    /// The first integral that the outputs in `slots` read.
    fn integral(&self, slots: &[u32]) -> Option<usize> {
        let mut open: Vec<u32> = slots.to_vec();
        let mut seen = BTreeSet::new();
        while let Some(slot) = open.pop() {
            let integral = self.context.integrals.iter().position(|plan| plan.slot == slot);
            if integral.is_some() {
                return integral;
            }
            let outputs = self.context.outputs.iter().filter(|output| output.slot == slot);
            open.extend(outputs.flat_map(|o| o.expr.slots()).filter(|read| seen.insert(**read)));
        }
        None
    }

    /// Entries of VARIABLES that the values in `slots` are computed from.
    fn depends_on(&self, slots: &[u32]) -> BTreeSet<usize> {
        let mut found = BTreeSet::new();
        let mut open: Vec<u32> = slots.to_vec();
        while let Some(slot) = open.pop() {
            for (at, entry) in self.context.entries.iter().enumerate() {
                if entry.slot == Some(slot) && found.insert(at) {
                    open.extend(entry.expr.iter().flat_map(|expr| expr.slots()));
                }
            }
            let outputs = self.context.outputs.iter().filter(|output| output.slot == slot);
            for output in outputs {
                let new = output.expr.slots().iter().filter(|read| **read != slot);
                open.extend(new);
            }
        }
        found
    }
}
