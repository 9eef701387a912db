//! The detector of a program with COLOR that has no INTEGRALS and no OUTPUTS.
//!
//! The detector is in the direction of the variables `thetas` and `phis` (degrees), or along the
//! normal. It is a cone with the half angle `alpha` (degrees) if the program has this variable, else
//! a point. The outputs are the four Stokes components of the radiance factor or of the BRDF, or with
//! `quantity = reflectance` the hemispherical reflectance.

use mist_format::program::{
    ApertureShape, ColourEntry, ColourKey, Integral, IntegralParameter, Output, Program, SourceText,
};

/// The Stokes components and the sensitivities that measure them.
const COMPONENTS: [(&str, &str); 4] =
    [("I", "(1,0,0,0)"), ("Q", "(0,1,0,0)"), ("U", "(0,0,1,0)"), ("V", "(0,0,0,1)")];

/// Adds the integrals, the outputs and the settings of COLOR that such a program lacks.
pub(super) fn complete(program: &mut Program) {
    let Some(colour) = &program.colour else { return };
    let is_complete = !program.integrals.is_empty() || !program.outputs.is_empty();
    if is_complete || colour.last(ColourKey::Spectrum).is_some() {
        return;
    }
    let quantity = colour.last(ColourKey::Quantity).map_or("factor", SourceText::as_str);
    let detector = Detector::of(program);
    let (integrals, outputs) = match quantity {
        "reflectance" => detector.hemisphere(),
        "factor" | "brdf" => detector.components(quantity),
        // COLOR refuses the missing spectrum.
        _ => return,
    };
    let labels: Vec<&str> = outputs.iter().map(|output| output.label.as_str()).collect();
    let mut settings =
        vec![(ColourKey::Spectrum, labels.join(",")), (ColourKey::Quantity, quantity.to_owned())];
    if quantity != "reflectance" {
        settings.extend(detector.patch(program).map(|patch| (ColourKey::Patch, patch)));
    }
    let colour = program.colour.as_mut().expect("the program has COLOR");
    for (key, value) in settings {
        if colour.last(key).is_none() {
            let (name, value) = (detector.text(key.name()), detector.text(&value));
            colour.entries.push(ColourEntry { key, name, value });
        }
    }
    (program.integrals, program.outputs) = (integrals, outputs);
}

/// Direction and opening of the detector, as expressions.
struct Detector {
    theta: &'static str,
    phi: &'static str,
    is_cone: bool,
    /// The cue of COLOR, where its texts are taken to stand.
    place: SourceText,
}

impl Detector {
    fn of(program: &Program) -> Self {
        let has = |name| program.variables.iter().any(|variable| variable.name.as_str() == name);
        let cue = program.sections.colour.start;
        Self {
            theta: if has("thetas") { "thetas*deg" } else { "0" },
            phi: if has("phis") { "phis*deg" } else { "0" },
            is_cone: has("alpha"),
            place: SourceText::new("COLOR:", cue),
        }
    }

    /// The text at the cue of COLOR.
    fn text(&self, text: &str) -> SourceText {
        self.place.with_text(text)
    }

    fn components(&self, quantity: &str) -> (Vec<Integral>, Vec<Output>) {
        let Self { theta, phi, is_cone, .. } = self;
        let omega = if *is_cone { "(pi*sin(alpha*deg)^2)" } else { "1" };
        let scale = if quantity == "factor" { "pi" } else { "1" };
        let mut integrals = Vec::new();
        let mut outputs = Vec::new();
        for (at, (component, sensitivity)) in COMPONENTS.into_iter().enumerate() {
            let name = format!("detector.{component}");
            let mut settings = vec![("CENTER", format!("({theta},{phi})"))];
            if *is_cone {
                settings.push(("ALPHA", "alpha*deg".to_owned()));
            }
            settings.push(("POL", sensitivity.to_owned()));
            let shape = if *is_cone { ApertureShape::Circle } else { ApertureShape::Differential };
            integrals.push(self.integral(&name, shape, settings));
            let expression = format!("{scale}*{name}/({omega}*cos({theta}))");
            outputs.push(self.output(at + 1, &format!("{quantity}.{component}"), &expression));
        }
        (integrals, outputs)
    }

    fn hemisphere(&self) -> (Vec<Integral>, Vec<Output>) {
        let integral = self.integral("detector", ApertureShape::Hemi, Vec::new());
        (vec![integral], vec![self.output(1, "reflectance", "detector")])
    }

    fn integral(
        &self,
        name: &str,
        shape: ApertureShape,
        settings: Vec<(&str, String)>,
    ) -> Integral {
        let setting = |(name, value): (&str, String)| IntegralParameter {
            name: self.text(name),
            value: self.text(&value),
        };
        Integral {
            name: self.text(name),
            shape,
            shape_text: self.text(shape.name()),
            parameters: settings.into_iter().map(setting).collect(),
            span: self.place.span(),
        }
    }

    fn output(&self, number: usize, label: &str, expression: &str) -> Output {
        Output {
            number: self.text(&number.to_string()),
            label: self.text(label),
            has_label: true,
            expression: self.text(expression),
        }
    }

    /// The words for the header of the table, if the half angle of the cone is one number.
    fn patch(&self, program: &Program) -> Option<String> {
        let mut angles = program.variables.iter().filter(|v| v.name.as_str() == "alpha");
        let (angle, None) = (angles.next()?, angles.next()) else { return None };
        let degrees: f64 = angle.value.as_str().parse().ok()?;
        Some(format!("circle {degrees}"))
    }
}
