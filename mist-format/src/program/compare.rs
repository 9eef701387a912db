//! Comparison of programs in different layouts.

use super::colour::ColourStatements;
use super::files::{FilesEntry, FilesSection};
use super::integral::{Integral, IntegralParameter};
use super::text::SourceText;
use super::tree::{Comment, ForLoop, ListLoop, Loop, Output, Program, ProgramVariable, Sections};
use crate::span::Span;

impl Program {
    /// The program without locations, for the comparison of programs in different layouts.
    pub fn without_locations(self) -> Self {
        let plain = SourceText::without_location;
        let variable = |v: ProgramVariable| ProgramVariable {
            name: plain(v.name),
            value: plain(v.value),
            kind: v.kind,
        };
        let output = |o: Output| Output {
            number: plain(o.number),
            label: plain(o.label),
            expression: plain(o.expression),
            has_label: o.has_label,
        };
        let file = |entry: FilesEntry| FilesEntry {
            name: plain(entry.name),
            value: plain(entry.value),
            key: entry.key,
        };
        let entries = self.files.entries.into_iter().map(file).collect();
        Self {
            model: plain(self.model),
            variables: self.variables.into_iter().map(variable).collect(),
            loops: self.loops.into_iter().map(Loop::without_locations).collect(),
            integrals: self.integrals.into_iter().map(Integral::without_locations).collect(),
            outputs: self.outputs.into_iter().map(output).collect(),
            files: FilesSection { entries },
            colour: self.colour.map(ColourStatements::without_locations),
            comments: self
                .comments
                .into_iter()
                .map(|c| Comment { span: Span::default(), ..c })
                .collect(),
            blank_lines: Vec::new(),
            trailing: plain(self.trailing),
            sections: Sections::default(),
        }
    }
}

impl Loop {
    fn without_locations(self) -> Self {
        let plain = SourceText::without_location;
        let span = Span::default();
        match self {
            Self::For(each) => Self::For(Box::new(ForLoop {
                variable: plain(each.variable),
                from: plain(each.from),
                to: plain(each.to),
                by: plain(each.by),
                span,
            })),
            Self::List(list) => Self::List(ListLoop { file: plain(list.file), span }),
        }
    }
}

impl Integral {
    fn without_locations(self) -> Self {
        let plain = SourceText::without_location;
        let parameter = |each: IntegralParameter| IntegralParameter {
            name: plain(each.name),
            value: plain(each.value),
        };
        Self {
            name: plain(self.name),
            shape: self.shape,
            shape_text: plain(self.shape_text),
            parameters: self.parameters.into_iter().map(parameter).collect(),
            span: Span::default(),
        }
    }
}
