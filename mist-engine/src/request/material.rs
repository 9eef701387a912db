//! Materials as users describe them: a model in JSON, or a program.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::parameters;

/// A model with the parameters that differ from its defaults.
///
/// ```
/// use mist_engine::material::Material;
/// use scattering::Mode;
///
/// let json = r#"{"model": "Lambertian_BRDF_Model",
///     "parameters": {"reflectance": "Table_Reflectance", "reflectance.table": 0.5}}"#;
/// let material = Material::from_json(json).unwrap();
/// let (model, _) = material.prepare(Mode::Sound, None).unwrap().model().unwrap();
/// assert_eq!(model.common().lambda, 0.532);
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Name of the model's class.
    pub model: String,
    /// Dotted names with the texts that programs would give them, in the order in which they are
    /// set.
    #[serde(default, with = "parameters")]
    pub parameters: Vec<(String, String)>,
    /// Texts of data files by the names that parameters give them.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
}

/// A program with its data files and the options of its run.
///
/// It is read by every command and request that takes a program.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ProgramDescription {
    /// The text of the program.
    pub program: String,
    /// Texts of data files by the names that the program gives them.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
    /// True if it gives NIST's tables, defects included.
    #[serde(default)]
    pub compat: bool,
    /// Name of the job.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub job: Option<String>,
    /// Seed of the Monte Carlo modes; 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
}

impl ProgramDescription {
    /// A program without files.
    pub fn bare(program: impl Into<String>) -> Self {
        Self { program: program.into(), ..Self::default() }
    }

    /// Reads a program: JSON if the text begins with `{`, else the text of the program.
    ///
    /// # Errors
    ///
    /// For invalid JSON, and for unknown and missing keys.
    pub fn parse(text: &str) -> Result<Self, serde_json::Error> {
        if is_json(text) { serde_json::from_str(text) } else { Ok(Self::bare(text)) }
    }
}

/// The one format of materials, in files and over HTTP.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialDescription {
    /// A model with parameters: `{"model": …}`.
    Model(Material),
    /// A program whose first step is the material: `{"program": …}`, or its bare text.
    Program(ProgramDescription),
}

impl MaterialDescription {
    /// Reads a description: JSON if the text begins with `{`, else the text of a program.
    ///
    /// # Errors
    ///
    /// For invalid JSON, and for unknown and missing keys.
    pub fn parse(text: &str) -> Result<Self, serde_json::Error> {
        if is_json(text) {
            Self::from_json(text)
        } else {
            Ok(Self::Program(ProgramDescription::bare(text)))
        }
    }

    /// Reads a description from JSON.
    ///
    /// # Errors
    ///
    /// As [`MaterialDescription::parse`].
    pub fn from_json(text: &str) -> Result<Self, serde_json::Error> {
        let json: serde_json::Value = serde_json::from_str(text)?;
        // From the text, whose errors have a line and a column.
        if json.get("program").is_some() {
            serde_json::from_str(text).map(Self::Program)
        } else {
            serde_json::from_str(text).map(Self::Model)
        }
    }
}

/// True for JSON, false for the text of a program.
fn is_json(text: &str) -> bool {
    text.trim_start().starts_with('{')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn models_programs_with_files_and_bare_programs_are_told_apart() {
        let read = |text| MaterialDescription::parse(text).unwrap();
        let model = r#"{"model": "Lambertian_BRDF_Model"}"#;
        assert!(matches!(read(model), MaterialDescription::Model(_)));
        let with_files = r#"{"program": "MODEL = X", "files": {"a.txt": "1 2"}, "compat": true}"#;
        let MaterialDescription::Program(program) = read(with_files) else { panic!() };
        assert!(program.compat && program.files.contains_key("a.txt"));
        assert!(matches!(read("MODEL = X"), MaterialDescription::Program(_)));
        assert!(MaterialDescription::parse(r#"{"modle": "X"}"#).is_err());
        assert!(ProgramDescription::parse(model).is_err());
        assert_eq!(ProgramDescription::parse("MODEL = X").unwrap().program, "MODEL = X");
    }
}
