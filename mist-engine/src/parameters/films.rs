//! The state of a parameter that holds films as `material thickness` pairs.

use std::hash::{Hash, Hasher};

use mist_format::optics::{self, OpticsError, StackText};
use scattering::stack::Film;

use super::{
    error::SetError,
    index::IndexState,
    input::{ParameterContext, ParameterInput},
    source::TableSource,
};

/// Films, the one next to the substrate first.
#[derive(Clone, Debug, Default)]
pub(crate) struct FilmsState {
    /// The texts they were read from.
    texts: Vec<String>,
    films: Vec<Film>,
    /// Files of their materials with their least and largest wavelength.
    files: Vec<(String, [f64; 2])>,
}

impl Hash for FilmsState {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.texts.hash(state);
    }
}

impl PartialEq for FilmsState {
    fn eq(&self, other: &Self) -> bool {
        // Files do not change during a run: equal texts are equal films.
        self.texts == other.texts
    }
}

impl Eq for FilmsState {}

impl FilmsState {
    /// Reads films, or the name of a file with films; an empty text has no film.
    pub(crate) fn read(text: &str, context: &ParameterContext<'_>) -> Result<Self, SetError> {
        let mut state = Self::default();
        state.grow(text, context)?;
        Ok(state)
    }

    /// Sets `grow` (adds films on top) or `wash` (takes all away).
    pub(crate) fn set(
        &mut self,
        name: &str,
        input: ParameterInput<'_>,
        context: &ParameterContext<'_>,
    ) -> Result<(), SetError> {
        match name {
            "grow" => self.grow(&input.to_text(), context),
            "wash" => {
                *self = Self::default();
                Ok(())
            }
            _ => Err(SetError::name(format!("a film stack has no parameter {name}"))
                .help("it has grow, which adds films, and wash, which takes them away")),
        }
    }

    fn grow(&mut self, text: &str, context: &ParameterContext<'_>) -> Result<(), SetError> {
        let dialect = context.library.dialect();
        let wrong = |error: OpticsError| SetError::value(error.to_string()).help(error.help());
        let films = match StackText::parse(text, dialect).map_err(wrong)? {
            StackText::Films(films) => films,
            StackText::File(name) => {
                let text =
                    context.library.text(&name).map_err(|e| SetError::value(e.to_string()))?;
                StackText::parse_file(&text, dialect)
                    .map_err(|error| SetError::value(format!("{name}: {error}")))?
            }
        };
        for optics::FilmText { material, thickness } in films {
            let (source, column) = TableSource::of_index_text(material, context.library)?;
            self.files.extend(source.file_range().map(|(file, range)| (file.to_owned(), range)));
            let index = IndexState::of_source("film", source, column, context)?.value();
            self.films.push(Film { index, thickness });
        }
        self.texts.push(text.to_owned());
        Ok(())
    }

    /// The files of the materials, and their least and largest wavelength.
    pub(crate) fn files(&self) -> impl Iterator<Item = (&str, [f64; 2])> {
        self.files.iter().map(|(file, range)| (file.as_str(), *range))
    }

    /// The texts of the films, in the order in which they grew.
    pub(crate) fn texts(&self) -> &[String] {
        &self.texts
    }

    pub(crate) fn value(&self) -> Vec<Film> {
        self.films.clone()
    }
}
