//! Converts old programs and documents to programs in the present language.
//!
//! * Documents of the Windows program become programs; parameters that their expressions read
//!   by the bare name are read as `#name`.
//! * A stack given by its films, `$stack = "m t"`, becomes a `Stack_StackModel` with films.
//! * Parameters and files with an empty value, which mean the default, are left out.

use crate::archive::{ArchiveError, WizardDocument, WizardElement};
use crate::diagnostic::Diagnostic;
use crate::dialect::Dialect;
use crate::expr::Function;
use crate::program::{self, Program, ProgramVariable, SourceText, VariableKind};
use crate::span::Span;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Parameters that hold a stack model.
const STACKS: [&str; 4] = ["stack", "spherecoat", "overcoat_films", "films"];

/// Errors of converting a file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ConvertError {
    /// The document cannot be read.
    #[error(transparent)]
    Document(#[from] ArchiveError),
    /// The program cannot be read.
    #[error("the program cannot be read")]
    Program(Vec<Diagnostic>),
    /// The program made from a document cannot be read.
    #[error("the document does not make a whole program")]
    Incomplete {
        /// The text of the program.
        text: String,
        /// The errors.
        found: Vec<Diagnostic>,
    },
}

/// Converts a document or a program, and gives the text of a program.
///
/// # Errors
/// See [`ConvertError`].
pub fn convert(bytes: &[u8]) -> Result<String, ConvertError> {
    let program = if WizardDocument::is_document(bytes) {
        let text = document_text(&WizardDocument::read(bytes)?);
        match program::parse(&text, Dialect::Sound) {
            Ok(program) => program,
            Err(found) => return Err(ConvertError::Incomplete { text, found }),
        }
    } else {
        let text = crate::decode(bytes);
        program::parse(&text, Dialect::Compat).map_err(ConvertError::Program)?
    };
    Ok(upgrade(program).to_string())
}

/// The present form of the variables and files of a program.
fn upgrade(mut program: Program) -> Program {
    let stacks: BTreeSet<String> =
        program.variables.iter().filter(|v| is_stack_model(v)).map(parameter).collect();
    let upgraded = |variable| upgrade_variable(variable, &stacks);
    program.variables = program.variables.into_iter().flat_map(upgraded).collect();
    // An empty header is a line of its own; the other entries have defaults.
    let has_value = |entry: &program::FilesEntry| {
        entry.key == program::FilesKey::Header || !entry.value.as_str().is_empty()
    };
    program.files.entries.retain(has_value);
    program
}

fn parameter(variable: &ProgramVariable) -> String {
    variable.parameter().unwrap_or_default().to_owned()
}

fn is_stack_model(variable: &ProgramVariable) -> bool {
    variable.kind == VariableKind::Literal && variable.value.as_str().ends_with("_StackModel")
}

fn upgrade_variable(variable: ProgramVariable, stacks: &BTreeSet<String>) -> Vec<ProgramVariable> {
    if variable.kind != VariableKind::Literal {
        return vec![variable];
    }
    let value = variable.value.as_str().trim();
    if value.is_empty() {
        return Vec::new();
    }
    let name = parameter(&variable);
    let (parent, last) = name.rsplit_once('.').unwrap_or(("", &name));
    let is_films = !stacks.contains(parent) && value != "default" && !is_stack_model(&variable);
    if !is_films || !STACKS.contains(&last) {
        return vec![variable];
    }
    let place = variable.name.span().start;
    let model = ProgramVariable {
        name: variable.name.clone(),
        kind: VariableKind::Literal,
        value: SourceText::new("Stack_StackModel", place),
    };
    let films =
        ProgramVariable { name: SourceText::new(format!("${name}.stack"), place), ..variable };
    vec![model, films]
}

/// A document as a program.
fn document_text(document: &WizardDocument) -> String {
    let names = DocumentNames::of(document);
    let mut sections: [String; 5] = Default::default();
    let mut outputs = 0;
    for element in &document.elements {
        let (section, lines) = match element {
            WizardElement::Variable { name, value, comment } => {
                (0, entry(name, &names.resolve(value), comment))
            }
            WizardElement::Parameter { name, value, literal: true, comment } => {
                (0, entry(&format!("${name}"), value, comment))
            }
            WizardElement::Parameter { name, value, literal: false, comment } => {
                (0, entry(&format!("#{name}"), &names.resolve(value), comment))
            }
            WizardElement::For { name, bounds, comment } => {
                (1, for_line(name, bounds, comment, &names))
            }
            WizardElement::Integral { name, shape, parameters, comment } => {
                (2, integral_lines(name, shape, parameters, comment, &names))
            }
            WizardElement::Output { text, comment } => {
                outputs += 1;
                (3, output_line(outputs, text, comment, &names))
            }
            WizardElement::File { name, value, comment } => (4, entry(name, value, comment)),
        };
        sections[section].push_str(&lines);
    }
    let [variables, vary, integrals, outputs, files] = sections;
    format!(
        "MODEL = {}{}\nVARIABLES:\n{variables}END\nVARY:\n{vary}END\nINTEGRALS:\n{integrals}END\n\
         OUTPUTS:\n{outputs}END\nFILES:\n{files}END\n",
        document.model,
        remarks(&[&document.comment])
    )
}

/// An assignment with its comment; empty if the value is empty.
fn entry(name: &str, value: &str, comment: &str) -> String {
    let (value, remark) = value.split_once(';').unwrap_or((value, ""));
    let value = value.trim().trim_matches('"').trim();
    if value.is_empty() {
        return String::new();
    }
    format!("{name} = {}{}\n", quote(value), remarks(&[remark, comment]))
}

fn for_line(name: &str, bounds: &[String; 3], comment: &str, names: &DocumentNames) -> String {
    let [from, to, by] = bounds.each_ref().map(|bound| quote(&names.resolve(bound)));
    format!("FOR {name} FROM {from} TO {to} BY {by}{}\n", remarks(&[comment]))
}

fn integral_lines(
    name: &str,
    shape: &str,
    parameters: &[(&str, String)],
    comment: &str,
    names: &DocumentNames,
) -> String {
    let mut lines = format!("{name} = {shape}{}\n", remarks(&[comment]));
    for (key, value) in parameters {
        lines.push_str(&entry(key, &names.resolve(value), ""));
    }
    lines + "END\n"
}

fn output_line(number: usize, text: &str, comment: &str, names: &DocumentNames) -> String {
    let labelled = match text.split_once('=') {
        Some(("", expression)) => expression.to_owned(),
        Some((label, expression)) => format!("{label}={}", names.resolve(expression)),
        None => names.resolve(text),
    };
    format!("{number} {}{}\n", quote(&labelled), remarks(&[comment]))
}

fn quote(text: &str) -> String {
    if text.contains(char::is_whitespace) { format!("\"{text}\"") } else { text.to_owned() }
}

/// The remarks of an entry as a comment.
fn remarks(remarks: &[&str]) -> String {
    let mut text = String::new();
    for remark in remarks.iter().map(|remark| remark.trim()).filter(|remark| !remark.is_empty()) {
        // Writing to a string cannot fail.
        let _ = write!(text, " ; {}", remark.replace(['\r', '\n'], " "));
    }
    text
}

/// The names to which expressions of a document can refer.
struct DocumentNames {
    variables: BTreeSet<String>,
    parameters: BTreeSet<String>,
}

impl DocumentNames {
    fn of(document: &WizardDocument) -> Self {
        let mut names = Self { variables: BTreeSet::new(), parameters: BTreeSet::new() };
        for element in &document.elements {
            match element {
                WizardElement::Variable { name, .. } | WizardElement::Integral { name, .. } => {
                    names.variables.insert(name.clone());
                }
                WizardElement::Parameter { name, literal: false, .. } => {
                    names.parameters.insert(name.clone());
                }
                WizardElement::Output { text, .. } => {
                    let label = text.split_once('=').map_or(text.as_str(), |parts| parts.0);
                    names.variables.insert(label.to_owned());
                }
                _ => {}
            }
        }
        names
    }

    /// The expression with `#` before each parameter that is not a variable.
    fn resolve(&self, expression: &str) -> String {
        let is_name =
            |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '#' | '$' | '@');
        let mut result = String::new();
        let mut rest = expression;
        while !rest.is_empty() {
            let len = rest.find(|c| !is_name(c)).unwrap_or(rest.len());
            let (word, behind) = rest.split_at(len);
            let meant = self.parameters.contains(word)
                && !self.variables.contains(word)
                && !(behind.trim_start().starts_with('(') && Function::find(word).is_some());
            result.push_str(if meant { "#" } else { "" });
            result.push_str(word);
            let next = behind.find(is_name).unwrap_or(behind.len());
            result.push_str(&behind[..next]);
            rest = &behind[next..];
        }
        result
    }
}

/// A diagnostic for a file that cannot be converted as a whole.
impl From<&ArchiveError> for Diagnostic {
    fn from(error: &ArchiveError) -> Self {
        Self::error("convert/document", Span::default(), error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::archive::tests::WizardWriter;

    fn document() -> Vec<u8> {
        let required = |writer: WizardWriter, name, value| writer.element(1, &[name, value, ""]);
        let mut writer = WizardWriter::new()
            .element(4, &["Bobbert_Vlieger_BRDF_Model", "a sphere"])
            .element(0, &["deg", "atan(1)/45", "one degree"])
            .element(0, &["t", "30", ""]);
        for (name, value) in [
            ("minsamples", "1"),
            ("differential", "(2*deg)^2"),
            ("incidentangle", "t*deg"),
            ("incidentpol", "(1,0,0,0); Unpolarized"),
            ("rotation", "0"),
        ] {
            writer = required(writer, name, value);
        }
        writer
            .element(2, &["lambda", "0.5"])
            .integer(0)
            .texts(&[""])
            .element(2, &["radius", "lambda/2"])
            .integer(0)
            .texts(&["half a wave"])
            .element(2, &["spherecoat", ""])
            .integer(1)
            .texts(&[""])
            .element(2, &["stack", "(1.5,0) 0.1"])
            .integer(1)
            .texts(&[""])
            .element(3, &["psd", "ABC_PSD_Function", ""])
            .element(5, &["t", "0", "60", "5", ""])
            .element(19, &["1", "f", "t*deg", "0", "incidentpol", "(1,0,0,0); all", "one"])
            .element(22, &["g", "incidentpol", "(1,0,0,0)", "", "0", "0", "0", "0", "0.1", "0.2"])
            .element(9, &["y=f*lambda", ""])
            .element(9, &["=g", ""])
            .element(10, &["results", "", ""])
            .element(10, &["samples", "\"\"", ""])
            .end()
    }

    #[test]
    fn a_document_becomes_a_program() {
        let text = convert(&document()).unwrap();
        for line in [
            "MODEL = Bobbert_Vlieger_BRDF_Model ; a sphere",
            "    deg = atan(1)/45 ; one degree",
            "    incidentpol = (1,0,0,0) ; Unpolarized",
            "    #lambda = 0.5",
            "    #radius = #lambda/2 ; half a wave",
            "    $stack = Stack_StackModel",
            "    $stack.stack = \"(1.5,0) 0.1\"",
            "    $psd = ABC_PSD_Function",
            "    FOR t FROM 0 TO 60 BY 5",
            "    f = DIFFERENTIAL ; one",
            "        CENTER = (t*deg,0)",
            "        POL = (1,0,0,0) ; all",
            "        OUTERALPHA = 0.2",
            "    1 y=f*#lambda",
            "    2 g",
        ] {
            assert!(text.lines().any(|found| found == line), "`{line}` is not in\n{text}");
        }
        assert!(!text.contains("spherecoat") && !text.contains("    samples"));
        assert_eq!(convert(text.as_bytes()).unwrap(), text, "converting again changes nothing");
    }

    #[test]
    fn a_bare_stack_of_a_program_becomes_a_stack_model() {
        let text = "MODEL = Facet_BRDF_Model VARIABLES: minsamples=1 differential=1 \
                    incidentangle=0 incidentpol=(1,0,0,0) rotation=0 $stack = \"1.5 0.1\" \
                    $source1.stack = \"1.5 0.1\" $films = Stack_StackModel $films.stack = \"1.5 0.1\" \
                    $substrate = \"\" END VARY: END INTEGRALS: END OUTPUTS: END FILES: END\n";
        let converted = convert(text.as_bytes()).unwrap();
        assert!(
            converted.contains("    $stack = Stack_StackModel\n    $stack.stack = \"1.5 0.1\"")
        );
        assert!(converted.contains("    $source1.stack.stack = \"1.5 0.1\""));
        assert!(
            converted.contains("    $films = Stack_StackModel\n    $films.stack = \"1.5 0.1\"")
        );
        assert!(!converted.contains("$films.stack.stack") && !converted.contains("$substrate"));
    }

    #[test]
    fn other_files_are_refused() {
        assert!(matches!(convert(b"hello"), Err(ConvertError::Program(_))));
        let cut = &document()[..100];
        assert!(matches!(convert(cut), Err(ConvertError::Document(_))));
        let empty = WizardWriter::new().element(4, &["M", ""]).end();
        assert!(matches!(convert(&empty), Err(ConvertError::Incomplete { .. })));
    }
}
