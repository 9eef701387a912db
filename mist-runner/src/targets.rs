//! The files that a job is going to write, and checks of their names before it runs.

use std::{
    collections::BTreeMap,
    path::{Component, Path, PathBuf},
};

use mist_engine::Job;
use mist_format::program::ColourKey;
use rise_bridge::formats::ColourFormat;

/// Permissions of a run to write files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Permissions {
    /// False if files that exist must stay.
    pub replace: bool,
    /// True if names that lead out of the folder of results are allowed.
    pub outside: bool,
}

/// A name that cannot be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TargetError {
    /// Two files have one name.
    #[error("{path} would be written twice, as {first} and as {second}: give one of them another name, or --out or --job", path = .path.display())]
    Same {
        /// The name.
        path: PathBuf,
        /// The first file.
        first: String,
        /// The second file.
        second: String,
    },
    /// The file exists and must stay.
    #[error("{path} exists, and --no-clobber is given", path = .0.display())]
    Exists(PathBuf),
    /// A picture has another extension.
    #[error("the plot {name:?} ends with .svg, .png or .pdf")]
    Plot {
        /// The name.
        name: String,
    },
    /// The name leads out of the folder of results.
    #[error(
        "the program writes {name:?}, which is not below the folder of results: --allow-outside \
         permits it, --job NAME gives all files another name"
    )]
    Outside {
        /// The name.
        name: String,
    },
}

/// The names that jobs are going to write.
#[derive(Clone, Debug, Default)]
pub struct Targets {
    taken: BTreeMap<PathBuf, String>,
}

impl Targets {
    /// Adds the files of `job`, called `owner` in messages, below the folder `out`.
    ///
    /// # Errors
    ///
    /// If a name is taken, exists and must stay, or leads out of `out`.
    pub fn add(
        &mut self,
        (owner, job): (&str, &Job),
        out: &Path,
        permissions: Permissions,
    ) -> Result<(), TargetError> {
        for (format, name) in colour_files(job) {
            if format.writer.key == ColourKey::Plot && !format.is_of(&name) {
                return Err(TargetError::Plot { name });
            }
        }
        for (title, name) in names(job) {
            if !permissions.outside && leads_out(&name) {
                return Err(TargetError::Outside { name });
            }
            let path = out.join(&name);
            if !permissions.replace && path.exists() {
                return Err(TargetError::Exists(path));
            }
            let second = format!("{title} of {owner}");
            if let Some(first) = self.taken.insert(path.clone(), second.clone()) {
                return Err(TargetError::Same { path, first, second });
            }
        }
        Ok(())
    }
}

/// The titles and names of the files of `job`.
fn names(job: &Job) -> Vec<(&'static str, String)> {
    let mut names = vec![("results", job.results_name()), ("listing", job.listing_name())];
    names.extend(job.samples_name().map(|name| ("samples", name)));
    names.extend(colour_files(job).into_iter().map(|(format, name)| (format.title, name)));
    names
}

/// The formats and names of the files that COLOR of `job` asks for.
pub fn colour_files(job: &Job) -> Vec<(ColourFormat, String)> {
    let keys = [ColourKey::Table, ColourKey::Spectra, ColourKey::Json, ColourKey::Plot];
    let file = |key| {
        let name = job.colour_name(key)?;
        Some((ColourFormat::of_key(key, &name)?, name))
    };
    keys.into_iter().filter_map(file).collect()
}

/// True if `name` is absolute or goes up.
fn leads_out(name: &str) -> bool {
    let goes = |part: Component<'_>| !matches!(part, Component::Normal(_) | Component::CurDir);
    Path::new(name).components().any(goes)
}

#[cfg(test)]
mod tests {
    use super::leads_out;

    #[test]
    fn names_that_go_up_or_begin_at_the_root_lead_out() {
        for name in ["../a.dat", "/tmp/a.dat", "b/../../a.dat"] {
            assert!(leads_out(name), "{name}");
        }
        for name in ["a.dat", "b/a.dat", "./a.dat", "..a"] {
            assert!(!leads_out(name), "{name}");
        }
    }
}
