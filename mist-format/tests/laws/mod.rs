//! Laws of all texts, for the property tests and for `fuzz/`.
//!
//! Each law takes any text, reads it and panics if what was read breaks the law. That reading
//! itself does not panic is the first law of all.

#![allow(unreachable_pub, reason = "the fuzz targets see it from another crate")]

use mist_format::convert::convert;
use mist_format::expr::{Expr, OperandStack, Scope};
use mist_format::number::PrintfFormat;
use mist_format::optics::{IndexText, StackText, TableText};
use mist_format::program::{MAX_PROGRAM_BYTES, Program};
use mist_format::table::{ColumnTable, FormulaFile, ListTable};
use mist_format::{Diagnostic, Dialect, Span, program};

const DIALECTS: [Dialect; 2] = [Dialect::Compat, Dialect::Sound];

/// A program is printed and read again without loss; a refusal has places inside the text.
pub fn program(text: &str) {
    for dialect in DIALECTS {
        match program::parse(text, dialect) {
            Ok(program) => printing_loses_nothing(&program, text, dialect),
            Err(found) => places_lie_inside(&found, text),
        }
    }
}

fn printing_loses_nothing(program: &Program, text: &str, dialect: Dialect) {
    let printed = program.to_string();
    if printed.len() > MAX_PROGRAM_BYTES {
        return;
    }
    let again = program::parse(&printed, dialect)
        .unwrap_or_else(|found| panic!("{found:?}\nin\n{printed}\nfrom\n{text}"));
    assert_eq!(again.to_string(), printed, "printing is stable, from\n{text}");
    let count = (again.comments.len(), program.comments.len());
    assert_eq!(count.0, count.1, "comments are kept, from\n{text}");
    let (mut again, mut program) = (again.without_locations(), program.clone().without_locations());
    // A comment inside an entry moves to a line of its own.
    for comment in again.comments.iter_mut().chain(&mut program.comments) {
        comment.own_line = true;
    }
    assert_eq!(again, program);
}

fn places_lie_inside(found: &[Diagnostic], text: &str) {
    assert!(!found.is_empty(), "a refusal says why, of\n{text}");
    for diagnostic in found {
        let notes = diagnostic.notes.iter().filter_map(|note| note.span);
        for span in std::iter::once(diagnostic.span).chain(notes) {
            assert!(fits(span, text), "{diagnostic:?} of\n{text}");
        }
        assert!(!diagnostic.message.is_empty() && diagnostic.help.is_some(), "{diagnostic:?}");
    }
}

fn fits(span: Span, text: &str) -> bool {
    span.start <= span.end && text.is_char_boundary(span.start) && text.is_char_boundary(span.end)
}

/// Three numbers and a vector, whatever their names are.
struct FourNames;

impl Scope for FourNames {
    fn variable(&self, slot: u32) -> Option<&[f64]> {
        [&[0.5][..], &[-2.0], &[3e7], &[1.0, 2.0, 3.0]].get(slot as usize).copied()
    }
}

/// Values of the sound dialect equal those of the compat dialect; errors have locations.
pub fn expression(text: &str) {
    let [compat, sound] = DIALECTS.map(|dialect| value(Expr::compile(text, dialect), text));
    if let Some(sound) = sound {
        assert_eq!(Some(sound), compat, "of {text}");
    }
    value(Expr::compile_library(text), text);
    if let Ok(format) = PrintfFormat::parse(text) {
        assert!(format.format(-1.5e10).len() < 256, "NIST's buffer has 256 bytes");
    }
}

fn value<E>(compiled: Result<Expr, E>, text: &str) -> Option<String>
where
    E: std::fmt::Display,
{
    let expr = compiled.map_err(|error| assert!(!error.to_string().is_empty())).ok()?;
    match expr.eval(&mut FourNames, &mut OperandStack::default()) {
        Ok(value) => Some(value.to_text()),
        Err(error) => {
            assert!(fits(error.span, text), "{error:?} of {text}");
            None
        }
    }
}

/// A table is sorted and answers with its own values between its first and last row.
pub fn table(text: &str) {
    for dialect in DIALECTS {
        if let Ok(table) = ColumnTable::parse(text, dialect) {
            columns_are_sorted(&table, text);
        }
        if let Ok(list) = ListTable::parse(text, dialect) {
            cells_lie_inside(&list, text);
        }
        let _ = TableText::parse(text, dialect);
    }
    if let Ok(file) = FormulaFile::parse(text) {
        let _ = file.columns_at(0.5, |_| None);
        if let Ok(Some(table)) = file.table(|_| None) {
            columns_are_sorted(&table, text);
        }
    }
}

fn columns_are_sorted(table: &ColumnTable, text: &str) {
    for column in 2..=table.columns().min(8) as i64 {
        let points = table.points(column).expect("the table has the column");
        assert!(points.windows(2).all(|pair| pair[0].0 <= pair[1].0), "sorted, of\n{text}");
        let (low, high) = points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |range, point| {
            (range.0.min(point.1), range.1.max(point.1))
        });
        for x in points.iter().take(4).flat_map(|point| [point.0, point.0 + 0.1, -1.0]) {
            let y = table.look_up(x, column).expect("the table has the column");
            // Rounding of the interpolation between two numbers of the column.
            let slack = 1e-12 * low.abs().max(high.abs());
            let between = low - slack <= y && y <= high + slack;
            assert!(between || !(high - low).is_finite(), "{y} at {x}, of\n{text}");
        }
    }
    assert!(table.look_up(0.5, 1).is_ok(), "column 1 is there, of\n{text}");
}

fn cells_lie_inside(list: &ListTable, text: &str) {
    let columns = list.names().len();
    assert_eq!(list.name_spans().len(), columns);
    for row in 0..list.row_count() {
        for column in 0..columns {
            let _ = list.cell(row, column);
            let span = list.cell_span(row, column).expect("every cell has a place");
            assert!(fits(span, text), "{span:?} of\n{text}");
        }
    }
}

/// Optical constants are numbers, a named file or a formula; a refusal says what to write.
pub fn optics(text: &str) {
    for dialect in DIALECTS {
        match IndexText::parse(text, dialect) {
            Ok(IndexText::Formula { columns, .. }) => {
                let _ = columns.eval(&mut FourNames, &mut OperandStack::default());
            }
            Ok(IndexText::File { column, .. }) => assert!(column < usize::MAX, "k stands behind n"),
            Ok(IndexText::Constant { .. }) => {}
            Err(error) => assert!(!error.help().is_empty() && !error.to_string().is_empty()),
        }
    }
}

/// Both dialects count the same films; films in files have thicknesses.
pub fn stack(text: &str) {
    let films = |dialect| match StackText::parse(text, dialect) {
        Ok(StackText::Films(films)) => Some(films.len()),
        _ => None,
    };
    if let [Some(compat), Some(sound)] = DIALECTS.map(films) {
        assert_eq!(compat, sound, "of {text}");
    }
    for dialect in DIALECTS {
        for film in StackText::parse_file(text, dialect).into_iter().flatten() {
            assert!(film.thickness >= 0.0, "{film:?} of\n{text}");
        }
    }
}

/// A converted text is a program, and converting it again changes nothing.
pub fn archive(bytes: &[u8]) {
    let Ok(text) = convert(bytes) else { return };
    if text.len() <= MAX_PROGRAM_BYTES {
        let again = convert(text.as_bytes());
        assert_eq!(again.as_deref(), Ok(text.as_str()), "converting again changes nothing");
    }
}
