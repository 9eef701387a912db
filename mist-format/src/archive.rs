//! Documents saved by NIST's Windows program (`MISTWizardFile1.0`), read only.
//!
//! The file is a plain archive: texts after a length byte, integers of four bytes, little endian.
//! Each element of the document's tree follows the number of its type; the results of the last
//! run, after the last element, are not read. The types were derived from published documents:
//!
//! | type | element | fields |
//! |---|---|---|
//! | 4 | model | name, comment |
//! | 0, 1 | variable, required variable | name, value, comment |
//! | 2 | parameter | name, value, integer: 1 if the value is a plain text, comment |
//! | 3 | parameter that is a model | name, value, comment |
//! | 5 | FOR loop | name, from, to, by, comment |
//! | 19 | DIFFERENTIAL | version, name, θ, φ, INPOL, POL, comment |
//! | 22 | ANNULUS | name, INPOL, POL, comment, inner θ, φ, outer θ, φ, inner, outer half-angle |
//! | 9 | output | expression with label, comment |
//! | 10 | file | name, value, comment |
//! | 18 | end | `MoreData` |
//!
//! The published annulus has both centres at the pole, so that inner before outer is an
//! inference from the order of its half-angles.

/// The first text of every document.
const MAGIC: &str = "MISTWizardFile1.0";

/// One element of a document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WizardElement {
    /// A variable of the user, or one that is required.
    Variable {
        /// Its name.
        name: String,
        /// An expression.
        value: String,
        /// A remark.
        comment: String,
    },
    /// A parameter of the model.
    Parameter {
        /// Its name.
        name: String,
        /// An expression, or a text.
        value: String,
        /// True for a text, false for an expression.
        literal: bool,
        /// A remark.
        comment: String,
    },
    /// A FOR loop.
    For {
        /// The variable.
        name: String,
        /// First value, last value and step.
        bounds: [String; 3],
        /// A remark.
        comment: String,
    },
    /// An integral.
    Integral {
        /// Its name.
        name: String,
        /// The word of its shape.
        shape: &'static str,
        /// Name and expression of each parameter.
        parameters: Vec<(&'static str, String)>,
        /// A remark.
        comment: String,
    },
    /// An output.
    Output {
        /// `label=expression`.
        text: String,
        /// A remark.
        comment: String,
    },
    /// An entry of FILES.
    File {
        /// Its name.
        name: String,
        /// Its value.
        value: String,
        /// A remark.
        comment: String,
    },
}

/// A document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WizardDocument {
    /// The class name of the model.
    pub model: String,
    /// A remark on the model.
    pub comment: String,
    /// All elements in their order.
    pub elements: Vec<WizardElement>,
}

/// Errors of reading a document.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ArchiveError {
    /// The first bytes are not those of a document.
    #[error("not a MISTWizardFile1.0 document")]
    NoDocument,
    /// The document is truncated.
    #[error("the document ends inside an element, at byte {at}")]
    Truncated {
        /// Offset in bytes.
        at: usize,
    },
    /// An element whose form is not known.
    #[error("the element of type {kind} at byte {at} is not known")]
    UnknownElement {
        /// The number of its type.
        kind: u32,
        /// Offset in bytes.
        at: usize,
    },
}

impl WizardDocument {
    /// True if the bytes are such a document.
    pub fn is_document(bytes: &[u8]) -> bool {
        bytes.first() == Some(&(MAGIC.len() as u8)) && bytes[1..].starts_with(MAGIC.as_bytes())
    }

    /// Reads a document.
    ///
    /// # Errors
    /// See [`ArchiveError`].
    pub fn read(bytes: &[u8]) -> Result<Self, ArchiveError> {
        if !Self::is_document(bytes) {
            return Err(ArchiveError::NoDocument);
        }
        let mut reader = WizardReader { bytes, at: 1 + MAGIC.len() };
        let mut document =
            Self { model: String::new(), comment: String::new(), elements: Vec::new() };
        loop {
            let at = reader.at;
            let element = match reader.integer()? {
                4 => {
                    [document.model, document.comment] = reader.texts()?;
                    continue;
                }
                18 => return Ok(document),
                kind => reader.element(kind, at)?,
            };
            document.elements.push(element);
        }
    }
}

struct WizardReader<'b> {
    bytes: &'b [u8],
    at: usize,
}

impl WizardReader<'_> {
    fn element(&mut self, kind: u32, at: usize) -> Result<WizardElement, ArchiveError> {
        Ok(match kind {
            0 | 1 => {
                let [name, value, comment] = self.texts()?;
                WizardElement::Variable { name, value, comment }
            }
            2 => {
                let [name, value] = self.texts()?;
                let literal = self.integer()? != 0;
                WizardElement::Parameter { name, value, literal, comment: self.text()? }
            }
            3 => {
                let [name, value, comment] = self.texts()?;
                WizardElement::Parameter { name, value, literal: true, comment }
            }
            5 => {
                let [name, from, to, by, comment] = self.texts()?;
                WizardElement::For { name, bounds: [from, to, by], comment }
            }
            9 => {
                let [text, comment] = self.texts()?;
                WizardElement::Output { text, comment }
            }
            10 => {
                let [name, value, comment] = self.texts()?;
                WizardElement::File { name, value, comment }
            }
            19 => {
                let [_, name, theta, phi, inpol, pol, comment] = self.texts()?;
                let center = direction(&theta, &phi);
                let parameters = vec![("CENTER", center), ("INPOL", inpol), ("POL", pol)];
                WizardElement::Integral { name, shape: "DIFFERENTIAL", parameters, comment }
            }
            22 => {
                let [name, inpol, pol, comment] = self.texts()?;
                let [inner_theta, inner_phi, outer_theta, outer_phi, inner, outer] =
                    self.texts()?;
                let parameters = vec![
                    ("INNERCENTER", direction(&inner_theta, &inner_phi)),
                    ("OUTERCENTER", direction(&outer_theta, &outer_phi)),
                    ("INNERALPHA", inner),
                    ("OUTERALPHA", outer),
                    ("INPOL", inpol),
                    ("POL", pol),
                ];
                WizardElement::Integral { name, shape: "ANNULUS", parameters, comment }
            }
            kind => return Err(ArchiveError::UnknownElement { kind, at }),
        })
    }

    fn texts<const N: usize>(&mut self) -> Result<[String; N], ArchiveError> {
        let mut texts = [const { String::new() }; N];
        for text in &mut texts {
            *text = self.text()?;
        }
        Ok(texts)
    }

    /// A text after its length: a byte, or 255 and two bytes, or 255, 65535 and four bytes.
    fn text(&mut self) -> Result<String, ArchiveError> {
        let mut len = u32::from(self.take::<1>()?[0]);
        if len == u32::from(u8::MAX) {
            len = u32::from(u16::from_le_bytes(self.take()?));
            if len == u32::from(u16::MAX) {
                len = self.integer()?;
            }
        }
        let end = usize::try_from(len).ok().and_then(|len| self.at.checked_add(len));
        let Some(bytes) = end.and_then(|end| self.bytes.get(self.at..end)) else {
            return Err(ArchiveError::Truncated { at: self.at });
        };
        self.at += bytes.len();
        Ok(crate::decode(bytes).into_owned())
    }

    fn integer(&mut self) -> Result<u32, ArchiveError> {
        Ok(u32::from_le_bytes(self.take()?))
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], ArchiveError> {
        let rest = &self.bytes[self.at..];
        let taken = rest.first_chunk().ok_or(ArchiveError::Truncated { at: self.at })?;
        self.at += N;
        Ok(*taken)
    }
}

fn direction(theta: &str, phi: &str) -> String {
    format!("({theta},{phi})")
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Builds a document from integers and texts.
    #[derive(Default)]
    pub(crate) struct WizardWriter(Vec<u8>);

    impl WizardWriter {
        pub(crate) fn new() -> Self {
            Self::default().texts(&[MAGIC])
        }

        pub(crate) fn element(self, kind: u32, texts: &[&str]) -> Self {
            self.integer(kind).texts(texts)
        }

        pub(crate) fn integer(mut self, value: u32) -> Self {
            self.0.extend(value.to_le_bytes());
            self
        }

        pub(crate) fn texts(mut self, texts: &[&str]) -> Self {
            for text in texts {
                match u8::try_from(text.len()) {
                    Ok(len) if len < u8::MAX => self.0.push(len),
                    _ => {
                        self.0.push(u8::MAX);
                        self.0.extend((text.len() as u16).to_le_bytes());
                    }
                }
                self.0.extend(text.as_bytes());
            }
            self
        }

        pub(crate) fn end(self) -> Vec<u8> {
            self.element(18, &["MoreData"]).0
        }
    }

    #[test]
    fn elements_are_read_in_their_order() {
        let long = "x".repeat(300);
        let bytes = WizardWriter::new()
            .element(4, &["Lambertian_BRDF_Model", ""])
            .element(0, &["a", "1", &long])
            .element(2, &["lambda", "0.5"])
            .integer(0)
            .texts(&[""])
            .element(9, &["y=a", ""])
            .end();
        let document = WizardDocument::read(&bytes).unwrap();
        assert_eq!(document.model, "Lambertian_BRDF_Model");
        assert_eq!(document.elements.len(), 3);
        assert_eq!(
            document.elements[0],
            WizardElement::Variable { name: "a".into(), value: "1".into(), comment: long }
        );
    }

    #[test]
    fn every_cut_of_a_document_is_an_error() {
        let bytes = WizardWriter::new().element(4, &["M", ""]).element(0, &["a", "1", ""]).end();
        let end = bytes.len() - "MoreData".len() - 1;
        for cut in 0..end {
            assert!(WizardDocument::read(&bytes[..cut]).is_err(), "{cut}");
        }
        assert!(WizardDocument::read(&bytes[..end]).is_ok());
    }

    #[test]
    fn unknown_elements_are_reported() {
        let bytes = WizardWriter::new().element(99, &[]).end();
        let error = WizardDocument::read(&bytes).unwrap_err();
        assert_eq!(error, ArchiveError::UnknownElement { kind: 99, at: 18 });
        assert_eq!(WizardDocument::read(b"MODEL = x"), Err(ArchiveError::NoDocument));
    }
}
