//! The values of all parameters as texts that set them again.

use scattering::{Class, Parameter, spec::number_text};

use super::state::{ObjectState, ParameterState};

/// A parameter of a model or of an object inside of it, with its present value.
#[derive(Clone, Debug)]
pub struct ParameterEntry {
    /// Dotted name, seen from the model.
    pub name: String,
    /// The class that has the parameter.
    pub class: &'static Class,
    /// Its description; none for a setting of a table, of optical constants or of films, such as
    /// `interpolationx`.
    pub parameter: Option<&'static Parameter>,
    /// The value as a text that reads back to the same bits; for an object the name of its class.
    pub text: String,
    /// True if the value is the default.
    pub is_default: bool,
}

/// The parameters of `object` and of the objects in it.
pub(super) fn of_object(object: &ObjectState) -> Vec<ParameterEntry> {
    let mut entries = Vec::new();
    push_object(object, "", &mut entries);
    entries
}

fn push_object(object: &ObjectState, before: &str, entries: &mut Vec<ParameterEntry>) {
    for (parameter, state) in object.parameters() {
        let name = format!("{before}{}", parameter.name);
        let entry = |text: String| {
            let is_default = text == parameter.kind.default_text();
            let (name, class) = (name.clone(), object.class);
            ParameterEntry { name, class, parameter: Some(parameter), text, is_default }
        };
        let settings: Vec<(String, String)> = match state {
            ParameterState::Member(member) => {
                entries.push(entry(member.class.name.to_owned()));
                push_object(member, &format!("{name}."), entries);
                continue;
            }
            ParameterState::Number(x) => {
                entries.push(entry(number_text(*x)));
                continue;
            }
            ParameterState::Integer(i) => {
                entries.push(entry(i.to_string()));
                continue;
            }
            ParameterState::Text(text) | ParameterState::File { name: text, .. } => {
                entries.push(entry(text.to_string()));
                continue;
            }
            ParameterState::Formula(formula) => {
                entries.push(entry(formula.text().to_owned()));
                continue;
            }
            ParameterState::Index(index) => {
                let (text, settings) = index.texts(parameter.kind.default_text());
                entries.push(entry(text));
                settings
            }
            ParameterState::Table(table) => {
                entries.push(entry(table.text()));
                table.settings()
            }
            ParameterState::Films(films) => {
                let mut texts = films.texts().iter();
                entries.push(entry(texts.next().cloned().unwrap_or_default()));
                texts.map(|text| ("grow".to_owned(), text.clone())).collect()
            }
        };
        entries.extend(settings.into_iter().map(|(setting, text)| ParameterEntry {
            name: format!("{name}.{setting}"),
            class: object.class,
            parameter: None,
            text,
            is_default: false,
        }));
    }
}

#[cfg(test)]
mod tests {
    use std::{collections::BTreeMap, sync::Arc};

    use scattering::{Mode, models, registry};

    use super::*;
    use crate::{
        DataFiles, MemoryFiles,
        deviation::dialect,
        parameters::{ModelParameters, ParameterInput, ParameterPath},
    };

    fn library() -> DataFiles {
        let files = [
            ("m.txt", "0.4 1.2 3\n0.6 1.3 3.5\n0.8 1.4 4\n"),
            ("films.txt", "(1.5,0) 0.1\n(2,0.1) 0.2\n"),
        ];
        let files = files.map(|(name, text)| (name.to_owned(), Arc::from(text)));
        DataFiles::new(Arc::new(MemoryFiles(BTreeMap::from(files))), dialect(Mode::Sound))
    }

    fn set(class: &'static Class, texts: &[(&str, &str)]) -> ModelParameters {
        let mut parameters = ModelParameters::new(class);
        for (name, text) in texts {
            let path = ParameterPath::resolve(class, name);
            let input = ParameterInput::Text(text);
            parameters.set(&path, input, &library(), Mode::Sound, None).unwrap();
        }
        parameters
    }

    /// The parameters that the texts of those that are not defaults make again.
    fn again(parameters: &ModelParameters) -> ModelParameters {
        let entries = parameters.entries();
        let changed = entries.iter().filter(|entry| !entry.is_default);
        let texts: Vec<_> = changed.map(|entry| (&*entry.name, &*entry.text)).collect();
        set(parameters.class(), &texts)
    }

    #[test]
    fn parameters_that_were_set_are_set_again_by_their_texts() {
        let facet = &models::find("Facet_BRDF_Model").unwrap().class;
        let parameters = set(
            facet,
            &[
                ("lambda", "0.6328000000000001"),
                ("substrate", "m.txt"),
                ("substrate.interpolationx", "log"),
                ("substrate.k", "3.25"),
                ("sdf", "Exponential_Slope_Distribution_Function"),
                ("sdf.s", "1e-7"),
            ],
        );
        assert_eq!(again(&parameters).entries().len(), parameters.entries().len());
        for (one, other) in again(&parameters).entries().iter().zip(parameters.entries()) {
            assert_eq!((&one.name, &one.text), (&other.name, &other.text));
        }
        let stack = &models::find("Correlated_Roughness_Stack_BRDF_Model").unwrap().class;
        let films = [("stack", "Stack_StackModel"), ("stack.stack", "films.txt")];
        let grown = [films[0], films[1], ("stack.stack.grow", "1.38 0.3")];
        for texts in [&films[..], &grown] {
            let parameters = set(stack, texts);
            assert_eq!(again(&parameters), parameters);
        }
    }

    #[test]
    fn defaults_of_every_class_are_told_as_defaults() {
        for class in registry::classes() {
            let entries = ModelParameters::new(class).entries();
            let changed = entries.iter().find(|entry| !entry.is_default);
            assert!(changed.is_none(), "{}: {:?}", class.name, changed.map(|entry| &entry.name));
        }
    }
}
