//! The section FILES.

use super::text::SourceText;

/// A polarization basis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BasisName {
    /// s and p of each beam.
    #[default]
    Psps,
    /// x and y turned with each beam.
    Xyxy,
    /// Perpendicular and parallel to the plane of both beams.
    Plane,
}

impl BasisName {
    /// Every basis.
    pub const ALL: &'static [Self] = &[Self::Psps, Self::Xyxy, Self::Plane];

    /// The word in a program; its case counts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Psps => "psps",
            Self::Xyxy => "xyxy",
            Self::Plane => "plane",
        }
    }
}

/// The section FILES: the output files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilesSection {
    /// Every assignment in the order written.
    pub entries: Vec<FilesEntry>,
}

/// One assignment in FILES.
#[derive(Clone, Debug, PartialEq)]
pub struct FilesEntry {
    /// The key, given by the name.
    pub key: FilesKey,
    /// The name as written.
    pub name: SourceText,
    /// The value.
    pub value: SourceText,
}

/// The names that FILES knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FilesKey {
    /// The table of loop values and outputs; `JOB.dat` unless given.
    Results,
    /// The report; `JOB.lst` unless given.
    Listing,
    /// One row per evaluated direction; none unless given.
    Samples,
    /// A line at the head of the results; repeatable.
    Header,
    /// printf format of each output; `%10g\t` unless given.
    Format,
    /// Polarization basis; psps unless given.
    Basis,
}

impl FilesKey {
    /// Every key.
    pub const ALL: &'static [Self] =
        &[Self::Results, Self::Listing, Self::Samples, Self::Header, Self::Format, Self::Basis];

    /// The word in a program.
    pub fn name(self) -> &'static str {
        match self {
            Self::Results => "results",
            Self::Listing => "listing",
            Self::Samples => "samples",
            Self::Header => "header",
            Self::Format => "format",
            Self::Basis => "basis",
        }
    }

    /// Finds a key by its word in any case.
    pub fn find(word: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|key| key.name().eq_ignore_ascii_case(word))
    }
}

impl FilesSection {
    /// The last value given for `key`, unless it is empty.
    pub fn last(&self, key: FilesKey) -> Option<&SourceText> {
        let found = self.entries.iter().rev().find(|entry| entry.key == key);
        found.map(|entry| &entry.value).filter(|value| !value.as_str().is_empty())
    }

    /// Name of the results file, if given.
    pub fn results(&self) -> Option<&SourceText> {
        self.last(FilesKey::Results)
    }

    /// Name of the listing file, if given.
    pub fn listing(&self) -> Option<&SourceText> {
        self.last(FilesKey::Listing)
    }

    /// Name of the samples file, if given.
    pub fn samples(&self) -> Option<&SourceText> {
        self.last(FilesKey::Samples)
    }

    /// The header lines.
    pub fn headers(&self) -> impl Iterator<Item = &SourceText> {
        self.entries.iter().filter(|entry| entry.key == FilesKey::Header).map(|entry| &entry.value)
    }

    /// The number format as written, if given; an empty one counts.
    pub fn format(&self) -> Option<&SourceText> {
        let found = self.entries.iter().rev().find(|entry| entry.key == FilesKey::Format);
        found.map(|entry| &entry.value)
    }

    /// The polarization basis.
    pub fn basis(&self) -> BasisName {
        let last = self.entries.iter().rev().find(|entry| entry.key == FilesKey::Basis);
        let word = last.map_or("", |entry| entry.value.as_str());
        BasisName::ALL.iter().copied().find(|basis| basis.name() == word).unwrap_or_default()
    }
}
